/* answer_texts.c: writes exact vectors as fractions in lowest terms, in the caller's units. Numbers of up to 127 bits
 * are reduced and written in machine arithmetic, others by sunder_i_big_ratio_text(). The three texts are in one block
 * of memory, which begins with that of dx (sunder_separation_clear()). */
#include "separation/answer/answer.h"

#include <string.h>

/* The size of a text: a sign, two numbers below 2^127, a slash and NUL; up to 7 bytes before it are overwritten. */
#define LONGEST (2 * 39 + 3 + 7)

/* ---- Short fractions, written from the end backwards ---- */

/* Returns the eight decimal digits of v < 10^8, one in each byte; the lowest byte is the first digit. Each step halves
 * all parts of the word at once. The quotients are exact: n 10486 / 2^20 for n < 10^4, and n 103 / 2^10 for n < 100. */
static inline uint64_t eight_digits(uint64_t v)
{
    const uint64_t fours = v / 10000 | v % 10000 << 32;
    const uint64_t hundreds = fours * 10486 >> 20 & 0x0000007f0000007f;
    const uint64_t twos = hundreds | (fours - 100 * hundreds) << 16;
    const uint64_t tens = twos * 103 >> 10 & 0x000f000f000f000f;
    return tens | (twos - 10 * tens) << 8;
}

/* Writes the digits as characters, the first digit first. */
static inline void put_word(char *at, uint64_t digits)
{
    digits |= 0x3030303030303030;
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    digits = __builtin_bswap64(digits);
#endif
    memcpy(at, &digits, sizeof digits);
}

/* Writes the decimal digits of v < 10^19 so that they end before `end`, padded with zeros to at least `least` digits;
 * returns the address of the first digit. Up to seven bytes before it are overwritten. */
static char *put_low_digits(char *end, uint64_t v, int least)
{
    char *at = end;
    for (; v >= 100000000; v /= 100000000) put_word(at -= 8, eight_digits(v % 100000000));
    const uint64_t last = eight_digits(v);
    put_word(at - 8, last);
    at -= 8 - __builtin_ctzll(last | (uint64_t)1 << 56) / 8; /* skips leading zeros, but not the only digit */
    while (end - at < least) *--at = '0';
    return at;
}

static char *put_digits(char *end, sunder_i_u128 v)
{
    const uint64_t chunk = 10000000000000000000u;
    for (; v >= chunk; v /= chunk) end = put_low_digits(end, (uint64_t)(v % chunk), 19);
    return put_low_digits(end, (uint64_t)v, 1);
}

/* Writes num / den * 2^exponent so that it ends before `end`, and returns its beginning. num and den are odd and have
 * no common divisor (num may be 0). Returns NULL if a number has more than 127 bits. */
static char *put_fraction(char *end, bool negative, sunder_i_u128 num, sunder_i_u128 den, long exponent)
{
    if (num == 0) {
        den = 1;
        exponent = 0;
    }
    sunder_i_u128 *grows = exponent > 0 ? &num : &den;
    const long shift = exponent > 0 ? exponent : -exponent;
    if (shift >= 127 || *grows >> (127 - shift)) return NULL;
    *grows <<= shift;
    *--end = 0;
    if (den != 1) {
        end = put_digits(end, den);
        *--end = '/';
    }
    end = put_digits(end, num);
    if (negative) *--end = '-';
    return end;
}

/* Divides v, which is not 0, by the largest power of two that divides it, and returns the exponent. */
static long take_twos(sunder_i_u128 *v)
{
    const unsigned twos = sunder_i_u128_twos(*v);
    *v >>= twos;
    return (long)twos;
}

/* Divides two odd numbers by their greatest common divisor. */
static void reduce_fraction(sunder_i_u128 *num, sunder_i_u128 *den)
{
    if (*den == 1) return;
    const sunder_i_u128 common = sunder_i_u128_odd_gcd(*num, *den);
    if (common == 1) return;
    *num /= common;
    *den /= common;
}

static char *put_coordinate(char *end, sunder_i_i128 c, sunder_i_i128 w, long exponent)
{
    sunder_i_u128 num = sunder_i_i128_abs(c), den = (sunder_i_u128)w;
    if (num == 0) return put_fraction(end, false, 0, 1, 0);
    exponent += take_twos(&num) - take_twos(&den);
    reduce_fraction(&num, &den);
    return put_fraction(end, c < 0, num, den, exponent);
}

/* Writes (x^2 + y^2) / w^2 in lowest terms. The common divisor with w is removed twice, which is enough: if a prime
 * divides the numerator a times and w b times, it is removed min(a, b) and then min(a - min(a, b), b) times, together
 * min(a, 2 b). */
static char *put_norm(char *end, sunder_i_i128 x, sunder_i_i128 y, sunder_i_i128 w, long exponent)
{
    sunder_i_u128 num = (sunder_i_u128)(x * x) + (sunder_i_u128)(y * y), den[2] = {(sunder_i_u128)w, (sunder_i_u128)w};
    if (num == 0) return put_fraction(end, false, 0, 1, 0);
    exponent = 2 * exponent + take_twos(&num) - 2 * take_twos(&den[0]);
    den[1] = den[0];
    reduce_fraction(&num, &den[0]);
    reduce_fraction(&num, &den[1]);
    return put_fraction(end, false, num, den[0] * den[1], exponent);
}

/* ---- The three texts ---- */

/* Sets the texts to the three strings in `block`; `dx` and `dy` are the sizes of the first two, with NUL. */
static void point_into(char *block, size_t dx, size_t dy, sunder_separation *out)
{
    out->dx_text = block;
    out->dy_text = block + dx;
    out->distance_squared_text = block + dx + dy;
}

/* Returns false if a number is too long for machine arithmetic. If out of memory it returns true and the texts stay
 * NULL. */
static bool short_texts(sunder_i_operands *g, const sunder_i_exact_translation *v, sunder_separation *out)
{
    if (!v->small) return false;
    const long e = g->placed.lattice.exponent;
    char buffer[3 * LONGEST], *const end = buffer + sizeof buffer;
    char *const norm = put_norm(end, v->x, v->y, v->w, e),
                *const dy = norm ? put_coordinate(norm, v->y, v->w, e) : NULL,
                *const dx = dy ? put_coordinate(dy, v->x, v->w, e) : NULL;
    if (!dx) return false;
    const size_t bytes = (size_t)(end - dx);
    char *block = sunder_i_alloc(bytes, 1);
    if (!block) return true;
    memcpy(block, dx, bytes);
    point_into(block, (size_t)(dy - dx), (size_t)(norm - dy), out);
    return true;
}

/* Copies the three texts to one block. */
static void join_texts(char *text[3], sunder_separation *out)
{
    size_t bytes[3];
    for (int k = 0; k < 3; k++) bytes[k] = strlen(text[k]) + 1;
    char *block = sunder_i_alloc(bytes[0] + bytes[1] + bytes[2], 1);
    if (!block) return;
    memcpy(block, text[0], bytes[0]);
    memcpy(block + bytes[0], text[1], bytes[1]);
    memcpy(block + bytes[0] + bytes[1], text[2], bytes[2]);
    point_into(block, bytes[0], bytes[1], out);
}

static void long_texts(sunder_i_operands *g, const sunder_i_exact_translation *v, sunder_separation *out)
{
    sunder_i_lattice *l = &g->placed.lattice;
    sunder_i_arena *a = &l->arena;
    const sunder_i_rational_point p = sunder_i_exact_translation_point(g, v);
    char *text[3];
    for (int k = 0; k < 2; k++) text[k] = sunder_i_big_ratio_text(a, sunder_i_rational_axis(&p, k), p.w, l->exponent);
    text[2] =
        sunder_i_big_ratio_text(a, sunder_i_rational_dot(a, p, p), sunder_i_big_mul(a, p.w, p.w), 2 * l->exponent);
    if (text[0] && text[1] && text[2]) join_texts(text, out);
    for (int k = 0; k < 3; k++) sunder_i_free(text[k]);
}

sunder_status sunder_i_answer_texts(sunder_i_operands *operands, const sunder_i_exact_translation *v,
                                    sunder_separation *out, sunder_error *err)
{
    if (!short_texts(operands, v, out)) long_texts(operands, v, out);
    if (out->dx_text && !operands->placed.lattice.arena.failed) return SUNDER_OK;
    sunder_separation_clear(out);
    return sunder_i_failure_cause(err);
}
