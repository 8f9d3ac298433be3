/* A sum as a shape. */
#ifndef SUNDER_I_TO_SHAPE_H
#define SUNDER_I_TO_SHAPE_H

#include "sum/sum_value.h"

/* The polygons of a sum, corners at the nearest doubles; degenerate parts are left out. exact: only where no corner is
 * moved by that; else *out stays as it is. Fails as sunder_shape_from_rings() does. */
sunder_status sunder_i_sum_to_shape(const sunder_sum *sum, bool exact, sunder_validity validity, sunder_shape **out,
                                    sunder_error *err);

#endif
