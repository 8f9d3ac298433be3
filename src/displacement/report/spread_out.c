/* Makes a layout of a cluster without a search: the cluster, together with all bodies that stand where it expands to,
 * is stretched about its centre by one factor sx along x and one factor sy along y. Each body moves with the centre of
 * its box.
 *
 * The boxes of two bodies keep the gap along x if sx is at least the required distance of their centres along x divided
 * by the present one; likewise along y with sy. A pair that keeps the gap along an axis comes no nearer along it. So
 * each conflict needs either sx >= x or sy >= y, with numbers x and y of its own, shown as the points (x, y):
 *
 *       sy |  x
 *          |    x   x
 *          |  x   x
 *          +----------- sx
 *
 * A pair of factors (sx, sy) is sufficient if each point lies to its left or below it. Such pairs are bounded by a
 * staircase; the corner of the staircase is chosen for which a corner of the cluster's box, the farthest place from the
 * centre, moves least. The boxes of features at an angle need larger factors than the features do, and features that
 * are no boxes may still be in conflict afterwards. The caller has to check. */
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"
#include "displacement/solve/clusters/solver.h"

#include "base/extremes.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* The factors that a conflict needs: a factor of at least x along x, or of at least y along y. */
typedef struct asked {
    double x, y;
} asked;

static int by_x_from_the_greatest(const void *a, const void *b)
{
    const asked *p = a, *q = b;
    return p->x != q->x ? (p->x < q->x ? 1 : -1) : (p->y < q->y) - (p->y > q->y);
}

/* Computes the centre and the half extents of the body's box at its original position. */
static void box_of(const sunder_i_solver *s, uint32_t body, double middle[2], double half[2])
{
    const double home[2] = {0, 0};
    double box[4];
    sunder_i_body_box(&s->model.body[body], home, 0, box);
    for (int c = 0; c < 2; c++) {
        middle[c] = box[c] + (box[c + 2] - box[c]) / 2;
        half[c] = (box[c + 2] - box[c]) / 2;
    }
}

/* Returns the factors that separate the boxes of bodies i and j by the gap. */
static asked factors_for(const sunder_i_solver *s, uint32_t i, uint32_t j)
{
    double at[2], from[2], half[2], other[2], need[2];
    box_of(s, i, at, half);
    box_of(s, j, from, other);
    for (int c = 0; c < 2; c++) need[c] = (half[c] + other[c] + s->model.rules.gap) / fabs(at[c] - from[c]);
    return (asked){need[0], need[1]};
}

/* Returns the factors needed by the conflicts of these bodies at the start, which the caller frees, and sets *n to
 * their number. Returns NULL if memory is out. */
static asked *list_asked(const sunder_i_solver *s, const uint32_t *body, size_t bodies, size_t *n)
{
    asked *list = sunder_i_alloc(1, sizeof *list);
    size_t capacity = list ? 1 : 0;
    *n = 0;
    for (size_t k = 0; k < bodies && list; k++) {
        const sunder_i_body *b = &s->model.body[body[k]];
        for (uint32_t m = 0; m < b->members; m++) {
            const sunder_i_relation first = {.a = s->model.member[b->member + m]};
            size_t at = sunder_i_lower_bound(&first, s->start.pair, s->start.n, sizeof first, sunder_i_by_id_pair);
            for (; at < s->start.n && s->start.pair[at].a == first.a; at++) {
                const sunder_i_relation *r = &s->start.pair[at];
                if (sunder_i_is_barrier(&s->model, r->b) || !sunder_i_is_conflict_of_bodies(&s->model, r)) continue;
                if (!sunder_i_reserve(&list, &capacity, *n + 1, sizeof *list)) {
                    sunder_i_free(list);
                    return NULL;
                }
                list[(*n)++] = factors_for(s, body[k], s->model.body_of[r->b]);
            }
        }
    }
    return list;
}

/* Chooses the pair of factors for which a corner of the cluster's box, of half extents half[], moves least. Returns
 * false if there is none. */
static bool choose_factors(asked *list, size_t n, const double half[2], double factor[2])
{
    double y = 1, least = INFINITY;
    if (n) qsort(list, n, sizeof *list, by_x_from_the_greatest);
    for (size_t k = 0; k <= n; k++) {
        const double x = k < n ? sunder_i_max(1, list[k].x) : 1, length = hypot((x - 1) * half[0], (y - 1) * half[1]);
        if (length < least) {
            least = length;
            factor[0] = x;
            factor[1] = y;
        }
        if (k < n) y = sunder_i_max(y, list[k].y);
    }
    return isfinite(least);
}

/* Computes the centre and the half extents of the box around the centres of the n bodies; this box is what is
 * stretched. */
static void find_extent(const sunder_i_solver *s, const uint32_t *body, size_t n, double middle[2], double half[2])
{
    double box[4];
    sunder_i_box_clear(box);
    for (size_t k = 0; k < n; k++) {
        double at[2], own[2];
        box_of(s, body[k], at, own);
        sunder_i_box_include(box, at);
    }
    for (int c = 0; c < 2; c++) {
        middle[c] = box[c] + (box[c + 2] - box[c]) / 2;
        half[c] = (box[c + 2] - box[c]) / 2;
    }
}

/* Returns a power of 2 whose multiples the moves are: at least the unit in the last place of the largest coordinate
 * that can occur, so that moved coordinates are exact. */
static double unit_of(const double middle[2], const double half[2], const double factor[2])
{
    double largest = 0;
    for (int c = 0; c < 2; c++) largest = sunder_i_max(largest, fabs(middle[c]) + 2 * factor[c] * half[c]);
    int exponent;
    frexp(largest, &exponent);
    return largest > 0 ? ldexp(1, exponent - DBL_MANT_DIG) : 1;
}

/* The centre, the half extents and the factors by which a cluster is stretched. */
typedef struct stretch {
    double middle[2], half[2], factor[2];
} stretch;

/* Appends the movable bodies that reach into the stretched box. Returns false if memory is out. */
static bool take_in(const sunder_i_solver *s, const stretch *g, sunder_i_list *body)
{
    sunder_i_list near = {0};
    double box[4];
    for (size_t c = 0; c < 4; c++) {
        const double reach = g->factor[c & 1] * g->half[c & 1] + s->model.rules.gap;
        box[c] = g->middle[c & 1] + (c < 2 ? -reach : reach);
    }
    bool ok = sunder_i_look_about(&s->model, &s->model.tree, box, &near);
    for (size_t k = 0; k < near.n && ok; k++) {
        const uint32_t b = s->model.body_of[near.item[k]];
        if (sunder_i_may_move(&s->model.body[b])) ok = sunder_i_list_push(body, b);
    }
    sunder_i_free(near.item);
    body->n = sunder_i_set_make(body->item, body->n);
    return ok;
}

/* Computes the stretch that the conflicts of all these bodies need. Sets *found to whether there is one. */
static sunder_status find_stretch(const sunder_i_solver *s, const sunder_i_list *body, stretch *g, bool *found,
                                  sunder_error *err)
{
    size_t asks;
    asked *list = list_asked(s, body->item, body->n, &asks);
    if (!list) return sunder_i_failure_cause(err);
    find_extent(s, body->item, body->n, g->middle, g->half);
    *found = choose_factors(list, asks, g->half, g->factor);
    sunder_i_free(list);
    return SUNDER_OK;
}

sunder_status sunder_i_spread_out(const sunder_i_solver *solver, sunder_i_list *body, double *goal, bool *found,
                                  sunder_error *err)
{
    const size_t most = SPREAD_TIMES * body->n + SPREAD_MOST;
    stretch g = {.factor = {1, 1}};
    sunder_status status = SUNDER_OK;
    *found = true;
    for (size_t n = 0; *found && n != body->n && !status;) {
        n = body->n;
        status = find_stretch(solver, body, &g, found, err);
        if (!status && *found && !take_in(solver, &g, body)) status = sunder_i_failure_cause(err);
        *found = *found && body->n <= most;
    }
    const double unit = unit_of(g.middle, g.half, g.factor);
    for (size_t k = 0; k < body->n && *found && !status; k++) {
        double at[2], own[2];
        box_of(solver, body->item[k], at, own);
        for (size_t c = 0; c < 2; c++) {
            const double to = (g.factor[c] - 1) * (1 + SPREAD_MARGIN) * (at[c] - g.middle[c]);
            goal[2 * (size_t)body->item[k] + c] = unit * rint(to / unit);
        }
    }
    return status;
}
