/* Karatsuba, Burnikel and Ziegler, Lehmer, and digits by powers of ten: each cuts its operands until GMP can take them
 * on the stack. */
#include "number/huge.h"

#include "base/watch.h"

#include <string.h>

static const sunder_i_big zero = {NULL, 0};

static sunder_i_big one(void)
{
    static const mp_limb_t limb = 1;
    return (sunder_i_big){&limb, 1};
}

/* Limbs [from, to) of a magnitude, as a number; it borrows them. */
static sunder_i_big slice(sunder_i_big a, mp_size_t from, mp_size_t to)
{
    if (to > a.size) to = a.size;
    while (to > from && a.limb[to - 1] == 0) to--;
    return to > from ? (sunder_i_big){a.limb + from, to - from} : zero;
}

/* a 2^(64 k) + b. */
static sunder_i_big join(sunder_i_arena *arena, sunder_i_big a, mp_size_t k, sunder_i_big b)
{
    return sunder_i_big_add(arena, sunder_i_big_shl(arena, a, 64 * (unsigned long)k), b);
}

/* A result that stays when the work beneath it is given back: `to` was allocated before the mark. */
static sunder_i_big settle(sunder_i_arena *arena, sunder_i_mark mark, mp_limb_t *to, sunder_i_big v)
{
    if (arena->failed) return zero;
    if (v.size) memmove(to, v.limb, (size_t)v.size * sizeof *to);
    sunder_i_arena_release(arena, mark);
    return (sunder_i_big){to, v.size};
}

/* ---- Products ---- */

/* a of any length, b no longer than a piece: piece by piece into p, which has room for all. */
static sunder_i_big mul_pieces(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, mp_size_t piece, mp_limb_t *p)
{
    const mp_size_t room = a.size + b.size;
    mpn_zero(p, room);
    for (mp_size_t at = 0; at < a.size && !arena->failed; at += piece) {
        const sunder_i_mark mark = sunder_i_arena_mark(arena);
        const sunder_i_big part = sunder_i_big_mul(arena, slice(a, at, at + piece), b);
        if (part.size) mpn_add(p + at, p + at, room - at, part.limb, part.size);
        if (!arena->failed) sunder_i_arena_release(arena, mark);
    }
    return arena->failed ? zero : slice((sunder_i_big){p, room}, 0, room);
}

/* a = a1 B + a0 and b likewise: with the middle (a0 + a1) (b0 + b1) - a0 b0 - a1 b1 three products do [KO62]. */
static sunder_i_big karatsuba(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    const mp_size_t k = (a.size + 1) / 2;
    const sunder_i_big a0 = slice(a, 0, k), a1 = slice(a, k, a.size), b0 = slice(b, 0, k), b1 = slice(b, k, b.size);
    const sunder_i_big low = sunder_i_big_mul(arena, a0, b0), high = sunder_i_big_mul(arena, a1, b1);
    sunder_i_big middle = sunder_i_big_mul(arena, sunder_i_big_add(arena, a0, a1), sunder_i_big_add(arena, b0, b1));
    middle = sunder_i_big_sub(arena, middle, sunder_i_big_add(arena, low, high));
    return join(arena, join(arena, high, k, middle), k, low);
}

sunder_i_big sunder_i_huge_mul(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    if (a.size < b.size) {
        const sunder_i_big t = a;
        a = b;
        b = t;
    }
    mp_limb_t *p = sunder_i_arena_alloc(arena, (size_t)(a.size + b.size), sizeof *p);
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    if (!p) return zero;
    if (b.size <= SUNDER_I_GMP_LIMBS) return mul_pieces(arena, a, b, SUNDER_I_GMP_LIMBS, p);
    if (2 * b.size <= a.size + 1) return mul_pieces(arena, a, b, b.size, p);
    return settle(arena, mark, p, karatsuba(arena, a, b));
}

/* ---- Quotients [BZ98] ---- */

static sunder_i_big divide_2_by_1(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, mp_size_t n, sunder_i_big *r);

/* a below b 2^(64 k), b of 2 k limbs, normalised: the upper halves give a quotient that is at most two too large. */
static sunder_i_big divide_3_by_2(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, mp_size_t k, sunder_i_big *r)
{
    const sunder_i_big upper = slice(a, k, a.size), b1 = slice(b, k, b.size), b0 = slice(b, 0, k);
    sunder_i_big q, rest;
    if (sunder_i_big_cmp(slice(a, 2 * k, a.size), b1) < 0)
        q = divide_2_by_1(arena, upper, b1, k, &rest);
    else { /* the largest of k limbs */
        q = sunder_i_big_sub(arena, sunder_i_big_shl(arena, one(), 64 * (unsigned long)k), one());
        rest = sunder_i_big_sub(arena, upper, sunder_i_big_sub(arena, join(arena, b1, k, zero), b1));
    }
    rest = sunder_i_big_sub(arena, join(arena, rest, k, slice(a, 0, k)), sunder_i_big_mul(arena, q, b0));
    while (rest.size < 0 && !arena->failed) {
        q = sunder_i_big_sub(arena, q, one());
        rest = sunder_i_big_add(arena, rest, b);
    }
    *r = rest;
    return q;
}

/* a below b 2^(64 n), b of n limbs, normalised. */
static sunder_i_big divide_2_by_1(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, mp_size_t n, sunder_i_big *r)
{
    *r = zero;
    if (arena->failed) return zero;
    if (2 * n <= SUNDER_I_GMP_LIMBS) return sunder_i_big_divide(arena, a, b, r);
    const mp_size_t k = n / 2;
    sunder_i_big rest;
    const sunder_i_big high = divide_3_by_2(arena, slice(a, k, a.size), b, k, &rest);
    const sunder_i_big low = divide_3_by_2(arena, join(arena, rest, k, slice(a, 0, k)), b, k, r);
    return join(arena, high, k, low);
}

/* Digit by digit, where a digit is as long as b: shifted so that b's top bit is set and its length halves evenly down
 * to what GMP divides. */
sunder_i_big sunder_i_huge_divide(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, sunder_i_big *remainder)
{
    mp_size_t n = b.size, halvings = 0;
    for (; 2 * n > SUNDER_I_GMP_LIMBS; n = (n + 1) / 2) halvings++;
    n <<= halvings;
    if (n < SUNDER_I_GMP_LIMBS / 2) n = SUNDER_I_GMP_LIMBS / 2;
    const mp_size_t room = a.size + 2 * n;
    mp_limb_t *q = sunder_i_arena_alloc(arena, (size_t)(room + n), sizeof *q);
    *remainder = zero;
    if (!q) return zero;
    mp_limb_t *r = q + room;
    mpn_zero(q, room);
    const unsigned long shift = 64 * (unsigned long)n - sunder_i_big_bits(b);
    const sunder_i_mark all = sunder_i_arena_mark(arena);
    const sunder_i_big u = sunder_i_big_shl(arena, a, shift), v = sunder_i_big_shl(arena, b, shift);
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    sunder_i_big rest = zero;
    for (mp_size_t at = (u.size - 1) / n * n; at >= 0 && !arena->failed; at -= n) {
        const sunder_i_big digit = divide_2_by_1(arena, join(arena, rest, n, slice(u, at, at + n)), v, n, &rest);
        if (digit.size) mpn_copyi(q + at, digit.limb, digit.size);
        rest = settle(arena, mark, r, rest);
    }
    *remainder = settle(arena, all, r, sunder_i_big_shr(arena, rest, shift));
    return arena->failed ? zero : slice((sunder_i_big){q, room}, 0, room);
}

/* ---- The greatest common divisor ---- */

/* Several steps of Euclid's algorithm at once: u' = a u - b v, v' = c v - d u; both negated where `odd`. */
typedef struct lehmer {
    uint64_t a, b, c, d;
    bool odd;
} lehmer;

/* Those steps that the leading 62 bits of u >= v determine: Collins' condition in Jebelean's form [Jeb95] says how far
 * they can be trusted. False if that is not for a single one. */
static bool lehmer_steps(uint64_t u, uint64_t v, lehmer *m)
{
    /* What is left after i steps is x_i u + y_i v, signs alternating; these are the magnitudes, below 2^31. */
    uint64_t x0 = 1, y0 = 0, x1 = 0, y1 = 1;
    bool odd = false;
    int steps = 0;
    while (v) {
        const uint64_t q = u / v, r = u % v;
        if (q >= (uint64_t)1 << 31) break;
        const uint64_t x2 = x0 + q * x1, y2 = y0 + q * y1;
        if (x2 >> 31 || y2 >> 31) break;
        if (odd ? (r < x2 || v - r < y1 + y2) : (r < y2 || v - r < x1 + x2)) break;
        u = v;
        v = r;
        x0 = x1, y0 = y1, x1 = x2, y1 = y2;
        odd = !odd;
        steps++;
    }
    *m = (lehmer){x0, y0, y1, x1, odd};
    return steps > 0;
}

/* x u - y v on n limbs; it is known not to be negative, and to fit. */
static void combine(mp_limb_t *r, const mp_limb_t *u, uint64_t x, const mp_limb_t *v, uint64_t y, mp_size_t n)
{
    mpn_mul_1(r, u, n, x);
    mpn_submul_1(r, v, n, y);
}

static uint64_t leading(sunder_i_big a, unsigned long bits)
{
    /* Bits [bits - 62, bits). */
    const unsigned long low = bits - 62, at = low / 64, shift = low % 64;
    const mp_limb_t first = (long)at < a.size ? a.limb[at] : 0, second = (long)at + 1 < a.size ? a.limb[at + 1] : 0;
    return (first >> shift | (shift ? second << (64 - shift) : 0)) & (((uint64_t)1 << 62) - 1);
}

sunder_i_big sunder_i_huge_gcd(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    if (sunder_i_big_cmp(a, b) < 0) {
        const sunder_i_big t = a;
        a = b;
        b = t;
    }
    const size_t room = (size_t)a.size + 1;
    mp_limb_t *block = sunder_i_arena_alloc(arena, 4 * room, sizeof *block);
    mp_limb_t *spare[2] = {block, block ? block + room : NULL}, *used[2] = {block ? block + 2 * room : NULL, NULL};
    if (!block) return zero;
    used[1] = used[0] + room;
    while (b.size > SUNDER_I_GMP_LIMBS) {
        if (!sunder_i_steps((size_t)a.size / 64 + 1)) arena->failed = true;
        if (arena->failed) return zero;
        const sunder_i_mark mark = sunder_i_arena_mark(arena);
        const unsigned long bits = sunder_i_big_bits(a);
        lehmer m;
        if (lehmer_steps(leading(a, bits), leading(b, bits), &m)) {
            const mp_size_t n = a.size;
            mp_limb_t *v = sunder_i_arena_alloc(arena, (size_t)n, sizeof *v); /* b, as long as a */
            if (!v) return zero;
            mpn_zero(v, n);
            mpn_copyi(v, b.limb, b.size);
            if (m.odd) {
                combine(spare[0], v, m.b, a.limb, m.a, n);
                combine(spare[1], a.limb, m.d, v, m.c, n);
            } else {
                combine(spare[0], a.limb, m.a, v, m.b, n);
                combine(spare[1], v, m.c, a.limb, m.d, n);
            }
            a = slice((sunder_i_big){spare[0], n}, 0, n);
            b = slice((sunder_i_big){spare[1], n}, 0, n);
        } else { /* a quotient too large for a word, or too close to call */
            sunder_i_big rest;
            sunder_i_big_divide(arena, a, b, &rest);
            if (arena->failed) return zero;
            mpn_copyi(spare[0], b.limb, b.size);
            if (rest.size) mpn_copyi(spare[1], rest.limb, rest.size);
            a = (sunder_i_big){spare[0], b.size};
            b = (sunder_i_big){spare[1], rest.size};
        }
        for (int i = 0; i < 2; i++) {
            mp_limb_t *t = spare[i];
            spare[i] = used[i];
            used[i] = t;
        }
        sunder_i_arena_release(arena, mark);
    }
    if (b.size == 0) return a;
    sunder_i_big rest;
    sunder_i_big_divide(arena, a, b, &rest);
    return sunder_i_big_gcd(arena, b, rest);
}

/* ---- Square root ---- */

/* Newton's iteration with as many bits as are right so far, twice as many each time. The invariant, with c = (bits of
 * a - 1) / 2 and d the leading bits of c: (s - 1)^2 < floor(a / 2^(2 c - 2 d)) < (s + 1)^2. One step keeps it, as the
 * error of a quotient step is the square of the old one over 2 s; at the end s or s - 1 is the root. */
sunder_i_big sunder_i_huge_sqrt(sunder_i_arena *arena, sunder_i_big a)
{
    const unsigned long c = (sunder_i_big_bits(a) - 1) / 2;
    unsigned long d = 0;
    int levels = 0;
    while (c >> levels) levels++;
    sunder_i_big s = one();
    for (int k = levels - 1; k >= 0 && !arena->failed; k--) {
        const unsigned long e = d;
        d = c >> k;
        const sunder_i_big part = sunder_i_big_shr(arena, a, 2 * c - e - d + 1);
        s = sunder_i_big_add(arena, sunder_i_big_shl(arena, s, d - e - 1), sunder_i_big_div_floor(arena, part, s));
    }
    if (sunder_i_big_cmp(sunder_i_big_mul(arena, s, s), a) > 0) s = sunder_i_big_sub(arena, s, one());
    return s;
}

/* ---- Decimal digits ---- */

#define WORD_DIGITS 19 /* of 10^19 - 1 < 2^64 */
#define PLAIN_LIMBS 30 /* below this, division by 10^19 again and again is the quicker */

static size_t plain_digits(sunder_i_arena *arena, sunder_i_big a, char *text, size_t width)
{
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    mp_limb_t *v = sunder_i_arena_alloc(arena, (size_t)a.size + 1, sizeof *v);
    if (!v) return 0;
    mp_size_t n = a.size;
    if (n) mpn_copyi(v, a.limb, n);
    char reversed[20 * (PLAIN_LIMBS + 2)];
    size_t at = 0;
    while (n > 0) {
        mp_limb_t word = mpn_divrem_1(v, 0, v, n, UINT64_C(10000000000000000000));
        while (n > 0 && v[n - 1] == 0) n--;
        for (int k = 0; k < WORD_DIGITS && (n > 0 || word > 0); k++, word /= 10)
            reversed[at++] = (char)('0' + word % 10);
    }
    while (at < width) reversed[at++] = '0';
    for (size_t i = 0; i < at; i++) text[i] = reversed[at - 1 - i];
    sunder_i_arena_release(arena, mark);
    return at;
}

/* a in `width` digits with zeros in front (0: as many as it has), a below power[level] squared, where power[i] is
 * 10^(19 2^i). */
static size_t digits_by_halves(sunder_i_arena *arena, sunder_i_big a, const sunder_i_big *power, int level, char *text,
                               size_t width)
{
    while (width == 0 && level >= 0 && sunder_i_big_cmp(a, power[level]) < 0) level--;
    if (a.size < PLAIN_LIMBS && width < WORD_DIGITS * PLAIN_LIMBS) return plain_digits(arena, a, text, width);
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    sunder_i_big low;
    const sunder_i_big high = sunder_i_big_divide(arena, a, power[level], &low);
    if (arena->failed) return 0;
    const size_t half = (size_t)WORD_DIGITS << level;
    const size_t n = digits_by_halves(arena, high, power, level - 1, text, width ? width - half : 0);
    const size_t m = n ? digits_by_halves(arena, low, power, level - 1, text + n, half) : 0;
    if (m == 0) return 0;
    sunder_i_arena_release(arena, mark);
    return n + m;
}

size_t sunder_i_huge_digits(sunder_i_arena *arena, sunder_i_big a, char *text)
{
    static const mp_limb_t ten[] = {UINT64_C(10000000000000000000)};
    sunder_i_big power[64] = {{ten, 1}};
    int level = 0;
    while (2 * power[level].size - 1 <= a.size && !arena->failed) {
        power[level + 1] = sunder_i_big_mul(arena, power[level], power[level]);
        level++;
    }
    return arena->failed ? 0 : digits_by_halves(arena, a, power, level, text, 0);
}
