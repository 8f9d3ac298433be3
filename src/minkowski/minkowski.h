/* Computes the sum of p and q with the method that suits the operands; sunder_minkowski_sum() calls this function with
 * force_wide false. If force_wide is set, as in tests, all numbers are big integers, whatever the operands. */
#ifndef SUNDER_I_MINKOWSKI_H
#define SUNDER_I_MINKOWSKI_H

#include "sunder_sum.h"

sunder_status sunder_i_minkowski_sum(const sunder_shape *p, const sunder_shape *q, bool force_wide,
                                     const sunder_sum_options *options, sunder_sum **out, sunder_error *err);

#endif
