/* Exact vectors as texts: fractions in lowest terms, in the caller's units. Numbers of up to 127 bits are reduced and
 * written in machine arithmetic, others by sunder_i_big_ratio_text(). */
#include "separation/answer/answer.h"

#include <string.h>

/* Decimal digits of v, below 10^19, before `end`, and no fewer than so many; returns the first. */
static char *put_low_digits(char *end, uint64_t v, int least)
{
    char *at = end;
    while (v >= 100) {
        const unsigned two = (unsigned)(v % 100);
        v /= 100;
        *--at = (char)('0' + two % 10);
        *--at = (char)('0' + two / 10);
    }
    if (v >= 10) {
        *--at = (char)('0' + v % 10);
        v /= 10;
    }
    *--at = (char)('0' + v);
    while (end - at < least) *--at = '0';
    return at;
}

/* Decimal digits of v at `at`; returns past the last one. */
static char *put_digits(char *at, sunder_i_u128 v)
{
    char buffer[3 * 19], *const end = buffer + sizeof buffer, *first = end;
    const uint64_t chunk = 10000000000000000000u;
    for (; v >= chunk; v /= chunk) first = put_low_digits(first, (uint64_t)(v % chunk), 19);
    first = put_low_digits(first, (uint64_t)v, 1);
    memcpy(at, first, (size_t)(end - first));
    return at + (end - first);
}

/* The text of num / den * 2^exponent; NULL if the fraction does not fit (then *fits is false) or memory is out. */
static char *quick_text(bool negative, sunder_i_u128 num, sunder_i_u128 den, long exponent, bool *fit)
{
    *fit = true;
    char text[2 * 40 + 2], *end = text;
    if (num == 0) {
        *end++ = '0';
    } else {
        const unsigned a = sunder_i_u128_twos(num), b = sunder_i_u128_twos(den);
        exponent += (long)a - (long)b;
        num >>= a;
        den >>= b;
        if (den != 1) {
            const sunder_i_u128 common = sunder_i_u128_odd_gcd(num, den);
            if (common != 1) {
                num /= common;
                den /= common;
            }
        }
        sunder_i_u128 *grows = exponent > 0 ? &num : &den;
        const long shift = exponent > 0 ? exponent : -exponent;
        if (shift >= 127 || *grows >> (127 - shift)) {
            *fit = false;
            return NULL;
        }
        *grows <<= shift;
        if (negative) *end++ = '-';
        end = put_digits(end, num);
        if (den != 1) {
            *end++ = '/';
            end = put_digits(end, den);
        }
    }
    *end++ = 0;
    char *copy = sunder_i_alloc((size_t)(end - text), 1);
    if (copy) memcpy(copy, text, (size_t)(end - text));
    return copy;
}

static char *coordinate_text(sunder_i_operands *g, const sunder_i_exact_translation *v, int k)
{
    sunder_i_lattice *l = &g->placed.lattice;
    if (v->small) {
        const sunder_i_i128 c = k ? v->y : v->x;
        bool fit;
        char *text = quick_text(c < 0, sunder_i_i128_abs(c), (sunder_i_u128)v->w, l->exponent, &fit);
        if (fit) return text;
    }
    const sunder_i_rational_point big = sunder_i_exact_translation_point(g, v);
    return sunder_i_big_ratio_text(&l->arena, sunder_i_rational_axis(&big, k), big.w, l->exponent);
}

static char *norm_text(sunder_i_operands *g, const sunder_i_exact_translation *v)
{
    sunder_i_lattice *l = &g->placed.lattice;
    if (v->small) {
        const sunder_i_u128 n = (sunder_i_u128)(v->x * v->x) + (sunder_i_u128)(v->y * v->y);
        bool fit;
        char *text = quick_text(false, n, (sunder_i_u128)(v->w * v->w), 2 * l->exponent, &fit);
        if (fit) return text;
    }
    const sunder_i_rational_point big = sunder_i_exact_translation_point(g, v);
    return sunder_i_big_ratio_text(&l->arena, sunder_i_rational_dot(&l->arena, big, big),
                                   sunder_i_big_mul(&l->arena, big.w, big.w), 2 * l->exponent);
}

sunder_status sunder_i_answer_texts(sunder_i_operands *g, const sunder_i_exact_translation *v, sunder_separation *out,
                                    sunder_error *err)
{
    out->dx_text = coordinate_text(g, v, 0);
    out->dy_text = coordinate_text(g, v, 1);
    out->distance_squared_text = norm_text(g, v);
    if (out->dx_text && out->dy_text && out->distance_squared_text && !g->placed.lattice.arena.failed) return SUNDER_OK;
    sunder_separation_clear(out);
    return sunder_i_no_memory(err);
}
