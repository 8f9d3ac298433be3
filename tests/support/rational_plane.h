/* Vectors of the plane and convex polygons in rationals, for oracles: simple, slow, and without code from src/. */
#ifndef SUNDER_TESTS_RATIONAL_PLANE_H
#define SUNDER_TESTS_RATIONAL_PLANE_H

#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct vec {
    mpq_t x, y;
} vec;

void vec_init(vec *v);
void vec_clear(vec *v);
void vec_set_d(vec *v, const double *xy);
void vec_sub(vec *r, const vec *p, const vec *q);
void vec_dot(mpq_t r, const vec *p, const vec *q);
void vec_cross(mpq_t r, const vec *p, const vec *q);
/* Returns 1 if p, q, r turn left, -1 if right, 0 if straight. */
int vec_side(const vec *p, const vec *q, const vec *r);

/* Counter-clockwise, strictly convex; a segment or a point has two corners or one. */
typedef struct hull {
    vec *v;
    size_t n, room; /* room: the number of initialised vectors */
} hull;

/* The convex hull of all differences of a corner of a and one of b. */
hull hull_difference(const double *a, size_t na, const double *b, size_t nb);
void hull_free(hull *h);
/* The squared distance of p from the closed polygon. */
void hull_square_from(mpq_t square, const hull *h, const vec *p);
/* Is the disc around p inside the polygon? square: of its radius. */
bool hull_holds_disc(const hull *h, const vec *p, const mpq_t square);

#endif
