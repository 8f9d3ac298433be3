/* big_text.c: conversion of big integers and their ratios to and from decimal text. */
#include "number/big_limbs.h"

#include "base/watch.h"

/* ---- To text ---- */

#define WORD_DIGITS 19 /* the digits of 10^19 - 1 < 2^64 */
#define PLAIN_LIMBS 30 /* below this number of limbs, repeated division by 10^19 is faster */

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

/* Writes a with `width` digits and leading zeros (0: without leading zeros); a is below power[level] squared, where
 * power[i] is 10^(19 2^i). Returns the number of digits; 0 if out of memory. */
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

/* Writes the decimal digits of a >= 0 to text, which must have room for them and for 20 more. Returns their number; 0
 * if out of memory. */
static size_t decimal_digits(sunder_i_arena *arena, sunder_i_big a, char *text)
{
    static const mp_limb_t ten[] = {UINT64_C(10000000000000000000)};
    if (a.size == 0) {
        text[0] = '0';
        return 1;
    }
    sunder_i_big power[64] = {{ten, 1}};
    int level = 0;
    while (2 * power[level].size - 1 <= a.size && !arena->failed) {
        power[level + 1] = sunder_i_big_mul(arena, power[level], power[level]);
        level++;
    }
    return arena->failed ? 0 : digits_by_halves(arena, a, power, level, text, 0);
}

/* Returns a number of characters that suffices for the digits of a, and one more. */
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
    n += decimal_digits(arena, num, text + n);
    if (!(den.size == 1 && den.limb[0] == 1)) {
        text[n++] = '/';
        n += decimal_digits(arena, den, text + n);
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
    *out = SUNDER_I_BIG_ZERO;
    /* Eighteen digits fit in 60 bits. All limbs are allocated in one block, since the text may have any length. */
    mp_limb_t *limb = sunder_i_limbs_alloc(arena, (mp_size_t)(n / 18 + 1));
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
    if (!arena->failed) *out = sunder_i_limbs_value(limb, used, 1);
    if (negative) *out = sunder_i_big_neg(*out);
    return true;
}
