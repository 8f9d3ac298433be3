/* narrow.h: determinants on a narrow lattice, in native integers: inline functions for the inner loops of the
 * algorithms. Coordinates are below 2^60 and differences below 2^61 in magnitude, so that products of two are below
 * 2^122 and their differences below 2^123. */
#ifndef SUNDER_I_NARROW_H
#define SUNDER_I_NARROW_H

#include "predicate/predicate.h"

static inline sunder_i_det sunder_i_narrow_cross(sunder_i_point u, sunder_i_point v)
{
    return (sunder_i_det)u.x * (sunder_i_det)v.y - (sunder_i_det)u.y * (sunder_i_det)v.x;
}

static inline sunder_i_det sunder_i_narrow_dot(sunder_i_point u, sunder_i_point v)
{
    return (sunder_i_det)u.x * (sunder_i_det)v.x + (sunder_i_det)u.y * (sunder_i_det)v.y;
}

/* The same products of *brief* vectors, with coordinates below 2^30: in 64 bits, below 2^61. */
static inline int64_t sunder_i_brief_cross(sunder_i_point u, sunder_i_point v) { return u.x * v.y - u.y * v.x; }
static inline int64_t sunder_i_brief_dot(sunder_i_point u, sunder_i_point v) { return u.x * v.x + u.y * v.y; }

static inline sunder_i_point sunder_i_narrow_sub(sunder_i_point a, sunder_i_point b)
{
    return (sunder_i_point){a.x - b.x, a.y - b.y};
}

static inline sunder_i_det sunder_i_narrow_orient(sunder_i_point a, sunder_i_point b, sunder_i_point c)
{
    return sunder_i_narrow_cross(sunder_i_narrow_sub(b, a), sunder_i_narrow_sub(c, a));
}

/* Inline version of sunder_i_orient(): no call is made if the lattice is narrow. */
static inline int sunder_i_orient_inline(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, sunder_i_point c)
{
    if (!l->narrow) return sunder_i_orient(l, a, b, c);
    l->counts.orientation_tests++;
    return sunder_i_det_sign(sunder_i_narrow_orient(a, b, c));
}

/* Inline versions of the functions of predicate.h. */
static inline int sunder_i_point_cmp_inline(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b)
{
    if (!l->narrow) return sunder_i_point_cmp(l, a, b);
    l->counts.comparisons++;
    return a.x != b.x ? (a.x > b.x) - (a.x < b.x) : (a.y > b.y) - (a.y < b.y);
}

static inline int sunder_i_cross_sign_inline(sunder_i_lattice *l, sunder_i_point u, sunder_i_point v)
{
    if (!l->narrow) return sunder_i_cross_sign(l, u, v);
    l->counts.orientation_tests++;
    return sunder_i_det_sign(sunder_i_narrow_cross(u, v));
}

static inline sunder_i_point sunder_i_point_sub_inline(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b)
{
    return l->narrow ? sunder_i_narrow_sub(a, b) : sunder_i_point_sub(l, a, b);
}

static inline sunder_i_i256 sunder_i_narrow_i256(int64_t v)
{
    return (sunder_i_i256){{v < 0 ? -(uint64_t)v : (uint64_t)v, 0, 0, 0}, (v > 0) - (v < 0)};
}

/* *out becomes sunder_i_hpoint_of() the sum of two points. */
static inline void sunder_i_hpoint_of_sum(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, sunder_i_hpoint *out)
{
    if (!l->narrow) {
        *out = sunder_i_hpoint_of(l, sunder_i_point_add(l, a, b));
        return;
    }
    const sunder_i_point s = {a.x + b.x, a.y + b.y};
    *out = (sunder_i_hpoint){sunder_i_narrow_i256(s.x), sunder_i_narrow_i256(s.y), 1, (double)s.x, (double)s.y};
}

/* Returns num / den as a double: both conversions and the division are rounded once each, so that the relative error is
 * below 2^-51. */
static inline double sunder_i_narrow_value(sunder_i_det num, sunder_i_det den)
{
    return sunder_i_det_double(num) / sunder_i_det_double(den);
}

/* Returns the fraction num / den, den not zero; both are below 2^124 in magnitude. */
static inline sunder_i_fraction sunder_i_narrow_fraction(sunder_i_det num, sunder_i_det den)
{
    if (den < 0) {
        num = -num;
        den = -den;
    }
    return (sunder_i_fraction){num, den, sunder_i_narrow_value(num, den)};
}

/* |s.value - s| <= 2^-50 * max(1, |s.value|), so that values that differ by more than this decide the order. */
#define SUNDER_I_FRACTION_ERROR SUNDER_I_DOUBT(0x1p-49)

#endif
