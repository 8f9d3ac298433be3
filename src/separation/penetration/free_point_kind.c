/* free_point_kind.c: classifies a free point by the cones that the subsums cover around it.
 *
 * Each subsum with the point on its boundary covers an open cone there, at most a half-plane. If the closures of all
 * cones leave an angle open, the point is on the boundary of the regularised obstacle: on an edge if the union of the
 * open cones is exactly one open half-plane, else it is a vertex. If they leave none, the point is degenerate: a
 * degenerate point if the open cones cover every direction, a point of a degenerate segment if some direction is
 * left. */
#include "separation/penetration/penetration_search.h"

typedef struct cone {
    sunder_i_point from, to; /* counterclockwise; at most pi */
} cone;

static int opposite_or_same(sunder_i_operands *g, sunder_i_point u, sunder_i_point v)
{
    return sunder_i_operands_cross(g, u, v) == 0 ? sunder_i_operands_dot(g, u, v) : 0;
}

static bool strictly_inside(sunder_i_operands *g, const cone *c, sunder_i_point r)
{
    return sunder_i_operands_cross(g, c->from, r) > 0 && sunder_i_operands_cross(g, r, c->to) > 0;
}

static sunder_i_point negative_point(sunder_i_operands *g, sunder_i_point u)
{
    return g->placed.lattice.narrow ? (sunder_i_point){-u.x, -u.y} : sunder_i_point_neg(&g->placed.lattice, u);
}

typedef enum where { OFF, BESIDE, ON } where; /* OFF: farther away than twice the error of doubles */

/* Returns the position of the point relative to the subsum. ON: it is on the boundary, and *out becomes the cone that
 * the subsum covers there. BESIDE: it is not on the boundary but too near for doubles to decide. OFF: it is farther
 * away. */
static where cone_of(sunder_i_operands *g, const sunder_i_free_point *f, sunder_i_subsum *s, cone *out)
{
    if (!sunder_i_box_near_point(s->box, f->x, f->y, 4 * g->error)) return OFF;
    if (!s->sides && !sunder_i_subsum_make(g, s)) return OFF;
    uint32_t on[2], n = 0, doubt = 0;
    const bool few = s->sides <= SUNDER_I_SIDES_IN_A_WORD;
    bool beside = false;
    if (few && !sunder_i_subsum_may_hold(s, f->x, f->y, 2, &doubt)) return OFF;
    for (uint32_t k = 0; few ? doubt != 0 : k < s->sides; k++) {
        if (few) {
            k = (uint32_t)__builtin_ctz(doubt);
            doubt &= doubt - 1;
        } else {
            const double v = s->sx[k] * (f->y - s->cy[k]) - s->sy[k] * (f->x - s->cx[k]);
            if (v > s->bound[k]) continue;
            if (v < -2 * s->bound[k]) return OFF;
        }
        const int side = beside ? -1 : sunder_i_carrier_side(g, &f->line, &f->t, s, k);
        beside |= side < 0;
        if (side == 0 && n < 2) on[n++] = k;
    }
    if (beside || n == 0) return BESIDE;
    /* if two sides contain the point it is their common vertex: `last` arrives there and `first` leaves */
    const uint32_t first = n == 2 ? (on[0] + 1 == on[1] ? on[1] : on[0]) : on[0];
    const uint32_t last = n == 2 ? (first == on[1] ? on[0] : on[1]) : on[0];
    out->from = s->side[first];
    out->to = negative_point(g, s->side[last]);
    return ON;
}

static sunder_i_point *sorted_rays(sunder_i_operands *g, const cone *cones, size_t n, size_t *rays)
{
    sunder_i_point *r = sunder_i_arena_alloc(&g->placed.lattice.arena, 2 * n, sizeof *r);
    *rays = 0;
    if (!r) return NULL;
    for (size_t i = 0; i < 2 * n; i++) {
        const sunder_i_point v = i & 1 ? cones[i / 2].to : cones[i / 2].from;
        size_t k = *rays;
        int c = 1;
        while (k > 0 && (c = sunder_i_angle_cmp(&g->placed.lattice, r[k - 1], v)) > 0) k--;
        if (k > 0 && c == 0) continue;
        for (size_t m = (*rays)++; m > k; m--) r[m] = r[m - 1];
        r[k] = v;
    }
    return r;
}

typedef struct around {
    size_t open_arcs, open_rays; /* the numbers of arcs and of rays that no cone covers */
    size_t start;                /* the ray at which the covered part after an open arc begins, if `starts` is 1 */
    size_t starts;
} around;

static around look_around(sunder_i_operands *g, const cone *cones, size_t n, const sunder_i_point *ray, size_t rays,
                          bool *arc_covered)
{
    around a = {0, 0, 0, 0};
    for (size_t k = 0; k < rays; k++) {
        bool inside = false, begins = false;
        for (size_t i = 0; i < n && !inside; i++) {
            inside = strictly_inside(g, cones + i, ray[k]);
            begins |= opposite_or_same(g, cones[i].from, ray[k]) > 0;
        }
        arc_covered[k] = inside || begins; /* the arc from this ray to the next one */
        a.open_rays += !inside;
        a.open_arcs += !arc_covered[k];
    }
    for (size_t k = 0; k < rays; k++)
        if (arc_covered[k] && !arc_covered[k ? k - 1 : rays - 1]) {
            a.start = k;
            a.starts++;
        }
    return a;
}

static sunder_contact classify_cones(sunder_i_operands *g, const cone *cones, size_t n)
{
    size_t rays;
    sunder_i_lattice *l = &g->placed.lattice;
    const sunder_i_point *ray = sorted_rays(g, cones, n, &rays);
    bool *arc_covered = sunder_i_arena_alloc(&l->arena, 2 * n, sizeof *arc_covered);
    if (!ray || !arc_covered) return SUNDER_CONTACT_VERTEX;
    const around a = look_around(g, cones, n, ray, rays, arc_covered);
    if (a.open_arcs == 0) return a.open_rays ? SUNDER_CONTACT_DEGENERATE_SEGMENT : SUNDER_CONTACT_DEGENERATE_POINT;
    /* one covered arc whose inner rays are covered, too: only its two ends are open */
    if (a.starts == 1) {
        size_t end = a.start, arcs = 0;
        while (arc_covered[end]) {
            end = end + 1 < rays ? end + 1 : 0;
            arcs++;
        }
        const size_t rays_outside = rays - (arcs - 1);
        if (a.open_rays == rays_outside && opposite_or_same(g, ray[a.start], ray[end]) < 0) return SUNDER_CONTACT_EDGE;
    }
    return SUNDER_CONTACT_VERTEX;
}

sunder_contact sunder_i_free_point_contact(sunder_i_operands *operands, const sunder_i_free_point *nearest,
                                           sunder_i_near_subsums *near)
{
    size_t n = 0;
    sunder_i_arena *arena = &operands->placed.lattice.arena;
    cone *cones = sunder_i_arena_alloc(arena, operands->subsums + 1, sizeof *cones + sizeof *near->subsum);
    *near = (sunder_i_near_subsums){.n = 0};
    if (!cones) return SUNDER_CONTACT_VERTEX;
    near->subsum = (uint32_t *)(cones + operands->subsums + 1);
    bool flat = true;
    for (size_t k = 0; k < operands->subsums; k++) {
        const where at = cone_of(operands, nearest, operands->subsum + k, cones + n);
        if (at == OFF) continue;
        near->subsum[near->n++] = (uint32_t)k;
        if (at == BESIDE) continue;
        flat = flat && opposite_or_same(operands, cones[n].from, cones[n].to) < 0 &&
               opposite_or_same(operands, cones[0].from, cones[n].from) > 0;
        n++;
    }
    if (flat && n > 0) return SUNDER_CONTACT_EDGE;
    return classify_cones(operands, cones, n);
}
