/* Exact places on a lattice of sums: the corners of free space, and whatever start, goal or rounded vertex a user
 * names, with numerators and denominators of any size.
 *
 * A place is a point on the lattice, its big integers in an arena; ax, ay are close to its coordinates in the units of
 * sunder_i_approx(). Questions are answered in doubles where the error bound allows it, else in big integers. */
#ifndef SUNDER_I_FILTERED_POINT_H
#define SUNDER_I_FILTERED_POINT_H

#include "sum/sum_value.h"

typedef struct sunder_i_filtered_point {
    sunder_i_rational_point at;
    double ax, ay;
} sunder_i_filtered_point;

/* What the tests are asked on. error bounds the distance of ax, ay and of doubles of lattice points from the truth. */
typedef struct sunder_i_filter {
    sunder_i_lattice *lattice;
    double error;
} sunder_i_filter;

/* From its integers in the lattice's arena. */
sunder_i_filtered_point sunder_i_filtered_make(sunder_i_lattice *lattice, sunder_i_rational_point at);
/* Of a vertex of the sum. Memory in the lattice's arena, whose `failed` tells. */
sunder_i_filtered_point sunder_i_filtered_of_vertex(sunder_i_lattice *lattice, const sunder_i_hpoint *vertex);
/* Of rational coordinates. */
sunder_i_filtered_point sunder_i_filtered_of_rational(const sunder_sum *sum, sunder_i_lattice *lattice,
                                                      sunder_i_ratio x, sunder_i_ratio y);
sunder_i_filtered_point sunder_i_filtered_of_double(const sunder_sum *sum, sunder_i_lattice *lattice,
                                                    const double xy[2]);

/* Lexicographic, x first; and by x or y alone. */
int sunder_i_filtered_cmp(const sunder_i_filter *g, const sunder_i_filtered_point *a, const sunder_i_filtered_point *b);
int sunder_i_filtered_cmp_x(const sunder_i_filter *g, const sunder_i_filtered_point *a,
                            const sunder_i_filtered_point *b);
int sunder_i_filtered_cmp_y(const sunder_i_filter *g, const sunder_i_filtered_point *a,
                            const sunder_i_filtered_point *b);
/* Side of c to the line ab: +1 left, -1 right, 0 on it, or a == b. */
int sunder_i_filtered_orient(const sunder_i_filter *g, const sunder_i_filtered_point *a,
                             const sunder_i_filtered_point *b, const sunder_i_filtered_point *c);
/* A lattice point, and doubles close to it, which stay where they are. */
typedef struct sunder_i_lattice_corner {
    sunder_i_point point;
    const double *at;
} sunder_i_lattice_corner;

/* Side of c to the line ab of lattice points. */
int sunder_i_filtered_side(const sunder_i_filter *g, sunder_i_lattice_corner a, sunder_i_lattice_corner b,
                           const sunder_i_filtered_point *c);
/* Side of the lattice point c to the line ab of places. */
int sunder_i_filtered_corner_side(const sunder_i_filter *g, const sunder_i_filtered_point *a,
                                  const sunder_i_filtered_point *b, sunder_i_lattice_corner c);

#endif
