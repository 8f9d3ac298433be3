/* of_pieces.c: a shape with one polygon for each of a list of convex pieces.
 *
 * Polygons of a shape may touch and overlap, so that some pieces of a polygonal set are a polygonal set; the sides
 * between them are inside it, or on the boundary that results from omitting others. Pieces may also have no area: a
 * segment is a ring of two vertices, a point a ring of one, which is its own neighbour; the shape is then flat.
 * Vertices that are not doubles keep their numbers, which are borrowed. */
#include "shape/of_pieces.h"

#include "base/error.h"
#include "spatial/box.h"

#include <string.h>

static uint32_t first_corner(const sunder_i_piece_of *p) { return p->piece ? p->shape->piece_end[p->piece - 1] : 0; }

uint32_t sunder_i_piece_corners(const sunder_i_piece_of *piece)
{
    return piece->shape ? piece->shape->piece_end[piece->piece] - first_corner(piece) : piece->n;
}

bool sunder_i_piece_edge(const sunder_i_piece_of *piece, uint32_t k, uint32_t vertex[2])
{
    const uint32_t n = sunder_i_piece_corners(piece);
    if (n == 1 || (n == 2 && k)) return false;
    vertex[0] = k;
    vertex[1] = k + 1 < n ? k + 1 : 0;
    if (!piece->shape) return true;
    for (int e = 0; e < 2; e++) vertex[e] = sunder_i_piece_vertices(piece->shape)[first_corner(piece) + vertex[e]];
    return sunder_i_is_boundary(piece->shape, vertex[0], vertex[1]);
}

/* Returns vertex k in doubles; *exact becomes its exact numbers, or NULL if it is a pair of doubles. */
static const double *corner_of(const sunder_i_piece_of *p, uint32_t k, const sunder_i_exact **exact)
{
    *exact = NULL;
    if (!p->shape) return p->xy + 2 * (size_t)k;
    const uint32_t v = sunder_i_piece_vertices(p->shape)[first_corner(p) + k];
    if (p->shape->rational && p->shape->form->numbers->exact[v].den.size) *exact = &p->shape->form->numbers->exact[v];
    return p->shape->xy + 2 * (size_t)v;
}

bool sunder_i_piece_has_area(const sunder_i_piece_of *piece) { return sunder_i_piece_corners(piece) > 2; }

void sunder_i_piece_box(const sunder_i_piece_of *piece, double box[4])
{
    const sunder_i_exact *exact;
    sunder_i_box_clear(box);
    for (uint32_t k = 0; k < sunder_i_piece_corners(piece); k++) sunder_i_box_include(box, corner_of(piece, k, &exact));
    if (piece->shape && piece->shape->rational) sunder_i_box_grow(box, 0, box);
}

/* The arrays to be filled. */
typedef struct arrays {
    uint32_t *ring_end, *poly_end, *next, *prev, *corner;
    bool *shared;
} arrays;

/* Allocates all arrays in the shape's arena. Returns false if out of memory. */
static bool make_room(sunder_shape *s, sunder_i_form *form, arrays *to)
{
    sunder_i_arena *a = &form->numbers->arena;
    s->xy = sunder_i_arena_alloc(a, s->vertices, 2 * sizeof *s->xy);
    s->piece_end = to->ring_end = sunder_i_arena_alloc(a, s->pieces + (size_t)s->vertices, sizeof *to->ring_end);
    to->corner = to->ring_end ? to->ring_end + s->pieces : NULL;
    to->poly_end = sunder_i_arena_alloc(a, s->pieces, sizeof *to->poly_end);
    to->next = sunder_i_arena_alloc(a, s->vertices, sizeof *to->next);
    to->prev = sunder_i_arena_alloc(a, s->vertices, sizeof *to->prev);
    to->shared = sunder_i_arena_alloc(a, s->vertices, sizeof *to->shared);
    form->cleaned =
        (sunder_i_cleaned){to->ring_end, to->poly_end, to->next, to->prev, to->shared, s->pieces, s->pieces};
    if (s->rational) form->numbers->exact = sunder_i_arena_alloc(a, s->vertices, sizeof *form->numbers->exact);
    return !a->failed;
}

static void fill_arrays(sunder_shape *s, const arrays *to, const sunder_i_piece_of *piece)
{
    uint32_t at = 0;
    for (uint32_t i = 0; i < s->pieces; i++) {
        const uint32_t n = sunder_i_piece_corners(&piece[i]), first = at;
        for (uint32_t k = 0; k < n; k++, at++) {
            const sunder_i_exact *exact;
            memcpy(s->xy + 2 * (size_t)at, corner_of(&piece[i], k, &exact), 2 * sizeof *s->xy);
            to->next[at] = k + 1 < n ? at + 1 : first;
            to->prev[at] = k ? at - 1 : first + n - 1;
            to->corner[at] = at;
            to->shared[at] = true;
            if (s->rational) s->form->numbers->exact[at] = exact ? *exact : (sunder_i_exact){.den = {NULL, 0}};
        }
        to->ring_end[i] = at;
        to->poly_end[i] = i + 1;
    }
}

/* Sets the box, and a lowest bit for all vertices: for crossings that of the shape they come from. */
static void measure_shape(sunder_shape *s, const sunder_i_piece_of *piece)
{
    sunder_i_extent extent = {0};
    sunder_i_extent_add(&extent, s->xy, s->vertices);
    for (uint32_t i = 0; i < s->pieces; i++) {
        const sunder_shape *of = piece[i].shape;
        if (of && of->rational && of->low_bit < extent.low_bit) extent.low_bit = of->low_bit;
    }
    s->low_bit = extent.low_bit;
    /* any point of the shape */
    if (s->vertices) memcpy(s->form->numbers->anchor, s->xy, sizeof s->form->numbers->anchor);
    for (int k = 0; k < 2; k++) {
        s->box[k] = extent.low[k];
        s->box[k + 2] = extent.high[k];
    }
    if (s->rational) sunder_i_box_grow(s->box, 0, s->box);
}

sunder_status sunder_i_shape_of_pieces(const sunder_i_piece_of *piece, size_t n, sunder_shape **out, sunder_error *err)
{
    size_t corners = 0;
    for (size_t i = 0; i < n; i++) corners += sunder_i_piece_corners(&piece[i]);
    if (corners >= UINT32_MAX / 2) return sunder_i_fail(err, SUNDER_ESIZE, "too many corners: %zu", corners);
    sunder_i_form *form;
    sunder_shape *s = sunder_i_calloc(1, sizeof *s + sizeof *form->numbers + sizeof *form);
    if (!s) return sunder_i_failure_cause(err);
    sunder_i_numbers *numbers = (sunder_i_numbers *)(s + 1);
    s->form = form = (sunder_i_form *)(numbers + 1);
    form->numbers = numbers;
    s->vertices = (uint32_t)corners;
    s->pieces = (uint32_t)n;
    for (size_t i = 0; i < n; i++) {
        s->flat = s->flat || sunder_i_piece_corners(&piece[i]) < 3;
        s->rational = s->rational || (piece[i].shape && piece[i].shape->rational);
    }
    arrays to;
    if (!make_room(s, form, &to)) {
        sunder_shape_free(s);
        return sunder_i_failure_cause(err);
    }
    fill_arrays(s, &to, piece);
    measure_shape(s, piece);
    *out = s;
    return SUNDER_OK;
}
