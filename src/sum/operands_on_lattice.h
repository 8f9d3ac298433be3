/* operands_on_lattice.h: the operands of a sum on the lattice of the sum. */
#ifndef SUNDER_I_OPERANDS_ON_LATTICE_H
#define SUNDER_I_OPERANDS_ON_LATTICE_H

#include "shape/shape.h"
#include "sum/sum_value.h"
#include "sunder_sum.h"

/* Places p and q on one lattice, which is moved to the sum together with the origins: the points in *placed refer to
 * its pool. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_sum_place(sunder_sum *sum, const sunder_shape *p, const sunder_shape *q, bool force_wide,
                                 sunder_i_placed *placed, sunder_error *err);

#endif
