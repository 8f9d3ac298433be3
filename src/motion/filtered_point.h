/* filtered_point.h: exact points on the lattice of a sum: the vertices of free space, and start, goal and rounded
 * vertices, whose numerators and denominators may have any size.
 *
 * `at` is the exact point; its big integers are in the lattice's arena. ax, ay are approximations of its coordinates in
 * the units of sunder_i_approx(). Tests use the doubles if the error bound allows a decision, else the big integers. */
#ifndef SUNDER_I_FILTERED_POINT_H
#define SUNDER_I_FILTERED_POINT_H

#include "sum/sum_value.h"
#include "sunder_sum.h"

typedef struct sunder_i_filtered_point {
    sunder_i_rational_point at;
    double ax, ay;
} sunder_i_filtered_point;

/* The context of the tests: `error` bounds the absolute error of ax, ay and of the doubles of lattice points. */
typedef struct sunder_i_filter {
    sunder_i_lattice *lattice;
    double error;
} sunder_i_filter;

/* Makes a point from its exact coordinates, whose integers are in the lattice's arena. */
sunder_i_filtered_point sunder_i_filtered_make(sunder_i_lattice *lattice, sunder_i_rational_point at);
/* Makes a point from a vertex of the sum. Its numbers are allocated in the lattice's arena; out of memory sets its
 * `failed`. */
sunder_i_filtered_point sunder_i_filtered_of_vertex(sunder_i_lattice *lattice, const sunder_i_hpoint *vertex);
/* Make a point from rational coordinates x, y, or from the doubles xy, in units of the input. */
sunder_i_filtered_point sunder_i_filtered_of_rational(const sunder_sum *sum, sunder_i_lattice *lattice,
                                                      sunder_i_ratio x, sunder_i_ratio y);
sunder_i_filtered_point sunder_i_filtered_of_double(const sunder_sum *sum, sunder_i_lattice *lattice,
                                                    const double xy[2]);

/* Compare two points lexicographically, x first, or by x or by y alone: < 0, 0, > 0. */
int sunder_i_filtered_cmp(const sunder_i_filter *g, const sunder_i_filtered_point *a, const sunder_i_filtered_point *b);
int sunder_i_filtered_cmp_x(const sunder_i_filter *g, const sunder_i_filtered_point *a,
                            const sunder_i_filtered_point *b);
int sunder_i_filtered_cmp_y(const sunder_i_filter *g, const sunder_i_filtered_point *a,
                            const sunder_i_filtered_point *b);
/* Returns +1 if c is left of the line ab, -1 if it is right of it, 0 if it is on it or a == b. */
int sunder_i_filtered_orient(const sunder_i_filter *g, const sunder_i_filtered_point *a,
                             const sunder_i_filtered_point *b, const sunder_i_filtered_point *c);
/* A lattice point, and approximate doubles of its coordinates (borrowed). */
typedef struct sunder_i_lattice_corner {
    sunder_i_point point;
    const double *at;
} sunder_i_lattice_corner;

/* Returns +1 if c is left of the line from the lattice point a to the lattice point b, -1 right of it, 0 on it. */
int sunder_i_filtered_side(const sunder_i_filter *g, sunder_i_lattice_corner a, sunder_i_lattice_corner b,
                           const sunder_i_filtered_point *c);
/* Returns +1 if the lattice point c is left of the line ab, -1 right of it, 0 on it. */
int sunder_i_filtered_corner_side(const sunder_i_filter *g, const sunder_i_filtered_point *a,
                                  const sunder_i_filtered_point *b, sunder_i_lattice_corner c);

#endif
