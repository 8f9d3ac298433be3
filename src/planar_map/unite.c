/* unite.c: the step of the incremental union: a convex polygon is added to a clean map, and elements that become
 * redundant are removed.
 *
 * These are the elements inside the polygon, which are found by a flood fill of trapezoids from its boundary, and those
 * parts of the boundary that are inside the union so far. Nothing else changes: an edge outside has the same faces on
 * both sides as before. */
#include "planar_map/map.h"

static bool see_trapezoid(sunder_i_planar_map *map, uint32_t t, uint32_t stamp)
{
    sunder_i_trapezoid *z = &map->trapezoid[t];
    if (z->stamp == stamp) return true;
    z->stamp = stamp;
    return sunder_i_map_push(map, &map->inside, t);
}

/* Lists the trapezoids, edges and vertices strictly inside the ring. The edges and vertices of the ring must have the
 * stamp already. Returns false if out of memory. */
static bool flood_ring(sunder_i_planar_map *map, uint32_t stamp)
{
    map->inside.n = map->edges_inside.n = map->vertices_inside.n = 0;
    for (size_t i = 0; i < map->ring.n; i++)
        if (!see_trapezoid(map, sunder_i_map_left_of(map, map->ring.item[i]), stamp)) return false;
    for (size_t i = 0; i < map->inside.n; i++) { /* the list is also the queue */
        const uint32_t t = map->inside.item[i];
        uint32_t to[6];
        int64_t step[6];
        const size_t n = sunder_i_map_around(map, t, stamp, to, step);
        for (size_t k = 0; k < n; k++)
            if (!see_trapezoid(map, to[k], stamp)) return false;
        const uint32_t e = map->trapezoid[t].bottom, v = map->trapezoid[t].left;
        if (map->edge[e].up == t && map->edge[e].stamp != stamp && !sunder_i_map_push(map, &map->edges_inside, e))
            return false;
        if (map->vertex[v].stamp != stamp) {
            map->vertex[v].stamp = stamp;
            if (!sunder_i_map_push(map, &map->vertices_inside, v)) return false;
        }
    }
    return true;
}

static bool clean_ring(sunder_i_planar_map *map)
{
    const uint32_t stamp = ++map->stamp;
    for (size_t i = 0; i < map->ring.n; i++) {
        const uint32_t h = map->ring.item[i];
        map->edge[h >> 1].stamp = stamp;
        map->vertex[sunder_i_planar_map_origin(map, h)].stamp = stamp;
    }
    if (!flood_ring(map, stamp)) return false;
    for (size_t i = 0; i < map->inside.n; i++) map->trapezoid[map->inside.item[i]].covered++;
    /* Each vertex of the ring is the origin of one of its half-edges. The vertices that remain are put on the stack;
     * `ring` keeps its edges that remain. */
    map->stack.n = 0;
    size_t kept = 0;
    for (size_t i = 0; i < map->ring.n; i++) {
        const uint32_t h = map->ring.item[i], v = sunder_i_planar_map_origin(map, h);
        const bool covered = sunder_i_planar_map_vertex_covered(map, v) > 0;
        if (!sunder_i_map_push(map, covered ? &map->vertices_inside : &map->stack, v)) return false;
        if (sunder_i_planar_map_edge_covered(map, h >> 1) == 0)
            map->ring.item[kept++] = h;
        else if (!sunder_i_map_push(map, &map->edges_inside, h >> 1))
            return false;
    }
    map->ring.n = kept;
    for (size_t i = 0; i < map->inside.n; i++) map->trapezoid[map->inside.item[i]].covered = 1;
    if (!sunder_i_map_remove_covered(map)) return false;
    for (size_t i = 0; i < map->ring.n; i++) sunder_i_map_settle_edge(map, map->ring.item[i] >> 1);
    for (size_t i = 0; i < map->stack.n; i++) sunder_i_map_settle_vertex(map, map->stack.item[i]);
    for (size_t i = 0; i < map->stack.n; i++)
        if (sunder_i_planar_map_mergeable(map, map->stack.item[i])) sunder_i_edge_merge(map, map->stack.item[i]);
    return true;
}

sunder_status sunder_i_planar_map_unite_polygon(sunder_i_planar_map *map, const sunder_i_rational_point *corner,
                                                const sunder_i_point *along, size_t n, sunder_error *err)
{
    SUNDER_I_ASSERT(map->marked);
    const sunder_status status = sunder_i_map_polygon(map, corner, along, n, true, err);
    if (status != SUNDER_OK || map->ring.n == 0) return status;
    if (!clean_ring(map) || !sunder_i_map_compact(map)) {
        map->failed = true;
        return sunder_i_failure_cause(err);
    }
    map->marked = true;
    return sunder_i_map_status(map, err);
}
