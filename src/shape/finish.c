/* A finished shape in one block of memory: the struct and its arrays behind it, those of wider types first. */
#include "shape/build.h"

#include <string.h>

/* Takes n elements off the block; with block NULL it only counts. */
static void *carve(unsigned char *block, size_t *used, size_t n, size_t size)
{
    void *at = block ? block + *used : NULL;
    *used += n * size;
    return at;
}

static size_t lay_out(sunder_shape *s, unsigned char *block, size_t raw_vertices, size_t raw_rings,
                      const sunder_shape *n, uint32_t corners)
{
    size_t used = (sizeof *s + 15) & ~(size_t)15;
    s->raw_xy = carve(block, &used, 2 * raw_vertices, sizeof *s->raw_xy);
    s->xy = carve(block, &used, 2 * (size_t)n->vertices, sizeof *s->xy);
    s->raw_ring_end = carve(block, &used, raw_rings, sizeof *s->raw_ring_end);
    s->raw_poly_end = carve(block, &used, n->raw_polygons, sizeof *s->raw_poly_end);
    s->ring_end = carve(block, &used, n->rings, sizeof *s->ring_end);
    s->poly_end = carve(block, &used, n->polygons, sizeof *s->poly_end);
    s->next = carve(block, &used, n->vertices, sizeof *s->next);
    s->prev = carve(block, &used, n->vertices, sizeof *s->prev);
    s->piece_end = carve(block, &used, n->pieces, sizeof *s->piece_end);
    s->piece_vertex = carve(block, &used, corners, sizeof *s->piece_vertex);
    s->shared = carve(block, &used, n->vertices, sizeof *s->shared);
    return used;
}

static void copy(void *to, const void *from, size_t n, size_t size)
{
    if (n) memcpy(to, from, n * size);
}

sunder_shape *sunder_i_shape_assemble(const double *xy, const size_t *ring_end, const size_t *poly_end, size_t polygons,
                                      const sunder_i_rings *r, const sunder_i_pieces *pieces)
{
    const size_t raw_rings = polygons ? poly_end[polygons - 1] : 0,
                 raw_vertices = raw_rings ? ring_end[raw_rings - 1] : 0;
    sunder_shape head = {.raw_polygons = polygons,
                         .vertices = r->vertices,
                         .rings = r->rings,
                         .polygons = r->polygons,
                         .pieces = pieces->pieces};
    const size_t bytes = lay_out(&head, NULL, raw_vertices, raw_rings, &head, pieces->corners);
    sunder_shape *s = sunder_i_alloc(bytes, 1);
    if (!s) return NULL;
    *s = head;
    lay_out(s, (unsigned char *)s, raw_vertices, raw_rings, &head, pieces->corners);
    copy(s->raw_xy, xy, 2 * raw_vertices, sizeof *xy);
    copy(s->raw_ring_end, ring_end, raw_rings, sizeof *ring_end);
    copy(s->raw_poly_end, poly_end, polygons, sizeof *poly_end);
    copy(s->xy, r->xy, 2 * (size_t)r->vertices, sizeof *r->xy);
    copy(s->ring_end, r->ring_end, r->rings, sizeof *r->ring_end);
    copy(s->poly_end, r->poly_end, r->polygons, sizeof *r->poly_end);
    copy(s->next, r->next, r->vertices, sizeof *r->next);
    copy(s->prev, r->prev, r->vertices, sizeof *r->prev);
    copy(s->piece_end, pieces->piece_end, pieces->pieces, sizeof *pieces->piece_end);
    copy(s->piece_vertex, pieces->piece_vertex, pieces->corners, sizeof *pieces->piece_vertex);
    return s;
}

void sunder_i_shape_measure(sunder_shape *s, const sunder_i_extent *known)
{
    if (known)
        s->extent = *known;
    else
        sunder_i_extent_add(&s->extent, s->xy, s->vertices);
    if (!s->vertices) return;
    for (int k = 0; k < 2; k++) {
        s->box[k] = s->extent.low[k];
        s->box[k + 2] = s->extent.high[k];
    }
}

static bool same_place(const sunder_shape *s, uint32_t i, uint32_t j)
{
    if (s->xy[2 * (size_t)i] != s->xy[2 * (size_t)j] || s->xy[2 * (size_t)i + 1] != s->xy[2 * (size_t)j + 1])
        return false;
    if (!s->rational) return true;
    /* In lowest terms one place has one set of numbers. */
    const sunder_i_exact *a = &s->exact[i], *b = &s->exact[j];
    return a->exponent == b->exponent && sunder_i_big_cmp(a->den, b->den) == 0 &&
           sunder_i_big_cmp(a->num[0], b->num[0]) == 0 && sunder_i_big_cmp(a->num[1], b->num[1]) == 0;
}

/* Equal for equal places; both zeros are one place. */
static uint32_t place_hash(const double *xy)
{
    const double at[2] = {xy[0] + 0.0, xy[1] + 0.0};
    uint64_t b[2];
    memcpy(b, at, sizeof b);
    b[0] = (b[0] ^ b[0] >> 29) * 0x9e3779b97f4a7c15u;
    b[0] = ((b[0] ^ b[1]) ^ b[0] >> 32) * 0xbf58476d1ce4e5b9u;
    return (uint32_t)(b[0] >> 32);
}

bool sunder_i_shape_mark_shared(sunder_shape *s, sunder_i_arena *arena)
{
    if (!s->vertices) return true;
    memset(s->shared, 0, s->vertices * sizeof *s->shared);
    if (s->vertices <= 16) {
        for (uint32_t i = 0; i < s->vertices; i++)
            for (uint32_t j = i + 1; j < s->vertices; j++)
                if (same_place(s, i, j)) s->shared[i] = s->shared[j] = true;
        return true;
    }
    /* Open addressing, at most half full; the first vertex of each place stands in the table. */
    size_t slots = 32;
    while (slots < 2 * (size_t)s->vertices) slots *= 2;
    uint32_t *table = sunder_i_arena_alloc(arena, slots, sizeof *table);
    if (!table) return false;
    memset(table, 0xff, slots * sizeof *table);
    for (uint32_t i = 0; i < s->vertices; i++) {
        size_t slot = place_hash(s->xy + 2 * (size_t)i) & (slots - 1);
        while (table[slot] != SUNDER_I_NONE && !same_place(s, table[slot], i)) slot = (slot + 1) & (slots - 1);
        if (table[slot] == SUNDER_I_NONE)
            table[slot] = i;
        else
            s->shared[i] = s->shared[table[slot]] = true;
    }
    return true;
}

void sunder_shape_free(sunder_shape *shape)
{
    if (!shape) return;
    sunder_i_arena_free(&shape->arena);
    sunder_i_free(shape);
}
