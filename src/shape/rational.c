/* Shapes with rational coordinates: what from_rings.c and move.c attach to a finished block. */
#include "shape/rational.h"

bool sunder_i_shape_set_rational(sunder_shape *s, const sunder_i_big *num, sunder_i_big den, long exponent)
{
    const size_t n = 2 * (size_t)s->vertices;
    s->rational = true;
    s->exponent = exponent;
    s->den = sunder_i_big_copy(&s->arena, den);
    s->num = sunder_i_arena_alloc(&s->arena, n, sizeof *s->num);
    if (!s->num) return false;
    for (size_t i = 0; i < n; i++) s->num[i] = sunder_i_big_copy(&s->arena, num[i]);
    return !s->arena.failed;
}

bool sunder_i_shape_measure_rational(sunder_shape *s)
{
    sunder_i_arena scratch;
    sunder_i_arena_init(&scratch);
    for (size_t i = 0; i < 2 * (size_t)s->vertices; i++) {
        const size_t k = i & 1;
        s->xy[i] = sunder_i_big_ratio(&scratch, s->num[i], s->den, s->exponent);
        const double down = sunder_i_big_ratio_down(&scratch, s->num[i], s->den, s->exponent);
        const double up = sunder_i_big_ratio_up(&scratch, s->num[i], s->den, s->exponent);
        if (i < 2 || down < s->box[k]) s->box[k] = down;
        if (i < 2 || up > s->box[k + 2]) s->box[k + 2] = up;
    }
    s->extent = (sunder_i_extent){0};
    if (s->vertices) {
        sunder_i_extent_add(&s->extent, s->box, 2);
        if (s->exponent < s->extent.low_bit) s->extent.low_bit = s->exponent < -4096 ? -4096 : (int)s->exponent;
    }
    const bool good = !scratch.failed;
    sunder_i_arena_free(&scratch);
    return good && sunder_i_shape_measure_pieces(s);
}
