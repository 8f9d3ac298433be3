/* The sum with one convex polygon, by the convolution's curve where that is all there is to it. */
#ifndef SUNDER_I_CONVOLUTION_H
#define SUNDER_I_CONVOLUTION_H

#include "shape/shape.h"
#include "sum/sum.h"

/* Fills in the vertices and rings of sum, which stands on a lattice that both operands are placed on, and sets *done;
 * leaves both alone where the curve does not prove the result: the general road has to be taken then. Fails only with
 * SUNDER_ENOMEM. */
sunder_status sunder_i_convolution_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                       const sunder_shape *q, const sunder_i_point *at_q, bool *done,
                                       sunder_error *err);

#endif
