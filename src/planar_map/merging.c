/* The vertical decomposition under removal: the reverse of trapezoids.c.
 *
 * Where an edge goes, the walls that ended on it run on to the next edge: so the rows of trapezoids above it and below
 * it become one row, with a wall at each vertex that either had one. Where an isolated vertex goes, or one in the
 * middle of an edge, its walls go. */
#include "planar_map/map.h"

/* Collects the rows above and below edge e, from left to right. */
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
    return sunder_i_map_room(map, 0, 0, map->above.n + map->beneath.n,
                             2 * (map->above.n + map->beneath.n) + 2 * map->above.n + 2 * map->beneath.n);
}

static uint32_t begin(sunder_i_planar_map *map, uint32_t u, uint32_t d, uint32_t left, uint32_t covered)
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
    map->made.item[map->made.n++] = m; /* collect_rows() made the list long enough */
    return m;
}

/* A wall between u and its right neighbour above the edge now reaches down to the bottom: m ends there, next begins. */
static void wall_from_above(sunder_i_planar_map *map, uint32_t u, uint32_t after, uint32_t m, uint32_t next)
{
    sunder_i_trapezoid *z = map->trapezoid;
    z[m].rl = next;
    z[next].ll = m;
    if (z[u].ru == after) {
        z[m].ru = next;
        z[next].lu = m;
        return;
    }
    z[m].ru = z[u].ru;
    if (z[u].ru != NOWHERE) z[z[u].ru].lu = m;
    z[next].lu = z[after].lu;
    if (z[after].lu != NOWHERE) z[z[after].lu].ru = next;
}

static void wall_from_below(sunder_i_planar_map *map, uint32_t d, uint32_t after, uint32_t m, uint32_t next)
{
    sunder_i_trapezoid *z = map->trapezoid;
    z[m].ru = next;
    z[next].lu = m;
    if (z[d].rl == after) {
        z[m].rl = next;
        z[next].ll = m;
        return;
    }
    z[m].rl = z[d].rl;
    if (z[d].rl != NOWHERE) z[z[d].rl].ll = m;
    z[next].ll = z[after].ll;
    if (z[after].ll != NOWHERE) z[z[after].ll].rl = next;
}

/* The old ones of a row lead to those of the new row between the same walls, and go. */
static void succeed(sunder_i_planar_map *map, const sunder_i_list *old)
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
    if (!sunder_i_reserve(&map->made.item, &map->made.capacity, un + dn, sizeof *map->made.item)) {
        map->failed = true;
        return false;
    }
    uint32_t covered = map->trapezoid[u[0]].covered - map->edge[e].sides[0];
    if (map->edge[e].sides[0] > map->trapezoid[u[0]].covered) covered = 0; /* counts not marked yet */
    uint32_t m = begin(map, u[0], d[0], map->edge[e].end[0], covered);
    sunder_i_trapezoid *z = map->trapezoid;
    z[m].lu = z[u[0]].lu;
    if (z[m].lu != NOWHERE) z[z[m].lu].ru = m;
    z[m].ll = z[d[0]].ll;
    if (z[m].ll != NOWHERE) z[z[m].ll].rl = m;
    size_t i = 0, j = 0;
    while (i + 1 < un || j + 1 < dn) {
        const uint32_t p = z[u[i]].right, q = z[d[j]].right;
        /* The last of a row ends in the edge's end, which is beyond all other walls. */
        const bool upper =
            j + 1 == dn || (i + 1 < un && sunder_i_site_cmp(map, &map->vertex[p].site, &map->vertex[q].site) < 0);
        z[m].right = upper ? p : q;
        const uint32_t next = begin(map, upper ? u[i + 1] : u[i], upper ? d[j] : d[j + 1], z[m].right, covered);
        if (upper) {
            wall_from_above(map, u[i], u[i + 1], m, next);
            i++;
        } else {
            wall_from_below(map, d[j], d[j + 1], m, next);
            j++;
        }
        m = next;
    }
    z[m].right = map->edge[e].end[1];
    z[m].ru = z[u[i]].ru;
    if (z[m].ru != NOWHERE) z[z[m].ru].lu = m;
    z[m].rl = z[d[j]].rl;
    if (z[m].rl != NOWHERE) z[z[m].rl].ll = m;
    for (size_t k = 0; k < map->made.n; k++) sunder_i_trapezoid_install(map, map->made.item[k]);
    succeed(map, &map->above);
    succeed(map, &map->beneath);
    return true;
}

void sunder_i_trapezoid_join(sunder_i_planar_map *map, uint32_t t, uint32_t r)
{
    sunder_i_trapezoid *z = map->trapezoid;
    z[t].right = z[r].right;
    z[t].ru = z[r].ru;
    z[t].rl = z[r].rl;
    if (z[t].ru != NOWHERE) z[z[t].ru].lu = t;
    if (z[t].rl != NOWHERE) z[z[t].rl].ll = t;
    sunder_i_history_alias(map, z[r].node, z[t].node);
    sunder_i_map_free_trapezoid(map, r);
    if (z[t].right != NOWHERE) map->vertex[z[t].right].left = t;
}
