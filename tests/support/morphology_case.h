/* Random cases of dilation and erosion, the library's results for them, and these results as sets with integer
 * coordinates. */
#ifndef SUNDER_TESTS_MORPHOLOGY_CASE_H
#define SUNDER_TESTS_MORPHOLOGY_CASE_H

#include "generate.h"

#define MORPHOLOGY_FRAME 64 /* beyond all coordinates of the boards used here */
/* The greatest scale that a case may need, so that products of two integers are exact in doubles. */
#define MORPHOLOGY_FINEST (1L << 20)

/* P: two simple polygons, or a board whose parts are disjoint members. B, the shape of the operation: a smaller board,
 * a simple or a convex polygon, or one with coordinates of the board's grid, so that exact fits occur. */
void morphology_case(polyset *p, polyset *b, rng *r);
/* Prints case i, and how to repeat it. */
void morphology_show(const char *what, size_t i, const polyset *p, const polyset *b);

/* Computed by two threads; NULL, with the reason printed, if it fails. */
sunder_sum *morphology_answer(const polyset *p, const polyset *b, sunder_operation operation);

/* The least k for which all vertices in the sum, times k, are integers; 0 if it is more than the greatest scale. */
long morphology_scale(const sunder_sum *sum);
/* The polygons times k, and (may be NULL) segments and points as arrays of coordinates, which the caller frees. */
void morphology_scaled(const sunder_sum *sum, long k, polyset *set, double **segments, double **points);

/* Is the point c on the closed segment ab; in the closed polygons of a set, which are disjoint? For integers below
 * 2^26. */
bool morphology_on_segment(const double *a, const double *b, const double *c);
bool morphology_in_polygons(const polyset *set, const double *at);

/* The complement of a regular set without overlaps, within a square around the origin that extends by `frame` on each
 * side. */
void morphology_complement(polyset *out, const polyset *d, double frame);

#endif
