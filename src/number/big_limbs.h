/* What the files of the big integers share: limbs of a value, memory for them, and the longest operands that GMP is
 * given. Internal to big*.c.
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
#ifndef SUNDER_I_BIG_LIMBS_H
#define SUNDER_I_BIG_LIMBS_H

#include "number/big.h"

#include <stdlib.h>

#define SUNDER_I_GMP_LIMBS 1024
#define SUNDER_I_BIG_ZERO ((sunder_i_big){NULL, 0})

/* The number of limbs of |a|. */
static inline mp_size_t sunder_i_limbs(sunder_i_big a) { return (mp_size_t)labs(a.size); }

/* Room for n limbs; NULL if memory is out. */
static inline mp_limb_t *sunder_i_limbs_alloc(sunder_i_arena *arena, mp_size_t n)
{
    return sunder_i_arena_alloc(arena, (size_t)n, sizeof(mp_limb_t));
}

/* The canonical value of n limbs with a sign; it borrows them. */
static inline sunder_i_big sunder_i_limbs_value(const mp_limb_t *limb, mp_size_t n, int sign)
{
    while (n > 0 && limb[n - 1] == 0) n--;
    return (sunder_i_big){limb, sign < 0 ? -n : n};
}

/* Limbs [from, to) of a magnitude, as a number; it borrows them. */
static inline sunder_i_big sunder_i_limbs_slice(sunder_i_big a, mp_size_t from, mp_size_t to)
{
    if (to > a.size) to = a.size;
    return to > from ? sunder_i_limbs_value(a.limb + from, to - from, 1) : SUNDER_I_BIG_ZERO;
}

/* Order of |a| and |b|. */
static inline int sunder_i_limbs_order(sunder_i_big a, sunder_i_big b)
{
    const mp_size_t m = sunder_i_limbs(a), n = sunder_i_limbs(b);
    if (m != n) return m < n ? -1 : 1;
    return m == 0 ? 0 : mpn_cmp(a.limb, b.limb, m);
}

static inline sunder_i_big sunder_i_big_one(void)
{
    static const mp_limb_t limb = 1;
    return (sunder_i_big){&limb, 1};
}

/* |a| / 2^shift without its fraction; *lost tells whether the fraction was not zero. */
sunder_i_big sunder_i_big_shift_down(sunder_i_arena *arena, sunder_i_big a, unsigned long shift, bool *lost);

#endif
