/* Shapes and sums as figures, and shapes as probes: the same numbers, taken off their lattice. */
#include "morphology/morphology.h"

#include "predicate/vector.h"

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

/* A lattice point, in the arena of the figure. */
static void read_point(sunder_i_arena *arena, const sunder_i_lattice *lattice, sunder_i_point at, sunder_i_xyw out)
{
    if (lattice->arena.failed) return;
    const sunder_i_vector v = sunder_i_vector_get(arena, lattice, at);
    out[0] = sunder_i_big_copy(arena, v.x);
    out[1] = sunder_i_big_copy(arena, v.y);
    out[2] = sunder_i_big_copy(arena, v.w);
}

bool sunder_i_figure_of_shape(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                              sunder_i_figure *out)
{
    sunder_i_figure f = {0};
    if (make_room(&f, shape->vertices, shape->vertices, shape->rings)) {
        for (uint32_t v = 0; v < shape->vertices; v++) {
            f.ring[v] = v;
            read_point(&f.arena, lattice, at[v], f.at[v]);
        }
        for (uint32_t r = 0; r < shape->rings; r++) f.ring_end[r] = shape->ring_end[r];
    }
    const bool ok = !f.arena.failed && !lattice->arena.failed;
    if (ok)
        *out = f;
    else
        sunder_i_figure_free(&f);
    return ok;
}

/* Vertices of the sum, one after the other, as corners from number `corner` on. */
static void read_corners(sunder_i_figure *f, size_t corner, const sunder_sum *sum, const uint32_t *vertex, size_t n)
{
    for (size_t i = 0; i < n; i++)
        sunder_i_hpoint_read(&f->arena, &sum->lattice, &sum->vertex[vertex[i]], f->at[corner + i]);
}

/* Numbers first, first + 1, ... in the arena. */
static const uint32_t *count_from(sunder_i_arena *arena, size_t first, size_t n)
{
    uint32_t *number = sunder_i_arena_alloc(arena, n + 1, sizeof *number);
    for (size_t i = 0; number && i < n; i++) number[i] = (uint32_t)(first + i);
    return number;
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
    const bool ok = !f.arena.failed;
    if (ok)
        *out = f;
    else
        sunder_i_figure_free(&f);
    return ok;
}

void sunder_i_probe_free(sunder_i_probe *probe)
{
    sunder_i_arena_free(&probe->arena);
    *probe = (sunder_i_probe){0};
}

/* The middle of the triangle of its first three corners, which are not collinear: a point inside the piece. */
static void find_inner(sunder_i_probe *p, size_t first, sunder_i_xyw inner)
{
    sunder_i_arena *m = &p->arena;
    sunder_i_xyw *c = p->corner + first;
    sunder_i_big w[3]; /* of the other two */
    for (int i = 0; i < 3; i++) w[i] = sunder_i_times(m, c[(i + 1) % 3][2], c[(i + 2) % 3][2]);
    for (int k = 0; k < 2; k++) {
        inner[k] = sunder_i_times(m, c[0][k], w[0]);
        for (int i = 1; i < 3; i++) inner[k] = sunder_i_big_add(m, inner[k], sunder_i_times(m, c[i][k], w[i]));
    }
    inner[2] = sunder_i_big_mul(m, sunder_i_big_i64(m, 3), sunder_i_times(m, c[0][2], w[0]));
}

bool sunder_i_probe_of_shape(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                             bool reflected, sunder_i_probe *out)
{
    const size_t corners = shape->pieces ? shape->piece_end[shape->pieces - 1] : 0;
    sunder_i_probe p = {.pieces = shape->pieces};
    sunder_i_arena *arena = &p.arena;
    p.end = sunder_i_arena_alloc(arena, p.pieces + 1u, sizeof *p.end);
    p.corner = sunder_i_arena_alloc(arena, corners + 1, sizeof *p.corner);
    p.side = sunder_i_arena_alloc(arena, corners + 1, sizeof *p.side);
    p.inner = sunder_i_arena_alloc(arena, p.pieces + 1u, sizeof *p.inner);
    for (size_t i = 0; i < corners && !arena->failed; i++) {
        read_point(arena, lattice, at[shape->piece_vertex[i]], p.corner[i]);
        for (int k = 0; k < 2 && reflected; k++) /* a half turn: still counter-clockwise */
            p.corner[i][k] = sunder_i_big_neg(p.corner[i][k]);
    }
    for (uint32_t j = 0; j < p.pieces && !arena->failed; j++) {
        const size_t first = j ? p.end[j - 1] : 0, end = p.end[j] = shape->piece_end[j];
        for (size_t i = first; i < end; i++) {
            const sunder_i_big *a = p.corner[i], *b = p.corner[i + 1 < end ? i + 1 : first];
            for (int k = 0; k < 2; k++)
                p.side[i][k] = sunder_i_big_sub(arena, sunder_i_times(arena, b[k], a[2]),
                                                sunder_i_times(arena, a[k], b[2]));
        }
        find_inner(&p, first, p.inner[j]);
    }
    const bool ok = !arena->failed && !lattice->arena.failed;
    if (ok)
        *out = p;
    else
        sunder_i_probe_free(&p);
    return ok;
}
