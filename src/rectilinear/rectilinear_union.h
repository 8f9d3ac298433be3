/* The outline of a union of open rectangles. Internal to this folder. */
#ifndef SUNDER_I_RECTILINEAR_UNION_H
#define SUNDER_I_RECTILINEAR_UNION_H

#include "rectilinear/rectangles.h"
#include "sum/sum_value.h"

/* Fills the outline of an empty sum, on whose narrow lattice the coordinates are. Fails with SUNDER_ENOMEM,
 * SUNDER_ECANCEL; the caller frees the sum. */
sunder_status sunder_i_rectangles_unite(const sunder_i_ranked_rectangles *rectangles, sunder_sum *sum,
                                        sunder_error *err);

#endif
