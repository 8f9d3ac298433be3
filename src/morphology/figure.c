/* Shapes and sums as figures, and shapes as probes: the same numbers, taken off their lattice. */
#include "morphology/morphology.h"

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

static sunder_i_big lattice_number(sunder_i_arena *arena, sunder_i_lattice *lattice, int64_t n)
{
    return sunder_i_big_copy(arena, sunder_i_lattice_get(lattice, n));
}

bool sunder_i_figure_of_shape(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                              sunder_i_figure *out)
{
    sunder_i_figure f = {0};
    if (make_room(&f, shape->vertices, shape->vertices, shape->rings)) {
        const sunder_i_big one = sunder_i_big_i64(&f.arena, 1);
        for (uint32_t v = 0; v < shape->vertices; v++) {
            f.ring[v] = v;
            f.at[v][0] = lattice_number(&f.arena, lattice, at[v].x);
            f.at[v][1] = lattice_number(&f.arena, lattice, at[v].y);
            f.at[v][2] = one;
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

bool sunder_i_figure_of_sum(sunder_sum *sum, bool regular, sunder_i_figure *out)
{
    sunder_i_figure f = {0};
    const size_t sides = sum->rings ? sum->ring_end[sum->rings - 1] : 0;
    if (make_room(&f, sum->vertices, sides, sum->rings)) {
        for (uint32_t v = 0; v < sum->vertices; v++) {
            sunder_i_big xyw[3];
            sunder_i_hpoint_big(&sum->lattice, &sum->vertex[v], &xyw[0], &xyw[1], &xyw[2]);
            for (int i = 0; i < 3; i++) f.at[v][i] = sunder_i_big_copy(&f.arena, xyw[i]);
        }
        for (size_t i = 0; i < sides; i++) f.ring[i] = sum->ring_vertex[i];
        for (size_t r = 0; r < sum->rings; r++) f.ring_end[r] = sum->ring_end[r];
        f.segment = sum->segment;
        f.point = sum->point;
        f.segments = regular ? 0 : sum->segments;
        f.points = regular ? 0 : sum->points;
    }
    const bool ok = !f.arena.failed && !sum->lattice.arena.failed;
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
    sunder_i_arena *arena = &p->arena;
    for (int k = 0; k < 2; k++)
        inner[k] = sunder_i_big_add(arena, p->corner[first][k],
                                    sunder_i_big_add(arena, p->corner[first + 1][k], p->corner[first + 2][k]));
    inner[2] = sunder_i_big_i64(arena, 3);
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
        const sunder_i_point here = at[shape->piece_vertex[i]];
        const int64_t xy[2] = {here.x, here.y};
        for (int k = 0; k < 2; k++) {
            const sunder_i_big n = lattice_number(arena, lattice, xy[k]);
            p.corner[i][k] = reflected ? sunder_i_big_neg(n) : n; /* a half turn: still counter-clockwise */
        }
    }
    for (uint32_t j = 0; j < p.pieces && !arena->failed; j++) {
        const size_t first = j ? p.end[j - 1] : 0, end = p.end[j] = shape->piece_end[j];
        for (size_t i = first; i < end; i++)
            for (int k = 0; k < 2; k++)
                p.side[i][k] = sunder_i_big_sub(arena, p.corner[i + 1 < end ? i + 1 : first][k], p.corner[i][k]);
        find_inner(&p, first, p.inner[j]);
    }
    const bool ok = !arena->failed && !lattice->arena.failed;
    if (ok)
        *out = p;
    else
        sunder_i_probe_free(&p);
    return ok;
}
