/* Sums of two simple polygons, neither of them convex, off their reduced convolution where that is all there is to
 * them. */
#ifndef SUNDER_I_REDUCED_CONVOLUTION_H
#define SUNDER_I_REDUCED_CONVOLUTION_H

#include "shape/shape.h"
#include "sum/canonical_sum.h"

/* Fills in the vertices and rings of `sum`, which stands on a lattice that both operands are placed on, and sets *done.
 * Changes neither where the reduced convolution does not prove the result, or may take longer than the general road.
 * Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_reduced_convolution_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                               const sunder_shape *q, const sunder_i_point *at_q, bool *done,
                                               sunder_error *err);

#endif
