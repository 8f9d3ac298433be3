/* The sum with its rung of numbers forced, for tests: force_wide computes on big integers throughout. */
#ifndef SUNDER_I_MINKOWSKI_H
#define SUNDER_I_MINKOWSKI_H

#include "sunder.h"

sunder_status sunder_i_minkowski_sum(const sunder_shape *p, const sunder_shape *q, bool force_wide,
                                     const sunder_sum_options *options, sunder_sum **out, sunder_error *err);

#endif
