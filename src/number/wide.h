/* wide.h: fixed-width integers on the stack: 128 bits from the compiler, 256 and 384 implemented here.
 *
 * These are sufficient for a predicate of known degree on a narrow lattice, without allocation. Every function states
 * its widest operands; none overflows within these limits. */
#ifndef SUNDER_I_WIDE_H
#define SUNDER_I_WIDE_H

#include <stdbool.h>
#include <stdint.h>

__extension__ typedef __int128 sunder_i_i128;
__extension__ typedef unsigned __int128 sunder_i_u128;

/* Sign and magnitude, limbs from low to high. sign is -1, 0 or +1, and 0 exactly if the magnitude is zero. */
typedef struct sunder_i_i256 {
    uint64_t limb[4];
    int sign;
} sunder_i_i256;

static inline int sunder_i_i128_sign(sunder_i_i128 v) { return (v > 0) - (v < 0); }

/* Returns true if the number fits in 64 bits. */
static inline bool sunder_i_i128_is_short(sunder_i_i128 a) { return (int64_t)(a >> 64) == (int64_t)a >> 63; }

/* Returns the nearest double. */
static inline double sunder_i_i128_double(sunder_i_i128 v)
{
    return sunder_i_i128_is_short(v) ? (double)(int64_t)v : (double)v;
}

/* Returns the magnitude without a branch, since the sign cannot be predicted. */
static inline sunder_i_u128 sunder_i_i128_abs(sunder_i_i128 v)
{
    const uint64_t high = (uint64_t)(v >> 64), below = -(high >> 63);
    const sunder_i_u128 all = (sunder_i_u128)below << 64 | below;
    return ((sunder_i_u128)v ^ all) - all;
}

/* r becomes the product of two 128-bit magnitudes, with 256 bits. */
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

/* Returns the number of trailing zero bits of v, which must not be zero. */
static inline unsigned sunder_i_u128_twos(sunder_i_u128 v)
{
    const uint64_t low = (uint64_t)v;
    return low ? (unsigned)__builtin_ctzll(low) : 64 + (unsigned)__builtin_ctzll((uint64_t)(v >> 64));
}

/* Return the greatest common divisor: of two odd numbers, and of any two that are not zero. */
sunder_i_u128 sunder_i_u128_odd_gcd(sunder_i_u128 a, sunder_i_u128 b);
sunder_i_u128 sunder_i_u128_gcd(sunder_i_u128 a, sunder_i_u128 b);

static inline int sunder_i_limbs_cmp(const uint64_t *a, const uint64_t *b, int n)
{
    for (int i = n - 1; i >= 0; i--)
        if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
}

/* Returns the sign of a * b - c * d, for any 128-bit operands (magnitudes below 2^127). */
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
 * Let p / v and q / w, v, w > 0, be two fractions for which doubles have shown that |p / v - q / w| <= apart: then |p w
 * - q v| <= apart v w, and if that is below 2^63, or 2^127, the lowest bits of the two products, however long these
 * are, determine their difference exactly. */

/* Returns true if apart * v * w is certainly below 2^62; v and w have at most 64 bits. */
static inline bool sunder_i_is_low_64(double apart, int64_t v, int64_t w)
{
    return apart * (double)v * (double)w < 0x1p62;
}

/* Returns true if apart * v * w is certainly below 2^126. */
static inline bool sunder_i_is_low_128(double apart, sunder_i_i128 v, sunder_i_i128 w)
{
    return apart * ((double)(int64_t)(v >> 64) + 1) * ((double)(int64_t)(w >> 64) + 1) < 0.25;
}

/* Return the sign of p w - q v from the lowest bits of each. */
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

/* Returns a * b + c * d; magnitudes: a, c below 2^64, b, d below 2^127; the result has at most 192 bits. */
sunder_i_i256 sunder_i_mul_add_long(int64_t a, sunder_i_i128 b, int64_t c, sunder_i_i128 d);

/* Returns a * b + c * d, a and c below 2^63. */
static inline sunder_i_i256 sunder_i_mul_add(int64_t a, sunder_i_i128 b, int64_t c, sunder_i_i128 d)
{
    if (sunder_i_i128_is_short(b) && sunder_i_i128_is_short(d))
        return sunder_i_i256_of((sunder_i_i128)a * (int64_t)b + (sunder_i_i128)c * (int64_t)d);
    return sunder_i_mul_add_long(a, b, c, d);
}

/* Returns the sign of a * b - c * d with a, c below 2^256 and b, d below 2^127. */
int sunder_i_cmp_products_256(const sunder_i_i256 *a, sunder_i_i128 b, const sunder_i_i256 *c, sunder_i_i128 d);

int sunder_i_i256_cmp(const sunder_i_i256 *a, const sunder_i_i256 *b);

/* Returns a double near the value: the relative error is below 2^-51. */
double sunder_i_i256_double_long(const sunder_i_i256 *a);

static inline double sunder_i_i256_double(const sunder_i_i256 *a)
{
    if (a->limb[2] | a->limb[3]) return sunder_i_i256_double_long(a);
    /* The second limb is rounded only if the first is far below it: the whole is rounded twice at most. */
    const double v = (double)a->limb[1] * 0x1p64 + (double)a->limb[0];
    return a->sign < 0 ? -v : v;
}

#endif
