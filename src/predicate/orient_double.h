/* orient_double.h: the two steps of sunder_orient(), as separate functions so that tests can call each. */
#ifndef SUNDER_I_ORIENT_DOUBLE_H
#define SUNDER_I_ORIENT_DOUBLE_H

#include "predicate/predicate.h"
#include "sunder_shape.h"

#define SUNDER_I_UNSURE 2

/* Returns +1 or -1 if floating point with a proved error bound decides the side, else SUNDER_I_UNSURE. */
int sunder_i_orient_filter(const sunder_point *a, const sunder_point *b, const sunder_point *c);
/* Returns the sign of the six products of the determinant, summed exactly in fixed memory. */
int sunder_i_orient_exact(const sunder_point *a, const sunder_point *b, const sunder_point *c);

#endif
