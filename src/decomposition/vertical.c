/* vertical.c: the vertical decomposition: from each reflex vertex a cut up, a cut down, or both, if that direction is
 * inside the polygon.
 *
 * In the literature verticals are drawn from every vertex, so that the pieces are trapezoids. For convex pieces those
 * of the reflex vertices are sufficient, and they are all needed: a reflex vertex between an edge to the left and one
 * to the right needs its one vertical; one with both edges on one side has an angle of more than pi if only one of its
 * two verticals is drawn. The others would only add pieces, and each piece adds a row of subsums. So there are at most
 * 2 r + 1 - h pieces for r reflex vertices and h holes, convex and with at most two vertical sides each.
 *
 * Verticals do not cross each other, so that each is found separately, as a ray through the triangulation. If two
 * reflex vertices see each other along a vertical, the lower one's cut is used. A Steiner point is the intersection of
 * x = x0 with an edge: its w is the edge's width, degree 1 (x: 1 over 0, y: 2 over 1). */
#include "decomposition/maker.h"

/* Returns true if d is strictly inside the sector of the reflex vertex v. The rest of the circle is a convex cone. */
static bool is_inside(const sunder_i_rings *r, uint32_t v, sunder_i_point d)
{
    sunder_i_lattice *l = r->lattice;
    const sunder_i_point in = sunder_i_point_sub(l, r->at[r->prev[v]], r->at[v]);
    const sunder_i_point out = sunder_i_point_sub(l, r->at[r->next[v]], r->at[v]);
    return sunder_i_cross_sign(l, in, d) < 0 || sunder_i_cross_sign(l, d, out) < 0;
}

void sunder_i_make_vertical(sunder_i_maker *m, const sunder_i_member *member)
{
    const sunder_i_rings *r = &m->rings;
    sunder_i_lattice *l = m->lattice;
    sunder_i_ray_shooting rays;
    sunder_i_cut *cut = sunder_i_arena_alloc(&m->scratch, 2 * (size_t)member->reflex, sizeof *cut);
    uint32_t n = 0;
    if (!cut || !sunder_i_ray_shooting_init(&rays, r, member, &m->scratch)) return;
    const sunder_i_point up = {0, 1}, down = {0, -1};
    for (uint32_t v = member->first; v < member->first + member->n && !sunder_i_maker_failed(m); v++) {
        if (!sunder_i_is_reflex(r, v)) continue;
        for (int k = 0; k < 2; k++) {
            const sunder_i_point along = k ? down : up;
            if (!is_inside(r, v, along)) continue;
            cut[n] = (sunder_i_cut){.from = v, .along = along, .toward = sunder_i_point_add(l, r->at[v], along)};
            if (!sunder_i_cut_run(&cut[n], &rays)) continue;
            const bool twice = k && cut[n].end == SUNDER_I_AT_VERTEX && sunder_i_is_reflex(r, cut[n].at) &&
                               is_inside(r, cut[n].at, up);
            if (!twice) n++;
        }
    }
    if (!sunder_i_maker_failed(m)) sunder_i_cuts_apply(m, member, cut, n);
    sunder_i_ray_shooting_free(&rays);
}
