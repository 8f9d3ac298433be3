/* Exact sums of products of doubles, in fixed memory: nothing is allocated, so nothing can fail.
 *
 * A product of two finite doubles is an integer of at most 106 bits times a power of two from 2^-2148 (the square of
 * the least subnormal) to 2^1942, so below 2^2048. A fixed-point number over that whole range holds any sum of up to
 * 2^76 of them: the long accumulator of [Kul13, section 8]. Adding is three words and a carry. */
#ifndef SUNDER_I_ACCUMULATOR_H
#define SUNDER_I_ACCUMULATOR_H

#include <stdint.h>

#define SUNDER_I_ACCUMULATOR_UNIT (-2148) /* the lowest bit stands for 2^-2148 */
#define SUNDER_I_ACCUMULATOR_LIMBS 67     /* 4288 bits: 4196 for one product, its sign, and room for sums */

/* Two's complement, lowest limb first. Zeroed: zero. */
typedef struct sunder_i_accumulator {
    uint64_t limb[SUNDER_I_ACCUMULATOR_LIMBS];
} sunder_i_accumulator;

/* Adds a b, or takes it away; both finite. */
void sunder_i_accumulator_add(sunder_i_accumulator *sum, double a, double b);
void sunder_i_accumulator_sub(sunder_i_accumulator *sum, double a, double b);
int sunder_i_accumulator_sign(const sunder_i_accumulator *sum);
/* total * 2^exponent to the nearest double, ties to even; infinite past the range. */
double sunder_i_accumulator_double(const sunder_i_accumulator *sum, int exponent);

#endif
