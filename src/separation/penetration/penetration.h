/* penetration.h: the least translation without a gap that separates the interiors of two sets; its length is called
 * their penetration depth. */
#ifndef SUNDER_I_PENETRATION_H
#define SUNDER_I_PENETRATION_H

#include "separation/answer/answer.h"

/* Does the same as sunder_i_least() for two sets that are not empty, without a gap; *out is zeroed by the caller. */
sunder_status sunder_i_least_without_gap(const sunder_shape *p, const sunder_shape *q, const sunder_i_least_options *o,
                                         sunder_separation *out, bool *beyond, sunder_error *err);

#endif
