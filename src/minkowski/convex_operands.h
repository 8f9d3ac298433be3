/* The sum of two convex polygons. */
#ifndef SUNDER_I_CONVEX_OPERANDS_H
#define SUNDER_I_CONVEX_OPERANDS_H

#include "shape/shape.h"
#include "sum/sum_value.h"

/* Is each of them one convex polygon? */
bool sunder_i_are_convex(const sunder_shape *p, const sunder_shape *q);
/* Fills an empty sum, but for its lattice, on which both stand. Fails with SUNDER_ENOMEM; the caller frees the sum.
 * Cost O(m + n). */
sunder_status sunder_i_convex_operands_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                           const sunder_shape *q, const sunder_i_point *at_q, sunder_error *err);

#endif
