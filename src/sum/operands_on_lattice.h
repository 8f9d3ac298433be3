/* The operands of a sum on the lattice that the sum then stands on. */
#ifndef SUNDER_I_OPERANDS_ON_LATTICE_H
#define SUNDER_I_OPERANDS_ON_LATTICE_H

#include "shape/shape.h"
#include "sum/sum_value.h"

/* Places p and q on one lattice, which moves into the sum, origins with it: the points in *placed refer to its pool. */
sunder_status sunder_i_sum_place(sunder_sum *sum, const sunder_shape *p, const sunder_shape *q, bool force_wide,
                                 sunder_i_placed *placed, sunder_error *err);

#endif
