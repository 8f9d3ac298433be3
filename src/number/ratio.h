/* ratio.h: ratios of big integers. */
#ifndef SUNDER_I_RATIO_H
#define SUNDER_I_RATIO_H

#include "number/big.h"

/* num / den, den > 0, not necessarily in lowest terms. */
typedef struct sunder_i_ratio {
    sunder_i_big num, den;
} sunder_i_ratio;

/* Returns the value of a finite double. */
sunder_i_ratio sunder_i_ratio_double(sunder_i_arena *arena, double v);
/* Parses "num" or "num/den", both decimal integers. Returns false if the text has another form, or den is zero. */
bool sunder_i_ratio_parse(sunder_i_arena *arena, const char *text, sunder_i_ratio *out);

/* Returns a + b over the least common multiple of the denominators. */
sunder_i_ratio sunder_i_ratio_add(sunder_i_arena *arena, sunder_i_ratio a, sunder_i_ratio b);
/* Returns a in lowest terms. */
sunder_i_ratio sunder_i_ratio_reduced(sunder_i_arena *arena, sunder_i_ratio a);
int sunder_i_ratio_cmp(sunder_i_arena *arena, sunder_i_ratio a, sunder_i_ratio b);

#endif
