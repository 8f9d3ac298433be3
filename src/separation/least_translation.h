/* least_translation.h: the least translation that separates two shapes, with all options. */
#ifndef SUNDER_I_LEAST_TRANSLATION_H
#define SUNDER_I_LEAST_TRANSLATION_H

#include "separation/answer/answer.h"

/* *out is set completely on success, and unchanged on failure. *beyond (may be NULL) becomes whether the translation is
 * longer than options->upper. */
sunder_status sunder_i_least(const sunder_shape *p, const sunder_shape *q, const sunder_i_least_options *options,
                             sunder_separation *out, bool *beyond, sunder_error *err);

#endif
