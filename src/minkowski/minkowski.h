/* The sum: which road leads to it is decided here, and sunder_minkowski_sum() is this with force_wide false. With
 * force_wide, which tests ask for, numbers are big integers throughout, whatever the operands. */
#ifndef SUNDER_I_MINKOWSKI_H
#define SUNDER_I_MINKOWSKI_H

#include "sunder.h"

sunder_status sunder_i_minkowski_sum(const sunder_shape *p, const sunder_shape *q, bool force_wide,
                                     const sunder_sum_options *options, sunder_sum **out, sunder_error *err);

#endif
