/* Convex subsums in doubles (subsums.h). Uses the library's internal headers, since pieces are not part of the public
 * interface. */
#include "subsums.h"

#include "convex/convex_sum.h"

#include <math.h>

typedef struct operand {
    sunder_shape *shape;
    sunder_i_decomposition pieces;
} operand;

static void add_subsum(const operand *p, const operand *q, const sunder_i_convex_sum *sum, bench_set *out)
{
    for (uint32_t k = 0; k < sum->corners; k++) {
        const double *a = p->shape->xy + 2 * p->pieces.corner[sum->of_p[k]].vertex;
        const double *b = q->shape->xy + 2 * q->pieces.corner[sum->of_q[k]].vertex;
        out->xy[2 * out->vertices] = a[0] + b[0];
        out->xy[2 * out->vertices + 1] = a[1] + b[1];
        out->vertices++;
    }
    out->ring_end[out->rings++] = out->vertices;
    out->poly_end[out->polygons++] = out->rings;
}

static int add_all(sunder_i_lattice *lattice, const operand *p, const operand *q, bench_set *out)
{
    const size_t rings = (size_t)p->pieces.pieces * q->pieces.pieces;
    const size_t sides_p = p->pieces.pieces ? p->pieces.piece_end[p->pieces.pieces - 1] : 0;
    const size_t sides_q = q->pieces.pieces ? q->pieces.piece_end[q->pieces.pieces - 1] : 0;
    bool ok = true;
    out->xy = bench_alloc(2 * (sides_p * q->pieces.pieces + sides_q * p->pieces.pieces) * sizeof(double));
    out->ring_end = bench_alloc(rings * sizeof(size_t));
    out->poly_end = bench_alloc(rings * sizeof(size_t));
    for (uint32_t i = 0; ok && i < p->pieces.pieces; i++) {
        sunder_i_arena arena;
        sunder_i_arena_init(&arena);
        for (uint32_t j = 0; ok && j < q->pieces.pieces; j++) {
            sunder_i_convex_sum sum;
            ok = sunder_i_convex_sum_of(lattice, &p->pieces, i, &q->pieces, j, &arena, &sum);
            if (ok) add_subsum(p, q, &sum, out);
        }
        sunder_i_arena_free(&arena);
    }
    return ok;
}

static sunder_status read_shape(const bench_set *s, sunder_shape **out, sunder_error *err)
{
    return sunder_shape_from_rings(s->xy, s->ring_end, s->poly_end, s->polygons, SUNDER_VALIDITY_STRICT, out, err);
}

int bench_subsums(const bench_set *p, const bench_set *q, bench_set *out)
{
    operand a = {0}, b = {0};
    sunder_i_placed placed;
    sunder_error err = {0};
    const sunder_i_place_options options = {0};
    sunder_status status = read_shape(p, &a.shape, &err);
    memset(out, 0, sizeof *out);
    if (!status) status = read_shape(q, &b.shape, &err);
    if (!status) {
        status = sunder_i_place(a.shape, b.shape, &options, &placed, &err);
        if (!status) {
            status = sunder_i_decompose_pair(&placed.lattice, a.shape, placed.p, b.shape, placed.q,
                                             SUNDER_DECOMPOSITION_OPTIMAL, &a.pieces, &b.pieces, &err);
            if (!status) {
                if (!add_all(&placed.lattice, &a, &b, out)) status = SUNDER_ENOMEM;
                sunder_i_decomposition_clear(&a.pieces);
                sunder_i_decomposition_clear(&b.pieces);
            }
            sunder_i_placed_free(&placed);
        }
    }
    sunder_shape_free(a.shape);
    sunder_shape_free(b.shape);
    if (status) fprintf(stderr, "subsums: %s %s\n", sunder_status_string(status), err.message);
    return !status;
}

double bench_radius(const bench_set *q)
{
    double low[2] = {q->xy[0], q->xy[1]}, high[2] = {q->xy[0], q->xy[1]}, radius = 0;
    for (size_t i = 0; i < 2 * q->vertices; i++) {
        low[i % 2] = fmin(low[i % 2], q->xy[i]);
        high[i % 2] = fmax(high[i % 2], q->xy[i]);
    }
    for (size_t i = 0; i < q->vertices; i++)
        radius = fmax(radius, hypot(q->xy[2 * i] - (low[0] + high[0]) / 2, q->xy[2 * i + 1] - (low[1] + high[1]) / 2));
    return radius;
}
