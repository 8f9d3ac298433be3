/* to_shape.h: converts a sum to a shape. */
#ifndef SUNDER_I_TO_SHAPE_H
#define SUNDER_I_TO_SHAPE_H

#include "sum/sum_value.h"

/* *out becomes the polygons of a sum, with vertices rounded to the nearest doubles; degenerate parts are omitted.
 * exact: only if rounding moves no vertex; otherwise *out is unchanged. Fails as sunder_shape_from_rings() does. */
sunder_status sunder_i_sum_to_shape(const sunder_sum *sum, bool exact, sunder_validity validity, sunder_shape **out,
                                    sunder_error *err);

#endif
