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

/* Does it fit in 64 bits? */
static inline bool sunder_i_i128_is_short(sunder_i_i128 a) { return (int64_t)(a >> 64) == (int64_t)a >> 63; }

/* To the nearest double. */
static inline double sunder_i_i128_double(sunder_i_i128 v)
{
    return sunder_i_i128_is_short(v) ? (double)(int64_t)v : (double)v;
}

/* Without a branch, since the sign cannot be predicted. */
static inline sunder_i_u128 sunder_i_i128_abs(sunder_i_i128 v)
{
    const uint64_t high = (uint64_t)(v >> 64), below = -(high >> 63);
    const sunder_i_u128 all = (sunder_i_u128)below << 64 | below;
    return ((sunder_i_u128)v ^ all) - all;
}

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

/* How many zero bits it ends in; not of zero. */
static inline unsigned sunder_i_u128_twos(sunder_i_u128 v)
{
    const uint64_t low = (uint64_t)v;
    return low ? (unsigned)__builtin_ctzll(low) : 64 + (unsigned)__builtin_ctzll((uint64_t)(v >> 64));
}

/* The greatest common divisor: of odd numbers, and of any two that are not zero. */
sunder_i_u128 sunder_i_u128_odd_gcd(sunder_i_u128 a, sunder_i_u128 b);
sunder_i_u128 sunder_i_u128_gcd(sunder_i_u128 a, sunder_i_u128 b);

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

/* ---- Differences that are known to be small ----
 *
 * Two fractions p / v and q / w, v, w > 0, of which it is known (from doubles) that |p / v - q / w| <= apart: then
 * |p w - q v| <= apart v w, and where that is below 2^63, or 2^127, the lowest bits of the two products, however long
 * these are, tell their difference exactly. */

/* Is apart * v * w below 2^62, for certain? v and w short. */
static inline bool sunder_i_is_low_64(double apart, int64_t v, int64_t w)
{
    return apart * (double)v * (double)w < 0x1p62;
}

/* Is apart * v * w below 2^126, for certain? */
static inline bool sunder_i_is_low_128(double apart, sunder_i_i128 v, sunder_i_i128 w)
{
    return apart * ((double)(int64_t)(v >> 64) + 1) * ((double)(int64_t)(w >> 64) + 1) < 0.25;
}

/* The sign of p w - q v by the lowest bits of each. */
static inline int sunder_i_sign_low_64(uint64_t p, uint64_t v, uint64_t q, uint64_t w)
{
    const int64_t d = (int64_t)(p * w - q * v);
    return (d > 0) - (d < 0);
}

static inline int sunder_i_sign_low_128(sunder_i_u128 p, sunder_i_u128 v, sunder_i_u128 q, sunder_i_u128 w)
{
    return sunder_i_i128_sign((sunder_i_i128)(p * w - q * v));
}

static inline sunder_i_i256 sunder_i_i256_of(sunder_i_i128 v)
{
    const sunder_i_u128 m = sunder_i_i128_abs(v);
    return (sunder_i_i256){{(uint64_t)m, (uint64_t)(m >> 64), 0, 0}, sunder_i_i128_sign(v)};
}

/* a * b + c * d, magnitudes: a, c below 2^64, b, d below 2^127; the result has at most 192 bits. */
sunder_i_i256 sunder_i_mul_add_long(int64_t a, sunder_i_i128 b, int64_t c, sunder_i_i128 d);

/* The same, a and c below 2^63. */
static inline sunder_i_i256 sunder_i_mul_add(int64_t a, sunder_i_i128 b, int64_t c, sunder_i_i128 d)
{
    if (sunder_i_i128_is_short(b) && sunder_i_i128_is_short(d))
        return sunder_i_i256_of((sunder_i_i128)a * (int64_t)b + (sunder_i_i128)c * (int64_t)d);
    return sunder_i_mul_add_long(a, b, c, d);
}

/* Sign of a * b - c * d with a, c below 2^256 and b, d below 2^127. */
int sunder_i_cmp_products_256(const sunder_i_i256 *a, sunder_i_i128 b, const sunder_i_i256 *c, sunder_i_i128 d);

int sunder_i_i256_cmp(const sunder_i_i256 *a, const sunder_i_i256 *b);

/* Nearly the nearest double: relative error below 2^-51. */
double sunder_i_i256_double_long(const sunder_i_i256 *a);

static inline double sunder_i_i256_double(const sunder_i_i256 *a)
{
    if (a->limb[2] | a->limb[3]) return sunder_i_i256_double_long(a);
    /* The second limb rounds only where the first is far below it: two roundings of the whole in all. */
    const double v = (double)a->limb[1] * 0x1p64 + (double)a->limb[0];
    return a->sign < 0 ? -v : v;
}

#endif
