/* map.c: construction, destruction, memory and queries of a map. */
#include "planar_map/map.h"

sunder_status sunder_i_planar_map_new(sunder_i_lattice *lattice, uint64_t seed, sunder_i_planar_map **out,
                                      sunder_error *err)
{
    sunder_i_planar_map *map = sunder_i_calloc(1, sizeof *map);
    if (!map) return sunder_i_failure_cause(err);
    map->lattice = lattice;
    map->random = seed;
    map->free_edge = map->free_trapezoid = NOWHERE;
    map->marked = true;
    sunder_i_arena_alloc(&map->scratch, 1, 1); /* its first chunk remains allocated when the arena is released */
    if (sunder_i_map_room(map, 0, 0, 1, 1)) {
        /* One trapezoid, the whole plane. */
        const uint32_t t = sunder_i_map_new_trapezoid(map);
        sunder_i_trapezoid *plane = &map->trapezoid[t];
        plane->top = plane->bottom = plane->left = plane->right = NOWHERE;
        plane->lu = plane->ll = plane->ru = plane->rl = NOWHERE;
        sunder_i_history_leaf(map, t);
    }
    if (sunder_i_map_broken(map)) {
        sunder_i_planar_map_free(map);
        return sunder_i_failure_cause(err);
    }
    *out = map;
    return SUNDER_OK;
}

void sunder_i_planar_map_free(sunder_i_planar_map *map)
{
    if (!map) return;
    sunder_i_map_drop_faces(map);
    sunder_i_list *const lists[] = {&map->crossed, &map->ring,   &map->above,        &map->beneath,        &map->made,
                                    &map->stack,   &map->inside, &map->edges_inside, &map->vertices_inside};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) sunder_i_free(lists[i]->item);
    sunder_i_free_all(map->vertex, map->edge, map->line, map->trapezoid, map->node);
    sunder_i_arena_free(&map->arena);
    sunder_i_arena_free(&map->scratch);
    sunder_i_free(map);
}

sunder_status sunder_i_map_status(sunder_i_planar_map *map, sunder_error *err)
{
    return sunder_i_map_broken(map) ? sunder_i_failure_cause(err) : SUNDER_OK;
}

/* ---- Memory ---- */

static bool grow_array(void *array, size_t *capacity, uint32_t used, size_t more, size_t size, size_t most)
{
    return used + more <= most && sunder_i_reserve(array, capacity, used + more, size);
}

bool sunder_i_map_room(sunder_i_planar_map *map, size_t vertices, size_t edges, size_t trapezoids, size_t nodes)
{
    /* Half-edges have 32 bits, vertices in the history 30, trapezoids with a flag 32. */
    const size_t most = (size_t)1 << 30;
    if (!grow_array(&map->vertex, &map->vertex_capacity, map->vertices, vertices, sizeof *map->vertex, most) ||
        !grow_array(&map->edge, &map->edge_capacity, map->edges, edges, sizeof *map->edge, most) ||
        !grow_array(&map->trapezoid, &map->trapezoid_capacity, map->trapezoids, trapezoids, sizeof *map->trapezoid,
                    2 * most - 1) ||
        !grow_array(&map->node, &map->node_capacity, map->nodes, nodes, sizeof *map->node, 4 * most - 2))
        map->failed = true;
    return !map->failed;
}

bool sunder_i_map_push(sunder_i_planar_map *map, sunder_i_list *list, uint32_t item)
{
    const bool pushed = sunder_i_list_push(list, item);
    if (!pushed) map->failed = true;
    return pushed;
}

/* Returns the memory for the limbs of a number in an arena, which allocates multiples of 16 bytes. */
static size_t bytes_of(sunder_i_big n)
{
    const size_t limbs = (size_t)(n.size < 0 ? -n.size : n.size);
    return (limbs * sizeof(mp_limb_t) + 15) & ~(size_t)15;
}

uint32_t sunder_i_map_new_vertex(sunder_i_planar_map *map, const sunder_i_site *site)
{
    const uint32_t v = map->vertices++;
    map->number_bytes += bytes_of(site->at.x) + bytes_of(site->at.y) + bytes_of(site->at.w);
    map->vertex[v] =
        (sunder_i_map_vertex){.site = *site, .out = NOWHERE, .left = NOWHERE, .right = NOWHERE, .alive = true};
    return v;
}

uint32_t sunder_i_map_new_edge(sunder_i_planar_map *map)
{
    uint32_t e = map->free_edge;
    if (e != NOWHERE) {
        map->free_edge = map->edge[e].end[1];
        map->dead_edges--;
    } else
        e = map->edges++;
    map->edge[e] = (sunder_i_map_edge){.up = NOWHERE, .down = NOWHERE};
    return e;
}

uint32_t sunder_i_map_new_trapezoid(sunder_i_planar_map *map)
{
    uint32_t t = map->free_trapezoid;
    if (t != NOWHERE) {
        map->free_trapezoid = map->trapezoid[t].top;
        map->dead_trapezoids--;
    } else
        t = map->trapezoids++;
    map->trapezoid[t] = (sunder_i_trapezoid){0};
    return t;
}

void sunder_i_map_free_edge(sunder_i_planar_map *map, uint32_t e)
{
    map->edge[e].end[0] = NOWHERE;
    map->edge[e].end[1] = map->free_edge;
    map->free_edge = e;
    map->dead_edges++;
}

void sunder_i_map_free_trapezoid(sunder_i_planar_map *map, uint32_t t)
{
    map->trapezoid[t].node = NOWHERE;
    map->trapezoid[t].top = map->free_trapezoid;
    map->free_trapezoid = t;
    map->dead_trapezoids++;
}

uint32_t sunder_i_map_new_line(sunder_i_planar_map *map, const sunder_i_map_line *line)
{
    if (!grow_array(&map->line, &map->line_capacity, map->lines, 1, sizeof *map->line, (size_t)1 << 30)) {
        map->failed = true;
        return NOWHERE;
    }
    map->line[map->lines] = *line;
    for (int i = 0; i < 3; i++) map->number_bytes += bytes_of(line->abc[i]);
    return map->lines++;
}

void sunder_i_map_drop_faces(sunder_i_planar_map *map)
{
    sunder_i_free_all(map->face_of_trapezoid, map->face_outer, map->face_covered, map->inner, map->isolated,
                      map->inner_end, map->isolated_end);
    map->face_of_trapezoid = map->face_outer = map->face_covered = map->inner = map->isolated = NULL;
    map->inner_end = map->isolated_end = NULL;
    map->faces_valid = false;
    map->faces = 0;
}

/* ---- Queries ---- */

uint32_t sunder_i_map_below_vertex(const sunder_i_planar_map *map, uint32_t v)
{
    const uint32_t h = map->vertex[v].out;
    return h != NOWHERE && !(h & 1) ? map->edge[h >> 1].down : map->vertex[v].right;
}

uint32_t sunder_i_planar_map_vertex_end(const sunder_i_planar_map *map) { return map->vertices; }

bool sunder_i_planar_map_vertex_alive(const sunder_i_planar_map *map, uint32_t v) { return map->vertex[v].alive; }

const sunder_i_rational_point *sunder_i_planar_map_vertex_point(const sunder_i_planar_map *map, uint32_t v)
{
    return &map->vertex[v].site.at;
}

int sunder_i_planar_map_vertex_cmp(sunder_i_planar_map *map, uint32_t v, uint32_t w)
{
    return v == w ? 0 : sunder_i_site_cmp(map, &map->vertex[v].site, &map->vertex[w].site);
}

uint32_t sunder_i_planar_map_vertex_out(const sunder_i_planar_map *map, uint32_t v) { return map->vertex[v].out; }

uint32_t sunder_i_planar_map_vertex_below(const sunder_i_planar_map *map, uint32_t v) { return map->vertex[v].below; }

uint32_t sunder_i_planar_map_vertex_covered(const sunder_i_planar_map *map, uint32_t v)
{
    return map->trapezoid[sunder_i_map_below_vertex(map, v)].covered - map->vertex[v].below;
}

uint32_t sunder_i_planar_map_edge_end(const sunder_i_planar_map *map) { return map->edges; }

bool sunder_i_planar_map_edge_alive(const sunder_i_planar_map *map, uint32_t e)
{
    return map->edge[e].end[0] != NOWHERE;
}

uint32_t sunder_i_planar_map_origin(const sunder_i_planar_map *map, uint32_t h) { return map->edge[h >> 1].end[h & 1]; }

uint32_t sunder_i_planar_map_next(const sunder_i_planar_map *map, uint32_t h) { return map->edge[h >> 1].cw[~h & 1]; }

uint32_t sunder_i_planar_map_prev(const sunder_i_planar_map *map, uint32_t h)
{
    return map->edge[h >> 1].ccw[h & 1] ^ 1;
}

uint32_t sunder_i_planar_map_ccw(const sunder_i_planar_map *map, uint32_t h) { return map->edge[h >> 1].ccw[h & 1]; }

uint32_t sunder_i_planar_map_sides(const sunder_i_planar_map *map, uint32_t h)
{
    return map->edge[h >> 1].sides[h & 1];
}

uint32_t sunder_i_planar_map_left_covered(const sunder_i_planar_map *map, uint32_t h)
{
    return map->trapezoid[sunder_i_map_left_of(map, h)].covered;
}

uint32_t sunder_i_planar_map_edge_covered(const sunder_i_planar_map *map, uint32_t e)
{
    return map->trapezoid[map->edge[e].up].covered - map->edge[e].sides[0];
}

void sunder_i_planar_map_size(const sunder_i_planar_map *map, sunder_i_map_size *out)
{
    out->vertices = map->vertices - map->dead_vertices;
    out->edges = map->edges - map->dead_edges;
    out->trapezoids = map->trapezoids - map->dead_trapezoids;
    out->history = map->nodes;
    out->bytes = sizeof *map + map->vertex_capacity * sizeof *map->vertex + map->edge_capacity * sizeof *map->edge +
                 map->line_capacity * sizeof *map->line + map->trapezoid_capacity * sizeof *map->trapezoid +
                 map->node_capacity * sizeof *map->node + map->number_bytes;
}

int sunder_i_planar_map_turn(sunder_i_planar_map *map, uint32_t e, uint32_t f)
{
    return sunder_i_line_turn(map, &map->line[map->edge[e].line], &map->line[map->edge[f].line]);
}

bool sunder_i_planar_map_failed(sunder_i_planar_map *map) { return sunder_i_map_broken(map); }
