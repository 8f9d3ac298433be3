/* rational_point.c: rational points: read from the lattice and stored there, added, compared. Denominators that are
 * one, or equal, are tested first: nearly all are. */
#include "predicate/rational_point.h"

#include "number/ball.h"

#include <stdlib.h>

static bool big_equal(sunder_i_big a, sunder_i_big b)
{
    if (a.size != b.size) return false;
    return a.size == 1 ? a.limb[0] == b.limb[0] : a.limb == b.limb || sunder_i_big_cmp(a, b) == 0;
}

sunder_i_rational_point sunder_i_rational_get(sunder_i_arena *arena, const sunder_i_lattice *lattice, sunder_i_point a)
{
    const sunder_i_ratio x = sunder_i_lattice_read(arena, lattice, a.x), y = sunder_i_lattice_read(arena, lattice, a.y);
    if (big_equal(x.den, y.den)) return (sunder_i_rational_point){x.num, y.num, x.den};
    /* One of the two is an integer, or they were computed separately. */
    return (sunder_i_rational_point){sunder_i_times(arena, x.num, y.den), sunder_i_times(arena, y.num, x.den),
                                     sunder_i_times(arena, x.den, y.den)};
}

/* Divides *x and *y by w. Returns true if w divides both; otherwise they are unchanged. */
static bool divides_point(sunder_i_arena *arena, sunder_i_big w, sunder_i_big *x, sunder_i_big *y)
{
    const sunder_i_big p = sunder_i_big_div_floor(arena, *x, w), q = sunder_i_big_div_floor(arena, *y, w);
    if (arena->failed || sunder_i_big_cmp(sunder_i_big_mul(arena, p, w), *x) != 0 ||
        sunder_i_big_cmp(sunder_i_big_mul(arena, q, w), *y) != 0)
        return false;
    *x = p;
    *y = q;
    return true;
}

sunder_i_point sunder_i_rational_put(sunder_i_lattice *lattice, sunder_i_rational_point u)
{
    sunder_i_arena *arena = &lattice->arena;
    /* Both corners of a side may have the denominator of one intersection, while their difference is a lattice
     * vector. */
    const bool whole = sunder_i_big_is_one(u.w) || divides_point(&lattice->scratch, u.w, &u.x, &u.y);
    const sunder_i_big x = sunder_i_big_copy(arena, u.x), y = sunder_i_big_copy(arena, u.y);
    if (whole) return (sunder_i_point){sunder_i_lattice_big(lattice, x), sunder_i_lattice_big(lattice, y)};
    const sunder_i_big w = sunder_i_big_copy(arena, u.w);
    return (sunder_i_point){sunder_i_lattice_ratio(lattice, x, w), sunder_i_lattice_ratio(lattice, y, w)};
}

sunder_i_rational_point sunder_i_rational_reduced(sunder_i_arena *arena, sunder_i_rational_point u)
{
    const sunder_i_big g = sunder_i_big_gcd(arena, sunder_i_big_gcd(arena, u.x, u.w), u.y);
    if (arena->failed || sunder_i_big_bits(g) <= 1) return u;
    return (sunder_i_rational_point){sunder_i_big_div_floor(arena, u.x, g), sunder_i_big_div_floor(arena, u.y, g),
                                     sunder_i_big_div_floor(arena, u.w, g)};
}

sunder_i_rational_point sunder_i_rational_add(sunder_i_arena *arena, sunder_i_rational_point u,
                                              sunder_i_rational_point v)
{
    if (big_equal(u.w, v.w))
        return (sunder_i_rational_point){sunder_i_big_add(arena, u.x, v.x), sunder_i_big_add(arena, u.y, v.y), u.w};
    return (sunder_i_rational_point){
        sunder_i_big_add(arena, sunder_i_times(arena, u.x, v.w), sunder_i_times(arena, v.x, u.w)),
        sunder_i_big_add(arena, sunder_i_times(arena, u.y, v.w), sunder_i_times(arena, v.y, u.w)),
        sunder_i_times(arena, u.w, v.w)};
}

sunder_i_rational_point sunder_i_rational_sub(sunder_i_arena *arena, sunder_i_rational_point u,
                                              sunder_i_rational_point v)
{
    return sunder_i_rational_add(arena, u, sunder_i_rational_neg(v));
}

sunder_i_rational_point sunder_i_rational_diff(sunder_i_arena *arena, const sunder_i_lattice *lattice, sunder_i_point b,
                                               sunder_i_point a)
{
    return sunder_i_rational_sub(arena, sunder_i_rational_get(arena, lattice, b),
                                 sunder_i_rational_get(arena, lattice, a));
}

int sunder_i_rational_cmp(sunder_i_arena *arena, const sunder_i_rational_point *u, const sunder_i_rational_point *v,
                          int axis)
{
    const sunder_i_big a = sunder_i_rational_axis(u, axis), b = sunder_i_rational_axis(v, axis);
    if (u->w.limb == v->w.limb) return sunder_i_big_cmp(a, b);
    return sunder_i_big_cmp(sunder_i_times(arena, a, v->w), sunder_i_times(arena, b, u->w));
}

/* From this number of limbs on an exact product takes longer than one of the leading bits. */
#define LONG_LIMBS 8

static bool is_long(const sunder_i_rational_point *u)
{
    const long x = labs(u->x.size), y = labs(u->y.size);
    return (x > y ? x : y) >= LONG_LIMBS;
}

typedef struct rough_point {
    sunder_i_ball x, y, w;
} rough_point;

static rough_point rough_of(const sunder_i_rational_point *u)
{
    return (rough_point){sunder_i_ball_big(u->x), sunder_i_ball_big(u->y), sunder_i_ball_big(u->w)};
}

/* Returns v - u, times both denominators. */
static rough_point rough_way(const rough_point *u, const rough_point *v)
{
    return (rough_point){sunder_i_ball_sub(sunder_i_ball_mul(v->x, u->w), sunder_i_ball_mul(u->x, v->w)),
                         sunder_i_ball_sub(sunder_i_ball_mul(v->y, u->w), sunder_i_ball_mul(u->y, v->w)), u->w};
}

/* Returns the sign of u x v if the leading bits decide it, else 0. */
static int rough_cross_sign(const rough_point *u, const rough_point *v)
{
    return sunder_i_ball_sign(sunder_i_ball_sub(sunder_i_ball_mul(u->x, v->y), sunder_i_ball_mul(u->y, v->x)));
}

static int rough_orient(const sunder_i_rational_point *a, const sunder_i_rational_point *b,
                        const sunder_i_rational_point *c)
{
    const rough_point p = rough_of(a), q = rough_of(b), r = rough_of(c);
    const rough_point u = rough_way(&p, &q), v = rough_way(&p, &r);
    return rough_cross_sign(&u, &v);
}

int sunder_i_rational_cross_sign(sunder_i_arena *arena, sunder_i_rational_point u, sunder_i_rational_point v)
{
    if (is_long(&u) || is_long(&v)) {
        const rough_point p = rough_of(&u), q = rough_of(&v);
        const int sign = rough_cross_sign(&p, &q);
        if (sign) return sign;
    }
    return sunder_i_big_sign(sunder_i_rational_cross(arena, u, v));
}

/* First the leading bits of the points are used. The side of points that are near each other depends on their
 * differences, which are therefore computed exactly, and their leading bits are used next. */
int sunder_i_rational_orient(sunder_i_arena *arena, sunder_i_rational_point a, sunder_i_rational_point b,
                             sunder_i_rational_point c)
{
    if (is_long(&a) || is_long(&b) || is_long(&c)) {
        const int sign = rough_orient(&a, &b, &c);
        if (sign) return sign;
    }
    return sunder_i_rational_cross_sign(arena, sunder_i_rational_sub(arena, b, a), sunder_i_rational_sub(arena, c, a));
}
