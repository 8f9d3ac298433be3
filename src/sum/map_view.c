/* map_view.c: the planar map of a sum, for users. Vertices and edges are numbered without gaps, although numbers of
 * removed ones are missing in the map itself. */
#include "sum/map_view.h"

struct sunder_map {
    sunder_i_planar_map *map;
    const sunder_sum *sum;
    uint32_t *vertex, *edge;       /* [vertices], [edges] the numbers of the vertices and edges in `map` */
    uint32_t *vertex_of, *edge_of; /* by the numbers in `map`: the user's number; NOWHERE: not alive */
    uint32_t *inner;               /* one half-edge of each inner boundary, with the user's number, face by face */
    uint32_t *inner_end;           /* [faces] the end of each face in `inner` */
    uint32_t vertices, edges, faces;
};

/* Numbers the elements below `end` for which `alive` is true: (*of)[k] becomes the map's number of element k,
 * (*back)[id] the number of the map's element id, or SUNDER_NOWHERE. *n, at first 0, becomes the number of elements.
 * Returns false if out of memory; the caller frees both arrays in any case. */
static bool number_alive(const sunder_i_planar_map *map, uint32_t end,
                         bool (*alive)(const sunder_i_planar_map *, uint32_t), uint32_t **of, uint32_t **back,
                         uint32_t *n)
{
    *of = sunder_i_alloc(end, sizeof **of);
    *back = sunder_i_alloc(end, sizeof **back);
    if (!*of || !*back) return false;
    for (uint32_t id = 0; id < end; id++) {
        (*back)[id] = alive(map, id) ? *n : SUNDER_NOWHERE;
        if (alive(map, id)) (*of)[(*n)++] = id;
    }
    return true;
}

static uint32_t half_of(const sunder_map *m, uint32_t h)
{
    return h == SUNDER_NOWHERE ? h : 2 * m->edge_of[h >> 1] + (h & 1);
}

static bool list_inner(sunder_map *m)
{
    m->inner_end = sunder_i_alloc(m->faces, sizeof *m->inner_end);
    if (!m->inner_end) return false;
    size_t n, sum = 0;
    for (uint32_t f = 0; f < m->faces; f++) {
        sunder_i_planar_map_face_inner(m->map, f, &n);
        m->inner_end[f] = (uint32_t)(sum += n);
    }
    m->inner = sunder_i_alloc(sum, sizeof *m->inner);
    if (!m->inner) return false;
    for (uint32_t f = 0, at = 0; f < m->faces; f++) {
        const uint32_t *h = sunder_i_planar_map_face_inner(m->map, f, &n);
        for (size_t i = 0; i < n; i++) m->inner[at++] = half_of(m, h[i]);
    }
    return true;
}

sunder_status sunder_i_map_view_take(sunder_i_planar_map *map, const sunder_sum *sum, sunder_map **out,
                                     sunder_error *err)
{
    sunder_map *m = sunder_i_calloc(1, sizeof *m);
    if (!m) {
        sunder_i_planar_map_free(map);
        return sunder_i_failure_cause(err);
    }
    m->map = map;
    m->sum = sum;
    const sunder_status status = sunder_i_planar_map_faces(map, err);
    if (status == SUNDER_OK) {
        m->faces = sunder_i_planar_map_face_end(map);
        if (number_alive(map, sunder_i_planar_map_vertex_end(map), sunder_i_planar_map_vertex_alive, &m->vertex,
                         &m->vertex_of, &m->vertices) &&
            number_alive(map, sunder_i_planar_map_edge_end(map), sunder_i_planar_map_edge_alive, &m->edge, &m->edge_of,
                         &m->edges) &&
            list_inner(m)) {
            *out = m;
            return SUNDER_OK;
        }
    }
    sunder_i_map_view_free(m);
    return status == SUNDER_OK ? sunder_i_failure_cause(err) : status;
}

void sunder_i_map_view_free(sunder_map *map)
{
    if (!map) return;
    sunder_i_planar_map_free(map->map);
    sunder_i_free_all(map->vertex, map->edge, map->vertex_of, map->edge_of, map->inner, map->inner_end, map);
}

const sunder_map *sunder_sum_map(const sunder_sum *sum) { return sum->map; }

size_t sunder_map_vertices(const sunder_map *map) { return map->vertices; }

size_t sunder_map_edges(const sunder_map *map) { return map->edges; }

size_t sunder_map_faces(const sunder_map *map) { return map->faces; }

void sunder_map_vertex(const sunder_map *map, uint32_t vertex, double xy[2])
{
    sunder_i_arena arena = {0};
    sunder_i_sum_doubles(&arena, map->sum, *sunder_i_planar_map_vertex_point(map->map, map->vertex[vertex]), xy);
    sunder_i_arena_free(&arena);
}

sunder_status sunder_map_vertex_text(const sunder_map *map, uint32_t vertex, char **x, char **y, sunder_error *err)
{
    sunder_i_arena arena = {0};
    const sunder_i_rational_point *at = sunder_i_planar_map_vertex_point(map->map, map->vertex[vertex]);
    const sunder_status status = sunder_i_sum_texts(&arena, map->sum, *at, x, y, err);
    sunder_i_arena_free(&arena);
    return status;
}

uint32_t sunder_map_out(const sunder_map *map, uint32_t vertex)
{
    return half_of(map, sunder_i_planar_map_vertex_out(map->map, map->vertex[vertex]));
}

uint32_t sunder_map_around(const sunder_map *map, uint32_t vertex)
{
    const uint32_t v = map->vertex[vertex];
    const bool isolated = sunder_i_planar_map_vertex_out(map->map, v) == SUNDER_I_NOWHERE;
    return isolated ? sunder_i_planar_map_vertex_face(map->map, v) : SUNDER_NOWHERE;
}

static uint32_t half_inside(const sunder_map *map, uint32_t half) { return 2 * map->edge[half >> 1] + (half & 1); }

uint32_t sunder_map_origin(const sunder_map *map, uint32_t half)
{
    return map->vertex_of[sunder_i_planar_map_origin(map->map, half_inside(map, half))];
}

uint32_t sunder_map_twin(uint32_t half) { return half ^ 1; }

uint32_t sunder_map_next(const sunder_map *map, uint32_t half)
{
    return half_of(map, sunder_i_planar_map_next(map->map, half_inside(map, half)));
}

uint32_t sunder_map_turn(const sunder_map *map, uint32_t half)
{
    return half_of(map, sunder_i_planar_map_ccw(map->map, half_inside(map, half)));
}

uint32_t sunder_map_face(const sunder_map *map, uint32_t half)
{
    return sunder_i_planar_map_face(map->map, half_inside(map, half));
}

uint32_t sunder_map_outer(const sunder_map *map, uint32_t face)
{
    return half_of(map, sunder_i_planar_map_face_outer(map->map, face));
}

const uint32_t *sunder_map_inner(const sunder_map *map, uint32_t face, size_t *n)
{
    const uint32_t first = face ? map->inner_end[face - 1] : 0;
    *n = map->inner_end[face] - first;
    return map->inner + first;
}

uint32_t sunder_map_vertex_covered(const sunder_map *map, uint32_t vertex)
{
    return sunder_i_planar_map_vertex_covered(map->map, map->vertex[vertex]);
}

uint32_t sunder_map_edge_covered(const sunder_map *map, uint32_t edge)
{
    return sunder_i_planar_map_edge_covered(map->map, map->edge[edge]);
}

uint32_t sunder_map_face_covered(const sunder_map *map, uint32_t face)
{
    return sunder_i_planar_map_face_covered(map->map, face);
}
