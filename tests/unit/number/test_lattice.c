/* number/lattice: doubles as integers without loss, narrow and wide. */
#include "failing.h"
#include "gmp_numbers.h"
#include "predicate/predicate.h"

#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void test_low_bit(void **state)
{
    (void)state;
    assert_int_equal(sunder_i_low_bit(0), INT_MAX);
    assert_int_equal(sunder_i_low_bit(-0.0), INT_MAX);
    assert_int_equal(sunder_i_low_bit(1), 0);
    assert_int_equal(sunder_i_low_bit(-6), 1);
    assert_int_equal(sunder_i_low_bit(0.375), -3);
    assert_int_equal(sunder_i_low_bit(0x1p-1074), -1074);
    assert_int_equal(sunder_i_low_bit(0x3p-1073), -1073);
    assert_int_equal(sunder_i_low_bit(0x1.fffffffffffffp1023), 971);
    assert_int_equal(sunder_i_low_bit(0x1p1023), 1023);
}

static void test_power_of_two(void **state)
{
    (void)state;
    static const int e[] = {0, 1, -1, 52, 971, 1023, 1024, 5000, -1022, -1023, -1074, -1075, -5000};
    for (size_t i = 0; i < sizeof e / sizeof *e; i++) assert_true(sunder_i_power_of_two(e[i]) == ldexp(1, e[i]));
}

static void test_extent(void **state)
{
    (void)state;
    sunder_i_extent e = {0};
    const double first[] = {3, -5}, more[] = {-1.5, 0, 8, -0.25};
    sunder_i_extent_add(&e, first, 0);
    assert_false(e.any);
    sunder_i_extent_add(&e, first, 1);
    assert_true(e.any);
    assert_true(e.low[0] == 3 && e.high[0] == 3 && e.low[1] == -5 && e.high[1] == -5 && e.low_bit == 0);
    sunder_i_extent_add(&e, more, 2);
    assert_true(e.low[0] == -1.5 && e.high[0] == 8 && e.low[1] == -5 && e.high[1] == 0);
    assert_int_equal(e.low_bit, -2);
}

/* Demands that value = n * 2^exponent + origin, exactly. */
static void check_value(sunder_i_lattice *l, int64_t n, double origin, double value)
{
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    mpz_from_big(mpq_numref(x), sunder_i_lattice_get(l, n));
    if (l->exponent >= 0)
        mpq_mul_2exp(x, x, (mp_bitcnt_t)l->exponent);
    else
        mpq_div_2exp(x, x, (mp_bitcnt_t)-l->exponent);
    mpq_set_d(y, origin);
    mpq_add(x, x, y);
    mpq_set_d(y, value);
    assert_true(mpq_equal(x, y));
    mpq_clears(x, y, NULL);
}

static void check_lattice(const double *p, size_t n, const double *q, size_t m, bool relative, bool wide,
                          int expect_narrow)
{
    sunder_i_extent e[2] = {{0}, {0}};
    double origin[2][2];
    sunder_i_lattice l;
    sunder_i_extent_add(&e[0], p, n);
    sunder_i_extent_add(&e[1], q, m);
    sunder_i_lattice_init(&l, e, 2, relative, origin, wide);
    if (expect_narrow >= 0) assert_int_equal(l.narrow, expect_narrow);
    if (!relative) assert_true(origin[0][0] == 0 && origin[0][1] == 0 && origin[1][0] == 0 && origin[1][1] == 0);
    double largest = 0;
    for (size_t set = 0; set < 2; set++) {
        const double *xy = set ? q : p;
        for (size_t i = 0; i < 2 * (set ? m : n); i++) {
            const int64_t v = sunder_i_lattice_int(&l, xy[i], origin[set][i & 1]);
            check_value(&l, v, origin[set][i & 1], xy[i]);
            if (l.narrow) assert_true(v < (int64_t)1 << 60 && v > -((int64_t)1 << 60));
            assert_true(isfinite(sunder_i_approx(&l, v)));
            largest = fmax(largest, fabs(sunder_i_approx(&l, v)));
        }
        sunder_i_point at[8];
        assert_true(n <= 8 && m <= 8);
        sunder_i_lattice_points(&l, xy, set ? m : n, origin[set], at);
        for (size_t i = 0; i < 2 * (set ? m : n); i++)
            check_value(&l, i & 1 ? at[i / 2].y : at[i / 2].x, origin[set][i & 1], xy[i]);
    }
    /* The error of the approximation, in ulps of the largest magnitude. */
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    const double ulp = nextafter(largest, INFINITY) - largest;
    for (size_t i = 0; i < 2 * n; i++) {
        const int64_t v = sunder_i_lattice_int(&l, p[i], origin[0][i & 1]);
        mpz_from_big(mpq_numref(x), sunder_i_lattice_get(&l, v));
        mpz_set_ui(mpq_denref(x), 1);
        mpq_div_2exp(x, x, (mp_bitcnt_t)l.approx_shift);
        mpq_set_d(y, sunder_i_approx(&l, v));
        mpq_sub(x, x, y);
        mpq_abs(x, x);
        mpq_set_d(y, ulp);
        assert_true(mpq_cmp(x, y) <= 0);
    }
    mpq_clears(x, y, NULL);
    assert_false(l.arena.failed);
    sunder_i_lattice_free(&l);
}

static void check_all(const double *p, size_t n, const double *q, size_t m, int narrow_relative, int narrow_absolute)
{
    check_lattice(p, n, q, m, true, false, narrow_relative);
    check_lattice(p, n, q, m, false, false, narrow_absolute);
    check_lattice(p, n, q, m, true, true, 0);
    check_lattice(p, n, q, m, false, true, 0);
}

static void test_values(void **state)
{
    (void)state;
    const double integers[] = {0, 0, 5, -7, 1e6, 3},
                 map[] = {451234.567, 5411234.567, 451240.123, 5411250.001, 451230, 5411233.5};
    const double huge[] = {1e300, -1e300, 1e-300, 1, -3e-300, 2}, tiny[] = {0x1p-1074, 0x3p-1070, -0x1p-1060, 0};
    const double top[] = {0x1.fffffffffffffp1023, -0x1.fffffffffffffp1023, 0x1.ffffffffffffep1023, 0};
    const double zeros[] = {0, 0, 0, 0}, far[] = {1e15, 1e15, 1e15 + 0.125, 1e15 + 0.25};
    check_all(integers, 3, integers, 3, 1, 1);
    check_all(map, 3, map, 3, 1, -1);
    check_all(map, 3, integers, 3, 1, -1);
    check_all(huge, 3, integers, 3, 0, 0);
    check_all(tiny, 2, tiny, 2, 1, 1);
    check_all(top, 2, top, 2, 1, 1);
    check_all(tiny, 2, top, 2, 0, 0);
    check_all(zeros, 2, zeros, 2, 1, 1);
    check_all(far, 2, map, 3, -1, -1);
    check_all(NULL, 0, map, 3, 1, -1);
    check_all(NULL, 0, NULL, 0, 1, 1);
}

static void test_random_values(void **state)
{
    (void)state;
    rng g = rng_start(test_seed(), 11);
    for (int i = 0; i < 2000; i++) {
        double p[8], q[6];
        const int spread = (int)rng_int(&g, 0, i % 3 ? 40 : 500), base = (int)rng_int(&g, -400, 400);
        const double at = i % 2 ? 0 : ldexp(rng_unit(&g), base + 40);
        for (int k = 0; k < 8; k++) p[k] = at + ldexp(rng_unit(&g) - 0.5, base + (int)rng_int(&g, -spread, 0));
        for (int k = 0; k < 6; k++) q[k] = at / 3 + ldexp(rng_unit(&g) - 0.5, base + (int)rng_int(&g, -spread, 0));
        check_all(p, 4, q, 3, -1, -1);
    }
}

static void test_arithmetic(void **state)
{
    (void)state;
    rng g = rng_start(test_seed(), 12);
    mpz_t a, b, r, s;
    mpz_inits(a, b, r, s, NULL);
    for (int wide = 0; wide < 2; wide++) {
        sunder_i_lattice l;
        double origin[1][2];
        const double xy[] = {-1e9, 1e9, 0.5, 3};
        sunder_i_extent e = {0};
        sunder_i_extent_add(&e, xy, 2);
        sunder_i_lattice_init(&l, &e, 1, false, origin, wide);
        assert_int_equal(l.narrow, !wide);
        for (int i = 0; i < 500; i++) {
            random_mpz(a, &g, wide ? 900 : 59);
            random_mpz(b, &g, wide ? 900 : 59);
            const int64_t x = sunder_i_lattice_big(&l, big_from_mpz(&l.arena, a));
            const int64_t y = sunder_i_lattice_big(&l, big_from_mpz(&l.arena, b));
            mpz_from_big(s, sunder_i_lattice_get(&l, x));
            assert_int_equal(mpz_cmp(s, a), 0);
            mpz_add(r, a, b);
            const sunder_i_point p = {x, y}, q = {y, y};
            mpz_from_big(s, sunder_i_lattice_get(&l, sunder_i_point_add(&l, p, q).x));
            assert_int_equal(mpz_cmp(s, r), 0);
            mpz_sub(r, a, b);
            mpz_from_big(s, sunder_i_lattice_get(&l, sunder_i_point_sub(&l, p, q).x));
            assert_int_equal(mpz_cmp(s, r), 0);
            mpz_neg(r, a);
            mpz_from_big(s, sunder_i_lattice_get(&l, sunder_i_point_neg(&l, p).x));
            assert_int_equal(mpz_cmp(s, r), 0);
        }
        sunder_i_lattice_free(&l);
    }
    mpz_clears(a, b, r, s, NULL);
}

static bool lattice_run(void *context)
{
    (void)context;
    sunder_i_lattice l;
    double origin[1][2];
    const double xy[] = {-1e290, 1e9, 1e-290, 3};
    sunder_i_extent e = {0};
    sunder_i_extent_add(&e, xy, 2);
    sunder_i_lattice_init(&l, &e, 1, true, origin, false);
    sunder_i_point v = {sunder_i_lattice_int(&l, xy[0], origin[0][0]), 0};
    for (int i = 0; i < 60; i++) v = sunder_i_point_sub(&l, v, (sunder_i_point){sunder_i_lattice_int(&l, xy[3], 0), 0});
    sunder_i_approx(&l, v.x);
    const bool ok = !l.arena.failed;
    sunder_i_lattice_free(&l);
    return ok;
}

static void test_out_of_memory(void **state)
{
    (void)state;
    assert_true(failing_loop(lattice_run, NULL, false));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_low_bit),       cmocka_unit_test(test_power_of_two),
                                       cmocka_unit_test(test_extent),        cmocka_unit_test(test_values),
                                       cmocka_unit_test(test_random_values), cmocka_unit_test(test_arithmetic),
                                       cmocka_unit_test(test_out_of_memory)};
    return cmocka_run_group_tests_name("number/lattice", tests, NULL, NULL);
}
