/* Crossings along a line. Numerator and denominator have degree 2 (below 2^124 on a narrow lattice); comparing two
 * fractions has degree 4 (256 bits). */
#include "predicate/kernel.h"
#include "predicate/wide_vector.h"

#include <math.h>

static sunder_i_fraction narrow_fraction(sunder_i_i128 num, sunder_i_i128 den)
{
    if (den < 0) {
        num = -num;
        den = -den;
    }
    return (sunder_i_fraction){num, den, sunder_i_narrow_value(num, den)};
}

static sunder_i_fraction wide_fraction(sunder_i_lattice *l, sunder_i_big num, sunder_i_big den)
{
    if (sunder_i_big_sign(den) < 0) {
        num = sunder_i_big_neg(num);
        den = sunder_i_big_neg(den);
    }
    sunder_i_fraction f = {0, 0, 0};
    if (l->arena.failed) return f;
    f.value = sunder_i_big_ratio(&l->arena, num, den, 0);
    f.num = sunder_i_lattice_big(l, num);
    f.den = sunder_i_lattice_big(l, den);
    return f;
}

sunder_i_fraction sunder_i_crossing(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, sunder_i_point c,
                                    sunder_i_point d)
{
    l->operations.segment_intersections++;
    if (l->narrow) {
        const sunder_i_point w = sunder_i_narrow_sub(d, c);
        return narrow_fraction(sunder_i_narrow_cross(sunder_i_narrow_sub(c, a), w),
                               sunder_i_narrow_cross(sunder_i_narrow_sub(b, a), w));
    }
    const sunder_i_vector w = sunder_i_wide_diff(l, d, c);
    return wide_fraction(l, sunder_i_wide_cross(l, sunder_i_wide_diff(l, c, a), w),
                         sunder_i_wide_cross(l, sunder_i_wide_diff(l, b, a), w));
}

sunder_i_fraction sunder_i_along(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, sunder_i_point c)
{
    /* Collinear: the ratio of either coordinate will do; take the longer one. */
    if (l->narrow) {
        const sunder_i_point u = sunder_i_narrow_sub(b, a), v = sunder_i_narrow_sub(c, a);
        const uint64_t ux = (uint64_t)(u.x < 0 ? -u.x : u.x), uy = (uint64_t)(u.y < 0 ? -u.y : u.y);
        return ux >= uy ? narrow_fraction(v.x, u.x) : narrow_fraction(v.y, u.y);
    }
    const sunder_i_vector u = sunder_i_wide_diff(l, b, a), v = sunder_i_wide_diff(l, c, a);
    return sunder_i_big_sign(u.x) ? wide_fraction(l, v.x, u.x) : wide_fraction(l, v.y, u.y);
}

sunder_i_fraction sunder_i_foot(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, sunder_i_point c)
{
    if (l->narrow) {
        const sunder_i_point u = sunder_i_narrow_sub(b, a);
        return narrow_fraction(sunder_i_narrow_dot(sunder_i_narrow_sub(c, a), u), sunder_i_narrow_dot(u, u));
    }
    const sunder_i_vector u = sunder_i_wide_diff(l, b, a);
    return wide_fraction(l, sunder_i_wide_dot(l, sunder_i_wide_diff(l, c, a), u), sunder_i_wide_dot(l, u, u));
}

sunder_i_fraction sunder_i_fraction_int(sunder_i_lattice *l, int n)
{
    if (l->narrow) return (sunder_i_fraction){n, 1, n};
    return wide_fraction(l, sunder_i_big_i64(&l->arena, n), sunder_i_big_i64(&l->arena, 1));
}

int sunder_i_fraction_cmp(sunder_i_lattice *l, const sunder_i_fraction *s, const sunder_i_fraction *t)
{
    l->operations.comparisons++;
    const double d = s->value - t->value;
    const double bound = SUNDER_I_FRACTION_ERROR * (1 + fabs(s->value) + fabs(t->value));
    if (d > bound) return 1;
    if (d < -bound) return -1;
    l->operations.exact_fallbacks++;
    if (l->narrow) return sunder_i_cmp_products(s->num, t->den, t->num, s->den);
    const sunder_i_mark mark = sunder_i_arena_mark(&l->arena);
    const int c = sunder_i_big_cmp(
        sunder_i_big_mul(&l->arena, sunder_i_lattice_get(l, (int64_t)s->num), sunder_i_lattice_get(l, (int64_t)t->den)),
        sunder_i_big_mul(&l->arena, sunder_i_lattice_get(l, (int64_t)t->num), sunder_i_lattice_get(l, (int64_t)s->den)));
    sunder_i_wide_drop(l, mark);
    return c;
}
