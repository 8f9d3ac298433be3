/* Exact sums of products of doubles, in fixed memory: nothing is allocated, so nothing can fail.
 *
 * A product of two finite doubles is an integer of at most 106 bits times a power of two from 2^-2148 (the square of
 * the least subnormal) to 2^1942, so below 2^2048. A fixed-point number over that whole range holds any sum of up to
 * 2^76 of them: the long accumulator of [Kul13, section 8]. Adding is three words and a carry.
 *
 * Why not expansions? The usual way to an exact sign of such a sum is an expansion [She96]: a sum of doubles that do
 * not overlap, which grows by one component with each addend. Its sign is that of the largest component, and an
 * adaptive predicate computes only as many components as the sign needs. The accumulator was chosen for four reasons.
 *
 *  - Range. The rounding error of a product is a double only if nothing underflows or overflows, so expansions are
 *    exact for coordinates between about 1e-145 and 1e153. Coordinates here may be any finite doubles, and expansions
 *    would need a second method behind them for the rest.
 *  - Order. Integers are added in any order with the same result. The totals of a layer (total.c) are added by threads
 *    and by shards, and have the same bits for every number of these.
 *  - Memory. Its size is a constant, 536 bytes, whatever the number of addends: the area of a ring with a million
 *    vertices needs no more than the side of one point.
 *  - Proof. Its correctness is that of integer addition. It depends neither on the rounding mode nor on contraction by
 *    the compiler; each operation of an expansion depends on both.
 *
 * The price is a constant cost. The side of a point to a line, six products, takes 1,060 instructions (callgrind, gcc
 * 12, -O3): a hundred for each product, and a third of all for the sign, if it is zero and every limb is tested. An
 * adaptive predicate is cheaper on inputs that are nearly degenerate. But a filter in doubles, with the first bound of
 * [She96], comes before each sign (orient_double.c, passage.c), so the accumulator decides only what is degenerate or
 * nearly so. The inner loops use integers of the lattice (lattice.h, wide.h): these need a common scale, which a single
 * question about three doubles does not have.
 *
 * Rationals of GMP were no rival: they allocate, and an allocation may fail in the middle of a predicate. */
#ifndef SUNDER_I_ACCUMULATOR_H
#define SUNDER_I_ACCUMULATOR_H

#include <stdint.h>

#define SUNDER_I_ACCUMULATOR_UNIT (-2148) /* the value of the lowest bit is 2^-2148 */
#define SUNDER_I_ACCUMULATOR_LIMBS 67     /* 4288 bits: 4196 for one product, its sign, and room for sums */

/* Two's complement, lowest limb first. If all limbs are 0, the value is 0. */
typedef struct sunder_i_accumulator {
    uint64_t limb[SUNDER_I_ACCUMULATOR_LIMBS];
} sunder_i_accumulator;

/* Add a b, or subtract it; both must be finite. */
void sunder_i_accumulator_add(sunder_i_accumulator *sum, double a, double b);
void sunder_i_accumulator_sub(sunder_i_accumulator *sum, double a, double b);
int sunder_i_accumulator_sign(const sunder_i_accumulator *sum);
/* Returns sum * 2^exponent, rounded to the nearest double, ties to even; infinite if it is out of range. */
double sunder_i_accumulator_double(const sunder_i_accumulator *sum, int exponent);

#endif
