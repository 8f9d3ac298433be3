/* Exact vectors as texts: fractions in lowest terms, in the caller's units. Numbers of up to 127 bits are reduced and
 * written in machine arithmetic, others by sunder_i_big_ratio_text(). */
#include "separation/answer/answer.h"

#include <string.h>

static unsigned twos(sunder_i_u128 v)
{
    const uint64_t low = (uint64_t)v;
    return low ? (unsigned)__builtin_ctzll(low) : 64 + (unsigned)__builtin_ctzll((uint64_t)(v >> 64));
}

/* Binary greatest common divisor of odd numbers. */
static sunder_i_u128 odd_gcd(sunder_i_u128 a, sunder_i_u128 b)
{
    while (a != b && (a >> 64 || b >> 64)) {
        if (a > b) {
            a -= b;
            a >>= twos(a);
        } else {
            b -= a;
            b >>= twos(b);
        }
    }
    uint64_t c = (uint64_t)a, d = (uint64_t)b;
    if (a == b) return a;
    while (c != d) {
        if (c > d) {
            c -= d;
            c >>= __builtin_ctzll(c);
        } else {
            d -= c;
            d >>= __builtin_ctzll(d);
        }
    }
    return c;
}

/* Decimal digits of v at `at`; returns past the last one. */
static char *put_digits(char *at, sunder_i_u128 v)
{
    char buffer[40];
    int n = 0;
    const uint64_t chunk = 10000000000000000000u;
    do {
        const bool more = v >= chunk;
        uint64_t low = more ? (uint64_t)(v % chunk) : (uint64_t)v;
        v = more ? v / chunk : 0;
        const int end = n + 19;
        do {
            buffer[n++] = (char)('0' + low % 10);
            low /= 10;
        } while (low);
        while (v && n < end) buffer[n++] = '0';
    } while (v);
    while (n > 0) *at++ = buffer[--n];
    return at;
}

/* The text of num / den * 2^exponent; NULL if the fraction does not fit (then *fits is false) or memory is out. */
static char *quick_text(bool negative, sunder_i_u128 num, sunder_i_u128 den, long exponent, bool *fit)
{
    *fit = true;
    char text[2 * 40 + 2], *end = text;
    if (num == 0) {
        *end++ = '0';
    } else {
        const unsigned a = twos(num), b = twos(den);
        exponent += (long)a - (long)b;
        num >>= a;
        den >>= b;
        if (den != 1) {
            const sunder_i_u128 common = odd_gcd(num, den);
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
