/* number/accumulator: sums of products of doubles of every size, compared with GMP's rationals. */
#include "number/accumulator.h"
#include "random.h"
#include "sunder_parts.h"

#include <float.h>
#include <gmp.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Any finite double: exponents over the whole range, few or many bits, subnormals too. */
static double any_double(rng *g)
{
    const double m = rng_int(g, 0, 1) ? rng_unit(g) : (double)rng_int(g, 0, 9);
    const double v = ldexp(m, (int)rng_int(g, -1080, 1020));
    return rng_int(g, 0, 1) ? -v : v;
}

/* Is d the nearest double to q, ties to even? q is closer to d than the midpoints to its neighbours, or on a midpoint
 * if d is even. */
static void demand_nearest(mpq_t q, double d)
{
    mpq_t edge, value;
    mpq_inits(edge, value, NULL);
    for (int side = -1; side <= 1; side += 2) {
        const double next = nextafter(d, side < 0 ? -INFINITY : INFINITY);
        if (isinf(d) || isinf(next)) continue;
        int exponent;
        const bool even = fmod(frexp(d, &exponent) * 0x1p53, 2) == 0 && fabs(d) >= DBL_MIN;
        mpq_set_d(edge, d);
        mpq_set_d(value, next);
        mpq_add(edge, edge, value);
        mpq_div_2exp(edge, edge, 1);
        const int c = mpq_cmp(q, edge) * side;
        assert_true(c < 0 || (c == 0 && (even || fabs(d) < DBL_MIN)));
    }
    mpq_clears(edge, value, NULL);
}

static void test_random_sums(void **state)
{
    (void)state;
    rng g = rng_start(test_seed(), 45);
    mpq_t sum, a, b;
    mpq_inits(sum, a, b, NULL);
    for (int i = 0; i < 3000; i++) {
        sunder_i_accumulator t = {{0}};
        mpq_set_ui(sum, 0, 1);
        double x = 0, y = 0;
        const int n = (int)rng_int(&g, 1, 12);
        for (int k = 0; k < n; k++) {
            const bool again = k > 0 && rng_int(&g, 0, 2) == 0; /* subtracts the last product again */
            if (!again) x = any_double(&g), y = any_double(&g);
            mpq_set_d(a, x);
            mpq_set_d(b, y);
            mpq_mul(a, a, b);
            if (again) {
                sunder_i_accumulator_sub(&t, x, y);
                mpq_sub(sum, sum, a);
            } else {
                sunder_i_accumulator_add(&t, x, y);
                mpq_add(sum, sum, a);
            }
        }
        assert_int_equal(sunder_i_accumulator_sign(&t), mpq_sgn(sum));
        const int e = (int)rng_int(&g, -3, 3);
        if (e >= 0)
            mpq_mul_2exp(sum, sum, (mp_bitcnt_t)e);
        else
            mpq_div_2exp(sum, sum, (mp_bitcnt_t)-e);
        const double d = sunder_i_accumulator_double(&t, e);
        if (isinf(d)) { /* true from DBL_MAX plus half a unit on */
            mpq_set_d(a, DBL_MAX);
            mpq_set_d(b, 0x1p970);
            mpq_add(a, a, b);
            mpq_abs(sum, sum);
            assert_true(mpq_cmp(sum, a) >= 0);
        } else {
            demand_nearest(sum, d);
        }
    }
    mpq_clears(sum, a, b, NULL);
}

static void test_ends(void **state)
{
    (void)state;
    sunder_i_accumulator t = {{0}};
    assert_true(sunder_i_accumulator_sign(&t) == 0 && sunder_i_accumulator_double(&t, 0) == 0);
    sunder_i_accumulator_sub(&t, 0x1p-1074, 0x1p-1074);
    assert_true(sunder_i_accumulator_sign(&t) < 0 && sunder_i_accumulator_double(&t, 0) == 0);
    assert_true(sunder_i_accumulator_double(&t, 1074) == -0x1p-1074);
    assert_true(sunder_i_accumulator_double(&t, 1073) == 0); /* half of the least double is a tie, rounded to even: 0 */
    for (int k = 0; k < 1000; k++) sunder_i_accumulator_add(&t, DBL_MAX, DBL_MAX);
    assert_true(sunder_i_accumulator_sign(&t) > 0 && isinf(sunder_i_accumulator_double(&t, 0)));
    for (int k = 0; k < 1000; k++) sunder_i_accumulator_sub(&t, DBL_MAX, DBL_MAX);
    assert_true(sunder_i_accumulator_double(&t, 1074) == -0x1p-1074);
}

/* Sums of any doubles, some of them merged from partial sums: rounded to the nearest, and rounded down. */
static void test_totals(void **state)
{
    (void)state;
    rng g = rng_start(test_seed(), 46);
    mpq_t sum, a;
    mpq_inits(sum, a, NULL);
    for (int i = 0; i < 2000; i++) {
        sunder_total whole = {0}, part = {0};
        mpq_set_ui(sum, 0, 1);
        for (int k = (int)rng_int(&g, 0, 9); k > 0; k--) {
            const double x = any_double(&g);
            sunder_total_add(rng_int(&g, 0, 1) ? &whole : &part, x);
            mpq_set_d(a, x);
            mpq_add(sum, sum, a);
        }
        sunder_total_join(&whole, &part);
        demand_nearest(sum, sunder_total_nearest(&whole));
        const double below = sunder_total_below(&whole), above = nextafter(below, INFINITY);
        mpq_set_d(a, below);
        assert_true(mpq_cmp(a, sum) <= 0);
        mpq_set_d(a, above);
        assert_true(mpq_cmp(a, sum) > 0);
    }
    mpq_clears(sum, a, NULL);
}

static void test_totals_past_the_range(void **state)
{
    (void)state;
    sunder_total t = {0};
    sunder_total_add(&t, DBL_MAX);
    sunder_total_add(&t, DBL_MAX);
    assert_true(sunder_total_nearest(&t) == INFINITY && sunder_total_below(&t) == DBL_MAX);
    sunder_total_add(&t, INFINITY);
    assert_true(sunder_total_nearest(&t) == INFINITY && sunder_total_below(&t) == INFINITY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_random_sums),
        cmocka_unit_test(test_totals),
        cmocka_unit_test(test_totals_past_the_range), cmocka_unit_test(test_ends)};
    return cmocka_run_group_tests_name("number/accumulator", tests, NULL, NULL);
}
