/* Integers of any size: sign and magnitude on arena memory, GMP's mpn_ layer beneath.
 *
 * Values are immutable and passed by value; results live in the arena given, so nothing is freed one by one, and a
 * failed allocation sets arena->failed and yields zero instead of ending the process (as mpz_ would, and mpn_ on large
 * operands: those never get there, see big_limbs.h).
 * Canonical form: `size` is 0 for zero; otherwise |size| limbs, the top one not zero, and the sign of size is the
 * value's. */
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
/* The odd-or-not integer m and exponent e with v = m * 2^e, m odd or zero (then e = 0). v finite. */
sunder_i_big sunder_i_big_double(sunder_i_arena *arena, double v, int *exponent);
/* A copy in another arena. */
sunder_i_big sunder_i_big_copy(sunder_i_arena *arena, sunder_i_big a);
/* The same of three that go together, in one piece of memory. */
void sunder_i_big_copy_3(sunder_i_arena *arena, sunder_i_big *a, sunder_i_big *b, sunder_i_big *c);

sunder_i_big sunder_i_big_neg(sunder_i_big a);
sunder_i_big sunder_i_big_add(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b);
sunder_i_big sunder_i_big_sub(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b);
sunder_i_big sunder_i_big_mul(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b);
/* a * 2^shift, shift >= 0. */
sunder_i_big sunder_i_big_shl(sunder_i_arena *arena, sunder_i_big a, unsigned long shift);
/* floor(a / 2^shift), towards minus infinity. */
sunder_i_big sunder_i_big_shr(sunder_i_arena *arena, sunder_i_big a, unsigned long shift);
/* floor(a / b), b > 0. */
sunder_i_big sunder_i_big_div_floor(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b);
/* The same and the remainder, a >= 0. */
sunder_i_big sunder_i_big_divide(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, sunder_i_big *remainder);
/* floor(sqrt(a)), a >= 0. */
sunder_i_big sunder_i_big_sqrt_floor(sunder_i_arena *arena, sunder_i_big a);
/* x^2 + y^2. */
sunder_i_big sunder_i_big_norm(sunder_i_arena *arena, sunder_i_big x, sunder_i_big y);
/* Greatest common divisor, >= 0. */
sunder_i_big sunder_i_big_gcd(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b);

int sunder_i_big_sign(sunder_i_big a);
int sunder_i_big_cmp(sunder_i_big a, sunder_i_big b);
static inline bool sunder_i_big_is_one(sunder_i_big a) { return a.size == 1 && a.limb[0] == 1; }
/* Number of bits of |a|; 0 for zero. */
unsigned long sunder_i_big_bits(sunder_i_big a);
/* Number of trailing zero bits; a != 0. */
unsigned long sunder_i_big_twos(sunder_i_big a);
/* Does |a| fit, and as what? */
bool sunder_i_big_fits_i64(sunder_i_big a, int64_t *v);

/* (num / den) * 2^exponent to the nearest double, ties to even; den > 0. Infinite past the range. */
double sunder_i_big_ratio(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent);
/* The greatest double <= (num / den) * 2^exponent, and the least one >= it. */
double sunder_i_big_ratio_down(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent);
double sunder_i_big_ratio_up(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent);

/* (num / den) * 2^exponent as text in lowest terms: "num", or "num/den" where den != 1. den > 0. Memory from
 * sunder_i_alloc(), NULL if memory is out. */
char *sunder_i_big_ratio_text(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent);

/* The integer that n characters say in decimal; false if they are none. */
bool sunder_i_big_parse(sunder_i_arena *arena, const char *text, size_t n, sunder_i_big *out);

#endif
