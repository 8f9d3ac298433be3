/* rectilinear_sum.h: the sum of two sets whose sides are parallel to the axes. */
#ifndef SUNDER_I_RECTILINEAR_SUM_H
#define SUNDER_I_RECTILINEAR_SUM_H

#include "shape/shape.h"
#include "sum/sum_value.h"
#include "sunder_sum.h"

/* Sets the outline of an empty sum, whose lattice must contain the vertices at_p of p and at_q of q, and sets *done. If
 * a side is not parallel to an axis, the lattice is not narrow, or there would be too many rectangles, *done is false
 * and nothing is changed. Fails with SUNDER_ENOMEM or SUNDER_ECANCEL. */
sunder_status sunder_i_rectilinear_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                       const sunder_shape *q, const sunder_i_point *at_q, bool *done,
                                       sunder_error *err);

#endif
