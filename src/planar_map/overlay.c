/* overlay.c: inserts all of one map into another, in random order.
 *
 * An edge is inserted as a segment with its counts; the new numbers of its ends are stored. The count `below` of a
 * vertex of the other map is added once, after all edges: no edge of the other map has one of its vertices in its
 * relative interior, so that insertions add to it only the counts of the overlaid edges. */
#include "base/random.h"
#include "planar_map/map.h"

static uint32_t copied_line(sunder_i_planar_map *map, const sunder_i_map_line *from)
{
    const sunder_i_map_line l = sunder_i_line_copy(from, &map->arena);
    return sunder_i_map_broken(map) ? NOWHERE : sunder_i_map_new_line(map, &l);
}

/* The new numbers of the vertices and lines of the map `of`; NOWHERE: not inserted yet. */
typedef struct names {
    uint32_t *vertex, *line;
} names;

static uint32_t vertex_here(sunder_i_planar_map *map, const sunder_i_planar_map *of, names *n, uint32_t v)
{
    if (n->vertex[v] == NOWHERE) {
        const sunder_i_site site = sunder_i_site_copy(&of->vertex[v].site, &map->arena);
        n->vertex[v] = sunder_i_map_vertex_at(map, &site);
    }
    return n->vertex[v];
}

static bool add_edge(sunder_i_planar_map *map, const sunder_i_planar_map *of, names *n, uint32_t e)
{
    const sunder_i_map_edge *edge = &of->edge[e];
    if (n->line[edge->line] == NOWHERE) n->line[edge->line] = copied_line(map, &of->line[edge->line]);
    const uint32_t v = vertex_here(map, of, n, edge->end[0]), line = n->line[edge->line];
    if (v == NOWHERE || line == NOWHERE) return false;
    const uint32_t known = n->vertex[edge->end[1]];
    const sunder_i_site target =
        known != NOWHERE ? map->vertex[known].site : sunder_i_site_copy(&of->vertex[edge->end[1]].site, &map->arena);
    if (sunder_i_map_broken(map)) return false;
    const uint32_t w = sunder_i_map_walk(map, v, &target, line, edge->sides[0], edge->sides[1], false);
    n->vertex[edge->end[1]] = w;
    return w != NOWHERE;
}

static bool add_all(sunder_i_planar_map *map, const sunder_i_planar_map *of, names *n, uint32_t *order)
{
    size_t count = 0;
    for (uint32_t e = 0; e < of->edges; e++)
        if (of->edge[e].end[0] != NOWHERE) order[count++] = e;
    for (size_t i = count; i > 0; i--) { /* shuffled while they are inserted; also the last edge uses a random number */
        sunder_i_shuffle_step(order, i, sizeof *order, sunder_i_draw(&map->random));
        if (!add_edge(map, of, n, order[i - 1])) return false;
    }
    for (uint32_t v = 0; v < of->vertices; v++) {
        if (!of->vertex[v].alive) continue;
        const uint32_t here = vertex_here(map, of, n, v);
        if (here == NOWHERE) return false;
        map->vertex[here].below += of->vertex[v].below;
    }
    return true;
}

sunder_status sunder_i_planar_map_overlay(sunder_i_planar_map *map, const sunder_i_planar_map *other, sunder_error *err)
{
    sunder_i_map_drop_faces(map);
    map->marked = false;
    names n = {sunder_i_alloc(other->vertices, sizeof(uint32_t)), sunder_i_alloc(other->lines, sizeof(uint32_t))};
    uint32_t *order = sunder_i_alloc(other->edges, sizeof *order);
    bool ok = n.vertex && n.line && order;
    if (ok) {
        memset(n.vertex, 0xff, other->vertices * sizeof(uint32_t));
        memset(n.line, 0xff, other->lines * sizeof(uint32_t));
        ok = add_all(map, other, &n, order);
    }
    sunder_i_free_all(n.vertex, n.line, order);
    if (!ok) map->failed = true;
    return sunder_i_map_status(map, err);
}

/* Makes a new map from the live elements of a map and replaces it; of the old map only vertices, lines, and edges with
 * their ends, lines and counts need to be valid. */
bool sunder_i_map_renew(sunder_i_planar_map *map)
{
    sunder_i_planar_map *fresh;
    if (sunder_i_planar_map_new(map->lattice, sunder_i_draw(&map->random), &fresh, NULL) != SUNDER_OK) return false;
    if (sunder_i_planar_map_overlay(fresh, map, NULL) != SUNDER_OK ||
        sunder_i_planar_map_mark(fresh, NULL) != SUNDER_OK) {
        sunder_i_planar_map_free(fresh);
        return false;
    }
    const sunder_i_planar_map old = *map;
    *map = *fresh;
    *fresh = old;
    sunder_i_planar_map_free(fresh);
    return true;
}

/* A map is made anew if its history has more nodes than HISTORY_EACH for each live trapezoid plus HISTORY_LEAST: after
 * many removals, removed vertices, lines and their history need more memory than the map itself, and make searches
 * longer. The numbers are so large that the time for new maps is below that of the insertions between them. */
#define HISTORY_EACH 64
#define HISTORY_LEAST 65536

bool sunder_i_map_compact(sunder_i_planar_map *map)
{
    const size_t live = map->trapezoids - map->dead_trapezoids;
    return map->nodes < HISTORY_EACH * live + HISTORY_LEAST || sunder_i_map_renew(map);
}
