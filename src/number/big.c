/* Big integers on arenas: what GMP does with limbs, with signs and memory added; and their ratios as doubles, each
 * rounded once. */
#include "number/big.h"

#include "base/watch.h"
#include "number/huge.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(GMP_LIMB_BITS == 64, "limbs of 64 bits");

static const sunder_i_big zero = {NULL, 0};

static mp_size_t limbs(sunder_i_big a) { return (mp_size_t)labs(a.size); }

static mp_limb_t *room(sunder_i_arena *arena, mp_size_t n)
{
    return sunder_i_arena_alloc(arena, (size_t)n, sizeof(mp_limb_t));
}

/* The canonical value of n limbs with a sign. */
static sunder_i_big make(const mp_limb_t *limb, mp_size_t n, int sign)
{
    while (n > 0 && limb[n - 1] == 0) n--;
    return (sunder_i_big){limb, sign < 0 ? -n : n};
}

static sunder_i_big from_limbs(sunder_i_arena *arena, const uint64_t *src, int n, int sign)
{
    mp_limb_t *p = room(arena, n);
    if (!p) return zero;
    for (int i = 0; i < n; i++) p[i] = src[i];
    return make(p, n, sign);
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
    if (v == 0) return zero;
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
    if (a.size == 0) return zero;
    mp_limb_t *p = room(arena, limbs(a));
    if (!p) return zero;
    mpn_copyi(p, a.limb, limbs(a));
    return (sunder_i_big){p, a.size};
}

void sunder_i_big_copy_3(sunder_i_arena *arena, sunder_i_big *a, sunder_i_big *b, sunder_i_big *c)
{
    sunder_i_big *const all[3] = {a, b, c};
    mp_limb_t *p = room(arena, limbs(*a) + limbs(*b) + limbs(*c));
    for (int i = 0; i < 3; i++) {
        const mp_size_t n = limbs(*all[i]);
        if (n == 0 || !p) {
            *all[i] = zero;
            continue;
        }
        for (mp_size_t k = 0; k < n; k++) p[k] = all[i]->limb[k];
        all[i]->limb = p;
        p += n;
    }
}

sunder_i_big sunder_i_big_neg(sunder_i_big a) { return (sunder_i_big){a.limb, -a.size}; }

int sunder_i_big_sign(sunder_i_big a) { return (a.size > 0) - (a.size < 0); }

static int cmp_magnitude(sunder_i_big a, sunder_i_big b)
{
    const mp_size_t m = limbs(a), n = limbs(b);
    if (m != n) return m < n ? -1 : 1;
    return m == 0 ? 0 : mpn_cmp(a.limb, b.limb, m);
}

int sunder_i_big_cmp(sunder_i_big a, sunder_i_big b)
{
    const int s = sunder_i_big_sign(a), t = sunder_i_big_sign(b);
    if (s != t) return s < t ? -1 : 1;
    const int c = cmp_magnitude(a, b);
    return s * ((c > 0) - (c < 0));
}

sunder_i_big sunder_i_big_add(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    if (a.size == 0) return b;
    if (b.size == 0) return a;
    const int c = cmp_magnitude(a, b);
    if (c < 0) {
        const sunder_i_big t = a;
        a = b;
        b = t;
    }
    const mp_size_t m = limbs(a), n = limbs(b);
    const bool same = (a.size > 0) == (b.size > 0);
    if (!same && c == 0) return zero;
    mp_limb_t *p = room(arena, m + 1);
    if (!p) return zero;
    if (same)
        p[m] = mpn_add(p, a.limb, m, b.limb, n);
    else {
        mpn_sub(p, a.limb, m, b.limb, n);
        p[m] = 0;
    }
    return make(p, m + 1, sunder_i_big_sign(a));
}

sunder_i_big sunder_i_big_sub(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    return sunder_i_big_add(arena, a, sunder_i_big_neg(b));
}

sunder_i_big sunder_i_big_mul(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    if (a.size == 0 || b.size == 0) return zero;
    const int sign = sunder_i_big_sign(a) * sunder_i_big_sign(b);
    if (limbs(a) < limbs(b)) {
        const sunder_i_big t = a;
        a = b;
        b = t;
    }
    const mp_size_t m = limbs(a), n = limbs(b);
    if (m > SUNDER_I_GMP_LIMBS) {
        const sunder_i_big v = sunder_i_huge_mul(arena, (sunder_i_big){a.limb, m}, (sunder_i_big){b.limb, n});
        return sign < 0 ? sunder_i_big_neg(v) : v;
    }
    mp_limb_t *p = room(arena, m + n);
    if (!p) return zero;
    mpn_mul(p, a.limb, m, b.limb, n);
    return make(p, m + n, sign);
}

sunder_i_big sunder_i_big_shl(sunder_i_arena *arena, sunder_i_big a, unsigned long shift)
{
    if (a.size == 0 || shift == 0) return a;
    const mp_size_t n = limbs(a), skip = (mp_size_t)(shift / 64);
    const unsigned rest = (unsigned)(shift % 64);
    mp_limb_t *p = room(arena, n + skip + 1);
    if (!p) return zero;
    if (skip) mpn_zero(p, skip);
    if (rest)
        p[n + skip] = mpn_lshift(p + skip, a.limb, n, rest);
    else {
        mpn_copyi(p + skip, a.limb, n);
        p[n + skip] = 0;
    }
    return make(p, n + skip + 1, sunder_i_big_sign(a));
}

/* |a| / 2^shift, dropping the fraction; *lost tells whether it was not zero. */
static sunder_i_big shift_down(sunder_i_arena *arena, sunder_i_big a, unsigned long shift, bool *lost)
{
    const mp_size_t n = limbs(a), skip = (mp_size_t)(shift / 64);
    const unsigned rest = (unsigned)(shift % 64);
    *lost = false;
    if (a.size == 0) return zero;
    if (skip >= n) {
        *lost = true;
        return zero;
    }
    for (mp_size_t i = 0; i < skip; i++)
        if (a.limb[i]) *lost = true;
    mp_limb_t *p = room(arena, n - skip);
    if (!p) return zero;
    if (rest) {
        if (mpn_rshift(p, a.limb + skip, n - skip, rest)) *lost = true;
    } else
        mpn_copyi(p, a.limb + skip, n - skip);
    return make(p, n - skip, 1);
}

sunder_i_big sunder_i_big_shr(sunder_i_arena *arena, sunder_i_big a, unsigned long shift)
{
    bool lost;
    sunder_i_big q = shift_down(arena, a, shift, &lost);
    if (a.size >= 0) return q;
    if (lost) q = sunder_i_big_add(arena, q, sunder_i_big_i64(arena, 1));
    return sunder_i_big_neg(q);
}

sunder_i_big sunder_i_big_divide(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b, sunder_i_big *remainder)
{
    const mp_size_t m = limbs(a), n = limbs(b);
    if (n == 0) { /* left of a product that failed, here or in another arena */
        *remainder = zero;
        return zero;
    }
    if (cmp_magnitude(a, b) < 0) {
        *remainder = (sunder_i_big){a.limb, m};
        return zero;
    }
    if (m > SUNDER_I_GMP_LIMBS) return sunder_i_huge_divide(arena, a, b, remainder);
    mp_limb_t *q = room(arena, m - n + 1), *r = room(arena, n);
    *remainder = zero;
    if (!q || !r) return zero;
    mpn_tdiv_qr(q, r, 0, a.limb, m, b.limb, n);
    *remainder = make(r, n, 1);
    return make(q, m - n + 1, 1);
}

sunder_i_big sunder_i_big_div_floor(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    sunder_i_big r, q = sunder_i_big_divide(arena, a.size < 0 ? sunder_i_big_neg(a) : a, b, &r);
    if (a.size >= 0) return q;
    if (r.size) q = sunder_i_big_add(arena, q, sunder_i_big_i64(arena, 1));
    return sunder_i_big_neg(q);
}

sunder_i_big sunder_i_big_norm(sunder_i_arena *arena, sunder_i_big x, sunder_i_big y)
{
    return sunder_i_big_add(arena, sunder_i_big_mul(arena, x, x), sunder_i_big_mul(arena, y, y));
}

sunder_i_big sunder_i_big_sqrt_floor(sunder_i_arena *arena, sunder_i_big a)
{
    if (a.size <= 0) return zero;
    const mp_size_t n = limbs(a);
    if (n > SUNDER_I_GMP_LIMBS) return sunder_i_huge_sqrt(arena, a);
    mp_limb_t *p = room(arena, (n + 1) / 2);
    if (!p) return zero;
    mpn_sqrtrem(p, NULL, a.limb, n);
    return make(p, (n + 1) / 2, 1);
}

unsigned long sunder_i_big_bits(sunder_i_big a)
{
    const mp_size_t n = limbs(a);
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
    if (limbs(a) > 1 || a.limb[0] > (uint64_t)INT64_MAX) return false;
    *v = a.size < 0 ? -(int64_t)a.limb[0] : (int64_t)a.limb[0];
    return true;
}

sunder_i_big sunder_i_big_gcd(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    if (a.size < 0) a.size = -a.size;
    if (b.size < 0) b.size = -b.size;
    if (a.size == 0) return b;
    if (b.size == 0) return a;
    /* mpn_gcd wants the second operand odd and not longer than the first; it destroys both. */
    const unsigned long ta = sunder_i_big_twos(a), tb = sunder_i_big_twos(b), twos = ta < tb ? ta : tb;
    sunder_i_big u = sunder_i_big_copy(arena, sunder_i_big_shr(arena, a, ta));
    sunder_i_big v = sunder_i_big_copy(arena, sunder_i_big_shr(arena, b, tb));
    if (arena->failed) return zero;
    if (limbs(u) < limbs(v)) {
        const sunder_i_big t = u;
        u = v;
        v = t;
    }
    if (limbs(u) > SUNDER_I_GMP_LIMBS) return sunder_i_big_shl(arena, sunder_i_huge_gcd(arena, u, v), twos);
    mp_limb_t *r = room(arena, limbs(v));
    if (!r) return zero;
    const mp_size_t n = mpn_gcd(r, (mp_limb_t *)(uintptr_t)u.limb, limbs(u), (mp_limb_t *)(uintptr_t)v.limb, limbs(v));
    return sunder_i_big_shl(arena, make(r, n, 1), twos);
}

/* ---- Rationals to doubles ---- */

typedef enum direction { DOWN, NEAREST, UP } direction;

/* Rounds q + (0 < tail < 1 if inexact) times 2^e, q >= 0 with 64 to 66 bits or exact, to a double of positive sign. */
static double round_positive(sunder_i_arena *arena, sunder_i_big q, bool inexact, long e, direction dir)
{
    const long bits = (long)sunder_i_big_bits(q);
    /* The lowest bit that a double can hold at this size: 53 bits, fewer in the subnormal range. */
    long drop = bits - 53;
    if (e + drop < -1074) drop = -1074 - e;
    if (drop < 0) drop = 0;
    bool lost = false;
    const unsigned long d = (unsigned long)drop;
    int64_t m = 0;
    const sunder_i_big kept = shift_down(arena, q, d, &lost);
    if (!sunder_i_big_fits_i64(kept, &m)) return 0;
    if (dir == UP) {
        if (lost || inexact) m++;
    } else if (dir == NEAREST && drop > 0 && d <= (unsigned long)bits) {
        const bool half = (q.limb[(d - 1) / 64] >> ((d - 1) % 64)) & 1;
        bool below = inexact;
        if (half && !below) below = sunder_i_big_twos(q) < d - 1;
        if (half && (below || (m & 1))) m++;
    }
    if (e + drop > 1100) return dir == DOWN ? 0x1.fffffffffffffp1023 : INFINITY;
    const double v = ldexp((double)m, (int)(e + drop));
    return isinf(v) && dir == DOWN ? 0x1.fffffffffffffp1023 : v;
}

/* m * 2^exponent, which must neither underflow nor overflow. */
static double scaled(uint64_t m, long exponent)
{
    const uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double power;
    memcpy(&power, &bits, sizeof power);
    return (double)m * power;
}

/* The 64 highest bits of |a| > 0, the first of them set. */
static uint64_t highest(sunder_i_big a)
{
    const mp_size_t n = limbs(a);
    const int up = __builtin_clzll(a.limb[n - 1]);
    return a.limb[n - 1] << up | (up && n > 1 ? a.limb[n - 2] >> (64 - up) : 0);
}

/* |num / den| * 2^exponent to the nearest double, from the highest bits of both, where these tell. Let A and D be
 * those, both at least 2^63, and num and den A + a and D + d but for powers of two, 0 <= a, d < 1. The quotient is
 * Q = 2^63 (A + a) / (D + d), and q = floor(2^63 A / D) < 2^64 is at most 2 off it: the floor takes less than 1 away, a
 * less than 2^63 / D <= 1, and d adds less than q / D < 2. So whatever is more than 2 from the middle between two
 * doubles is rounded to the same one. */
static bool quick_ratio(sunder_i_big num, sunder_i_big den, long exponent, double *v)
{
    const long e = (long)sunder_i_big_bits(num) - (long)sunder_i_big_bits(den) - 63 + exponent;
    if (e < -1000 || e > 900) return false;
    const uint64_t q = (uint64_t)(((sunder_i_u128)highest(num) << 63) / highest(den));
    const int drop = q >> 63 ? 11 : 10;
    const uint64_t half = (uint64_t)1 << (drop - 1), low = q & (2 * half - 1);
    if (low + 2 >= half && low <= half + 2) return false;
    *v = scaled((q >> drop) + (low > half), e + drop);
    return true;
}

static double ratio(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent, direction dir)
{
    if (num.size == 0) return 0;
    const bool negative = num.size < 0, whole = sunder_i_big_is_one(den);
    double v = 0;
    if (whole && dir == NEAREST && limbs(num) == 1 && exponent > -1000 && exponent < 900) {
        v = scaled(num.limb[0], exponent); /* no underflow, so rounded once */
        return negative ? -v : v;
    }
    if (dir == NEAREST && !whole && den.size && quick_ratio(num, den, exponent, &v)) return negative ? -v : v;
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    if (negative) {
        num.size = -num.size;
        dir = dir == UP ? DOWN : dir == DOWN ? UP : NEAREST;
    }
    if (whole) {
        v = round_positive(arena, num, false, exponent, dir);
        if (!arena->failed) sunder_i_arena_release(arena, mark);
        return negative ? -v : v;
    }
    /* A quotient of 65 or 66 bits leaves at least eleven below the 53 kept, and the remainder settles the rest. */
    const long shift = 65 - ((long)sunder_i_big_bits(num) - (long)sunder_i_big_bits(den));
    if (shift > 0)
        num = sunder_i_big_shl(arena, num, (unsigned long)shift);
    else
        den = sunder_i_big_shl(arena, den, (unsigned long)-shift);
    sunder_i_big r;
    const sunder_i_big q = sunder_i_big_divide(arena, num, den, &r);
    if (q.size) v = round_positive(arena, q, r.size != 0, exponent - shift, dir);
    if (!arena->failed) sunder_i_arena_release(arena, mark);
    return negative ? -v : v;
}

double sunder_i_big_ratio(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent)
{
    return ratio(arena, num, den, exponent, NEAREST);
}

double sunder_i_big_ratio_down(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent)
{
    return ratio(arena, num, den, exponent, DOWN);
}

double sunder_i_big_ratio_up(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent)
{
    return ratio(arena, num, den, exponent, UP);
}

/* ---- Text ---- */

/* Digits of a >= 0 at text; returns how many. */
static size_t digits(sunder_i_arena *arena, sunder_i_big a, char *text)
{
    if (a.size) return sunder_i_huge_digits(arena, a, text);
    text[0] = '0';
    return 1;
}

/* Enough characters for the digits of a number of that many bits, and a spare one. */
static size_t digit_room(sunder_i_big a) { return (size_t)(sunder_i_big_bits(a) * 31 / 100) + 4; }

char *sunder_i_big_ratio_text(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent)
{
    const bool negative = num.size < 0;
    if (negative) num.size = -num.size;
    if (num.size == 0) den = sunder_i_big_i64(arena, 1), exponent = 0;
    if (exponent > 0) num = sunder_i_big_shl(arena, num, (unsigned long)exponent);
    if (exponent < 0) den = sunder_i_big_shl(arena, den, (unsigned long)-exponent);
    const sunder_i_big g = sunder_i_big_gcd(arena, num, den);
    if (arena->failed || den.size == 0) return NULL;
    num = sunder_i_big_div_floor(arena, num, g);
    den = sunder_i_big_div_floor(arena, den, g);
    if (arena->failed) return NULL;
    char *text = sunder_i_alloc(digit_room(num) + digit_room(den) + 4, 1);
    if (!text) {
        arena->failed = true;
        return NULL;
    }
    size_t n = 0;
    if (negative) text[n++] = '-';
    n += digits(arena, num, text + n);
    if (!(den.size == 1 && den.limb[0] == 1)) {
        text[n++] = '/';
        n += digits(arena, den, text + n);
    }
    text[n] = '\0';
    if (arena->failed) {
        sunder_i_free(text);
        return NULL;
    }
    return text;
}

/* ---- From text ---- */

bool sunder_i_big_parse(sunder_i_arena *arena, const char *text, size_t n, sunder_i_big *out)
{
    const bool negative = n && *text == '-';
    if (n && (*text == '-' || *text == '+')) text++, n--;
    if (n == 0) return false;
    *out = zero;
    /* Eighteen digits at a time fit in 60 bits; all of them in one block, for the text may be as long as it likes. */
    mp_limb_t *limb = room(arena, (mp_size_t)(n / 18 + 1));
    mp_size_t used = 0;
    for (size_t i = 0; i < n;) {
        mp_limb_t part = 0, scale = 1;
        for (int k = 0; k < 18 && i < n; k++, i++) {
            if (text[i] < '0' || text[i] > '9') return false;
            part = 10 * part + (mp_limb_t)(text[i] - '0');
            scale *= 10;
        }
        if (arena->failed) continue;
        if (!sunder_i_steps((size_t)used / 64)) arena->failed = true;
        limb[used] = used ? mpn_mul_1(limb, limb, used, scale) : 0;
        mpn_add_1(limb, limb, ++used, part);
    }
    if (!arena->failed) *out = make(limb, used, 1);
    if (negative) *out = sunder_i_big_neg(*out);
    return true;
}
