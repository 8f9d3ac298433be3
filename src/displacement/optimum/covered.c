/* Is a convex region within a union of convex pieces? Proved in doubles.
 *
 * It is if all its corners are in one piece, for pieces are convex; else it is cut in two, across where it is longest,
 * and each half is asked for. If the middle of one is in no piece the answer is no. A region is known up to its blur,
 * a piece's polygon up to its own, and a distance up to a grain: so corners have to be in by these together, and then
 * the disc of radius blur about each is in the true piece (forbidden.c), and so is all that lies between them.
 *
 * What touches the boundary of the union from within can so not be covered: whoever asks leaves some room. A middle
 * that is in no piece is told: it says where the union has a gap. */
#include "displacement/optimum/region.h"
#include "displacement/optimum/tuning.h"

#include <math.h>
#include <string.h>

typedef struct covering {
    const sunder_i_forbidden *forbidden;
    bool *used;
    uint64_t steps, most;
    const sunder_i_forbidden_piece *last; /* that held a region: it may hold the next */
    double *gap;                          /* NULL, or for a place that is in no piece */
} covering;

static bool is_in(covering *c, const sunder_i_forbidden_piece *p, const double u[2], double blur)
{
    c->steps++;
    if (u[0] <= p->box[0] || u[0] >= p->box[2] || u[1] <= p->box[1] || u[1] >= p->box[3]) return false;
    c->steps += p->edges;
    return sunder_i_forbidden_distance(c->forbidden, p, u) < p->radius - (blur + p->vague + c->forbidden->grain);
}

static bool holds(covering *c, const sunder_i_forbidden_piece *p, const sunder_i_region *r)
{
    for (uint32_t k = 0; k < r->n; k++)
        if (!is_in(c, p, r->xy + 2 * k, r->blur)) return false;
    if (c->used) c->used[p - c->forbidden->piece] = true;
    return true;
}

/* The middle of the region, and the direction in which it is longest. */
static void measure(const sunder_i_region *r, double middle[2], double along[2])
{
    double longest = -1;
    middle[0] = middle[1] = 0;
    for (uint32_t k = 0; k < r->n; k++) {
        for (size_t c = 0; c < 2; c++) middle[c] += r->xy[2 * k + c] / r->n;
        for (uint32_t l = k + 1; l < r->n; l++) {
            const double x = r->xy[2 * l] - r->xy[2 * k], y = r->xy[2 * l + 1] - r->xy[2 * k + 1];
            if (x * x + y * y <= longest) continue;
            longest = x * x + y * y;
            along[0] = x;
            along[1] = y;
        }
    }
    longest = sqrt(longest);
    for (size_t c = 0; c < 2; c++) along[c] = longest > 0 ? along[c] / longest : (double)(c == 0);
}

static bool is_covered(covering *c, const sunder_i_region *r, int depth)
{
    double middle[2], along[2];
    bool any = false;
    if (r->n == 0) return true;
    if (c->last && holds(c, c->last, r)) return true;
    measure(r, middle, along);
    const double at[4] = {middle[0], middle[1], middle[0], middle[1]};
    sunder_i_forbidden_walk walk;
    sunder_i_forbidden_start(&walk, c->forbidden);
    for (const sunder_i_forbidden_piece *p; (p = sunder_i_forbidden_next(&walk, c->forbidden, at));) {
        if (!is_in(c, p, middle, r->blur)) continue;
        any = true;
        if (p == c->last || !holds(c, p, r)) continue;
        c->last = p;
        c->steps += walk.looks;
        return true;
    }
    c->steps += walk.looks;
    if (!any && c->gap) memcpy(c->gap, middle, sizeof middle);
    if (!any || depth == COVER_DEPTH || c->steps > c->most) return false;
    const double d = along[0] * middle[0] + along[1] * middle[1], back[2] = {-along[0], -along[1]};
    sunder_i_region half = *r;
    sunder_i_region_clip(&half, along, d, SUNDER_I_NO_CUT, c->forbidden->grain);
    if (!is_covered(c, &half, depth + 1)) return false;
    half = *r;
    sunder_i_region_clip(&half, back, -d, SUNDER_I_NO_CUT, c->forbidden->grain);
    return is_covered(c, &half, depth + 1);
}

bool sunder_i_region_is_covered(const sunder_i_region *region, const sunder_i_forbidden *forbidden, bool *used,
                                double gap[2], uint64_t *steps)
{
    covering c = {.forbidden = forbidden, .used = used, .most = COVER_STEPS, .gap = gap};
    if (gap) gap[0] = gap[1] = NAN;
    const bool covered = is_covered(&c, region, 0);
    *steps += c.steps;
    return covered;
}
