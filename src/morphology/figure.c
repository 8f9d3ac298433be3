/* figure.c: converts shapes and sums to figures, and shapes to structuring elements: the same numbers, without their
 * lattice. */
#include "morphology/morphology.h"

#include "base/sort.h"
#include "predicate/rational_point.h"

void sunder_i_figure_free(sunder_i_figure *figure)
{
    sunder_i_arena_free(&figure->arena);
    *figure = (sunder_i_figure){0};
}

static bool make_room(sunder_i_figure *f, size_t corners, size_t sides, size_t rings)
{
    f->at = sunder_i_arena_alloc(&f->arena, corners + 1, sizeof *f->at);
    f->ring = sunder_i_arena_alloc(&f->arena, sides + 1, sizeof *f->ring);
    f->ring_end = sunder_i_arena_alloc(&f->arena, rings + 1, sizeof *f->ring_end);
    f->rings = rings;
    f->sides = sides;
    return !f->arena.failed;
}

/* Returns a lattice point as rational numbers in the figure's arena. */
static sunder_i_rational_point read_point(sunder_i_arena *arena, const sunder_i_lattice *lattice, sunder_i_point at)
{
    if (lattice->arena.failed) return (sunder_i_rational_point){{NULL, 0}, {NULL, 0}, {NULL, 0}};
    return sunder_i_rational_copy(arena, sunder_i_rational_get(arena, lattice, at));
}

bool sunder_i_figure_of_shape(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                              sunder_i_figure *out)
{
    sunder_i_figure f = {0};
    if (make_room(&f, shape->vertices, shape->vertices, shape->form->cleaned.rings)) {
        for (uint32_t v = 0; v < shape->vertices; v++) {
            f.ring[v] = v;
            f.touches = f.touches || shape->form->cleaned.shared[v];
            f.at[v] = read_point(&f.arena, lattice, at[v]);
        }
        for (uint32_t r = 0; r < shape->form->cleaned.rings; r++) f.ring_end[r] = shape->form->cleaned.ring_end[r];
    }
    const bool ok = !f.arena.failed && !lattice->arena.failed;
    if (ok)
        *out = f;
    else
        sunder_i_figure_free(&f);
    return ok;
}

/* Reads n vertices of the sum as vertices of the figure from number `corner` on. */
static void read_corners(sunder_i_figure *f, size_t corner, const sunder_sum *sum, const uint32_t *vertex, size_t n)
{
    for (size_t i = 0; i < n; i++)
        f->at[corner + i] = sunder_i_hpoint_read(&f->arena, &sum->lattice, &sum->vertex[vertex[i]]);
}

/* Returns an array with the numbers first, first + 1, ... in the arena; NULL if out of memory. */
static const uint32_t *count_from(sunder_i_arena *arena, size_t first, size_t n)
{
    uint32_t *number = sunder_i_arena_alloc(arena, n + 1, sizeof *number);
    for (size_t i = 0; number && i < n; i++) number[i] = (uint32_t)(first + i);
    return number;
}

/* Sets *repeated to whether a vertex occurs twice, in one ring or in two. Returns false if out of memory. */
static bool is_repeated(const uint32_t *vertex, size_t n, bool *repeated)
{
    uint64_t *sorted = sunder_i_alloc(n, sizeof *sorted);
    for (size_t i = 0; sorted && i < n; i++) sorted[i] = vertex[i];
    const bool ok = sorted && sunder_i_sort_keys(sorted, n);
    *repeated = false;
    for (size_t i = 1; ok && i < n && !*repeated; i++) *repeated = sorted[i] == sorted[i - 1];
    sunder_i_free(sorted);
    return ok;
}

bool sunder_i_figure_of_sum(const sunder_sum *sum, size_t first, size_t last, bool regular, sunder_i_figure *out)
{
    sunder_i_figure f = {0};
    const size_t ring = first ? sum->poly_end[first - 1] : 0, ring_end = last ? sum->poly_end[last - 1] : 0;
    const size_t start = ring ? sum->ring_end[ring - 1] : 0, end = ring_end ? sum->ring_end[ring_end - 1] : 0;
    f.segments = regular ? 0 : sum->segments;
    f.points = regular ? 0 : sum->points;
    if (make_room(&f, end - start + 2 * f.segments + f.points, end - start, ring_end - ring)) {
        read_corners(&f, 0, sum, sum->ring_vertex + start, f.sides);
        read_corners(&f, f.sides, sum, sum->segment, 2 * f.segments);
        read_corners(&f, f.sides + 2 * f.segments, sum, sum->point, f.points);
        for (size_t i = 0; i < f.sides; i++) f.ring[i] = (uint32_t)i;
        for (size_t r = 0; r < f.rings; r++) f.ring_end[r] = sum->ring_end[ring + r] - start;
        f.segment = count_from(&f.arena, f.sides, 2 * f.segments);
        f.point = count_from(&f.arena, f.sides + 2 * f.segments, f.points);
    }
    const bool ok = !f.arena.failed && is_repeated(sum->ring_vertex + start, f.sides, &f.touches);
    if (ok)
        *out = f;
    else
        sunder_i_figure_free(&f);
    return ok;
}

void sunder_i_structuring_element_free(sunder_i_structuring_element *element)
{
    sunder_i_arena_free(&element->arena);
    *element = (sunder_i_structuring_element){0};
}

/* Returns a point inside the piece: the centroid of its first three vertices, which are not collinear. */
static sunder_i_rational_point inner_point(sunder_i_arena *m, const sunder_i_rational_point *corner)
{
    sunder_i_rational_point sum = sunder_i_rational_add(m, sunder_i_rational_add(m, corner[0], corner[1]), corner[2]);
    sum.w = sunder_i_big_mul(m, sunder_i_big_i64(m, 3), sum.w);
    return sum;
}

bool sunder_i_structuring_element_of_shape(sunder_i_lattice *lattice, const sunder_shape *shape,
                                           const sunder_i_point *at, bool reflected, sunder_i_structuring_element *out)
{
    const size_t corners = shape->pieces ? shape->piece_end[shape->pieces - 1] : 0;
    sunder_i_structuring_element p = {.pieces = shape->pieces};
    sunder_i_arena *arena = &p.arena;
    p.end = sunder_i_arena_alloc(arena, p.pieces + 1u, sizeof *p.end);
    p.corner = sunder_i_arena_alloc(arena, corners + 1, sizeof *p.corner);
    p.side = sunder_i_arena_alloc(arena, corners + 1, sizeof *p.side);
    p.along = sunder_i_arena_alloc(arena, corners + 1, sizeof *p.along);
    p.plain = true;
    p.inner = sunder_i_arena_alloc(arena, p.pieces + 1u, sizeof *p.inner);
    for (size_t i = 0; i < corners && !arena->failed; i++) {
        p.corner[i] = read_point(arena, lattice, at[sunder_i_piece_vertices(shape)[i]]);
        /* a rotation by half a turn: still counterclockwise */
        if (reflected) p.corner[i] = sunder_i_rational_neg(p.corner[i]);
    }
    for (uint32_t j = 0; j < p.pieces && !arena->failed; j++) {
        const size_t first = j ? p.end[j - 1] : 0, end = p.end[j] = shape->piece_end[j];
        for (size_t i = first; i < end && !arena->failed; i++) {
            p.side[i] = sunder_i_rational_sub(arena, p.corner[i + 1 < end ? i + 1 : first], p.corner[i]);
            p.plain = sunder_i_heading(arena, p.side[i], &p.along[i]) && p.plain;
        }
        p.inner[j] = inner_point(arena, p.corner + first);
    }
    const bool ok = !arena->failed && !lattice->arena.failed;
    if (ok)
        *out = p;
    else
        sunder_i_structuring_element_free(&p);
    return ok;
}
