/* big_double.c: ratios of big integers as doubles, each rounded once. */
#include "number/big_limbs.h"

#include <math.h>
#include <string.h>

typedef enum direction { DOWN, NEAREST, UP } direction;

/* Returns q + (0 < tail < 1 if inexact) times 2^e, q >= 0 with 64 to 66 bits or exact, rounded to a double in the given
 * direction. */
static double round_positive(sunder_i_arena *arena, sunder_i_big q, bool inexact, long e, direction dir)
{
    const long bits = (long)sunder_i_big_bits(q);
    /* The number of bits below the lowest bit that a double of this size can have: 53 bits are kept, fewer in the
     * subnormal range. */
    long drop = bits - 53;
    if (e + drop < -1074) drop = -1074 - e;
    if (drop < 0) drop = 0;
    bool lost = false;
    const unsigned long d = (unsigned long)drop;
    int64_t m = 0;
    const sunder_i_big kept = sunder_i_big_shift_down(arena, q, d, &lost);
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

/* Returns m * 2^exponent, which must neither underflow nor overflow. */
static double scaled_word(uint64_t m, long exponent)
{
    const uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double power;
    memcpy(&power, &bits, sizeof power);
    return (double)m * power;
}

/* Returns the 64 highest bits of |a| > 0, the first of them set. */
static uint64_t highest_bits(sunder_i_big a)
{
    const mp_size_t n = sunder_i_limbs(a);
    const int up = __builtin_clzll(a.limb[n - 1]);
    return a.limb[n - 1] << up | (up && n > 1 ? a.limb[n - 2] >> (64 - up) : 0);
}

/* *v becomes |num / den| * 2^exponent, rounded to the nearest double, if the highest bits of both decide it; else
 * returns false. Let A and D be these bits, both at least 2^63, and num and den equal A + a and D + d up to powers of
 * two, 0 <= a, d < 1. The quotient is Q = 2^63 (A + a) / (D + d), and q = floor(2^63 A / D) < 2^64 differs from it by
 * at most 2: the floor subtracts less than 1, a less than 2^63 / D <= 1, and d adds less than q / D < 2. So a value
 * whose distance from the midpoint between two doubles is more than 2 is rounded to the same double. */
static bool quick_ratio(sunder_i_big num, sunder_i_big den, long exponent, double *v)
{
    const long e = (long)sunder_i_big_bits(num) - (long)sunder_i_big_bits(den) - 63 + exponent;
    if (e < -1000 || e > 900) return false;
    const uint64_t q = (uint64_t)(((sunder_i_u128)highest_bits(num) << 63) / highest_bits(den));
    const int drop = q >> 63 ? 11 : 10;
    const uint64_t half = (uint64_t)1 << (drop - 1), low = q & (2 * half - 1);
    if (low + 2 >= half && low <= half + 2) return false;
    *v = scaled_word((q >> drop) + (low > half), e + drop);
    return true;
}

static double rounded_ratio(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent, direction dir)
{
    if (num.size == 0) return 0;
    const bool negative = num.size < 0, whole = sunder_i_big_is_one(den);
    double v = 0;
    if (whole && dir == NEAREST && sunder_i_limbs(num) == 1 && exponent > -1000 && exponent < 900) {
        v = scaled_word(num.limb[0], exponent); /* there is no underflow, so that it is rounded once */
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
    /* A quotient of 65 or 66 bits has at least eleven bits below the 53 that are kept, and the remainder decides the
     * rest. */
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
    return rounded_ratio(arena, num, den, exponent, NEAREST);
}

double sunder_i_big_ratio_down(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent)
{
    return rounded_ratio(arena, num, den, exponent, DOWN);
}

double sunder_i_big_ratio_up(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent)
{
    return rounded_ratio(arena, num, den, exponent, UP);
}
