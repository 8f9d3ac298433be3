/* reduced_convolution.h: sums of two simple polygons, neither of them convex, computed from their reduced convolution,
 * if its segments are tame. */
#ifndef SUNDER_I_REDUCED_CONVOLUTION_H
#define SUNDER_I_REDUCED_CONVOLUTION_H

#include "shape/shape.h"
#include "sum/canonical_sum.h"
#include "sunder_sum.h"

/* Sets the vertices and rings of `sum` to the sum of p and q, and sets *done. The sum's lattice must contain the
 * vertices at_p and at_q. If the reduced convolution does not prove the result, or may take longer than the general
 * method, *done is false and nothing is changed. Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_reduced_convolution_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                               const sunder_shape *q, const sunder_i_point *at_q, bool *done,
                                               sunder_error *err);

#endif
