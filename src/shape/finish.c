/* finish.c: a finished shape in one block of memory: the struct, followed by its arrays, those with larger elements
 * first, except those that all rings with few vertices share. */
#include "shape/build.h"

#include "shape/few_corners.h"

#include <string.h>

/* Takes n elements from the block and returns their address; with block NULL it only counts. */
static void *carve_array(unsigned char *block, size_t *used, size_t n, size_t size)
{
    void *at = block ? block + *used : NULL;
    *used += n * size;
    return at;
}

/* Which arrays a shape needs for itself. */
typedef struct layout {
    size_t raw_vertices, raw_rings;
    uint32_t raw_polygons;
    uint32_t corners; /* the number of vertices of all pieces */
    bool numbers;     /* some vertex may not be a pair of doubles, or there are many vertices */
    bool few;         /* one ring with few vertices in different positions, so that its form is shared */
    bool whole;       /* ... and it is one convex piece that begins at its first vertex */
    bool clean;       /* ... and the raw ring begins with its vertices */
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

static layout choose_layout(const double *xy, const size_t *ring_end, const size_t *poly_end, size_t polygons,
                            const sunder_i_rings *r, const sunder_i_pieces *pieces)
{
    layout l = {.raw_rings = polygons ? poly_end[polygons - 1] : 0,
                .raw_polygons = (uint32_t)polygons,
                .corners = pieces->corners,
                .numbers = r->rounded || r->vertices > SUNDER_I_ANCHOR_CORNERS};
    l.raw_vertices = l.raw_rings ? ring_end[l.raw_rings - 1] : 0;
    l.few = r->rings == 1 && r->polygons == 1 && r->vertices >= 3 && r->vertices <= SUNDER_I_FEW_CORNERS &&
            polygons == 1 && l.raw_rings == 1 && l.raw_vertices >= 3 && l.raw_vertices <= SUNDER_I_FEW_CORNERS + 1 &&
            !r->rounded && have_places_of_their_own(r);
    if (!l.few) return l;
    l.whole = pieces->pieces == 1 && pieces->corners == r->vertices && is_identity(pieces->piece_vertex, r->vertices);
    l.clean = l.raw_vertices >= r->vertices && memcmp(xy, r->xy, 2 * (size_t)r->vertices * sizeof *xy) == 0;
    return l;
}

/* The arrays to be filled. */
typedef struct arrays {
    size_t *given_ring_end, *given_poly_end;
    uint32_t *ring_end, *poly_end, *next, *prev, *piece_end;
    bool *shared;
} arrays;

/* Lays out the arrays that describe the rings, raw and cleaned; `head` has the numbers of rings and polygons. */
static void lay_out_rings(sunder_shape *s, unsigned char *block, size_t *used, const layout *l,
                          const sunder_i_cleaned *head, arrays *to)
{
    sunder_i_numbers *numbers = l->numbers ? carve_array(block, used, 1, sizeof *numbers) : NULL;
    sunder_i_form *form = carve_array(block, used, 1, sizeof *form);
    to->given_ring_end = carve_array(block, used, l->raw_rings, sizeof *to->given_ring_end);
    to->given_poly_end = carve_array(block, used, l->raw_polygons, sizeof *to->given_poly_end);
    to->ring_end = carve_array(block, used, head->rings, sizeof *to->ring_end);
    to->poly_end = carve_array(block, used, head->polygons, sizeof *to->poly_end);
    to->next = carve_array(block, used, s->vertices, sizeof *to->next);
    to->prev = carve_array(block, used, s->vertices, sizeof *to->prev);
    if (!block) return;
    if (numbers) *numbers = (sunder_i_numbers){0};
    *form =
        (sunder_i_form){.given = {to->given_ring_end, to->given_poly_end, l->raw_polygons},
                        .cleaned = {to->ring_end, to->poly_end, to->next, to->prev, NULL, head->rings, head->polygons},
                        .numbers = numbers};
    s->form = form;
}

/* Sets the marks of vertices with a common position. */
static void set_shared(sunder_shape *s, const bool *shared) { ((sunder_i_form *)s->form)->cleaned.shared = shared; }

/* Lays out the block and returns its size; with block NULL it only counts. */
static size_t lay_out(sunder_shape *s, unsigned char *block, const layout *l, const sunder_i_cleaned *head, arrays *to)
{
    size_t used = sizeof *s + 2 * l->raw_vertices * sizeof *s->raw_xy;
    *to = (arrays){0};
    double *xy = l->clean ? NULL : carve_array(block, &used, 2 * (size_t)s->vertices, sizeof *s->xy);
    if (!l->few) lay_out_rings(s, block, &used, l, head, to);
    if (!l->whole) to->piece_end = carve_array(block, &used, (size_t)s->pieces + l->corners, sizeof *to->piece_end);
    if (!l->few) to->shared = carve_array(block, &used, s->vertices, sizeof *to->shared);
    if (!block) return used;
    s->xy = l->clean ? s->raw_xy : xy;
    s->piece_end = l->whole ? sunder_i_few_whole(s->vertices) : to->piece_end;
    if (l->few) {
        s->form = sunder_i_few_form(s->vertices, l->raw_vertices);
    } else {
        set_shared(s, to->shared);
    }
    return used;
}

static void copy_array(void *to, const void *from, size_t n, size_t size)
{
    if (n) memcpy(to, from, n * size);
}

/* Allocates the shape with its arrays and copies the pieces; NULL if out of memory. */
static sunder_shape *allocate_shape(uint32_t vertices, const sunder_i_pieces *pieces, const layout *l,
                                    const sunder_i_cleaned *head, arrays *to)
{
    sunder_shape counted = {.vertices = vertices, .pieces = pieces->pieces};
    sunder_shape *s = sunder_i_alloc(lay_out(&counted, NULL, l, head, to), 1);
    if (!s) return NULL;
    *s = counted;
    lay_out(s, (unsigned char *)s, l, head, to);
    if (l->whole) return s;
    copy_array(to->piece_end, pieces->piece_end, pieces->pieces, sizeof *pieces->piece_end);
    copy_array(to->piece_end + pieces->pieces, pieces->piece_vertex, pieces->corners, sizeof *pieces->piece_vertex);
    return s;
}

sunder_shape *sunder_i_shape_assemble(const double *xy, const size_t *ring_end, const size_t *poly_end, size_t polygons,
                                      const sunder_i_rings *r, const sunder_i_pieces *pieces)
{
    const layout l = choose_layout(xy, ring_end, poly_end, polygons, r, pieces);
    const sunder_i_cleaned head = {.rings = r->rings, .polygons = r->polygons};
    arrays to;
    sunder_shape *s = allocate_shape(r->vertices, pieces, &l, &head, &to);
    if (!s) return NULL;
    copy_array(s->raw_xy, xy, 2 * l.raw_vertices, sizeof *xy);
    if (!l.clean) copy_array(s->xy, r->xy, 2 * (size_t)r->vertices, sizeof *r->xy);
    if (l.few) return s;
    copy_array(to.given_ring_end, ring_end, l.raw_rings, sizeof *ring_end);
    copy_array(to.given_poly_end, poly_end, polygons, sizeof *poly_end);
    copy_array(to.ring_end, r->ring_end, r->rings, sizeof *r->ring_end);
    copy_array(to.poly_end, r->poly_end, r->polygons, sizeof *r->poly_end);
    copy_array(to.next, r->next, r->vertices, sizeof *r->next);
    copy_array(to.prev, r->prev, r->vertices, sizeof *r->prev);
    return s;
}

sunder_shape *sunder_i_shape_assemble_small(const double *xy, size_t raw, uint32_t n, sunder_i_small_ring ring,
                                            const sunder_i_pieces *pieces)
{
    const bool whole = pieces->pieces == 1, own = ring.turned || ring.start;
    const size_t doubles = 2 * (raw + (own ? n : 0)), numbers = whole ? 0 : (size_t)pieces->pieces + pieces->corners;
    sunder_shape *s = sunder_i_alloc(sizeof *s + doubles * sizeof *xy + numbers * sizeof *pieces->piece_end, 1);
    if (!s) return NULL;
    double *const raw_xy = s->raw_xy, *const own_xy = own ? raw_xy + 2 * raw : raw_xy;
    uint32_t *const ends = (uint32_t *)(void *)(raw_xy + doubles);
    *s = (sunder_shape){.form = sunder_i_few_form(n, raw),
                        .piece_end = whole ? sunder_i_few_whole(n) : ends,
                        .xy = own_xy,
                        .vertices = n,
                        .pieces = pieces->pieces};
    memcpy(raw_xy, xy, 2 * raw * sizeof *xy);
    for (uint32_t i = 0; own && i < n; i++)
        memcpy(own_xy + 2 * i, xy + 2 * sunder_i_small_ring_corner(ring, n, i), 2 * sizeof *xy);
    if (!whole) {
        memcpy(ends, pieces->piece_end, pieces->pieces * sizeof *ends);
        memcpy(ends + pieces->pieces, pieces->piece_vertex, pieces->corners * sizeof *ends);
    }
    return s;
}

/* Returns the shape's own marks of vertices with a common position; NULL for a shared form, in which even the nearest
 * doubles differ. */
static bool *own_marks(sunder_shape *s)
{
    return sunder_i_is_few_form(s->form) ? NULL : (bool *)s->form->cleaned.shared;
}

void sunder_i_shape_copy_shared(sunder_shape *shape, const bool *shared)
{
    bool *own = own_marks(shape);
    if (own) copy_array(own, shared, shape->vertices, sizeof *own);
}

void sunder_i_shape_mark_none_shared(sunder_shape *shape)
{
    bool *own = own_marks(shape);
    if (own && shape->vertices) memset(own, 0, shape->vertices * sizeof *own);
}

void sunder_i_shape_measure(sunder_shape *shape, const sunder_i_extent *known)
{
    sunder_i_extent extent = {0};
    if (known)
        extent = *known;
    else
        sunder_i_extent_add(&extent, shape->xy, shape->vertices);
    shape->low_bit = extent.low_bit;
    if (!shape->vertices) return;
    for (int k = 0; k < 2; k++) {
        shape->box[k] = extent.low[k];
        shape->box[k + 2] = extent.high[k];
    }
}

static bool same_place(const sunder_shape *s, uint32_t i, uint32_t j)
{
    if (s->xy[2 * (size_t)i] != s->xy[2 * (size_t)j] || s->xy[2 * (size_t)i + 1] != s->xy[2 * (size_t)j + 1])
        return false;
    if (!s->rational) return true;
    /* in lowest terms a position has one representation */
    const sunder_i_exact *a = &s->form->numbers->exact[i], *b = &s->form->numbers->exact[j];
    return a->exponent == b->exponent && sunder_i_big_cmp(a->den, b->den) == 0 &&
           sunder_i_big_cmp(a->num[0], b->num[0]) == 0 && sunder_i_big_cmp(a->num[1], b->num[1]) == 0;
}

/* Returns a hash of a position; both zeros have the same one. */
static uint32_t place_hash(const double *xy)
{
    const double at[2] = {xy[0] + 0.0, xy[1] + 0.0};
    uint64_t b[2];
    memcpy(b, at, sizeof b);
    b[0] = (b[0] ^ b[0] >> 29) * 0x9e3779b97f4a7c15u;
    b[0] = ((b[0] ^ b[1]) ^ b[0] >> 32) * 0xbf58476d1ce4e5b9u;
    return (uint32_t)(b[0] >> 32);
}

bool sunder_i_shape_mark_shared(sunder_shape *shape, sunder_i_arena *arena)
{
    bool *const shared = own_marks(shape);
    if (!shape->vertices || !shared) return true;
    memset(shared, 0, shape->vertices * sizeof *shared);
    if (shape->vertices <= 16) {
        for (uint32_t i = 0; i < shape->vertices; i++)
            for (uint32_t j = i + 1; j < shape->vertices; j++)
                if (same_place(shape, i, j)) shared[i] = shared[j] = true;
        return true;
    }
    /* a hash table with open addressing, at most half full; it contains the first vertex of each position */
    size_t slots = 32;
    while (slots < 2 * (size_t)shape->vertices) slots *= 2;
    uint32_t *table = sunder_i_arena_alloc(arena, slots, sizeof *table);
    if (!table) return false;
    memset(table, 0xff, slots * sizeof *table);
    for (uint32_t i = 0; i < shape->vertices; i++) {
        size_t slot = place_hash(shape->xy + 2 * (size_t)i) & (slots - 1);
        while (table[slot] != SUNDER_I_NONE && !same_place(shape, table[slot], i)) slot = (slot + 1) & (slots - 1);
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
    if (shape->form && shape->form->numbers) sunder_i_arena_free(&shape->form->numbers->arena);
    sunder_i_free(shape);
}
