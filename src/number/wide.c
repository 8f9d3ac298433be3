/* wide.c: sums of two products of 64 by 128 bits, the order of products of 128 by 128 and of 256 by 128 bits, and
 * greatest common divisors. */
#include "number/wide.h"

#include <math.h>
#include <string.h>

typedef struct magnitude {
    uint64_t limb[4];
    int sign;
} magnitude;

static magnitude product_of(int64_t a, sunder_i_i128 b)
{
    magnitude m;
    const int sign = (a > 0) - (a < 0);
    m.sign = sign * sunder_i_i128_sign(b);
    const uint64_t bits = (uint64_t)a;
    sunder_i_u128_mul(a < 0 ? 0 - bits : bits, sunder_i_i128_abs(b), m.limb);
    return m;
}

sunder_i_i256 sunder_i_mul_add_long(int64_t a, sunder_i_i128 b, int64_t c, sunder_i_i128 d)
{
    magnitude s = product_of(a, b), t = product_of(c, d);
    sunder_i_i256 r;
    if (s.sign == 0) s = t, t.sign = 0;
    if (t.sign == 0) {
        memcpy(r.limb, s.limb, sizeof r.limb);
        r.sign = s.sign;
        return r;
    }
    if (s.sign == t.sign) {
        sunder_i_u128 carry = 0;
        for (int i = 0; i < 4; i++) {
            carry += (sunder_i_u128)s.limb[i] + t.limb[i];
            r.limb[i] = (uint64_t)carry;
            carry >>= 64;
        }
        r.sign = s.sign;
        return r;
    }
    const int order = sunder_i_limbs_cmp(s.limb, t.limb, 4);
    r.sign = order * s.sign;
    if (order < 0) {
        const magnitude swap = s;
        s = t;
        t = swap;
    }
    uint64_t borrow = 0;
    for (int i = 0; i < 4; i++) {
        const sunder_i_u128 take = (sunder_i_u128)t.limb[i] + borrow;
        r.limb[i] = s.limb[i] - (uint64_t)take;
        borrow = s.limb[i] < take;
    }
    return r;
}

/* Multiplies 256 by 128 bits to 384 bits. */
static void mul_256_128(const uint64_t a[4], sunder_i_u128 b, uint64_t r[6])
{
    const uint64_t b0 = (uint64_t)b, b1 = (uint64_t)(b >> 64);
    uint64_t carry = 0;
    for (int i = 0; i < 4; i++) {
        const sunder_i_u128 t = (sunder_i_u128)a[i] * b0 + carry;
        r[i] = (uint64_t)t;
        carry = (uint64_t)(t >> 64);
    }
    r[4] = carry;
    carry = 0;
    for (int i = 0; i < 4; i++) {
        const sunder_i_u128 t = (sunder_i_u128)a[i] * b1 + r[i + 1] + carry;
        r[i + 1] = (uint64_t)t;
        carry = (uint64_t)(t >> 64);
    }
    r[5] = carry;
}

int sunder_i_cmp_products_256(const sunder_i_i256 *a, sunder_i_i128 b, const sunder_i_i256 *c, sunder_i_i128 d)
{
    const int s = a->sign * sunder_i_i128_sign(b), t = c->sign * sunder_i_i128_sign(d);
    if (s != t) return s < t ? -1 : 1;
    if (s == 0) return 0;
    uint64_t l[6], r[6];
    mul_256_128(a->limb, sunder_i_i128_abs(b), l);
    mul_256_128(c->limb, sunder_i_i128_abs(d), r);
    return s * sunder_i_limbs_cmp(l, r, 6);
}

int sunder_i_i256_cmp(const sunder_i_i256 *a, const sunder_i_i256 *b)
{
    if (a->sign != b->sign) return a->sign < b->sign ? -1 : 1;
    return a->sign * sunder_i_limbs_cmp(a->limb, b->limb, 4);
}

double sunder_i_i256_double_long(const sunder_i_i256 *a)
{
    int top = 3;
    while (top > 0 && a->limb[top] == 0) top--;
    double v = (double)a->limb[top];
    if (top > 0) {
        /* Two limbs have at least 65 significant bits, so that the omitted ones are far below the rounding. */
        const sunder_i_u128 two = (sunder_i_u128)a->limb[top] << 64 | a->limb[top - 1];
        v = ldexp((double)two, 64 * (top - 1));
    }
    return a->sign < 0 ? -v : v;
}

/* The binary algorithm: the difference of two odd numbers is even, and its odd part has the same common divisors with
 * the lesser number. */
/* Returns the gcd of two odd numbers. The loop avoids branches, since which number is greater cannot be predicted. */
static uint64_t odd_gcd_64(uint64_t a, uint64_t b)
{
    while (a != b) {
        const uint64_t less = a < b ? a : b, off = a < b ? b - a : a - b;
        a = off >> __builtin_ctzll(off);
        b = less;
    }
    return a;
}

sunder_i_u128 sunder_i_u128_odd_gcd(sunder_i_u128 a, sunder_i_u128 b)
{
    while (a >> 64 && b >> 64 && a != b) {
        if (a > b) {
            a -= b;
            a >>= sunder_i_u128_twos(a);
        } else {
            b -= a;
            b >>= sunder_i_u128_twos(b);
        }
    }
    if (a == b) return a;
    /* One number has at most 64 bits: the other, if greater, is replaced by its remainder. */
    const uint64_t c = (uint64_t)(a < b ? a : b);
    const sunder_i_u128 other = a < b ? b : a;
    const uint64_t rest = other >> 64 ? (uint64_t)(other % c) : (uint64_t)other % c;
    return rest ? odd_gcd_64(c, rest >> __builtin_ctzll(rest)) : c;
}

sunder_i_u128 sunder_i_u128_gcd(sunder_i_u128 a, sunder_i_u128 b)
{
    const unsigned i = sunder_i_u128_twos(a), j = sunder_i_u128_twos(b);
    return sunder_i_u128_odd_gcd(a >> i, b >> j) << (i < j ? i : j);
}
