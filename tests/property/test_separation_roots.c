/* Lengths of translations, square roots that are mostly irrational, compared with GMP: the nearest double and the
 * greatest that is not larger, for random vectors and for vectors whose length is a double, or as near to one as
 * possible. */
#include "random.h"

#include "separation/answer/answer.h"

#include <gmp.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* The sign of d - sqrt(n) / w, for d >= 0, w > 0. */
static int compare(double d, const mpq_t n, const mpq_t w)
{
    mpq_t a;
    mpq_init(a);
    mpq_set_d(a, d);
    mpq_mul(a, a, w);
    mpq_mul(a, a, a);
    const int c = mpq_cmp(a, n);
    mpq_clear(a);
    return c;
}

/* The sign of (a + b) / 2 - sqrt(n) / w. */
static int compare_middle(double a, double b, const mpq_t n, const mpq_t w)
{
    mpq_t m, h;
    mpq_inits(m, h, NULL);
    mpq_set_d(m, a);
    mpq_set_d(h, b);
    mpq_add(m, m, h);
    mpq_div_2exp(m, m, 1);
    mpq_mul(m, m, w);
    mpq_mul(m, m, m);
    const int c = mpq_cmp(m, n);
    mpq_clears(m, h, NULL);
    return c;
}

/* The vector (x / w, y / w) 2^exponent as doubles. */
static sunder_separation answer(int64_t x, int64_t y, int64_t w, int exponent)
{
    sunder_i_operands g;
    memset(&g, 0, sizeof g);
    g.placed.lattice.exponent = exponent;
    const sunder_i_exact_translation v = {.small = true, .x = x, .y = y, .w = w};
    sunder_separation s = {0};
    sunder_i_answer_numbers(&g, &v, &s);
    sunder_i_arena_free(&g.placed.lattice.arena);
    return s;
}

static void check(int64_t x, int64_t y, int64_t w)
{
    const sunder_separation s = answer(x, y, w, 0), far = answer(x, y, w, 500); /* the second uses big integers */
    if (far.distance != ldexp(s.distance, 500) || far.lower_bound != ldexp(s.lower_bound, 500))
        fail_msg("(%lld, %lld) / %lld: %a, at least %a, but times 2^500 %a, at least %a", (long long)x, (long long)y,
                 (long long)w, s.distance, s.lower_bound, far.distance, far.lower_bound);
    mpq_t n, den;
    mpz_t term;
    mpq_inits(n, den, NULL);
    mpz_init_set_si(term, x);
    mpz_mul(mpq_numref(n), term, term);
    mpz_set_si(term, y);
    mpz_addmul(mpq_numref(n), term, term);
    mpq_set_si(den, w, 1);
    const double next = nextafter(s.lower_bound, INFINITY), up = nextafter(s.distance, INFINITY);
    const bool bounded = compare(s.lower_bound, n, den) <= 0;
    const bool greatest = compare(next, n, den) > 0;
    const bool nearest = compare_middle(s.distance, up, n, den) >= 0 &&
                         (s.distance == 0 || compare_middle(nextafter(s.distance, 0), s.distance, n, den) <= 0);
    mpq_clears(n, den, NULL);
    mpz_clear(term);
    if (!bounded || !greatest || !nearest)
        fail_msg("(%lld, %lld) / %lld: %a, at least %a", (long long)x, (long long)y, (long long)w, s.distance,
                 s.lower_bound);
}

/* Numbers with at most that many bits; small ones are as frequent as large ones. */
static int64_t of_bits(rng *r, int most) { return (int64_t)(rng_next(r) >> (64 - rng_int(r, 1, most))); }

/* The inverse of an odd number modulo 2^64 [Newton's steps, each doubles the digits that are right]. */
static uint64_t inverse(uint64_t odd)
{
    uint64_t x = odd;
    for (int i = 0; i < 5; i++) x *= 2 - odd * x;
    return x;
}

/* b / w as near to m / 2^bits as two such numbers can be without being equal, above it or below: m w = 2^bits b -+ 1.
 * With 53 bits m / 2^bits is a double, with 54 it is the midpoint of two. */
static bool quotient_near(rng *r, int bits, bool above, int64_t *b, int64_t *w)
{
    const uint64_t one = (uint64_t)1 << bits, odd = (uint64_t)1 << 52 | rng_next(r) >> 12 | 1;
    const uint64_t m = (above ? -inverse(odd) : inverse(odd)) & (one - 1);
    __extension__ const unsigned __int128 product = (unsigned __int128)m * odd;
    *b = (int64_t)((product + (above ? 1 : 0)) >> bits);
    *w = (int64_t)odd;
    return m >= one / 2;
}

/* Lengths as near as possible to a double, or to the midpoint of two. */
static void near_doubles(void **state)
{
    (void)state;
    rng r = rng_start(test_seed(), 1);
    size_t quotients = 0;
    for (size_t i = 0; i < test_count(4000); i++) {
        const int64_t k = of_bits(&r, 26), shift = (int64_t)1 << rng_int(&r, 0, 52);
        check(2 * k * k, 2 * k, shift);         /* the root of (2 k^2 + 1)^2 - 1 */
        check(of_bits(&r, 53), 1, shift);       /* the root of a square plus one */
        check(3 * k * k, 4 * k * k, 2 * shift); /* 5 k^2, a double or not */
        int64_t b, w;
        for (int how = 0; how < 4; how++) {
            if (!quotient_near(&r, how < 2 ? 53 : 54, how % 2, &b, &w)) continue;
            quotients++;
            check(b, 0, w);
        }
    }
    assert_true(quotients > test_count(4000));
}

static void lengths(void **state)
{
    (void)state;
    rng r = rng_start(test_seed(), 0);
    for (size_t i = 0; i < test_count(20000); i++) {
        int64_t x = of_bits(&r, 62), y = of_bits(&r, 62), w = of_bits(&r, 62) + 1;
        if (i % 2) w = (int64_t)1 << rng_int(&r, 0, 52);
        switch (i / 2 % 4) {
        case 0: break;                                  /* usually irrational */
        case 1: y = 0; break;                           /* the length is x / w */
        case 2: x = 3 * (x >> 3), y = x / 3 * 4; break; /* the length is 5 x / 3 w */
        default: y = rng_int(&r, 0, 3); break;          /* the length is nearly x / w */
        }
        check(x, y, w);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lengths), cmocka_unit_test(near_doubles)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
