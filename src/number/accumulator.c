/* accumulator.c: a product has three words at a position given by its exponents; a carry is propagated as far as
 * necessary. The result is the leading 53 bits of the magnitude, rounded once by the next bit and whether any bit after
 * that is set. */
#include "number/accumulator.h"

#include "number/wide.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Returns m < 2^53 with |v| = m 2^(*e - 1074); *e is 0 for subnormal v, so that it is never negative. */
static uint64_t take_apart(double v, int *e)
{
    uint64_t b;
    memcpy(&b, &v, sizeof b);
    const int field = (int)(b >> 52 & 0x7ff);
    const uint64_t fraction = b & (((uint64_t)1 << 52) - 1);
    *e = field ? field - 1 : 0;
    return field ? fraction | (uint64_t)1 << 52 : fraction;
}

static void accumulate_product(sunder_i_accumulator *t, double a, double b, bool minus)
{
    int ea, eb;
    const uint64_t ma = take_apart(a, &ea), mb = take_apart(b, &eb);
    if (ma == 0 || mb == 0) return;
    if (signbit(a) != signbit(b)) minus = !minus;
    const sunder_i_u128 m = (sunder_i_u128)ma * mb;
    const int at = (ea + eb) / 64, shift = (ea + eb) % 64;
    /* The third word is the part of m's upper half above 64 - shift bits; shift may be 0. */
    const sunder_i_u128 low = m << shift;
    const uint64_t word[3] = {(uint64_t)low, (uint64_t)(low >> 64), shift ? (uint64_t)(m >> 64) >> (64 - shift) : 0};
    uint64_t carry = 0;
    for (int i = at; i < SUNDER_I_ACCUMULATOR_LIMBS; i++) {
        const uint64_t w = i - at < 3 ? word[i - at] : 0;
        if (i - at >= 3 && carry == 0) break;
        const uint64_t old = t->limb[i];
        if (minus) {
            const uint64_t d = old - w;
            t->limb[i] = d - carry;
            carry = (old < w) | (d < carry);
        } else {
            const uint64_t s = old + w;
            t->limb[i] = s + carry;
            carry = (s < w) | (t->limb[i] < carry);
        }
    }
}

void sunder_i_accumulator_add(sunder_i_accumulator *sum, double a, double b) { accumulate_product(sum, a, b, false); }
void sunder_i_accumulator_sub(sunder_i_accumulator *sum, double a, double b) { accumulate_product(sum, a, b, true); }

int sunder_i_accumulator_sign(const sunder_i_accumulator *sum)
{
    if (sum->limb[SUNDER_I_ACCUMULATOR_LIMBS - 1] >> 63) return -1;
    for (int i = 0; i < SUNDER_I_ACCUMULATOR_LIMBS; i++)
        if (sum->limb[i]) return 1;
    return 0;
}

/* Returns the bits [low, low + 64) of a magnitude; low may be negative. */
static uint64_t bits_from(const sunder_i_accumulator *t, long low)
{
    if (low < 0) return low <= -64 ? 0 : t->limb[0] << -low;
    const long at = low / 64, shift = low % 64;
    const uint64_t above = at + 1 < SUNDER_I_ACCUMULATOR_LIMBS ? t->limb[at + 1] : 0;
    return shift ? t->limb[at] >> shift | above << (64 - shift) : t->limb[at];
}

static bool any_below(const sunder_i_accumulator *t, long end)
{
    for (long i = 0; 64 * i < end; i++) {
        const long rest = end - 64 * i;
        if (rest >= 64 ? t->limb[i] : t->limb[i] << (64 - rest)) return true;
    }
    return false;
}

double sunder_i_accumulator_double(const sunder_i_accumulator *sum, int exponent)
{
    const int sign = sunder_i_accumulator_sign(sum);
    if (sign == 0) return 0;
    sunder_i_accumulator m = *sum;
    if (sign < 0) { /* the negative: ~m + 1 */
        uint64_t carry = 1;
        for (int i = 0; i < SUNDER_I_ACCUMULATOR_LIMBS; i++) {
            m.limb[i] = ~m.limb[i] + carry;
            carry = carry && m.limb[i] == 0;
        }
    }
    long top = SUNDER_I_ACCUMULATOR_LIMBS - 1;
    while (m.limb[top] == 0) top--;
    const long bits = 64 * (top + 1) - __builtin_clzll(m.limb[top]);
    /* The lowest bit of the result: 53 bits are kept, fewer in the subnormal range. The bit below it, and whether any
     * bit after that is set, determine the rounding. */
    const long unit = SUNDER_I_ACCUMULATOR_UNIT + exponent;
    long drop = bits - 53;
    if (unit + drop < -1074) drop = -1074 - unit;
    if (drop > bits) return sign < 0 ? -0.0 : 0.0;
    uint64_t kept = drop == bits ? 0 : bits_from(&m, drop) & (((uint64_t)1 << 53) - 1);
    if (drop > 0 && bits_from(&m, drop - 1) & 1 && (kept & 1 || any_below(&m, drop - 1))) kept++;
    return ldexp(sign < 0 ? -(double)kept : (double)kept, (int)(unit + drop));
}
