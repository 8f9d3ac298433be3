/* A finished shape in one block of memory: the struct and its arrays behind it, those of wider types first; but for
 * those that all rings of few corners have in common. */
#include "shape/build.h"

#include "shape/few_corners.h"

#include <string.h>

/* Takes n elements off the block; with block NULL it only counts. */
static void *carve(unsigned char *block, size_t *used, size_t n, size_t size)
{
    void *at = block ? block + *used : NULL;
    *used += n * size;
    return at;
}

/* Which arrays a shape has of its own. */
typedef struct layout {
    size_t raw_vertices, raw_rings;
    uint32_t corners; /* of pieces */
    bool numbers;     /* some corner may be no pair of doubles */
    bool few;         /* its rings are one of few corners: links and ends are those of all such */
    bool whole;       /* and it is its only piece, from its first corner on */
    bool clean;       /* and the ring as given begins with its corners */
    bool unshared;    /* and they all stand in different places */
} layout;

static bool have_places_of_their_own(const sunder_i_rings *r)
{
    for (uint32_t i = 0; i < r->vertices; i++)
        for (uint32_t j = i + 1; j < r->vertices; j++)
            if (r->xy[2 * i] == r->xy[2 * j] && r->xy[2 * i + 1] == r->xy[2 * j + 1]) return false;
    return true;
}

static bool is_identity(const uint32_t *number, uint32_t n)
{
    for (uint32_t k = 0; k < n; k++)
        if (number[k] != k) return false;
    return true;
}

static layout plan(const double *xy, const size_t *ring_end, const size_t *poly_end, size_t polygons,
                   const sunder_i_rings *r, const sunder_i_pieces *pieces)
{
    layout l = {.raw_rings = polygons ? poly_end[polygons - 1] : 0, .corners = pieces->corners, .numbers = r->rounded};
    l.raw_vertices = l.raw_rings ? ring_end[l.raw_rings - 1] : 0;
    l.few = r->rings == 1 && r->polygons == 1 && r->vertices >= 3 && r->vertices <= SUNDER_I_FEW_CORNERS &&
            polygons == 1 && l.raw_rings == 1 && l.raw_vertices <= SUNDER_I_FEW_CORNERS + 1;
    if (!l.few) return l;
    l.whole = pieces->pieces == 1 && pieces->corners == r->vertices && is_identity(pieces->piece_vertex, r->vertices);
    l.clean =
        !r->rounded && l.raw_vertices >= r->vertices && memcmp(xy, r->xy, 2 * (size_t)r->vertices * sizeof *xy) == 0;
    l.unshared = have_places_of_their_own(r);
    return l;
}

static size_t lay_out(sunder_shape *s, unsigned char *block, const sunder_shape *n, const layout *l)
{
    size_t used = sizeof *s;
    s->numbers = l->numbers ? carve(block, &used, 1, sizeof *s->numbers) : NULL;
    s->raw_xy = carve(block, &used, 2 * l->raw_vertices, sizeof *s->raw_xy);
    s->xy = l->clean ? s->raw_xy : carve(block, &used, 2 * (size_t)n->vertices, sizeof *s->xy);
    if (l->few) {
        const sunder_i_few_corners few = sunder_i_few_corners_of(n->vertices);
        s->raw_ring_end = sunder_i_few_long(l->raw_vertices);
        s->raw_poly_end = sunder_i_few_long(1);
        s->ring_end = sunder_i_few(n->vertices);
        s->poly_end = sunder_i_few(1);
        s->next = few.next;
        s->prev = few.prev;
        s->piece_end = sunder_i_few(n->vertices);
        s->piece_vertex = few.corner;
        s->shared = few.unshared;
    } else {
        s->raw_ring_end = carve(block, &used, l->raw_rings, sizeof *s->raw_ring_end);
        s->raw_poly_end = carve(block, &used, n->raw_polygons, sizeof *s->raw_poly_end);
        s->ring_end = carve(block, &used, n->rings, sizeof *s->ring_end);
        s->poly_end = carve(block, &used, n->polygons, sizeof *s->poly_end);
        s->next = carve(block, &used, n->vertices, sizeof *s->next);
        s->prev = carve(block, &used, n->vertices, sizeof *s->prev);
    }
    if (!l->whole) {
        s->piece_end = carve(block, &used, n->pieces, sizeof *s->piece_end);
        s->piece_vertex = carve(block, &used, l->corners, sizeof *s->piece_vertex);
    }
    if (!l->unshared) s->shared = carve(block, &used, n->vertices, sizeof *s->shared);
    return used;
}

/* `to` is an array of the shape's own block, so it may be written. */
static void copy(const void *to, const void *from, size_t n, size_t size)
{
    if (n) memcpy((void *)to, from, n * size);
}

/* The shape with its arrays, which are to be filled; NULL if memory is out. */
static sunder_shape *allocate(const sunder_shape *head, const layout *l)
{
    sunder_shape counted = *head;
    sunder_shape *s = sunder_i_alloc(lay_out(&counted, NULL, head, l), 1);
    if (!s) return NULL;
    *s = *head;
    lay_out(s, (unsigned char *)s, head, l);
    if (s->numbers) *s->numbers = (sunder_i_numbers){0};
    return s;
}

sunder_shape *sunder_i_shape_assemble(const double *xy, const size_t *ring_end, const size_t *poly_end, size_t polygons,
                                      const sunder_i_rings *r, const sunder_i_pieces *pieces)
{
    const layout l = plan(xy, ring_end, poly_end, polygons, r, pieces);
    sunder_shape head = {.raw_polygons = (uint32_t)polygons,
                         .vertices = r->vertices,
                         .rings = r->rings,
                         .polygons = r->polygons,
                         .pieces = pieces->pieces};
    sunder_shape *s = allocate(&head, &l);
    if (!s) return NULL;
    copy(s->raw_xy, xy, 2 * l.raw_vertices, sizeof *xy);
    if (!l.clean) copy(s->xy, r->xy, 2 * (size_t)r->vertices, sizeof *r->xy);
    if (!l.few) {
        copy(s->raw_ring_end, ring_end, l.raw_rings, sizeof *ring_end);
        copy(s->raw_poly_end, poly_end, polygons, sizeof *poly_end);
        copy(s->ring_end, r->ring_end, r->rings, sizeof *r->ring_end);
        copy(s->poly_end, r->poly_end, r->polygons, sizeof *r->poly_end);
        copy(s->next, r->next, r->vertices, sizeof *r->next);
        copy(s->prev, r->prev, r->vertices, sizeof *r->prev);
    }
    if (!l.whole) {
        copy(s->piece_end, pieces->piece_end, pieces->pieces, sizeof *pieces->piece_end);
        copy(s->piece_vertex, pieces->piece_vertex, pieces->corners, sizeof *pieces->piece_vertex);
    }
    return s;
}

sunder_shape *sunder_i_shape_assemble_small(const double *xy, size_t raw, uint32_t n, bool turned,
                                            const sunder_i_pieces *pieces)
{
    const bool whole = pieces->pieces == 1;
    const size_t doubles = 2 * (raw + (turned ? n : 0)), numbers = whole ? 0 : (size_t)pieces->pieces + pieces->corners;
    const sunder_i_few_corners few = sunder_i_few_corners_of(n);
    sunder_shape *s = sunder_i_alloc(sizeof *s + doubles * sizeof *xy + numbers * sizeof *pieces->piece_end, 1);
    if (!s) return NULL;
    double *const raw_xy = (double *)(void *)(s + 1), *const own_xy = turned ? raw_xy + 2 * raw : raw_xy;
    uint32_t *const ends = (uint32_t *)(void *)(raw_xy + doubles);
    *s = (sunder_shape){.raw_xy = raw_xy,
                        .raw_ring_end = sunder_i_few_long(raw),
                        .raw_poly_end = sunder_i_few_long(1),
                        .raw_polygons = 1,
                        .vertices = n,
                        .rings = 1,
                        .polygons = 1,
                        .pieces = pieces->pieces,
                        .xy = own_xy,
                        .ring_end = sunder_i_few(n),
                        .poly_end = sunder_i_few(1),
                        .next = few.next,
                        .prev = few.prev,
                        .shared = few.unshared,
                        .piece_end = whole ? sunder_i_few(n) : ends,
                        .piece_vertex = whole ? few.corner : ends + pieces->pieces};
    memcpy(raw_xy, xy, 2 * raw * sizeof *xy);
    for (uint32_t i = 0; turned && i < n; i++) memcpy(own_xy + 2 * i, xy + 2 * (n - 1 - i), 2 * sizeof *xy);
    if (!whole) {
        memcpy(ends, pieces->piece_end, pieces->pieces * sizeof *ends);
        memcpy(ends + pieces->pieces, pieces->piece_vertex, pieces->corners * sizeof *ends);
    }
    return s;
}

/* The marks of a shape of which some corners may share their places; NULL where it is known that none do, since even
 * the nearest doubles differ. */
static bool *own_marks(sunder_shape *s)
{
    const bool few = s->vertices >= 3 && s->vertices <= SUNDER_I_FEW_CORNERS &&
                     s->shared == sunder_i_few_corners_of(s->vertices).unshared;
    return few ? NULL : (bool *)s->shared;
}

void sunder_i_shape_copy_shared(sunder_shape *s, const bool *shared)
{
    bool *own = own_marks(s);
    if (own) copy(own, shared, s->vertices, sizeof *own);
}

void sunder_i_shape_mark_none_shared(sunder_shape *s)
{
    bool *own = own_marks(s);
    if (own && s->vertices) memset(own, 0, s->vertices * sizeof *own);
}

void sunder_i_shape_measure(sunder_shape *s, const sunder_i_extent *known)
{
    sunder_i_extent extent = {0};
    if (known)
        extent = *known;
    else
        sunder_i_extent_add(&extent, s->xy, s->vertices);
    s->low_bit = extent.low_bit;
    if (!s->vertices) return;
    for (int k = 0; k < 2; k++) {
        s->box[k] = extent.low[k];
        s->box[k + 2] = extent.high[k];
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
    bool *const shared = own_marks(s);
    if (!s->vertices || !shared) return true;
    memset(shared, 0, s->vertices * sizeof *shared);
    if (s->vertices <= 16) {
        for (uint32_t i = 0; i < s->vertices; i++)
            for (uint32_t j = i + 1; j < s->vertices; j++)
                if (same_place(s, i, j)) shared[i] = shared[j] = true;
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
            shared[i] = shared[table[slot]] = true;
    }
    return true;
}

void sunder_shape_free(sunder_shape *shape)
{
    if (!shape) return;
    if (shape->numbers) sunder_i_arena_free(&shape->numbers->arena);
    sunder_i_free(shape);
}
