/* convex_operands.h: the sum of two convex polygons. */
#ifndef SUNDER_I_CONVEX_OPERANDS_H
#define SUNDER_I_CONVEX_OPERANDS_H

#include "shape/shape.h"
#include "sum/sum_value.h"
#include "sunder_sum.h"

/* Returns true if p and q each are one convex polygon. */
bool sunder_i_are_convex(const sunder_shape *p, const sunder_shape *q);
/* Sets the outline of an empty sum; its lattice must contain the vertices at_p of p and at_q of q. Takes O(m + n) for m
 * and n vertices. Fails with SUNDER_ENOMEM; the caller frees the sum in either case. */
sunder_status sunder_i_convex_operands_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                           const sunder_shape *q, const sunder_i_point *at_q, sunder_error *err);

#endif
