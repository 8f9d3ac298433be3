/* shape_pieces.c: convex pieces of polygons with holes, without added vertices: holes are joined to their outer ring by
 * bridges (bridge.c), ears are cut off until nothing is left (ears.c), and diagonals are removed as long as the pieces
 * stay strictly convex (merge_triangles.c). */
#include "shape/ears.h"

static uint32_t ring_begin(const sunder_i_rings *r, uint32_t ring) { return ring ? r->ring_end[ring - 1] : 0; }

/* Returns whether the vertices lo .. hi of a ring are a convex piece. */
static bool is_convex(const sunder_i_rings *r, uint32_t lo, uint32_t hi)
{
    /* all turns are to the left, and the ring turns once: the direction in lexicographic order changes twice */
    int falls = 0;
    for (uint32_t i = lo; i < hi; i++) {
        if (sunder_i_rings_orient(r, r->prev[i], i, r->next[i]) <= 0) return false;
        falls += sunder_i_rings_cmp(r, r->prev[i], i) < 0 && sunder_i_rings_cmp(r, i, r->next[i]) > 0;
    }
    return falls == 1;
}

/* Converts the pieces of a mesh to lists of vertices. */
static void collect_pieces(sunder_i_mesh *mesh, sunder_i_pieces *out)
{
    for (uint32_t h = 0; h < mesh->halves; h++) {
        if (mesh->origin[h] == SUNDER_I_NONE) continue;
        for (uint32_t g = h; mesh->origin[g] != SUNDER_I_NONE; g = mesh->next[g]) {
            out->piece_vertex[out->corners++] = mesh->origin[g];
            mesh->origin[g] = SUNDER_I_NONE;
        }
        out->piece_end[out->pieces++] = out->corners;
    }
}

bool sunder_i_triangulate(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, sunder_i_arena *arena,
                          sunder_i_mesh *mesh)
{
    const uint32_t lo = ring_begin(r, ring_lo), n = r->ring_end[ring_hi - 1] - lo, holes = ring_hi - ring_lo - 1;
    const size_t nodes = (size_t)n + 2 * (size_t)holes, halves = 3 * (nodes - 2);
    uint32_t *block = sunder_i_arena_alloc(arena, 4 * nodes + 4 * halves + holes, sizeof *block);
    if (!block) return false;
    sunder_i_walk walk = {.nodes = n};
    *mesh = (sunder_i_mesh){0};
    uint32_t **const array[] = {&walk.vertex, &walk.next, &walk.prev, &walk.beyond};
    for (size_t k = 0; k < 4; k++, block += nodes) *array[k] = block;
    uint32_t **const half[] = {&mesh->origin, &mesh->twin, &mesh->next, &mesh->prev};
    for (size_t k = 0; k < 4; k++, block += halves) *half[k] = block;
    for (uint32_t i = 0; i < n; i++) {
        walk.vertex[i] = lo + i;
        walk.next[i] = r->next[lo + i] - lo;
        walk.prev[i] = r->prev[lo + i] - lo;
        walk.beyond[i] = SUNDER_I_NONE;
    }
    for (uint32_t i = 0; i < holes; i++) block[i] = SUNDER_I_NONE;
    if (holes) sunder_i_bridge_holes(r, ring_lo, ring_hi, &walk, arena);
    if (!arena->failed) sunder_i_ears_cut(r, &walk, block, holes, mesh, arena);
    return !arena->failed && !r->lattice->arena.failed;
}

/* Decomposes one polygon: the rings ring_lo .. ring_hi. */
static void decompose_polygon(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, sunder_i_arena *arena,
                              sunder_i_pieces *out)
{
    const uint32_t lo = ring_begin(r, ring_lo), hi = r->ring_end[ring_hi - 1];
    if (ring_hi - ring_lo == 1 && is_convex(r, lo, hi)) {
        for (uint32_t v = lo; v < hi; v++) out->piece_vertex[out->corners++] = v;
        out->piece_end[out->pieces++] = out->corners;
        return;
    }
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    sunder_i_mesh mesh;
    if (!sunder_i_triangulate(r, ring_lo, ring_hi, arena, &mesh)) return;
    sunder_i_mesh_merge(r, &mesh);
    collect_pieces(&mesh, out);
    sunder_i_arena_release(arena, mark);
}

bool sunder_i_pieces_find(const sunder_i_rings *r, sunder_i_arena *arena, sunder_i_pieces *out)
{
    /* a polygon with n vertices and h holes has at most n + 2 h - 2 triangles */
    const size_t most = r->vertices + 2 * (size_t)r->rings;
    out->pieces = out->corners = 0;
    out->piece_end = sunder_i_arena_alloc(arena, most, sizeof *out->piece_end);
    out->piece_vertex = sunder_i_arena_alloc(arena, 3 * most, sizeof *out->piece_vertex);
    if (arena->failed) return false;
    for (uint32_t p = 0; p < r->polygons; p++)
        decompose_polygon(r, p ? r->poly_end[p - 1] : 0, r->poly_end[p], arena, out);
    return !arena->failed && !r->lattice->arena.failed;
}
