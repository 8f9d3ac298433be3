/* One convex piece for the depth of several.
 *
 * Two things that overlap lack the distance that they have to keep, and the length of the least translation that takes
 * their interiors apart. Of two convex pieces that is how deep u lies in the set K of the moves at which these overlap.
 * Where several such sets join, the depth in their union is greater than in each. Any convex polygon Q in the union
 * shows a part of it: u is at least as deep in the union as in Q, and no farther from the union than from Q. So Q
 * counts like the set of one pair of convex pieces.
 *
 * Q is made around a place u, like the free regions of [DT15] but the other way round. It begins as a square. As long
 * as a place in it is in none of the sets, it is clipped: across the way from u to the nearest place outside in about
 * that direction. So no side is nearer to u than the nearest way out.
 *
 * An outline with many corners may need too many clips, or leave Q too many corners. The disc around u as far as the
 * nearest way out lies in the sets, and shows the same depth. So Q then begins as a polygon around this disc, and at
 * last as one within the disc, which shows the depth but for half a percent. */
#include "displacement/prove/optimum/tree.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

#define TURN 6.28318530717958647692

typedef struct growing {
    const sunder_i_forbidden *inner; /* the sets to be joined, not grown */
    double u[2];
    uint64_t *steps;
} growing;

/* Is piece p of the two things? */
static bool is_of(const sunder_i_model *model, const sunder_i_forbidden_piece *p, uint32_t f, uint32_t g)
{
    return p->priced && !p->row && !p->joined && sunder_i_whole_of(model, p->a->feature) == f &&
           sunder_i_whole_of(model, p->b->feature) == g;
}

/* Sets *inner to the sets of overlap of the two things. Returns false if memory is out. */
static bool find_inner(const sunder_i_model *model, const sunder_i_forbidden *pieces, uint32_t f, uint32_t g,
                       sunder_i_forbidden *inner)
{
    *inner = (sunder_i_forbidden){.edge = pieces->edge, .size = pieces->size, .grain = pieces->grain};
    inner->piece = sunder_i_alloc(pieces->pieces, sizeof *inner->piece);
    for (size_t k = 0; k < pieces->pieces && inner->piece; k++) {
        const sunder_i_forbidden_piece *p = &pieces->piece[k];
        if (!is_of(model, p, f, g) || p->edges < 3) continue;
        sunder_i_forbidden_piece *to = &inner->piece[inner->pieces++];
        *to = *p;
        to->priced = false;
        to->radius = to->within = 0;
    }
    return inner->piece;
}

/* Returns how far it is from u to a place outside along the direction of an angle. */
static double way_out(const growing *g, double angle)
{
    const double dir[2] = {cos(angle), sin(angle)};
    *g->steps += g->inner->pieces;
    return sunder_i_forbidden_exit(g->inner, g->u, dir, 4 * g->inner->size);
}

/* Turns the direction of an angle, by less than `turn`, to where the way out is shortest nearby. Returns its length. */
static double shorten_way(const growing *g, double turn, double *angle)
{
    double least = way_out(g, *angle);
    for (; turn > 0x1p-24; turn /= 2)
        for (int side = -1; side < 2; side += 2) {
            const double out = way_out(g, *angle + side * turn);
            if (out >= least) continue;
            least = out;
            *angle += side * turn;
        }
    return least;
}

static double nearest_way_out(const growing *g)
{
    const double step = TURN / SUNDER_I_TREE_RAYS;
    double least = INFINITY, angle = 0;
    for (int k = 0; k < SUNDER_I_TREE_RAYS; k++) {
        const double out = way_out(g, k * step);
        if (out >= least) continue;
        least = out;
        angle = k * step;
    }
    return shorten_way(g, step / 2, &angle);
}

/* Clips the region so that it does not contain a place that is in no set. */
static void clip_off(const growing *g, sunder_i_region *region, const double place[2])
{
    const double x = place[0] - g->u[0], y = place[1] - g->u[1], far = hypot(x, y), straight = atan2(y, x);
    double angle = straight, out = shorten_way(g, JOINED_TURN, &angle);
    if (!(out < far * cos(angle - straight))) {
        angle = straight;
        out = sunder_i_min(far, way_out(g, straight));
    }
    const double n[2] = {-cos(angle), -sin(angle)};
    sunder_i_region_clip(region, n, n[0] * g->u[0] + n[1] * g->u[1] - out * (1 - JOINED_ROOM), SUNDER_I_NO_CUT,
                         g->inner->grain);
}

/* Clips the region until it lies in the sets. Returns false if that did not end, or left it too many corners. */
static bool clip_to_sets(const growing *g, sunder_i_region *region)
{
    for (int round = 0; round < JOINED_ROUNDS && region->n; round++) {
        double gap[2];
        if (sunder_i_region_is_covered(region, g->inner, NULL, gap, g->steps))
            return region->n <= SUNDER_I_JOINED_CORNERS;
        if (!(fabs(gap[0]) < INFINITY)) return false;
        clip_off(g, region, gap);
    }
    return false;
}

/* Makes the regular polygon around u whose sides are at the distance `within`. */
static void init_regular(const growing *g, int sides, double within, sunder_i_region *region)
{
    sunder_i_region_init(region, g->u, within);
    for (int k = 0; k < sides; k++) {
        const double angle = TURN * k / sides, n[2] = {-cos(angle), -sin(angle)};
        sunder_i_region_clip(region, n, n[0] * g->u[0] + n[1] * g->u[1] - within, SUNDER_I_NO_CUT, g->inner->grain);
    }
}

/* Makes the polygon. Returns false if none was found. */
static bool grow(const growing *g, double depth, sunder_i_region *region)
{
    const double near = depth * (1 - JOINED_ROOM), halved = TURN / 2 / SUNDER_I_JOINED_CORNERS;
    sunder_i_region_init(region, g->u, sunder_i_min(8 * depth, 2 * g->inner->size));
    if (clip_to_sets(g, region)) return true;
    init_regular(g, AROUND_DISC, near, region);
    if (clip_to_sets(g, region)) return true;
    init_regular(g, SUNDER_I_JOINED_CORNERS, near * cos(halved), region);
    return clip_to_sets(g, region);
}

bool sunder_i_join_pieces(const sunder_i_model *model, const sunder_i_forbidden *pieces, uint32_t f, uint32_t g,
                          const double u[2], double more, sunder_i_joined *out, bool *any, uint64_t *steps)
{
    sunder_i_forbidden inner;
    sunder_i_region region;
    *any = false;
    if (!find_inner(model, pieces, f, g, &inner)) return false;
    const growing way = {.inner = &inner, .u = {u[0], u[1]}, .steps = steps};
    size_t guess = SIZE_MAX;
    if (inner.pieces > 1 && sunder_i_forbidden_is_deeper(&inner, u, 0, &guess)) {
        const double depth = nearest_way_out(&way);
        if (depth > more) *any = grow(&way, depth, &region);
    }
    if (*any) {
        *out = (sunder_i_joined){.f = f, .g = g, .corners = region.n, .blur = region.blur};
        memcpy(out->corner, region.xy, 2 * region.n * sizeof *out->corner);
    }
    sunder_i_free(inner.piece);
    return true;
}

bool sunder_i_joined_find_parts(const sunder_i_model *model, const sunder_i_forbidden *pieces, uint32_t joined,
                                bool *used)
{
    const sunder_i_forbidden_piece *p = &pieces->piece[joined];
    const uint32_t f = sunder_i_whole_of(model, p->a->feature), g = sunder_i_whole_of(model, p->b->feature);
    sunder_i_forbidden inner;
    sunder_i_region region = {.n = p->edges};
    uint64_t steps = 0;
    for (uint32_t k = 0; k < p->edges; k++)
        memcpy(region.xy + 2 * k, pieces->edge[p->edge + k].from, 2 * sizeof *region.xy);
    bool ok = find_inner(model, pieces, f, g, &inner);
    bool *of_inner = sunder_i_calloc(inner.pieces, sizeof *of_inner);
    if (ok && of_inner) {
        const bool known = sunder_i_region_is_covered(&region, &inner, of_inner, NULL, &steps);
        for (size_t k = 0, m = 0; k < pieces->pieces && m < inner.pieces; k++) {
            if (pieces->piece[k].edge != inner.piece[m].edge) continue;
            used[k] = !known || of_inner[m];
            m++;
        }
    }
    ok = ok && of_inner;
    sunder_i_free_all(inner.piece, of_inner);
    return ok;
}
