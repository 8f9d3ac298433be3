/* Fixed-width integers on the stack: 128 bits from the compiler, 256 and 384 of our own.
 *
 * The middle rung of the ladder: what a predicate of known degree needs on a narrow lattice, with no allocation. Every
 * function states the widest operands it may be given; none overflows within them. */
#ifndef SUNDER_I_WIDE_H
#define SUNDER_I_WIDE_H

#include <stdbool.h>
#include <stdint.h>

__extension__ typedef __int128 sunder_i_i128;
__extension__ typedef unsigned __int128 sunder_i_u128;

/* Sign and magnitude, little-endian limbs. sign is -1, 0 or +1, and 0 exactly when the magnitude is zero. */
typedef struct sunder_i_i256 {
    uint64_t limb[4];
    int sign;
} sunder_i_i256;

static inline int sunder_i_i128_sign(sunder_i_i128 v) { return (v > 0) - (v < 0); }

static inline sunder_i_u128 sunder_i_i128_abs(sunder_i_i128 v) { return v < 0 ? -(sunder_i_u128)v : (sunder_i_u128)v; }

/* a * b of 128-bit magnitudes, 256 bits. */
static inline void sunder_i_u128_mul(sunder_i_u128 a, sunder_i_u128 b, uint64_t r[4])
{
    const uint64_t a0 = (uint64_t)a, a1 = (uint64_t)(a >> 64), b0 = (uint64_t)b, b1 = (uint64_t)(b >> 64);
    const sunder_i_u128 p00 = (sunder_i_u128)a0 * b0, p01 = (sunder_i_u128)a0 * b1;
    const sunder_i_u128 p10 = (sunder_i_u128)a1 * b0, p11 = (sunder_i_u128)a1 * b1;
    const sunder_i_u128 mid = (p00 >> 64) + (uint64_t)p01 + (uint64_t)p10;
    const sunder_i_u128 high = p11 + (p01 >> 64) + (p10 >> 64) + (mid >> 64);
    r[0] = (uint64_t)p00;
    r[1] = (uint64_t)mid;
    r[2] = (uint64_t)high;
    r[3] = (uint64_t)(high >> 64);
}

static inline int sunder_i_limbs_cmp(const uint64_t *a, const uint64_t *b, int n)
{
    for (int i = n - 1; i >= 0; i--)
        if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
}

/* Sign of a * b - c * d, any 128-bit operands (magnitudes below 2^127). */
static inline int sunder_i_cmp_products(sunder_i_i128 a, sunder_i_i128 b, sunder_i_i128 c, sunder_i_i128 d)
{
    const int s = sunder_i_i128_sign(a) * sunder_i_i128_sign(b), t = sunder_i_i128_sign(c) * sunder_i_i128_sign(d);
    if (s != t) return s < t ? -1 : 1;
    if (s == 0) return 0;
    uint64_t l[4], r[4];
    sunder_i_u128_mul(sunder_i_i128_abs(a), sunder_i_i128_abs(b), l);
    sunder_i_u128_mul(sunder_i_i128_abs(c), sunder_i_i128_abs(d), r);
    return s * sunder_i_limbs_cmp(l, r, 4);
}

/* a * b + c * d, magnitudes: a, c below 2^64, b, d below 2^127; the result has at most 192 bits. */
sunder_i_i256 sunder_i_mul_add(int64_t a, sunder_i_i128 b, int64_t c, sunder_i_i128 d);

/* Sign of a * b - c * d with a, c below 2^256 and b, d below 2^127. */
int sunder_i_cmp_products_256(const sunder_i_i256 *a, sunder_i_i128 b, const sunder_i_i256 *c, sunder_i_i128 d);

int sunder_i_i256_cmp(const sunder_i_i256 *a, const sunder_i_i256 *b);

/* Nearly the nearest double: relative error below 2^-52. */
double sunder_i_i256_double(const sunder_i_i256 *a);

#endif
