/* rectilinear_union.h: the outline of a union of open rectangles. Internal to this folder. */
#ifndef SUNDER_I_RECTILINEAR_UNION_H
#define SUNDER_I_RECTILINEAR_UNION_H

#include "rectilinear/rectangles.h"
#include "sum/sum_value.h"
#include "sunder_sum.h"

/* Sets the outline of an empty sum, whose narrow lattice the coordinates refer to. Fails with SUNDER_ENOMEM or
 * SUNDER_ECANCEL; the caller frees the sum. */
sunder_status sunder_i_rectangles_unite(const sunder_i_ranked_rectangles *rectangles, sunder_sum *sum,
                                        sunder_error *err);

#endif
