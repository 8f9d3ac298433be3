/* Without a gap: how deep are two sets in each other? The least translation that takes their interiors apart, whose
 * length is called their penetration depth. */
#ifndef SUNDER_I_PENETRATION_H
#define SUNDER_I_PENETRATION_H

#include "separation/answer/answer.h"

/* Of two sets that are not empty; out is zero at first. As sunder_i_least(). */
sunder_status sunder_i_least_without_gap(const sunder_shape *p, const sunder_shape *q, const sunder_i_least_options *o,
                                         sunder_separation *out, bool *beyond, sunder_error *err);

#endif
