/* The least separating translation, with every knob. */
#ifndef SUNDER_I_LEAST_H
#define SUNDER_I_LEAST_H

#include "separation/separation.h"

typedef struct sunder_i_least_options {
    const double *tp, *tq; /* exact translations, or NULL */
    double gap;            /* >= 0, finite */
    double upper;          /* a length past which the answer no longer matters; INFINITY for none */
    bool texts;            /* make the three texts */
    bool force_wide, force_squares; /* for tests */
} sunder_i_least_options;

/* *beyond may be NULL. out is all set on success, untouched on failure. */
sunder_status sunder_i_least(const sunder_shape *p, const sunder_shape *q, const sunder_i_least_options *options,
                             sunder_separation *out, bool *beyond, sunder_error *err);

/* Pieces of an answer: nothing has to move; the answer lies beyond the upper limit. */
sunder_status sunder_i_stay(bool texts, sunder_separation *out, sunder_error *err);
void sunder_i_too_far(double upper, sunder_separation *out, bool *beyond);

#endif
