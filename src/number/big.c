/* big.c: big integers in arenas: the mpn_ functions of GMP operate on limbs; signs and memory are added here. Sums,
 * order, shifts; products and quotients are in big_product.c, roots and the gcd in big_gcd.c. */
#include "number/big_limbs.h"

#include <math.h>

_Static_assert(GMP_LIMB_BITS == 64, "limbs of 64 bits");

static sunder_i_big from_limbs(sunder_i_arena *arena, const uint64_t *src, int n, int sign)
{
    mp_limb_t *p = sunder_i_limbs_alloc(arena, n);
    if (!p) return SUNDER_I_BIG_ZERO;
    for (int i = 0; i < n; i++) p[i] = src[i];
    return sunder_i_limbs_value(p, n, sign);
}

sunder_i_big sunder_i_big_i64(sunder_i_arena *arena, int64_t v)
{
    const uint64_t m = v < 0 ? -(uint64_t)v : (uint64_t)v;
    return from_limbs(arena, &m, 1, v < 0 ? -1 : 1);
}

sunder_i_big sunder_i_big_i128(sunder_i_arena *arena, sunder_i_i128 v)
{
    const sunder_i_u128 m = sunder_i_i128_abs(v);
    const uint64_t limb[2] = {(uint64_t)m, (uint64_t)(m >> 64)};
    return from_limbs(arena, limb, 2, v < 0 ? -1 : 1);
}

sunder_i_big sunder_i_big_i256(sunder_i_arena *arena, sunder_i_i256 v) { return from_limbs(arena, v.limb, 4, v.sign); }

sunder_i_big sunder_i_big_double(sunder_i_arena *arena, double v, int *exponent)
{
    *exponent = 0;
    if (v == 0) return SUNDER_I_BIG_ZERO;
    int e;
    int64_t m = (int64_t)ldexp(frexp(v, &e), 53);
    e -= 53;
    const int twos = __builtin_ctzll((unsigned long long)m);
    m /= (int64_t)1 << twos;
    *exponent = e + twos;
    return sunder_i_big_i64(arena, m);
}

sunder_i_big sunder_i_big_copy(sunder_i_arena *arena, sunder_i_big a)
{
    if (a.size == 0) return SUNDER_I_BIG_ZERO;
    mp_limb_t *p = sunder_i_limbs_alloc(arena, sunder_i_limbs(a));
    if (!p) return SUNDER_I_BIG_ZERO;
    mpn_copyi(p, a.limb, sunder_i_limbs(a));
    return (sunder_i_big){p, a.size};
}

void sunder_i_big_copy_3(sunder_i_arena *arena, sunder_i_big *a, sunder_i_big *b, sunder_i_big *c)
{
    sunder_i_big *const all[3] = {a, b, c};
    mp_limb_t *p = sunder_i_limbs_alloc(arena, sunder_i_limbs(*a) + sunder_i_limbs(*b) + sunder_i_limbs(*c));
    for (int i = 0; i < 3; i++) {
        const mp_size_t n = sunder_i_limbs(*all[i]);
        if (n == 0 || !p) {
            *all[i] = SUNDER_I_BIG_ZERO;
            continue;
        }
        for (mp_size_t k = 0; k < n; k++) p[k] = all[i]->limb[k];
        all[i]->limb = p;
        p += n;
    }
}

sunder_i_big sunder_i_big_neg(sunder_i_big a) { return (sunder_i_big){a.limb, -a.size}; }

int sunder_i_big_sign(sunder_i_big a) { return (a.size > 0) - (a.size < 0); }

int sunder_i_big_cmp(sunder_i_big a, sunder_i_big b)
{
    const int s = sunder_i_big_sign(a), t = sunder_i_big_sign(b);
    if (s != t) return s < t ? -1 : 1;
    const int c = sunder_i_limbs_order(a, b);
    return s * ((c > 0) - (c < 0));
}

sunder_i_big sunder_i_big_add(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    if (a.size == 0) return b;
    if (b.size == 0) return a;
    const int c = sunder_i_limbs_order(a, b);
    if (c < 0) {
        const sunder_i_big t = a;
        a = b;
        b = t;
    }
    const mp_size_t m = sunder_i_limbs(a), n = sunder_i_limbs(b);
    const bool same = (a.size > 0) == (b.size > 0);
    if (!same && c == 0) return SUNDER_I_BIG_ZERO;
    mp_limb_t *p = sunder_i_limbs_alloc(arena, m + 1);
    if (!p) return SUNDER_I_BIG_ZERO;
    if (same)
        p[m] = mpn_add(p, a.limb, m, b.limb, n);
    else {
        mpn_sub(p, a.limb, m, b.limb, n);
        p[m] = 0;
    }
    return sunder_i_limbs_value(p, m + 1, sunder_i_big_sign(a));
}

sunder_i_big sunder_i_big_sub(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    return sunder_i_big_add(arena, a, sunder_i_big_neg(b));
}

sunder_i_big sunder_i_big_shl(sunder_i_arena *arena, sunder_i_big a, unsigned long shift)
{
    if (a.size == 0 || shift == 0) return a;
    const mp_size_t n = sunder_i_limbs(a), skip = (mp_size_t)(shift / 64);
    const unsigned rest = (unsigned)(shift % 64);
    mp_limb_t *p = sunder_i_limbs_alloc(arena, n + skip + 1);
    if (!p) return SUNDER_I_BIG_ZERO;
    if (skip) mpn_zero(p, skip);
    if (rest)
        p[n + skip] = mpn_lshift(p + skip, a.limb, n, rest);
    else {
        mpn_copyi(p + skip, a.limb, n);
        p[n + skip] = 0;
    }
    return sunder_i_limbs_value(p, n + skip + 1, sunder_i_big_sign(a));
}

sunder_i_big sunder_i_big_shift_down(sunder_i_arena *arena, sunder_i_big a, unsigned long shift, bool *lost)
{
    const mp_size_t n = sunder_i_limbs(a), skip = (mp_size_t)(shift / 64);
    const unsigned rest = (unsigned)(shift % 64);
    *lost = false;
    if (a.size == 0) return SUNDER_I_BIG_ZERO;
    if (skip >= n) {
        *lost = true;
        return SUNDER_I_BIG_ZERO;
    }
    for (mp_size_t i = 0; i < skip; i++)
        if (a.limb[i]) *lost = true;
    mp_limb_t *p = sunder_i_limbs_alloc(arena, n - skip);
    if (!p) return SUNDER_I_BIG_ZERO;
    if (rest) {
        if (mpn_rshift(p, a.limb + skip, n - skip, rest)) *lost = true;
    } else
        mpn_copyi(p, a.limb + skip, n - skip);
    return sunder_i_limbs_value(p, n - skip, 1);
}

sunder_i_big sunder_i_big_shr(sunder_i_arena *arena, sunder_i_big a, unsigned long shift)
{
    bool lost;
    sunder_i_big q = sunder_i_big_shift_down(arena, a, shift, &lost);
    if (a.size >= 0) return q;
    if (lost) q = sunder_i_big_add(arena, q, sunder_i_big_i64(arena, 1));
    return sunder_i_big_neg(q);
}

unsigned long sunder_i_big_bits(sunder_i_big a)
{
    const mp_size_t n = sunder_i_limbs(a);
    if (n == 0) return 0;
    return (unsigned long)n * 64 - (unsigned long)__builtin_clzll(a.limb[n - 1]);
}

unsigned long sunder_i_big_twos(sunder_i_big a) { return mpn_scan1(a.limb, 0); }

bool sunder_i_big_fits_i64(sunder_i_big a, int64_t *v)
{
    if (a.size == 0) {
        *v = 0;
        return true;
    }
    if (sunder_i_limbs(a) > 1 || a.limb[0] > (uint64_t)INT64_MAX) return false;
    *v = a.size < 0 ? -(int64_t)a.limb[0] : (int64_t)a.limb[0];
    return true;
}
