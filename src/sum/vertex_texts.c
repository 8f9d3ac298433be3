/* vertex_texts.c: vertices of a sum as exact rational texts, and as the nearest doubles, one at a time
 * (nearest_doubles.c converts many at once). */
#include "sum/sum_value.h"

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
        sunder_i_free_all(text[0], text[1]);
        return sunder_i_failure_cause(err);
    }
    *x = text[0];
    *y = text[1];
    return SUNDER_OK;
}

void sunder_sum_vertex(const sunder_sum *sum, uint32_t vertex, double xy[2])
{
    sunder_i_arena arena = {0};
    sunder_i_sum_doubles(&arena, sum, sunder_i_sum_point(&arena, sum, vertex), xy);
    sunder_i_arena_free(&arena);
}

sunder_status sunder_sum_vertex_text(const sunder_sum *sum, uint32_t vertex, char **x, char **y, sunder_error *err)
{
    sunder_i_arena arena = {0};
    const sunder_status status = sunder_i_sum_texts(&arena, sum, sunder_i_sum_point(&arena, sum, vertex), x, y, err);
    sunder_i_arena_free(&arena);
    return status;
}
