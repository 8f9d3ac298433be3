/* Is a convex region contained in a union of convex pieces? Proved in doubles.
 *
 * It is if all its corners are in one piece, since pieces are convex. Otherwise it is cut in two, and each half is
 * tested. The cut goes through the piece that contains the region's middle and most of its corners, just inside the
 * piece's boundary at the corner that is farthest outside, so that pieces which overlap in a strip need to meet only
 * there. If that line hardly cuts the region, the cut is across its longest extent. So is every second one of many
 * cuts: lines at the boundary of a piece with an arc may cut off ever thinner slivers. If the middle of a part is in no
 * piece the answer is no.
 *
 * Where a slope S is given, a priced piece contains a corner v if v lacks more than S(v): its distance from K, which is
 * negative inside, and S(v) add up to less than the radius. Distance and S are convex functions, so this holds for the
 * whole region if it holds at its corners.
 *
 * A region is known up to its blur, a piece's polygon up to its own error (`vague`), and a distance up to a grain. So
 * corners have to be inside by the sum of the three. Then the disc of radius blur around each corner is in the true
 * piece (forbidden.c), and so is everything between them.
 *
 * A region that touches the boundary of the union from within cannot be shown to be covered: callers leave some room.
 * An uncovered middle is returned, as it shows a gap of the union. So is the middle of a region too small to be divided
 * again: there the union has a gap without width, between pieces that only touch. */
#include "displacement/prove/optimum/region.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

typedef struct covering {
    const sunder_i_forbidden *forbidden;
    const sunder_i_slope *slope; /* for priced pieces; NULL if there are none */
    double steep;                /* 1 and the slope's greatest derivative, or more; 1 without a slope */
    bool *used;
    uint64_t steps, most;
    const sunder_i_forbidden_piece *last; /* the last piece that contained a region: it may contain the next one */
    double *gap;                          /* NULL, or receives a place that is in no piece */
    sunder_i_regions *left;               /* NULL, or receives the uncovered regions */
} covering;

/* Does u lack more than the slope there, by a priced piece? */
static bool lacks_more(covering *c, const sunder_i_forbidden_piece *p, const double u[2], double blur)
{
    c->steps += 1 + p->edges;
    return sunder_i_forbidden_distance(c->forbidden, p, u) + sunder_i_slope_at(c->slope, u) <
           p->radius - p->vague - (blur + c->forbidden->grain) * c->steep;
}

static bool is_in(covering *c, const sunder_i_forbidden_piece *p, const double u[2], double blur)
{
    if (p->priced) return lacks_more(c, p, u, blur);
    c->steps++;
    if (u[0] <= p->box[0] || u[0] >= p->box[2] || u[1] <= p->box[1] || u[1] >= p->box[3]) return false;
    c->steps += p->edges;
    const double deep = blur + p->vague + c->forbidden->grain;
    if (p->radius > 0) return sunder_i_forbidden_distance(c->forbidden, p, u) < p->radius - deep;
    const sunder_i_obstacle_edge *edge = c->forbidden->edge + p->edge, *end = edge + p->edges;
    for (; edge < end; edge++)
        if (!(edge->n[0] * (u[0] - edge->from[0]) + edge->n[1] * (u[1] - edge->from[1]) < -deep)) return false;
    return true;
}

/* Returns the number of the region's corners in piece p. If all are in it, p contains the region and is marked as
 * used. */
static uint32_t corners_in(covering *c, const sunder_i_forbidden_piece *p, const sunder_i_region *r)
{
    uint32_t n = 0;
    for (uint32_t k = 0; k < r->n; k++) n += is_in(c, p, r->xy + 2 * k, r->blur);
    if (n == r->n && c->used) c->used[p - c->forbidden->piece] = true;
    return n;
}

/* Sets `middle` to the mean of the region's corners, and `along` to the direction of its longest extent. */
static void measure_region(const sunder_i_region *r, double middle[2], double along[2])
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

/* Returns the distance of u from the piece grown by its radius, measured along the normal of one line; negative inside.
 * The line n.u = *d is the one beyond which u lies farthest. */
static double distance_outside(covering *c, const sunder_i_forbidden_piece *p, const double u[2], double n[2],
                               double *d)
{
    double most = -INFINITY;
    c->steps += p->edges;
    if (p->priced) {
        most = sunder_i_forbidden_normal(c->forbidden, p, u, n) + sunder_i_slope_at(c->slope, u) - p->radius;
        for (int k = 0; k < 2; k++) n[k] -= c->slope->n[k] / c->slope->share;
        const double length = hypot(n[0], n[1]);
        if (!(length > 0)) return 0;
        for (int k = 0; k < 2; k++) n[k] /= length;
        *d = n[0] * u[0] + n[1] * u[1] - most / length;
        return most / length;
    }
    if (p->radius > 0) {
        most = sunder_i_forbidden_normal(c->forbidden, p, u, n) - p->radius;
        *d = n[0] * u[0] + n[1] * u[1] - most;
        return most;
    }
    for (uint32_t k = 0; k < p->edges; k++) {
        const sunder_i_obstacle_edge *e = &c->forbidden->edge[p->edge + k];
        const double off = e->n[0] * (u[0] - e->from[0]) + e->n[1] * (u[1] - e->from[1]);
        if (!(off > most)) continue;
        most = off;
        memcpy(n, e->n, sizeof e->n);
        *d = e->n[0] * e->from[0] + e->n[1] * e->from[1];
    }
    return most;
}

/* Finds a line n.u = *d just inside the piece at the region's corner that is farthest outside of it. Returns false if
 * the line would hardly pass between that corner and the middle. */
static bool find_leaving(covering *c, const sunder_i_forbidden_piece *p, const sunder_i_region *r,
                         const double middle[2], double n[2], double *d)
{
    double farthest = 0;
    for (uint32_t k = 0; k < r->n; k++) {
        double normal[2] = {0, 0}, level = 0;
        const double off = distance_outside(c, p, r->xy + 2 * k, normal, &level);
        if (!(off > farthest)) continue;
        farthest = off;
        *d = level;
        memcpy(n, normal, sizeof normal);
    }
    const double room = farthest > 0 ? LEAVING_ROOM * (*d - (n[0] * middle[0] + n[1] * middle[1])) : 0;
    *d -= room;
    return room > 4 * (r->blur + p->vague + c->forbidden->grain) * c->steep;
}

static bool is_covered(covering *c, const sunder_i_region *r, int depth);

/* Cuts the region by the line n.u = d and tests both halves. */
static bool are_halves_covered(covering *c, const sunder_i_region *r, const double n[2], double d, int depth)
{
    const double back[2] = {-n[0], -n[1]};
    sunder_i_region half = *r;
    sunder_i_region_clip(&half, back, -d, SUNDER_I_NO_CUT, c->forbidden->grain);
    if (!is_covered(c, &half, depth + 1)) return false;
    half = *r;
    sunder_i_region_clip(&half, n, d, SUNDER_I_NO_CUT, c->forbidden->grain);
    return is_covered(c, &half, depth + 1);
}

/* Appends an uncovered region to the list, if there is one, and returns true: the region then counts as covered for
 * now. Such regions are small and few. */
static bool leave_over(covering *c, const sunder_i_region *r)
{
    return c->left && sunder_i_reserve(&c->left->item, &c->left->capacity, c->left->n + 1, sizeof *c->left->item) &&
           (c->left->item[c->left->n++] = *r, true);
}

static bool is_covered(covering *c, const sunder_i_region *r, int depth)
{
    double middle[2], along[2], d = 0;
    if (r->n == 0) return true;
    if (c->last && corners_in(c, c->last, r) == r->n) return true;
    measure_region(r, middle, along);
    const double at[4] = {middle[0], middle[1], middle[0], middle[1]};
    const sunder_i_forbidden_piece *most = NULL;
    uint32_t in_most = 0;
    sunder_i_forbidden_walk walk;
    sunder_i_forbidden_start(&walk, c->forbidden);
    for (const sunder_i_forbidden_piece *p; (p = sunder_i_forbidden_next(&walk, c->forbidden, at));) {
        if (!is_in(c, p, middle, r->blur)) continue;
        const uint32_t n = p == c->last ? 0 : corners_in(c, p, r);
        if (most && n <= in_most) continue;
        most = p;
        in_most = n;
        if (n < r->n) continue;
        c->last = p;
        c->steps += walk.looks;
        return true;
    }
    c->steps += walk.looks;
    if (c->gap && (!most || depth == COVER_DEPTH)) memcpy(c->gap, middle, sizeof middle);
    if ((!most && (!c->left || depth >= LEFT_DEPTH)) || depth == COVER_DEPTH || c->steps > c->most)
        return leave_over(c, r);
    const bool across = depth >= ACROSS_FROM && depth % 2;
    if (!most || across || !find_leaving(c, most, r, middle, along, &d)) {
        measure_region(r, middle, along);
        d = along[0] * middle[0] + along[1] * middle[1];
    }
    return are_halves_covered(c, r, along, d, depth);
}

bool sunder_i_region_is_covered(const sunder_i_region *region, const sunder_i_forbidden *forbidden, bool *used,
                                double gap[2], uint64_t *steps)
{
    covering c = {.forbidden = forbidden, .steep = 1, .used = used, .most = COVER_STEPS, .gap = gap};
    if (gap) gap[0] = gap[1] = NAN;
    const bool covered = is_covered(&c, region, 0);
    *steps += c.steps;
    return covered;
}

bool sunder_i_region_lacks(const sunder_i_region *region, const sunder_i_forbidden *forbidden,
                           const sunder_i_slope *slope, bool *used, double gap[2], uint64_t *steps)
{
    const double steep = 2 * (1 + (fabs(slope->n[0]) + fabs(slope->n[1])) / slope->share);
    covering c = {
        .forbidden = forbidden, .slope = slope, .steep = steep, .used = used, .most = COVER_STEPS, .gap = gap};
    gap[0] = gap[1] = NAN;
    const bool covered = is_covered(&c, region, 0);
    *steps += c.steps;
    return covered;
}

bool sunder_i_region_cover(const sunder_i_region *region, const sunder_i_forbidden *forbidden, sunder_i_regions *left,
                           uint64_t *steps)
{
    covering c = {.forbidden = forbidden, .steep = 1, .most = COVER_STEPS, .left = left};
    const bool ok = is_covered(&c, region, 0);
    *steps += c.steps;
    return ok;
}
