/* rational_point.h: points and vectors with rational coordinates over one denominator, in big integers: intersections,
 * Steiner points, and lattice points on lattices that are not narrow. Signs of products are those of the numerators,
 * since denominators are positive. Fractions need not be in lowest terms: equal points may have different numbers. */
#ifndef SUNDER_I_RATIONAL_POINT_H
#define SUNDER_I_RATIONAL_POINT_H

#include "number/lattice.h"

/* The point (x / w, y / w), w > 0. */
typedef struct sunder_i_rational_point {
    sunder_i_big x, y, w;
} sunder_i_rational_point;

/* Returns the numerator of coordinate `axis`: 0: x, 1: y. */
static inline sunder_i_big sunder_i_rational_axis(const sunder_i_rational_point *u, int axis)
{
    return axis ? u->y : u->x;
}

/* Returns a lattice point as a rational point; plain numbers are allocated in `arena`. The lattice does not change. */
sunder_i_rational_point sunder_i_rational_get(sunder_i_arena *arena, const sunder_i_lattice *lattice, sunder_i_point a);
/* Returns a rational point as a point of the lattice; its numbers are copied to the lattice's arena. */
sunder_i_point sunder_i_rational_put(sunder_i_lattice *lattice, sunder_i_rational_point u);
/* Returns the point in lowest terms. */
sunder_i_rational_point sunder_i_rational_reduced(sunder_i_arena *arena, sunder_i_rational_point u);

/* Return u + v and u - v; if both have the same denominator, the result has it, too. */
sunder_i_rational_point sunder_i_rational_add(sunder_i_arena *arena, sunder_i_rational_point u,
                                              sunder_i_rational_point v);
sunder_i_rational_point sunder_i_rational_sub(sunder_i_arena *arena, sunder_i_rational_point u,
                                              sunder_i_rational_point v);
/* Returns b - a for lattice points a, b. */
sunder_i_rational_point sunder_i_rational_diff(sunder_i_arena *arena, const sunder_i_lattice *lattice, sunder_i_point b,
                                               sunder_i_point a);

/* Compares two points by one coordinate. */
int sunder_i_rational_cmp(sunder_i_arena *arena, const sunder_i_rational_point *u, const sunder_i_rational_point *v,
                          int axis);
/* Returns the side of c with respect to the line ab: +1 left, -1 right, 0 if it is on the line or a == b. */
int sunder_i_rational_orient(sunder_i_arena *arena, sunder_i_rational_point a, sunder_i_rational_point b,
                             sunder_i_rational_point c);

/* Returns a copy in another arena. */
static inline sunder_i_rational_point sunder_i_rational_copy(sunder_i_arena *arena, sunder_i_rational_point u)
{
    sunder_i_big_copy_3(arena, &u.x, &u.y, &u.w);
    return u;
}

/* *x and *y become the coordinates times 2^exponent, rounded to the nearest doubles. */
static inline void sunder_i_rational_doubles(sunder_i_arena *arena, sunder_i_rational_point u, long exponent, double *x,
                                             double *y)
{
    *x = sunder_i_big_ratio(arena, u.x, u.w, exponent);
    *y = sunder_i_big_ratio(arena, u.y, u.w, exponent);
}

static inline sunder_i_rational_point sunder_i_rational_neg(sunder_i_rational_point u)
{
    return (sunder_i_rational_point){sunder_i_big_neg(u.x), sunder_i_big_neg(u.y), u.w};
}

/* Returns the sign of the cross product of u and v. */
int sunder_i_rational_cross_sign(sunder_i_arena *arena, sunder_i_rational_point u, sunder_i_rational_point v);
/* Return the cross product and the dot product, times both denominators. */
static inline sunder_i_big sunder_i_rational_cross(sunder_i_arena *arena, sunder_i_rational_point u,
                                                   sunder_i_rational_point v)
{
    return sunder_i_big_sub(arena, sunder_i_big_mul(arena, u.x, v.y), sunder_i_big_mul(arena, u.y, v.x));
}

static inline sunder_i_big sunder_i_rational_dot(sunder_i_arena *arena, sunder_i_rational_point u,
                                                 sunder_i_rational_point v)
{
    return sunder_i_big_add(arena, sunder_i_big_mul(arena, u.x, v.x), sunder_i_big_mul(arena, u.y, v.y));
}

/* Returns a times b, where b is a denominator: most denominators are one. */
static inline sunder_i_big sunder_i_times(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    return sunder_i_big_is_one(b) ? a : sunder_i_big_mul(arena, a, b);
}

#endif
