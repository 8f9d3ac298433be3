/* The sum of two sets whose sides run along the axes. */
#ifndef SUNDER_I_RECTILINEAR_SUM_H
#define SUNDER_I_RECTILINEAR_SUM_H

#include "shape/shape.h"
#include "sum/sum_value.h"

/* Fills the outline of an empty sum, which stands on a lattice that both operands are placed on, and sets *done.
 * Changes neither where a side is not along an axis, the lattice is not narrow, or there would be too many rectangles.
 * Fails with SUNDER_ENOMEM, SUNDER_ECANCEL. */
sunder_status sunder_i_rectilinear_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                       const sunder_shape *q, const sunder_i_point *at_q, bool *done,
                                       sunder_error *err);

#endif
