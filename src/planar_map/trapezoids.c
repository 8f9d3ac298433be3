/* trapezoids.c: the vertical decomposition at insertions: a wall inserted in a trapezoid, an edge drawn through a row
 * of trapezoids. */
#include "planar_map/map.h"

void sunder_i_trapezoid_install(sunder_i_planar_map *map, uint32_t t)
{
    const sunder_i_trapezoid *z = &map->trapezoid[t];
    if (z->left != NOWHERE) {
        map->vertex[z->left].right = t;
        if (z->bottom != NOWHERE && map->edge[z->bottom].end[0] == z->left) map->edge[z->bottom].up = t;
        if (z->top != NOWHERE && map->edge[z->top].end[0] == z->left) map->edge[z->top].down = t;
    }
    if (z->right != NOWHERE) map->vertex[z->right].left = t;
}

uint32_t sunder_i_trapezoid_split(sunder_i_planar_map *map, uint32_t t, uint32_t v, sunder_i_wall wall)
{
    const uint32_t r = sunder_i_map_new_trapezoid(map), node = map->trapezoid[t].node;
    sunder_i_trapezoid *z = map->trapezoid;
    z[r] = z[t];
    z[r].left = z[t].right = v;
    sunder_i_trapezoid_link(map, r, z[t].ru, true);
    sunder_i_trapezoid_link(map, r, z[t].rl, false);
    z[t].ru = z[t].rl = z[r].lu = z[r].ll = NOWHERE;
    if (wall != SUNDER_I_WALL_ON_TOP) sunder_i_trapezoid_link(map, t, r, true);
    if (wall != SUNDER_I_WALL_ON_BOTTOM) sunder_i_trapezoid_link(map, t, r, false);
    const uint32_t smaller = sunder_i_history_leaf(map, t), greater = sunder_i_history_leaf(map, r);
    sunder_i_history_at(map, node, v, smaller, greater);
    sunder_i_trapezoid_install(map, t);
    sunder_i_trapezoid_install(map, r);
    return r;
}

void sunder_i_trapezoid_link(sunder_i_planar_map *map, uint32_t a, uint32_t b, bool upper)
{
    sunder_i_trapezoid *z = map->trapezoid;
    if (a != NOWHERE) *(upper ? &z[a].ru : &z[a].rl) = b;
    if (b != NOWHERE) *(upper ? &z[b].lu : &z[b].ll) = a;
}

void sunder_i_trapezoid_pass(sunder_i_planar_map *map, const sunder_i_trapezoid *before, uint32_t after,
                             const sunder_i_trapezoid *old_after, uint32_t a, uint32_t b, bool upper)
{
    const uint32_t across = upper ? before->ru : before->rl, back = upper ? old_after->lu : old_after->ll;
    if (across == after) {
        sunder_i_trapezoid_link(map, a, b, upper);
        return;
    }
    sunder_i_trapezoid_link(map, a, across, upper);
    sunder_i_trapezoid_link(map, back, b, upper);
}

/* Each crossed trapezoid is divided into a part above e and one below. If the vertex of its right wall is above e, the
 * wall no longer extends below e: the lower part continues in the next trapezoid, and the upper part ends; likewise in
 * the opposite case. So each crossed trapezoid except the first begins exactly one new part, at the same vertex and
 * along the same other edge, and the part gets its number: so references of edges and vertices to it remain valid. The
 * first begins two, and the upper one gets its number. Invariant: u and d are the parts above and below that are open
 * at the current trapezoid; `old` is its former contents. */
void sunder_i_trapezoid_draw(sunder_i_planar_map *map, uint32_t e)
{
    sunder_i_trapezoid *z = map->trapezoid;
    const uint32_t *t = map->crossed.item;
    const size_t n = map->crossed.n;
    const uint32_t v = map->edge[e].end[0], w = map->edge[e].end[1], line = map->edge[e].line;
    sunder_i_trapezoid old = z[t[0]];
    uint32_t u = t[0], d = sunder_i_map_new_trapezoid(map);
    z[d] = old;
    z[u].bottom = z[d].top = e;
    z[u].left = z[d].left = v;
    z[u].ll = z[d].lu = NOWHERE;
    sunder_i_trapezoid_link(map, old.lu, u, true);
    sunder_i_trapezoid_link(map, old.ll, d, false);
    map->edge[e].up = u;
    map->edge[e].down = d;
    if (old.bottom != NOWHERE && map->edge[old.bottom].end[0] == v) map->edge[old.bottom].up = d;
    sunder_i_history_leaf(map, u);
    sunder_i_history_leaf(map, d);
    for (size_t i = 0; i < n; i++) {
        sunder_i_history_by(map, old.node, line, z[d].node, z[u].node);
        if (i + 1 == n) break;
        const uint32_t p = old.right, next = t[i + 1];
        const sunder_i_trapezoid after = z[next];
        /* The row continues through the part of the wall below its vertex p, or above it; if p has no edge to the
         * right, both parts lead to the same trapezoid, and the side of p decides. */
        const bool p_above =
            old.rl == next && (old.ru != next || sunder_i_site_side(map, &map->line[line], &map->vertex[p].site) > 0);
        z[next] = (sunder_i_trapezoid){.left = p,
                                       .covered = after.covered,
                                       .stamp = after.stamp,
                                       .lu = NOWHERE,
                                       .ll = NOWHERE,
                                       .ru = NOWHERE,
                                       .rl = NOWHERE};
        uint32_t *open = p_above ? &u : &d;
        z[next].top = p_above ? after.top : e;
        z[next].bottom = p_above ? e : after.bottom;
        z[*open].right = p;
        map->vertex[p].left = *open;
        sunder_i_trapezoid_link(map, *open, next, !p_above); /* between the vertex and e */
        sunder_i_trapezoid_pass(map, &old, next, &after, *open, next, p_above);
        *open = next;
        sunder_i_history_leaf(map, next);
        old = after;
    }
    z[u].right = z[d].right = w;
    z[u].rl = z[d].ru = NOWHERE;
    sunder_i_trapezoid_link(map, u, old.ru, true);
    sunder_i_trapezoid_link(map, d, old.rl, false);
}
