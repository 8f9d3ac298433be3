/* answer.h: the options of a least translation, and the conversion of an exact vector on the lattice to the caller's
 * form: the nearest doubles, and texts. */
#ifndef SUNDER_I_ANSWER_H
#define SUNDER_I_ANSWER_H

#include "separation/operands/pair_operands.h"

typedef struct sunder_i_least_options {
    const double *tp, *tq;          /* exact translations of P and of Q; NULL: none */
    double gap;                     /* >= 0, finite */
    double upper;                   /* a length beyond which the answer is not needed; INFINITY: no limit */
    bool texts;                     /* set the three texts of the answer */
    bool bound_only;                /* only overlap and lower_bound are needed; (dx, dy) need not separate the
                                     * operands */
    bool force_wide, force_squares; /* for tests */
} sunder_i_least_options;

/* Completes a zeroed *out for operands that need not move: the zero translation and, if `texts` is true, its texts.
 * Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_stay(bool texts, sunder_separation *out, sunder_error *err);
/* Completes a zeroed *out for a least translation that is longer than `upper`: lower_bound becomes `upper`, no
 * translation is given, and *beyond becomes true. */
void sunder_i_too_far(double upper, sunder_separation *out, bool *beyond);

/* The vector (x / w, y / w) in lattice units, w > 0: 128-bit integers if `small` (|x|, |y|, w < 2^63), else the big
 * integers of `big`. */
typedef struct sunder_i_exact_translation {
    bool small;
    sunder_i_i128 x, y, w;
    sunder_i_rational_point big;
} sunder_i_exact_translation;

/* Returns whether the point's x, y and w are below 2^63 in absolute value. */
bool sunder_i_hpoint_is_short(const sunder_i_hpoint *point);
sunder_i_exact_translation sunder_i_exact_translation_of(sunder_i_operands *operands, const sunder_i_hpoint *point);
/* Returns the vector with big integers. */
sunder_i_rational_point sunder_i_exact_translation_point(sunder_i_operands *operands,
                                                         const sunder_i_exact_translation *v);

/* Sets dx, dy and distance to the nearest doubles, and lower_bound to the distance rounded down. */
void sunder_i_answer_numbers(sunder_i_operands *operands, const sunder_i_exact_translation *v, sunder_separation *out);

/* Sets the three texts; on failure all are NULL. */
sunder_status sunder_i_answer_texts(sunder_i_operands *operands, const sunder_i_exact_translation *v,
                                    sunder_separation *out, sunder_error *err);

/* Returns (dx, dy), in the caller's units, as an exact vector in lattice units. */
sunder_i_rational_point sunder_i_doubles_point(sunder_i_operands *operands, double dx, double dy);

/* Returns whether (dx, dy) is exactly the vector v. */
bool sunder_i_answer_exact(sunder_i_operands *operands, const sunder_i_exact_translation *v, double dx, double dy);

#endif
