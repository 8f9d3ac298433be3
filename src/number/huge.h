/* Integers longer than GMP can work on with stack memory alone.
 *
 * GMP takes scratch memory for large operands from its own allocator, which ends the process when memory is out, and
 * which only the process may replace, not a library. Below some thousand limbs it stays on the stack: a single piece of
 * up to 32,512 bytes (TMP_ALLOC in its gmp-impl.h). So mpn_ functions are given operands of at most SUNDER_I_GMP_LIMBS
 * limbs, for which none of them needs 4,000 limbs of scratch at once: products of that length are far below the Fourier
 * transform, the quotient and gcd below what needs inverses. Longer results are put together here from such pieces, on
 * arena memory. (mpn_get_str takes its table of powers from the heap even for short numbers: it is not used.)
 *
 * Karatsuba for products, Burnikel and Ziegler for quotients, Lehmer for the gcd: the asymptotics of GMP's faster
 * algorithms are given up. Numbers of this size are corners of repaired scribbles, and products of coordinates that
 * span the range of doubles. */
#ifndef SUNDER_I_HUGE_H
#define SUNDER_I_HUGE_H

#include "number/big.h"

#define SUNDER_I_GMP_LIMBS 1024

/* Magnitudes: a, b >= 0 below, and b > 0 to divide by. As everywhere zero where memory is out, and arena->failed. */
sunder_i_big sunder_i_huge_mul(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b);
sunder_i_big sunder_i_huge_divide(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, sunder_i_big *remainder);
/* Both odd. */
sunder_i_big sunder_i_huge_gcd(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b);
/* floor(sqrt(a)), a > 0. */
sunder_i_big sunder_i_huge_sqrt(sunder_i_arena *arena, sunder_i_big a);
/* The decimal digits of a > 0 at text, which has room for them and for 20 more; returns how many, 0 where memory is
 * out. Of numbers of any size. */
size_t sunder_i_huge_digits(sunder_i_arena *arena, sunder_i_big a, char *text);

#endif
