/* big_limbs.h: limbs of a value, memory for them, and the longest operands of GMP functions, shared by big*.c only.
 *
 * GMP takes scratch memory for large operands from its own allocator, which ends the process if out of memory, and
 * which only the process may replace, not a library. Below some thousand limbs it uses the stack: a single block of up
 * to 32,512 bytes (TMP_ALLOC in its gmp-impl.h). Therefore mpn_ functions are only called with operands of at most
 * SUNDER_I_GMP_LIMBS limbs, for which none of them needs 4,000 limbs of scratch memory at once: products of that length
 * are far below the Fourier transform, the quotient and gcd below the algorithms that need inverses. Longer results are
 * computed here from such parts, in arena memory. (mpn_get_str allocates its table of powers on the heap even for short
 * numbers: it is not used.)
 *
 * Products are computed with Karatsuba's algorithm, quotients with that of Burnikel and Ziegler, the gcd with Lehmer's:
 * the faster algorithms of GMP are not available. Numbers of this size are vertices of repaired scribbles, and products
 * of coordinates that span the range of doubles. */
#ifndef SUNDER_I_BIG_LIMBS_H
#define SUNDER_I_BIG_LIMBS_H

#include "number/big.h"

#include <stdlib.h>

#define SUNDER_I_GMP_LIMBS 1024
#define SUNDER_I_BIG_ZERO ((sunder_i_big){NULL, 0})

/* Returns the number of limbs of |a|. */
static inline mp_size_t sunder_i_limbs(sunder_i_big a) { return (mp_size_t)labs(a.size); }

/* Allocates n limbs; NULL if out of memory. */
static inline mp_limb_t *sunder_i_limbs_alloc(sunder_i_arena *arena, mp_size_t n)
{
    return sunder_i_arena_alloc(arena, (size_t)n, sizeof(mp_limb_t));
}

/* Returns the value of n limbs with a sign, in canonical form; it borrows the limbs. */
static inline sunder_i_big sunder_i_limbs_value(const mp_limb_t *limb, mp_size_t n, int sign)
{
    while (n > 0 && limb[n - 1] == 0) n--;
    return (sunder_i_big){limb, sign < 0 ? -n : n};
}

/* Returns the limbs [from, to) of a magnitude, as a number; it borrows the limbs. */
static inline sunder_i_big sunder_i_limbs_slice(sunder_i_big a, mp_size_t from, mp_size_t to)
{
    if (to > a.size) to = a.size;
    return to > from ? sunder_i_limbs_value(a.limb + from, to - from, 1) : SUNDER_I_BIG_ZERO;
}

/* Compares |a| and |b|. */
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

/* Returns |a| / 2^shift without its fraction; *lost becomes true if the fraction is not zero. */
sunder_i_big sunder_i_big_shift_down(sunder_i_arena *arena, sunder_i_big a, unsigned long shift, bool *lost);

#endif
