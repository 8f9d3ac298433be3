/* faces.c: faces: sets of trapezoids connected through walls, and the boundaries around and inside them.
 *
 * The face left of a half-edge is that of the trapezoids along it. The half-edges that follow each other around it form
 * cycles. A cycle is the outer boundary of its face, or an inner one; its smallest vertex decides this. No half-edge of
 * the cycle leads to the left from there. The cycle is an inner boundary exactly if the points directly to the left of
 * that vertex belong to the corner that the cycle makes there: it then surrounds its edges from outside. That corner is
 * between the highest half-edge out of the vertex and the lowest, and the vertex has no half-edge to the left at all.
 * (A cycle may pass through its smallest vertex several times, as with antennas; one of those corners is
 * sufficient.) */
#include "planar_map/map.h"

typedef struct cycle {
    uint32_t h, face;
    bool inner;
} cycle;

static bool label_faces(sunder_i_planar_map *map)
{
    uint32_t *face = sunder_i_alloc(map->trapezoids, sizeof *face);
    if (!face) return false;
    map->face_of_trapezoid = face;
    memset(face, 0xff, map->trapezoids * sizeof *face);
    map->faces = 0;
    uint32_t outermost = 0;
    while (map->trapezoid[outermost].node == NOWHERE || map->trapezoid[outermost].top != NOWHERE) outermost++;
    for (uint32_t i = 0; i <= map->trapezoids; i++) {
        const uint32_t seed = i ? i - 1 : outermost;
        if (map->trapezoid[seed].node == NOWHERE || face[seed] != NOWHERE) continue;
        const uint32_t f = map->faces++;
        map->stack.n = 0;
        face[seed] = f;
        if (!sunder_i_map_push(map, &map->stack, seed)) return false;
        while (map->stack.n) {
            const sunder_i_trapezoid *z = &map->trapezoid[map->stack.item[--map->stack.n]];
            const uint32_t across[4] = {z->lu, z->ll, z->ru, z->rl};
            for (int k = 0; k < 4; k++) {
                if (across[k] == NOWHERE || face[across[k]] != NOWHERE) continue;
                face[across[k]] = f;
                if (!sunder_i_map_push(map, &map->stack, across[k])) return false;
            }
        }
    }
    map->face_covered = sunder_i_alloc(map->faces, sizeof *map->face_covered);
    if (!map->face_covered) return false;
    for (uint32_t t = 0; t < map->trapezoids; t++)
        if (map->trapezoid[t].node != NOWHERE) map->face_covered[face[t]] = map->trapezoid[t].covered;
    return true;
}

/* Returns true if the corner before h, at the origin of h, is the one to the left of a vertex that has no edges to the
 * left. */
static bool leftmost_corner(const sunder_i_planar_map *map, uint32_t h)
{
    return !(h & 1) && sunder_i_planar_map_ccw(map, h) == map->vertex[sunder_i_planar_map_origin(map, h)].out;
}

static cycle trace_cycle(sunder_i_planar_map *map, uint32_t start, uint8_t *seen)
{
    uint32_t least = sunder_i_planar_map_origin(map, start), h = start;
    bool inner = false;
    do {
        seen[h] = 1;
        const uint32_t v = sunder_i_planar_map_origin(map, h);
        if (v != least && sunder_i_planar_map_vertex_cmp(map, v, least) < 0) {
            least = v;
            inner = false;
        }
        if (v == least && leftmost_corner(map, h)) inner = true;
        h = sunder_i_planar_map_next(map, h);
    } while (h != start);
    return (cycle){start, map->face_of_trapezoid[sunder_i_map_left_of(map, start)], inner};
}

/* Sorts items by face: item i belongs to face of[i]; (*end)[f] becomes the index after the last item of face f. Returns
 * false if out of memory. */
static bool by_face(uint32_t faces, const uint32_t *item, const uint32_t *of, size_t n, uint32_t **sorted, size_t **end)
{
    *sorted = sunder_i_alloc(n, sizeof **sorted);
    *end = sunder_i_calloc(faces, sizeof **end);
    if (!*sorted || !*end) return false;
    for (size_t i = 0; i < n; i++) (*end)[of[i]]++;
    size_t sum = 0;
    for (uint32_t f = 0; f < faces; f++) {
        const size_t here = (*end)[f];
        (*end)[f] = sum;
        sum += here;
    }
    for (size_t i = 0; i < n; i++) (*sorted)[(*end)[of[i]]++] = item[i];
    return true;
}

static bool find_boundaries(sunder_i_planar_map *map, uint8_t *seen, sunder_i_list *item, sunder_i_list *of)
{
    map->face_outer = sunder_i_alloc(map->faces, sizeof *map->face_outer);
    if (!map->face_outer) return false;
    memset(map->face_outer, 0xff, map->faces * sizeof *map->face_outer);
    for (uint32_t h = 0; h < 2 * map->edges; h++) {
        if (map->edge[h >> 1].end[0] == NOWHERE || seen[h]) continue;
        const cycle c = trace_cycle(map, h, seen);
        if (!c.inner)
            map->face_outer[c.face] = c.h;
        else if (!sunder_i_map_push(map, item, c.h) || !sunder_i_map_push(map, of, c.face))
            return false;
    }
    if (!by_face(map->faces, item->item, of->item, item->n, &map->inner, &map->inner_end)) return false;
    item->n = of->n = 0;
    for (uint32_t v = 0; v < map->vertices; v++)
        if (map->vertex[v].alive && map->vertex[v].out == NOWHERE &&
            (!sunder_i_map_push(map, item, v) ||
             !sunder_i_map_push(map, of, map->face_of_trapezoid[map->vertex[v].right])))
            return false;
    return by_face(map->faces, item->item, of->item, item->n, &map->isolated, &map->isolated_end);
}

sunder_status sunder_i_planar_map_faces(sunder_i_planar_map *map, sunder_error *err)
{
    if (map->faces_valid) return SUNDER_OK;
    sunder_i_map_drop_faces(map);
    sunder_i_list item = {0}, of = {0};
    uint8_t *seen = sunder_i_calloc(2 * (size_t)map->edges, 1);
    const bool ok = seen && label_faces(map) && find_boundaries(map, seen, &item, &of);
    sunder_i_free_all(seen, item.item, of.item);
    if (!ok) map->failed = true;
    map->faces_valid = ok;
    SUNDER_I_CHECK(sunder_i_planar_map_sound(map), map->trapezoids);
    return sunder_i_map_status(map, err);
}

uint32_t sunder_i_planar_map_face_end(const sunder_i_planar_map *map) { return map->faces; }

uint32_t sunder_i_planar_map_face_covered(const sunder_i_planar_map *map, uint32_t f) { return map->face_covered[f]; }

uint32_t sunder_i_planar_map_face_outer(const sunder_i_planar_map *map, uint32_t f) { return map->face_outer[f]; }

static const uint32_t *slice_of_face(const uint32_t *item, const size_t *end, uint32_t f, size_t *n)
{
    const size_t first = f ? end[f - 1] : 0;
    *n = end[f] - first;
    return item + first;
}

const uint32_t *sunder_i_planar_map_face_inner(const sunder_i_planar_map *map, uint32_t f, size_t *n)
{
    return slice_of_face(map->inner, map->inner_end, f, n);
}

const uint32_t *sunder_i_planar_map_face_isolated(const sunder_i_planar_map *map, uint32_t f, size_t *n)
{
    return slice_of_face(map->isolated, map->isolated_end, f, n);
}

uint32_t sunder_i_planar_map_face(const sunder_i_planar_map *map, uint32_t h)
{
    return map->face_of_trapezoid[sunder_i_map_left_of(map, h)];
}

uint32_t sunder_i_planar_map_vertex_face(const sunder_i_planar_map *map, uint32_t v)
{
    return map->face_of_trapezoid[map->vertex[v].right];
}
