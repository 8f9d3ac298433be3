/* clean_map.c: cleaning converts the map of many regions to that of their union.
 *
 * Covered elements are removed: edges whose relative interior is inside some region, and vertices inside some region.
 * Edges are removed first: all edges at a covered vertex are covered, so that the vertex is isolated when it is
 * removed. An edge or vertex that no region covers remains, even between covered faces: there it is a degenerate hole.
 * Then vertices in the interior of straight edges with equal counts are removed.
 *
 * After this the union counts as one region that has every remaining edge on its boundary: `sides` is 1 towards a
 * covered face and 0 towards an uncovered one, `below` likewise. So the covered count of every remaining edge and
 * vertex is 0, as required. */
#include "planar_map/map.h"

#include "base/watch.h"

void sunder_i_map_settle_edge(sunder_i_planar_map *map, uint32_t e)
{
    sunder_i_map_edge *edge = &map->edge[e];
    edge->sides[0] = map->trapezoid[edge->up].covered != 0;
    edge->sides[1] = map->trapezoid[edge->down].covered != 0;
}

void sunder_i_map_settle_vertex(sunder_i_planar_map *map, uint32_t v)
{
    map->vertex[v].below = map->trapezoid[sunder_i_map_below_vertex(map, v)].covered != 0;
}

/* Removes the edges of edges_inside and the vertices of vertices_inside, all of which are covered. The counts of the
 * faces on both sides must be 1 already. */
bool sunder_i_map_remove_covered(sunder_i_planar_map *map)
{
    for (size_t i = 0; i < map->edges_inside.n; i++) {
        const uint32_t e = map->edges_inside.item[i];
        map->edge[e].sides[0] = map->edge[e].sides[1] = 0; /* so that the face that results from the removal is
                                                            * covered */
        if (!sunder_i_step() || !sunder_i_edge_remove(map, e)) return false;
    }
    for (size_t i = 0; i < map->vertices_inside.n; i++) sunder_i_edge_drop_vertex(map, map->vertices_inside.item[i]);
    return true;
}

bool sunder_i_planar_map_mergeable(sunder_i_planar_map *map, uint32_t v)
{
    const uint32_t h = map->vertex[v].out;
    if (h == NOWHERE || (h & 1)) return false;
    const uint32_t g = sunder_i_planar_map_ccw(map, h);
    if (!(g & 1) || sunder_i_planar_map_ccw(map, g) != h) return false;
    const sunder_i_map_edge *right = &map->edge[h >> 1], *left = &map->edge[g >> 1];
    return right->sides[0] == left->sides[0] && right->sides[1] == left->sides[1] &&
           sunder_i_line_turn(map, &map->line[left->line], &map->line[right->line]) == 0;
}

/* Lists the covered edges in edges_inside and the covered vertices in vertices_inside. Returns false if out of
 * memory. */
static bool list_covered(sunder_i_planar_map *map)
{
    map->edges_inside.n = map->vertices_inside.n = 0;
    for (uint32_t e = 0; e < map->edges; e++)
        if (!sunder_i_step() || (map->edge[e].end[0] != NOWHERE && sunder_i_planar_map_edge_covered(map, e) > 0 &&
                                 !sunder_i_map_push(map, &map->edges_inside, e)))
            return false;
    for (uint32_t v = 0; v < map->vertices; v++)
        if (map->vertex[v].alive && sunder_i_planar_map_vertex_covered(map, v) > 0 &&
            !sunder_i_map_push(map, &map->vertices_inside, v))
            return false;
    return true;
}

static void settle_all(sunder_i_planar_map *map)
{
    for (uint32_t e = 0; e < map->edges && sunder_i_step(); e++)
        if (map->edge[e].end[0] != NOWHERE) sunder_i_map_settle_edge(map, e);
    for (uint32_t v = 0; v < map->vertices && sunder_i_step(); v++)
        if (map->vertex[v].alive) sunder_i_map_settle_vertex(map, v);
}

/* If few elements remain, a new map is made from them; the old map then needs no valid trapezoids. */
static bool start_afresh(sunder_i_planar_map *map)
{
    settle_all(map);
    for (size_t i = 0; i < map->edges_inside.n; i++) map->edge[map->edges_inside.item[i]].end[0] = NOWHERE;
    for (size_t i = 0; i < map->vertices_inside.n; i++) map->vertex[map->vertices_inside.item[i]].alive = false;
    return sunder_i_map_renew(map);
}

sunder_status sunder_i_planar_map_clean(sunder_i_planar_map *map, sunder_error *err)
{
    SUNDER_I_ASSERT(map->marked);
    sunder_i_map_drop_faces(map);
    bool ok = list_covered(map);
    if (ok) {
        for (uint32_t t = 0; t < map->trapezoids; t++)
            if (map->trapezoid[t].node != NOWHERE) map->trapezoid[t].covered = map->trapezoid[t].covered != 0;
        /* The removal of an edge takes about as long as an insertion. */
        if (2 * map->edges_inside.n > map->edges - map->dead_edges)
            ok = start_afresh(map);
        else {
            ok = sunder_i_map_remove_covered(map);
            if (ok) settle_all(map);
        }
    }
    if (!ok) {
        map->failed = true;
        return sunder_i_failure_cause(err);
    }
    for (uint32_t v = 0; v < map->vertices; v++)
        if (!sunder_i_step())
            map->failed = true;
        else if (map->vertex[v].alive && sunder_i_planar_map_mergeable(map, v))
            sunder_i_edge_merge(map, v);
    SUNDER_I_CHECK(sunder_i_planar_map_sound(map), map->trapezoids);
    return sunder_i_map_status(map, err);
}

/* ---- Removal of single elements ---- */

sunder_status sunder_i_planar_map_remove_edge(sunder_i_planar_map *map, uint32_t h, sunder_error *err)
{
    sunder_i_map_drop_faces(map);
    map->marked = false;
    sunder_i_edge_remove(map, h >> 1);
    return sunder_i_map_status(map, err);
}

sunder_status sunder_i_planar_map_remove_vertex(sunder_i_planar_map *map, uint32_t v, sunder_error *err)
{
    SUNDER_I_ASSERT(map->vertex[v].out == NOWHERE);
    sunder_i_map_drop_faces(map);
    sunder_i_edge_drop_vertex(map, v);
    return sunder_i_map_status(map, err);
}

sunder_status sunder_i_planar_map_merge_vertex(sunder_i_planar_map *map, uint32_t v, sunder_error *err)
{
    SUNDER_I_ASSERT(sunder_i_planar_map_mergeable(map, v));
    sunder_i_map_drop_faces(map);
    sunder_i_edge_merge(map, v);
    return sunder_i_map_status(map, err);
}
