/* fraction.c: positions of intersections along a line, as fractions. Numerator and denominator have degree 2: they are
 * below 2^124 on a narrow lattice, and below 2^126 elsewhere if all points are plain. Comparing two fractions has
 * degree 4 (256 bits). If one of the points is a handle, so is the fraction: den is 0, and num is the handle of a ratio
 * in the lattice's pool. */
#include "predicate/narrow.h"

#include <math.h>

/* Returns num / den, which are in the scratch arena, as a handle; den is not zero. */
static sunder_i_fraction pooled_fraction(sunder_i_lattice *l, sunder_i_big num, sunder_i_big den)
{
    if (sunder_i_big_sign(den) < 0) {
        num = sunder_i_big_neg(num);
        den = sunder_i_big_neg(den);
    }
    if (l->scratch.failed || l->arena.failed) return (sunder_i_fraction){0, 1, 0};
    const double value = sunder_i_big_ratio(&l->scratch, num, den, 0);
    const sunder_i_big n = sunder_i_big_copy(&l->arena, num), d = sunder_i_big_copy(&l->arena, den);
    return (sunder_i_fraction){sunder_i_lattice_pool(l, n, d, value), 0, value};
}

static bool are_plain(const sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, sunder_i_point c)
{
    return l->narrow ||
           (sunder_i_point_is_plain(a) && sunder_i_point_is_plain(b) && sunder_i_point_is_plain(c) && !l->pooled);
}

sunder_i_fraction sunder_i_crossing(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c,
                                    sunder_i_point d)
{
    lattice->counts.segment_intersections++;
    if (are_plain(lattice, a, b, c) && (lattice->narrow || sunder_i_point_is_plain(d))) {
        const sunder_i_point w = sunder_i_narrow_sub(d, c);
        return sunder_i_narrow_fraction(sunder_i_narrow_cross(sunder_i_narrow_sub(c, a), w),
                                        sunder_i_narrow_cross(sunder_i_narrow_sub(b, a), w));
    }
    const sunder_i_mark mark = sunder_i_lattice_begin(lattice);
    sunder_i_arena *m = &lattice->scratch;
    const sunder_i_rational_point p = sunder_i_rational_get(m, lattice, a), q = sunder_i_rational_get(m, lattice, c);
    const sunder_i_rational_point w = sunder_i_rational_sub(m, sunder_i_rational_get(m, lattice, d), q);
    const sunder_i_rational_point u = sunder_i_rational_sub(m, sunder_i_rational_get(m, lattice, b), p),
                                  v = sunder_i_rational_sub(m, q, p);
    const sunder_i_fraction f = pooled_fraction(lattice, sunder_i_times(m, sunder_i_rational_cross(m, v, w), u.w),
                                                sunder_i_times(m, sunder_i_rational_cross(m, u, w), v.w));
    sunder_i_lattice_end(lattice, mark);
    return f;
}

sunder_i_fraction sunder_i_along(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c)
{
    /* The points are collinear, so that the ratio of either coordinate is correct; the longer one is used. */
    if (are_plain(lattice, a, b, c)) {
        const sunder_i_point u = sunder_i_narrow_sub(b, a), v = sunder_i_narrow_sub(c, a);
        const uint64_t ux = (uint64_t)(u.x < 0 ? -u.x : u.x), uy = (uint64_t)(u.y < 0 ? -u.y : u.y);
        return ux >= uy ? sunder_i_narrow_fraction(v.x, u.x) : sunder_i_narrow_fraction(v.y, u.y);
    }
    const sunder_i_mark mark = sunder_i_lattice_begin(lattice);
    sunder_i_arena *m = &lattice->scratch;
    const sunder_i_rational_point u = sunder_i_rational_diff(m, lattice, b, a),
                                  v = sunder_i_rational_diff(m, lattice, c, a);
    const bool by_x = sunder_i_big_sign(u.x) != 0;
    const sunder_i_fraction f =
        pooled_fraction(lattice, sunder_i_times(m, by_x ? v.x : v.y, u.w), sunder_i_times(m, by_x ? u.x : u.y, v.w));
    sunder_i_lattice_end(lattice, mark);
    return f;
}

sunder_i_fraction sunder_i_foot(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c)
{
    if (are_plain(lattice, a, b, c)) {
        const sunder_i_point u = sunder_i_narrow_sub(b, a);
        return sunder_i_narrow_fraction(sunder_i_narrow_dot(sunder_i_narrow_sub(c, a), u), sunder_i_narrow_dot(u, u));
    }
    const sunder_i_mark mark = sunder_i_lattice_begin(lattice);
    sunder_i_arena *m = &lattice->scratch;
    const sunder_i_rational_point u = sunder_i_rational_diff(m, lattice, b, a),
                                  v = sunder_i_rational_diff(m, lattice, c, a);
    const sunder_i_fraction f = pooled_fraction(lattice, sunder_i_times(m, sunder_i_rational_dot(m, v, u), u.w),
                                                sunder_i_times(m, sunder_i_rational_dot(m, u, u), v.w));
    sunder_i_lattice_end(lattice, mark);
    return f;
}

sunder_i_fraction sunder_i_fraction_int(sunder_i_lattice *lattice, int n)
{
    (void)lattice;
    return (sunder_i_fraction){n, 1, n};
}

sunder_i_ratio sunder_i_fraction_read(sunder_i_arena *arena, const sunder_i_lattice *lattice,
                                      const sunder_i_fraction *t)
{
    if (t->den == 0) return sunder_i_lattice_read(arena, lattice, (int64_t)t->num);
    return (sunder_i_ratio){sunder_i_big_i128(arena, sunder_i_det_i128(t->num)),
                            sunder_i_big_i128(arena, sunder_i_det_i128(t->den))};
}

int sunder_i_fraction_sign(const sunder_i_lattice *lattice, const sunder_i_fraction *t)
{
    if (t->den != 0) return sunder_i_det_sign(t->num);
    return sunder_i_big_sign(lattice->pool[(int64_t)t->num - INT64_MIN].ratio.num);
}

/* Compares two fractions that doubles do not decide; their difference is at most `apart`. */
static __attribute__((noinline)) int exact_fraction_cmp(sunder_i_lattice *l, const sunder_i_fraction *s,
                                                        const sunder_i_fraction *t, double apart)
{
    l->counts.exact_fallbacks++;
    if (s->den != 0 && t->den != 0) {
        const sunder_i_i128 p = sunder_i_det_i128(s->num), v = sunder_i_det_i128(s->den);
        const sunder_i_i128 q = sunder_i_det_i128(t->num), w = sunder_i_det_i128(t->den);
        if (sunder_i_i128_is_short(v) && sunder_i_i128_is_short(w) && sunder_i_is_low_64(apart, (int64_t)v, (int64_t)w))
            return sunder_i_sign_low_64((uint64_t)p, (uint64_t)v, (uint64_t)q, (uint64_t)w);
        if (sunder_i_is_low_128(apart, v, w))
            return sunder_i_sign_low_128((sunder_i_u128)p, (sunder_i_u128)v, (sunder_i_u128)q, (sunder_i_u128)w);
        return sunder_i_cmp_products(p, w, q, v);
    }
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const int c = sunder_i_ratio_cmp(m, sunder_i_fraction_read(m, l, s), sunder_i_fraction_read(m, l, t));
    sunder_i_lattice_end(l, mark);
    return c;
}

int sunder_i_fraction_cmp(sunder_i_lattice *lattice, const sunder_i_fraction *s, const sunder_i_fraction *t)
{
    lattice->counts.comparisons++;
    const double d = s->value - t->value;
    const double bound = SUNDER_I_FRACTION_ERROR * (1 + fabs(s->value) + fabs(t->value));
    if (d > bound) return 1;
    if (d < -bound) return -1;
    return SUNDER_I_DOUBLES_MAY_ERR ? exact_fraction_cmp(lattice, s, t, 2 * bound) : 0;
}
