/* carry.c: the new place of a vertex. Its exact place is from + move. The rounded sum may lie on the other side of a
 * wall, so the doubles about it are tried, nearest first, until one is as far inside as the vertex was. */
#include "follow/follow.h"

#include <math.h>

/* Doubles are tried that are at most this many steps from the rounded sum, along each axis. Beside a straight wall, or
 * in a corner that is not very sharp, one or two steps are enough. */
enum { MOST_STEPS = 12 };

/* The member of a group that held a vertex: one whose vertex it was, else one that has it in its interior, else one
 * that has it on its boundary. */
typedef struct holding {
    const gis_follow_targets *targets;
    size_t group, holder;
    sunder_point at;
    int side; /* as of sunder_shape_locate(); -1: there is none yet */
} holding;

static bool look_for_holder(void *user, size_t i)
{
    holding *h = user;
    const gis_follow_target *target = &h->targets->target[i];
    if (target->group != h->group || !target->home) return true;
    const bool was_vertex = gis_follow_was_vertex(target, &h->at);
    const int side = was_vertex ? 0 : sunder_shape_locate(target->home, &h->at);
    if (was_vertex || side > h->side) {
        h->side = side;
        h->holder = i;
    }
    return !was_vertex;
}

/* x + d = *sum + *rest exactly, unless it overflows (Knuth's two-sum). */
static void add_exactly(double x, double d, double *sum, double *rest)
{
    const double s = x + d, b = s - x;
    *sum = s;
    *rest = (x - (s - b)) + (d - b);
}

static double step_by(double x, int steps)
{
    for (; steps > 0; steps--) x = nextafter(x, INFINITY);
    for (; steps < 0; steps++) x = nextafter(x, -INFINITY);
    return x;
}

/* Sets `to` to the nearest doubles about `sum` + `rest` that the shape holds at least as far inside as `side` says.
 * Differences of close doubles are exact. Returns false, and leaves `to`, if it tries no such doubles. */
static bool find_inside(const sunder_shape *shape, int side, const double sum[2], const double rest[2], double to[2])
{
    double least = INFINITY;
    for (int i = -MOST_STEPS; i <= MOST_STEPS; i++)
        for (int j = -MOST_STEPS; j <= MOST_STEPS; j++) {
            const sunder_point at = {step_by(sum[0], i), step_by(sum[1], j)};
            const double off = hypot(at.x - sum[0] - rest[0], at.y - sum[1] - rest[1]);
            if (off >= least || sunder_shape_locate(shape, &at) < side) continue;
            least = off;
            to[0] = at.x;
            to[1] = at.y;
        }
    return least < INFINITY;
}

bool gis_follow_carry(const gis_follow_targets *targets, size_t target, const double from[2], double to[2], bool *kept,
                      gis_error *error)
{
    const double *move = targets->target[target].move;
    double sum[2], rest[2];
    holding h = {targets, targets->target[target].group, 0, {from[0], from[1]}, -1};
    for (int k = 0; k < 2; k++) add_exactly(from[k], move[k], &sum[k], &rest[k]);
    to[0] = sum[0];
    to[1] = sum[1];
    if (move[0] == 0 && move[1] == 0) return true;
    const double box[4] = {from[0], from[1], from[0], from[1]};
    if (!gis_follow_near(targets, box, 0, look_for_holder, &h, error)) return false;
    const sunder_point at = {to[0], to[1]};
    if (h.side < 0 || sunder_shape_locate(targets->target[h.holder].now, &at) >= h.side) return true;
    if (!find_inside(targets->target[h.holder].now, h.side, sum, rest, to)) *kept = false;
    return true;
}
