/* rational_corners.c: vertices that are not doubles: making, reducing and rounding them; box and lowest bit of a shape
 * that has some. */
#include "shape/rational_corners.h"

#include <limits.h>

/* Adds v times den to num[k], which is in units of 2^*exponent; the unit becomes finer if v requires it. */
static void add_double(sunder_i_arena *arena, sunder_i_big num[2], int k, sunder_i_big den, double v, long *exponent)
{
    int e;
    const sunder_i_big m = sunder_i_big_double(arena, v, &e);
    if (m.size == 0) return;
    for (int i = 0; i < 2 && e < *exponent; i++)
        num[i] = sunder_i_big_shl(arena, num[i], (unsigned long)(*exponent - e));
    if (e < *exponent) *exponent = e;
    const sunder_i_big part = sunder_i_big_mul(arena, m, den);
    num[k] = sunder_i_big_add(arena, num[k], sunder_i_big_shl(arena, part, (unsigned long)(e - *exponent)));
}

/* Returns the exponent of the largest power of two that divides both numbers. */
static unsigned long common_twos(const sunder_i_big num[2])
{
    const unsigned long a = num[0].size ? sunder_i_big_twos(num[0]) : ULONG_MAX;
    const unsigned long b = num[1].size ? sunder_i_big_twos(num[1]) : ULONG_MAX;
    const unsigned long least = a < b ? a : b;
    return least == ULONG_MAX ? 0 : least;
}

sunder_i_exact sunder_i_exact_make(sunder_i_arena *arena, sunder_i_rational_point u, long exponent, const double add[2])
{
    const sunder_i_big den = u.w;
    sunder_i_exact r = {{u.x, u.y}, den, exponent};
    for (int k = 0; k < 2; k++) add_double(arena, r.num, k, den, add[k], &r.exponent);
    const sunder_i_big g = sunder_i_big_gcd(arena, sunder_i_big_gcd(arena, r.num[0], r.num[1]), den);
    if (arena->failed) return r;
    r.den = sunder_i_big_div_floor(arena, den, g);
    for (int k = 0; k < 2; k++) r.num[k] = sunder_i_big_div_floor(arena, r.num[k], g);
    if (arena->failed) return r;
    const unsigned long up = common_twos(r.num), down = sunder_i_big_twos(r.den);
    for (int k = 0; k < 2; k++) r.num[k] = sunder_i_big_shr(arena, r.num[k], up);
    r.den = sunder_i_big_shr(arena, r.den, down);
    r.exponent += (long)up - (long)down;
    return r;
}

bool sunder_i_exact_is_double(sunder_i_arena *arena, const sunder_i_exact *corner)
{
    if (sunder_i_big_bits(corner->den) != 1) return false;
    for (int k = 0; k < 2; k++)
        if (sunder_i_big_ratio_down(arena, corner->num[k], corner->den, corner->exponent) !=
            sunder_i_big_ratio_up(arena, corner->num[k], corner->den, corner->exponent))
            return false;
    return true;
}

bool sunder_i_shape_set_rational(sunder_shape *s, const sunder_i_exact *exact)
{
    sunder_i_arena *arena = &s->form->numbers->arena;
    s->rational = true;
    s->form->numbers->exact = sunder_i_arena_alloc(arena, s->vertices, sizeof *s->form->numbers->exact);
    for (uint32_t v = 0; s->form->numbers->exact && v < s->vertices; v++) {
        const sunder_i_exact *from = &exact[v];
        s->form->numbers->exact[v] =
            (sunder_i_exact){{sunder_i_big_copy(arena, from->num[0]), sunder_i_big_copy(arena, from->num[1])},
                             sunder_i_big_copy(arena, from->den),
                             from->exponent};
    }
    return !arena->failed;
}

/* Sets the coordinates of vertex v to the nearest doubles, and down[] and up[] to them rounded down and up. */
static void round_vertex(sunder_i_arena *arena, sunder_shape *s, uint32_t v, double down[2], double up[2])
{
    const sunder_i_exact *from = &s->form->numbers->exact[v];
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    for (size_t k = 0; k < 2; k++) {
        double *xy = s->xy + 2 * (size_t)v;
        if (from->den.size) {
            xy[k] = sunder_i_big_ratio(arena, from->num[k], from->den, from->exponent);
            down[k] = sunder_i_big_ratio_down(arena, from->num[k], from->den, from->exponent);
            up[k] = sunder_i_big_ratio_up(arena, from->num[k], from->den, from->exponent);
        } else {
            down[k] = up[k] = xy[k];
        }
    }
    if (!arena->failed) sunder_i_arena_release(arena, mark);
}

bool sunder_i_shape_measure_rational(sunder_shape *s)
{
    sunder_i_arena scratch;
    sunder_i_arena_init(&scratch);
    for (uint32_t v = 0; v < s->vertices; v++) {
        double down[2], up[2];
        round_vertex(&scratch, s, v, down, up);
        for (int k = 0; k < 2; k++) {
            if (v == 0 || down[k] < s->box[k]) s->box[k] = down[k];
            if (v == 0 || up[k] > s->box[k + 2]) s->box[k + 2] = up[k];
        }
    }
    /* crossings make the unit finer only if they are doubles; else they have denominators */
    sunder_i_extent extent = {0};
    sunder_i_extent_add(&extent, s->raw_xy, sunder_i_shape_raw_vertices(s));
    for (uint32_t v = 0; v < s->vertices; v++)
        if (!s->form->numbers->exact[v].den.size) sunder_i_extent_add(&extent, s->xy + 2 * (size_t)v, 1);
    s->low_bit = extent.low_bit;
    const bool good = !scratch.failed;
    sunder_i_arena_free(&scratch);
    return good && sunder_i_shape_measure_pieces(s);
}
