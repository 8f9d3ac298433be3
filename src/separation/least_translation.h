/* The least translation that parts two features, with every knob. */
#ifndef SUNDER_I_LEAST_TRANSLATION_H
#define SUNDER_I_LEAST_TRANSLATION_H

#include "separation/answer/answer.h"

/* *beyond may be NULL. out is all set on success, untouched on failure. */
sunder_status sunder_i_least(const sunder_shape *p, const sunder_shape *q, const sunder_i_least_options *options,
                             sunder_separation *out, bool *beyond, sunder_error *err);

#endif
