/* The rungs of sunder_orient(), each by itself so that tests can force them. */
#ifndef SUNDER_I_ORIENT_DOUBLE_H
#define SUNDER_I_ORIENT_DOUBLE_H

#include "predicate/predicate.h"

#define SUNDER_I_UNSURE 2

/* Floating point with a proved bound: +1, -1 or SUNDER_I_UNSURE. */
int sunder_i_orient_filter(const sunder_point *a, const sunder_point *b, const sunder_point *c);
/* The six products of the determinant, summed exactly in fixed memory. */
int sunder_i_orient_exact(const sunder_point *a, const sunder_point *b, const sunder_point *c);

#endif
