/* Cases of growing and shrinking, what the library answers, and its answers as sets of integers. */
#ifndef SUNDER_TESTS_MORPHOLOGY_CASE_H
#define SUNDER_TESTS_MORPHOLOGY_CASE_H

#include "generate.h"

#define MORPHOLOGY_FRAME 64 /* beyond all that the boards here reach */
/* The finest scale that a case may need, so that products of two integers are exact doubles. */
#define MORPHOLOGY_FINEST (1L << 20)

/* P: two simple polygons, or a board whose parts are disjoint members. B, to grow and shrink by: a smaller board, a
 * simple or a convex polygon, or one with coordinates of the board's grid, so that fits are exact. */
void morphology_case(polyset *p, polyset *b, rng *r);
/* Prints case i, and how to see it again. */
void morphology_show(const char *what, size_t i, const polyset *p, const polyset *b);

/* By two threads; NULL, with the reason printed, where it fails. */
sunder_sum *morphology_answer(const polyset *p, const polyset *b, sunder_operation operation);

/* The least k that makes integers of all vertices that the sum names; 0 if it is more than the finest. */
long morphology_scale(const sunder_sum *sum);
/* Its polygons times k, and (may be NULL) segments and points as pairs and singles of coordinates, to be freed. */
void morphology_scaled(const sunder_sum *sum, long k, polyset *set, double **segments, double **points);

/* Is the point c on the closed segment ab; in the closed polygons of a set, which are disjoint? Of integers
 * below 2^26. */
bool morphology_on_segment(const double *a, const double *b, const double *c);
bool morphology_in_polygons(const polyset *set, const double *at);

/* The complement of a regular set without overlaps, within a square that reaches so far on each side of the origin. */
void morphology_complement(polyset *out, const polyset *d, double frame);

#endif
