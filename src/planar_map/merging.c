/* merging.c: the vertical decomposition after a removal: the opposite of trapezoids.c.
 *
 * If an edge is removed, the walls that ended on it extend to the next edge: the rows of trapezoids above it and below
 * it become one row, with a wall at each vertex that had a wall in one of the rows. If an isolated vertex is removed,
 * or one in the interior of an edge, its walls are removed. */
#include "planar_map/map.h"

/* Lists the rows above and below edge e, from left to right, and reserves memory. Returns false if out of memory. */
static bool collect_rows(sunder_i_planar_map *map, uint32_t e)
{
    const uint32_t w = map->edge[e].end[1];
    map->above.n = map->beneath.n = map->made.n = 0;
    for (uint32_t t = map->edge[e].up;; t = map->trapezoid[t].rl) {
        if (!sunder_i_map_push(map, &map->above, t)) return false;
        if (map->trapezoid[t].right == w) break;
    }
    for (uint32_t t = map->edge[e].down;; t = map->trapezoid[t].ru) {
        if (!sunder_i_map_push(map, &map->beneath, t)) return false;
        if (map->trapezoid[t].right == w) break;
    }
    /* Memory for a leaf of each new trapezoid, and for the trees of link_successors(): these have each wall of the new
     * row at most twice, once for each old row. */
    const size_t n = map->above.n + map->beneath.n;
    if (!sunder_i_reserve(&map->made.item, &map->made.capacity, n, sizeof *map->made.item)) map->failed = true;
    return sunder_i_map_room(map, 0, 0, n, 3 * n);
}

static uint32_t begin_trapezoid(sunder_i_planar_map *map, uint32_t u, uint32_t d, uint32_t left, uint32_t covered)
{
    const uint32_t m = sunder_i_map_new_trapezoid(map);
    map->trapezoid[m] = (sunder_i_trapezoid){.top = map->trapezoid[u].top,
                                             .bottom = map->trapezoid[d].bottom,
                                             .left = left,
                                             .right = NOWHERE,
                                             .lu = NOWHERE,
                                             .ll = NOWHERE,
                                             .ru = NOWHERE,
                                             .rl = NOWHERE,
                                             .covered = covered,
                                             .stamp = map->trapezoid[u].stamp};
    sunder_i_history_leaf(map, m);
    map->made.item[map->made.n++] = m; /* collect_rows() has made the list long enough */
    return m;
}

/* Extends the wall between trapezoid t of a row and the next one, `after`, across the removed edge: m ends there,
 * `next` begins. */
static void wall_across(sunder_i_planar_map *map, uint32_t t, uint32_t after, uint32_t m, uint32_t next, bool above)
{
    sunder_i_trapezoid_link(map, m, next, !above);
    sunder_i_trapezoid_pass(map, &map->trapezoid[t], after, &map->trapezoid[after], m, next, above);
}

/* Makes the old trapezoids of a row lead, in the history, to those of the new row between the same walls, and frees
 * them. */
static void link_successors(sunder_i_planar_map *map, const sunder_i_list *old)
{
    size_t first = 0;
    for (size_t i = 0; i < old->n; i++) {
        const uint32_t t = old->item[i], right = map->trapezoid[t].right;
        size_t last = first;
        while (map->trapezoid[map->made.item[last]].right != right) last++;
        sunder_i_history_row(map, map->trapezoid[t].node, map->made.item + first, last - first + 1);
        first = last + 1;
    }
    for (size_t i = 0; i < old->n; i++) sunder_i_map_free_trapezoid(map, old->item[i]);
}

bool sunder_i_trapezoid_erase(sunder_i_planar_map *map, uint32_t e)
{
    if (!collect_rows(map, e)) return false;
    const uint32_t *u = map->above.item, *d = map->beneath.item;
    const size_t un = map->above.n, dn = map->beneath.n;
    uint32_t covered = map->trapezoid[u[0]].covered - map->edge[e].sides[0];
    if (map->edge[e].sides[0] > map->trapezoid[u[0]].covered) covered = 0; /* the counts are not valid yet */
    uint32_t m = begin_trapezoid(map, u[0], d[0], map->edge[e].end[0], covered);
    sunder_i_trapezoid *z = map->trapezoid;
    sunder_i_trapezoid_link(map, z[u[0]].lu, m, true);
    sunder_i_trapezoid_link(map, z[d[0]].ll, m, false);
    size_t i = 0, j = 0;
    while (i + 1 < un || j + 1 < dn) {
        const uint32_t p = z[u[i]].right, q = z[d[j]].right;
        /* The last trapezoid of a row ends at the edge's end, which is beyond all other walls. */
        const bool upper =
            j + 1 == dn || (i + 1 < un && sunder_i_site_cmp(map, &map->vertex[p].site, &map->vertex[q].site) < 0);
        z[m].right = upper ? p : q;
        const uint32_t next =
            begin_trapezoid(map, upper ? u[i + 1] : u[i], upper ? d[j] : d[j + 1], z[m].right, covered);
        if (upper) {
            wall_across(map, u[i], u[i + 1], m, next, true);
            i++;
        } else {
            wall_across(map, d[j], d[j + 1], m, next, false);
            j++;
        }
        m = next;
    }
    z[m].right = map->edge[e].end[1];
    sunder_i_trapezoid_link(map, m, z[u[i]].ru, true);
    sunder_i_trapezoid_link(map, m, z[d[j]].rl, false);
    for (size_t k = 0; k < map->made.n; k++) sunder_i_trapezoid_install(map, map->made.item[k]);
    link_successors(map, &map->above);
    link_successors(map, &map->beneath);
    return true;
}

void sunder_i_trapezoid_join(sunder_i_planar_map *map, uint32_t t, uint32_t r)
{
    sunder_i_trapezoid *z = map->trapezoid;
    z[t].right = z[r].right;
    sunder_i_trapezoid_link(map, t, z[r].ru, true);
    sunder_i_trapezoid_link(map, t, z[r].rl, false);
    sunder_i_history_alias(map, z[r].node, z[t].node);
    sunder_i_map_free_trapezoid(map, r);
    if (z[t].right != NOWHERE) map->vertex[z[t].right].left = t;
}
