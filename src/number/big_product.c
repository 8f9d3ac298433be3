/* big_product.c: products and quotients of big integers: with GMP if the operands are short enough (big_limbs.h
 * explains why), else with the algorithms of Karatsuba and of Burnikel and Ziegler, which divide the operands until
 * they are. */
#include "number/big_limbs.h"

#include <string.h>

/* Returns a 2^(64 k) + b. */
static sunder_i_big join_limbs(sunder_i_arena *arena, sunder_i_big a, mp_size_t k, sunder_i_big b)
{
    return sunder_i_big_add(arena, sunder_i_big_shl(arena, a, 64 * (unsigned long)k), b);
}

/* Copies a result to `to`, which was allocated before the mark, and releases the memory allocated since. Returns the
 * copy. */
static sunder_i_big settle_result(sunder_i_arena *arena, sunder_i_mark mark, mp_limb_t *to, sunder_i_big v)
{
    if (arena->failed) return SUNDER_I_BIG_ZERO;
    if (v.size) memmove(to, v.limb, (size_t)v.size * sizeof *to);
    sunder_i_arena_release(arena, mark);
    return (sunder_i_big){to, v.size};
}

/* ---- Products ---- */

/* Returns the product of a, of any length, and b, of at most `piece` limbs; computed piece by piece in p, which has
 * room for all. */
static sunder_i_big mul_pieces(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, mp_size_t piece, mp_limb_t *p)
{
    const mp_size_t room = a.size + b.size;
    mpn_zero(p, room);
    for (mp_size_t at = 0; at < a.size && !arena->failed; at += piece) {
        const sunder_i_mark mark = sunder_i_arena_mark(arena);
        const sunder_i_big part = sunder_i_big_mul(arena, sunder_i_limbs_slice(a, at, at + piece), b);
        if (part.size) mpn_add(p + at, p + at, room - at, part.limb, part.size);
        if (!arena->failed) sunder_i_arena_release(arena, mark);
    }
    return arena->failed ? SUNDER_I_BIG_ZERO : sunder_i_limbs_slice((sunder_i_big){p, room}, 0, room);
}

/* a = a1 B + a0 and b likewise: with the middle term (a0 + a1) (b0 + b1) - a0 b0 - a1 b1 three products are sufficient
 * [KO62]. */
static sunder_i_big multiply_karatsuba(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    const mp_size_t k = (a.size + 1) / 2;
    const sunder_i_big a0 = sunder_i_limbs_slice(a, 0, k), a1 = sunder_i_limbs_slice(a, k, a.size),
                       b0 = sunder_i_limbs_slice(b, 0, k), b1 = sunder_i_limbs_slice(b, k, b.size);
    const sunder_i_big low = sunder_i_big_mul(arena, a0, b0), high = sunder_i_big_mul(arena, a1, b1);
    sunder_i_big middle = sunder_i_big_mul(arena, sunder_i_big_add(arena, a0, a1), sunder_i_big_add(arena, b0, b1));
    middle = sunder_i_big_sub(arena, middle, sunder_i_big_add(arena, low, high));
    return join_limbs(arena, join_limbs(arena, high, k, middle), k, low);
}

/* Returns the product of two magnitudes. */
static sunder_i_big multiply_long(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    if (a.size < b.size) {
        const sunder_i_big t = a;
        a = b;
        b = t;
    }
    mp_limb_t *p = sunder_i_arena_alloc(arena, (size_t)(a.size + b.size), sizeof *p);
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    if (!p) return SUNDER_I_BIG_ZERO;
    if (b.size <= SUNDER_I_GMP_LIMBS) return mul_pieces(arena, a, b, SUNDER_I_GMP_LIMBS, p);
    if (2 * b.size <= a.size + 1) return mul_pieces(arena, a, b, b.size, p);
    return settle_result(arena, mark, p, multiply_karatsuba(arena, a, b));
}

sunder_i_big sunder_i_big_mul(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    if (a.size == 0 || b.size == 0) return SUNDER_I_BIG_ZERO;
    const int sign = sunder_i_big_sign(a) * sunder_i_big_sign(b);
    if (sunder_i_limbs(a) < sunder_i_limbs(b)) {
        const sunder_i_big t = a;
        a = b;
        b = t;
    }
    const mp_size_t m = sunder_i_limbs(a), n = sunder_i_limbs(b);
    if (m > SUNDER_I_GMP_LIMBS) {
        const sunder_i_big v = multiply_long(arena, (sunder_i_big){a.limb, m}, (sunder_i_big){b.limb, n});
        return sign < 0 ? sunder_i_big_neg(v) : v;
    }
    mp_limb_t *p = sunder_i_limbs_alloc(arena, m + n);
    if (!p) return SUNDER_I_BIG_ZERO;
    mpn_mul(p, a.limb, m, b.limb, n);
    return sunder_i_limbs_value(p, m + n, sign);
}

sunder_i_big sunder_i_big_norm(sunder_i_arena *arena, sunder_i_big x, sunder_i_big y)
{
    return sunder_i_big_add(arena, sunder_i_big_mul(arena, x, x), sunder_i_big_mul(arena, y, y));
}

/* ---- Quotients [BZ98] ---- */

static sunder_i_big divide_2_by_1(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, mp_size_t n, sunder_i_big *r);

/* Divides a, below b 2^(64 k), by b, which has 2 k limbs and is normalised: the upper halves give a quotient that is at
 * most two too large. */
static sunder_i_big divide_3_by_2(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, mp_size_t k, sunder_i_big *r)
{
    const sunder_i_big upper = sunder_i_limbs_slice(a, k, a.size), b1 = sunder_i_limbs_slice(b, k, b.size),
                       b0 = sunder_i_limbs_slice(b, 0, k);
    sunder_i_big q, rest;
    if (sunder_i_big_cmp(sunder_i_limbs_slice(a, 2 * k, a.size), b1) < 0)
        q = divide_2_by_1(arena, upper, b1, k, &rest);
    else { /* the largest number of k limbs */
        q = sunder_i_big_sub(arena, sunder_i_big_shl(arena, sunder_i_big_one(), 64 * (unsigned long)k),
                             sunder_i_big_one());
        rest = sunder_i_big_sub(arena, upper, sunder_i_big_sub(arena, join_limbs(arena, b1, k, SUNDER_I_BIG_ZERO), b1));
    }
    rest = sunder_i_big_sub(arena, join_limbs(arena, rest, k, sunder_i_limbs_slice(a, 0, k)),
                            sunder_i_big_mul(arena, q, b0));
    while (rest.size < 0 && !arena->failed) {
        q = sunder_i_big_sub(arena, q, sunder_i_big_one());
        rest = sunder_i_big_add(arena, rest, b);
    }
    *r = rest;
    return q;
}

/* Divides a, below b 2^(64 n), by b, which has n limbs and is normalised. */
static sunder_i_big divide_2_by_1(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, mp_size_t n, sunder_i_big *r)
{
    *r = SUNDER_I_BIG_ZERO;
    if (arena->failed) return SUNDER_I_BIG_ZERO;
    if (2 * n <= SUNDER_I_GMP_LIMBS) return sunder_i_big_divide(arena, a, b, r);
    const mp_size_t k = n / 2;
    sunder_i_big rest;
    const sunder_i_big high = divide_3_by_2(arena, sunder_i_limbs_slice(a, k, a.size), b, k, &rest);
    const sunder_i_big low = divide_3_by_2(arena, join_limbs(arena, rest, k, sunder_i_limbs_slice(a, 0, k)), b, k, r);
    return join_limbs(arena, high, k, low);
}

/* Divides digit by digit, where a digit is as long as b: both are shifted so that b's top bit is set and its length can
 * be halved evenly down to the length that GMP divides. */
static sunder_i_big divide_long(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, sunder_i_big *remainder)
{
    mp_size_t n = b.size, halvings = 0;
    for (; 2 * n > SUNDER_I_GMP_LIMBS; n = (n + 1) / 2) halvings++;
    n <<= halvings;
    if (n < SUNDER_I_GMP_LIMBS / 2) n = SUNDER_I_GMP_LIMBS / 2;
    const mp_size_t room = a.size + 2 * n;
    mp_limb_t *q = sunder_i_arena_alloc(arena, (size_t)(room + n), sizeof *q);
    *remainder = SUNDER_I_BIG_ZERO;
    if (!q) return SUNDER_I_BIG_ZERO;
    mp_limb_t *r = q + room;
    mpn_zero(q, room);
    const unsigned long shift = 64 * (unsigned long)n - sunder_i_big_bits(b);
    const sunder_i_mark all = sunder_i_arena_mark(arena);
    const sunder_i_big u = sunder_i_big_shl(arena, a, shift), v = sunder_i_big_shl(arena, b, shift);
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    sunder_i_big rest = SUNDER_I_BIG_ZERO;
    for (mp_size_t at = (u.size - 1) / n * n; at >= 0 && !arena->failed; at -= n) {
        const sunder_i_big digit =
            divide_2_by_1(arena, join_limbs(arena, rest, n, sunder_i_limbs_slice(u, at, at + n)), v, n, &rest);
        if (digit.size) mpn_copyi(q + at, digit.limb, digit.size);
        rest = settle_result(arena, mark, r, rest);
    }
    *remainder = settle_result(arena, all, r, sunder_i_big_shr(arena, rest, shift));
    return arena->failed ? SUNDER_I_BIG_ZERO : sunder_i_limbs_slice((sunder_i_big){q, room}, 0, room);
}

sunder_i_big sunder_i_big_divide(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, sunder_i_big *remainder)
{
    const mp_size_t m = sunder_i_limbs(a), n = sunder_i_limbs(b);
    if (n == 0) { /* the result of a product that failed, in this or another arena */
        *remainder = SUNDER_I_BIG_ZERO;
        return SUNDER_I_BIG_ZERO;
    }
    if (sunder_i_limbs_order(a, b) < 0) {
        *remainder = (sunder_i_big){a.limb, m};
        return SUNDER_I_BIG_ZERO;
    }
    if (m > SUNDER_I_GMP_LIMBS) return divide_long(arena, a, b, remainder);
    mp_limb_t *q = sunder_i_limbs_alloc(arena, m - n + 1), *r = sunder_i_limbs_alloc(arena, n);
    *remainder = SUNDER_I_BIG_ZERO;
    if (!q || !r) return SUNDER_I_BIG_ZERO;
    mpn_tdiv_qr(q, r, 0, a.limb, m, b.limb, n);
    *remainder = sunder_i_limbs_value(r, n, 1);
    return sunder_i_limbs_value(q, m - n + 1, 1);
}

sunder_i_big sunder_i_big_div_floor(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    sunder_i_big r, q = sunder_i_big_divide(arena, a.size < 0 ? sunder_i_big_neg(a) : a, b, &r);
    if (a.size >= 0) return q;
    if (r.size) q = sunder_i_big_add(arena, q, sunder_i_big_i64(arena, 1));
    return sunder_i_big_neg(q);
}
