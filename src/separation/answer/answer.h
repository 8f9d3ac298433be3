/* Options of a least translation; and the step from an exact vector on the lattice to the caller's form: nearest
 * doubles and texts. */
#ifndef SUNDER_I_ANSWER_H
#define SUNDER_I_ANSWER_H

#include "separation/operands/pair_operands.h"

typedef struct sunder_i_least_options {
    const double *tp, *tq;          /* exact translations, or NULL */
    double gap;                     /* >= 0, finite */
    double upper;                   /* a length past which the answer no longer matters; INFINITY for none */
    bool texts;                     /* make the three texts */
    bool bound_only;                /* wanted are overlap and lower_bound; dx and dy need not be free */
    bool force_wide, force_squares; /* for tests */
} sunder_i_least_options;

/* Nothing has to move; the answer lies beyond the upper limit. */
sunder_status sunder_i_stay(bool texts, sunder_separation *out, sunder_error *err);
void sunder_i_too_far(double upper, sunder_separation *out, bool *beyond);

/* (x / w, y / w) lattice units, w > 0: as 128-bit integers where they fit (`small`: |x|, |y|, w < 2^63), else as big
 * ones. */
typedef struct sunder_i_exact_translation {
    bool small;
    sunder_i_i128 x, y, w;
    sunder_i_rational_point big;
} sunder_i_exact_translation;

/* Is it `small`? */
bool sunder_i_hpoint_is_short(const sunder_i_hpoint *point);
sunder_i_exact_translation sunder_i_exact_translation_of(sunder_i_operands *operands, const sunder_i_hpoint *point);
/* As big integers. */
sunder_i_rational_point sunder_i_exact_translation_point(sunder_i_operands *operands,
                                                         const sunder_i_exact_translation *v);

/* dx, dy, distance: the nearest doubles; lower_bound: the distance rounded down. */
void sunder_i_answer_numbers(sunder_i_operands *operands, const sunder_i_exact_translation *v, sunder_separation *out);

/* The three texts; on failure none is left. */
sunder_status sunder_i_answer_texts(sunder_i_operands *operands, const sunder_i_exact_translation *v,
                                    sunder_separation *out, sunder_error *err);

/* (dx, dy) in lattice units, exactly. */
sunder_i_rational_point sunder_i_doubles_point(sunder_i_operands *operands, double dx, double dy);

/* Are out->dx and out->dy exactly the vector? */
bool sunder_i_answer_exact(sunder_i_operands *operands, const sunder_i_exact_translation *v, double dx, double dy);

#endif
