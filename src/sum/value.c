/* Coordinates and area of a sum on the way out: exact rationals as text, nearest doubles. */
#include "sum/sum.h"

#include <math.h>

long sunder_i_sum_coordinate(sunder_i_arena *arena, const sunder_sum *sum, int axis, sunder_i_big n, sunder_i_big d,
                             sunder_i_big *num, sunder_i_big *den)
{
    const sunder_i_lattice *l = &sum->lattice;
    /* n * 2^e / d + both origins, over one power of two. */
    long e = l->exponent;
    for (int operand = 0; operand < 2; operand++) {
        int oe;
        const sunder_i_big o = sunder_i_big_double(arena, sum->origin[operand][axis], &oe);
        if (o.size == 0) continue;
        sunder_i_big od = sunder_i_big_mul(arena, o, d);
        if (oe >= e)
            od = sunder_i_big_shl(arena, od, (unsigned long)(oe - e));
        else {
            n = sunder_i_big_shl(arena, n, (unsigned long)(e - oe));
            e = oe;
        }
        n = sunder_i_big_add(arena, n, od);
    }
    *num = n;
    *den = d;
    return e;
}

void sunder_i_sum_doubles(sunder_i_arena *arena, const sunder_sum *sum, sunder_i_rational_point at, double xy[2])
{
    for (int k = 0; k < 2; k++) {
        sunder_i_big num, den;
        const long e = sunder_i_sum_coordinate(arena, sum, k, sunder_i_rational_axis(&at, k), at.w, &num, &den);
        xy[k] = arena->failed ? (double)NAN : sunder_i_big_ratio(arena, num, den, e);
    }
}

sunder_status sunder_i_sum_texts(sunder_i_arena *arena, const sunder_sum *sum, sunder_i_rational_point at, char **x,
                                 char **y, sunder_error *err)
{
    char *text[2] = {NULL, NULL};
    for (int k = 0; k < 2; k++) {
        sunder_i_big num, den;
        const long e = sunder_i_sum_coordinate(arena, sum, k, sunder_i_rational_axis(&at, k), at.w, &num, &den);
        if (!arena->failed) text[k] = sunder_i_big_ratio_text(arena, num, den, e);
    }
    if (!text[0] || !text[1]) {
        sunder_i_free(text[0]);
        sunder_i_free(text[1]);
        return sunder_i_no_memory(err);
    }
    *x = text[0];
    *y = text[1];
    return SUNDER_OK;
}

static sunder_i_rational_point vertex_point(sunder_i_arena *arena, const sunder_sum *sum, uint32_t vertex)
{
    return sunder_i_hpoint_read(arena, &sum->lattice, &sum->vertex[vertex]);
}

void sunder_sum_vertex(const sunder_sum *sum, uint32_t vertex, double xy[2])
{
    sunder_i_arena arena = {0};
    sunder_i_sum_doubles(&arena, sum, vertex_point(&arena, sum, vertex), xy);
    sunder_i_arena_free(&arena);
}

sunder_status sunder_sum_vertex_text(const sunder_sum *sum, uint32_t vertex, char **x, char **y, sunder_error *err)
{
    sunder_i_arena arena = {0};
    const sunder_status status = sunder_i_sum_texts(&arena, sum, vertex_point(&arena, sum, vertex), x, y, err);
    sunder_i_arena_free(&arena);
    return status;
}

/* ---- Area ---- */

/* Twice the area over one edge, x1 y2 - x2 y1, in lattice units: the origin drops out over a closed ring. */
static sunder_i_ratio edge_term(sunder_i_arena *arena, const sunder_sum *sum, uint32_t u, uint32_t v)
{
    const sunder_i_rational_point a = vertex_point(arena, sum, u), b = vertex_point(arena, sum, v);
    return sunder_i_ratio_reduced(
        arena, (sunder_i_ratio){sunder_i_rational_cross(arena, a, b), sunder_i_big_mul(arena, a.w, b.w)});
}

/* Sums are taken in pairs, pairs of pairs and so on, so that operands of one addition are of one size: level k holds
 * the sum of 2^k terms, or nothing. */
typedef struct adder {
    sunder_i_ratio level[64];
    bool full[64];
} adder;

static void add_term(sunder_i_arena *arena, adder *a, sunder_i_ratio term)
{
    int k = 0;
    for (; a->full[k]; k++) {
        term = sunder_i_ratio_reduced(arena, sunder_i_ratio_add(arena, a->level[k], term));
        a->full[k] = false;
    }
    a->level[k] = term;
    a->full[k] = true;
}

static sunder_i_ratio total_of(sunder_i_arena *arena, const adder *a)
{
    sunder_i_ratio total = {{NULL, 0}, sunder_i_big_i64(arena, 1)};
    for (int k = 0; k < 64; k++)
        if (a->full[k]) total = sunder_i_ratio_add(arena, total, a->level[k]);
    return total;
}

/* Every so many edges have their numbers in an arena of their own, of which only the sum is kept. */
#define EDGES 256

static sunder_i_ratio area_twice(sunder_i_arena *arena, const sunder_sum *sum)
{
    sunder_i_arena scratch = {0};
    adder some = {.full = {false}}, all = {.full = {false}};
    size_t n = 0;
    for (size_t r = 0; r < sum->rings; r++) {
        const size_t from = r ? sum->ring_end[r - 1] : 0, to = sum->ring_end[r];
        for (size_t i = from; i < to && !arena->failed; i++) {
            const uint32_t u = sum->ring_vertex[i], v = sum->ring_vertex[i + 1 < to ? i + 1 : from];
            add_term(&scratch, &some, edge_term(&scratch, sum, u, v));
            if (++n % EDGES && (i + 1 < to || r + 1 < sum->rings)) continue;
            const sunder_i_ratio part = sunder_i_ratio_reduced(&scratch, total_of(&scratch, &some));
            add_term(arena, &all,
                     (sunder_i_ratio){sunder_i_big_copy(arena, part.num), sunder_i_big_copy(arena, part.den)});
            arena->failed = arena->failed || scratch.failed;
            sunder_i_arena_free(&scratch);
            scratch = (sunder_i_arena){0};
            some = (adder){.full = {false}};
        }
    }
    sunder_i_arena_free(&scratch);
    return total_of(arena, &all);
}

sunder_status sunder_sum_area_text(const sunder_sum *sum, char **area, sunder_error *err)
{
    sunder_i_arena arena = {0};
    const sunder_i_ratio twice = area_twice(&arena, sum);
    char *text = NULL;
    if (!arena.failed) {
        text = sunder_i_big_ratio_text(&arena, twice.num, twice.den, 2 * sum->lattice.exponent - 1);
    }
    sunder_i_arena_free(&arena);
    if (!text) return sunder_i_no_memory(err);
    *area = text;
    return SUNDER_OK;
}
