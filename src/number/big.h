/* big.h: integers of any size: sign and magnitude in arena memory, on top of GMP's mpn_ functions.
 *
 * Values are immutable and passed by value; results are allocated in the given arena, so that no number is freed
 * separately, and a failed allocation sets arena->failed and gives zero instead of ending the process (as mpz_ would,
 * and mpn_ for large operands: those are never passed to it, see big_limbs.h). Canonical form: `size` is 0 for zero;
 * otherwise there are |size| limbs, the top one not zero, and the sign of size is that of the value. */
#ifndef SUNDER_I_BIG_H
#define SUNDER_I_BIG_H

#include "base/memory.h"
#include "number/wide.h"

#include <gmp.h>

typedef struct sunder_i_big {
    const mp_limb_t *limb;
    long size;
} sunder_i_big;

sunder_i_big sunder_i_big_i64(sunder_i_arena *arena, int64_t v);
sunder_i_big sunder_i_big_i128(sunder_i_arena *arena, sunder_i_i128 v);
sunder_i_big sunder_i_big_i256(sunder_i_arena *arena, sunder_i_i256 v);
/* Returns the integer m, and the exponent in *exponent, with v = m * 2^*exponent, m odd or zero (then *exponent = 0). v
 * must be finite. */
sunder_i_big sunder_i_big_double(sunder_i_arena *arena, double v, int *exponent);
/* Returns a copy in another arena. */
sunder_i_big sunder_i_big_copy(sunder_i_arena *arena, sunder_i_big a);
/* Copies three numbers to one block of memory in the arena. */
void sunder_i_big_copy_3(sunder_i_arena *arena, sunder_i_big *a, sunder_i_big *b, sunder_i_big *c);

sunder_i_big sunder_i_big_neg(sunder_i_big a);
sunder_i_big sunder_i_big_add(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b);
sunder_i_big sunder_i_big_sub(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b);
sunder_i_big sunder_i_big_mul(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b);
/* Returns a * 2^shift, shift >= 0. */
sunder_i_big sunder_i_big_shl(sunder_i_arena *arena, sunder_i_big a, unsigned long shift);
/* Returns floor(a / 2^shift), rounded towards minus infinity. */
sunder_i_big sunder_i_big_shr(sunder_i_arena *arena, sunder_i_big a, unsigned long shift);
/* Returns floor(a / b), b > 0. */
sunder_i_big sunder_i_big_div_floor(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b);
/* Returns floor(a / b) and *remainder, a >= 0. */
sunder_i_big sunder_i_big_divide(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, sunder_i_big *remainder);
/* Returns floor(sqrt(a)), a >= 0. */
sunder_i_big sunder_i_big_sqrt_floor(sunder_i_arena *arena, sunder_i_big a);
/* Returns x^2 + y^2. */
sunder_i_big sunder_i_big_norm(sunder_i_arena *arena, sunder_i_big x, sunder_i_big y);
/* Returns the greatest common divisor, >= 0. */
sunder_i_big sunder_i_big_gcd(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b);

int sunder_i_big_sign(sunder_i_big a);
int sunder_i_big_cmp(sunder_i_big a, sunder_i_big b);
static inline bool sunder_i_big_is_one(sunder_i_big a) { return a.size == 1 && a.limb[0] == 1; }
/* Returns the number of bits of |a|; 0 for zero. */
unsigned long sunder_i_big_bits(sunder_i_big a);
/* Returns the number of trailing zero bits; a != 0. */
unsigned long sunder_i_big_twos(sunder_i_big a);
/* Returns true if |a| fits in 63 bits; then *v becomes its value. */
bool sunder_i_big_fits_i64(sunder_i_big a, int64_t *v);

/* Returns (num / den) * 2^exponent, rounded to the nearest double, ties to even; den > 0. Infinite if it is out of
 * range. */
double sunder_i_big_ratio(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent);
/* Return the greatest double <= (num / den) * 2^exponent, and the least one >= it. */
double sunder_i_big_ratio_down(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent);
double sunder_i_big_ratio_up(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent);

/* Returns (num / den) * 2^exponent as text in lowest terms: "num", or "num/den" if den != 1. den > 0. The text is
 * allocated with sunder_i_alloc(); NULL if out of memory. */
char *sunder_i_big_ratio_text(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent);

/* *out becomes the decimal integer of n characters, with an optional sign. Returns false if they are not a decimal
 * integer. */
bool sunder_i_big_parse(sunder_i_arena *arena, const char *text, size_t n, sunder_i_big *out);

#endif
