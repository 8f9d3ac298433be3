/* displacement/prove/proofs/exact_line: the line of an edge passes both ends exactly, computed again in rationals; what
 * doubles do not hold is refused. */
#include "random.h"

#include "displacement/prove/proofs/exact_line.h"

#include <gmp.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { CASES = 20000 };

/* Sets out to n.p. */
static void dot(mpq_t out, const double n[2], const double p[2])
{
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    mpq_set_d(out, n[0]);
    mpq_set_d(x, p[0]);
    mpq_mul(out, out, x);
    mpq_set_d(x, n[1]);
    mpq_set_d(y, p[1]);
    mpq_mul(x, x, y);
    mpq_add(out, out, x);
    mpq_clears(x, y, NULL);
}

/* Compares the line with both ends; its normal points to the right of pq, and is at most 1 long. */
static void check_line(const double p[2], const double q[2], const sunder_i_half_plane *line)
{
    mpq_t at, d;
    mpq_inits(at, d, NULL);
    mpq_set_d(d, line->base);
    dot(at, line->n, p);
    assert_int_equal(mpq_cmp(at, d), 0);
    dot(at, line->n, q);
    assert_int_equal(mpq_cmp(at, d), 0);
    const double right[2] = {q[1] - p[1], p[0] - q[0]};
    dot(at, line->n, right);
    assert_true(mpq_sgn(at) > 0);
    dot(at, line->n, line->n);
    assert_true(mpq_cmp_ui(at, 1, 1) <= 0 && mpq_cmp_ui(at, 1, 4) > 0);
    mpq_clears(at, d, NULL);
}

static void test_lines_of_multiples_of_a_unit(void **state)
{
    for (size_t k = 0; k < test_count(CASES); k++) {
        rng r = rng_start(test_seed(), k);
        const double unit = ldexp(1, (int)rng_int(&r, -30, 30));
        double p[2], q[2];
        for (int x = 0; x < 2; x++) {
            p[x] = unit * (double)rng_int(&r, -1000, 1000);
            q[x] = rng_once_in(&r, 4) ? p[x] : unit * (double)rng_int(&r, -1000, 1000);
        }
        sunder_i_half_plane line;
        const bool found = sunder_i_exact_line(p, q, 0, &line);
        assert_int_equal(found, p[0] != q[0] || p[1] != q[1]);
        if (found) check_line(p, q, &line);
    }
}

static void test_lines_of_any_doubles(void **state)
{
    size_t found = 0;
    for (size_t k = 0; k < test_count(CASES); k++) {
        rng r = rng_start(test_seed(), k);
        double p[2], q[2];
        for (int x = 0; x < 2; x++) {
            p[x] = rng_unit(&r);
            q[x] = rng_unit(&r);
        }
        if (rng_once_in(&r, 2)) q[1] = p[1];
        sunder_i_half_plane line;
        if (!sunder_i_exact_line(p, q, 0, &line)) continue;
        check_line(p, q, &line);
        found++;
    }
    assert_true(found > 0 && found < test_count(CASES));
}

/* A line parallel to an axis is moved by the clearance, rounded down; any other only by 0. */
static void test_clearances(void **state)
{
    const double p[2] = {1, 3}, along[2] = {5, 3}, across[2] = {5, 4};
    sunder_i_half_plane line;
    assert_true(sunder_i_exact_line(p, along, 2, &line));
    assert_true(line.n[0] == 0 && line.n[1] == -1 && line.base == -3 && line.d == -1);
    assert_true(sunder_i_exact_line(p, along, -0.5, &line) && line.d == -3.5);
    assert_true(sunder_i_exact_line(along, p, 0x1p-60, &line) && line.base == 3 && line.d < 3 + 0x1p-60 && line.d >= 2);
    assert_false(sunder_i_exact_line(p, across, 2, &line));
    assert_true(sunder_i_exact_line(p, across, 0, &line));
}

static void test_numbers_at_the_ends_of_doubles(void **state)
{
    const double low[2] = {0, 0}, tiny[2] = {0x1p-1040, 0x1p-1041}, huge[2] = {1e308, 1e308}, minus[2] = {-1e308, 1};
    sunder_i_half_plane line;
    double out;
    assert_false(sunder_i_exact_line(low, tiny, 0, &line));
    assert_false(sunder_i_exact_line(huge, minus, 0, &line));
    assert_false(sunder_i_exact_line(low, low, 0, &line));
    assert_false(sunder_i_multiply_exactly(0x1p-600, 0x1p-600, &out));
    assert_false(sunder_i_multiply_exactly(0x1p600, 0x1p600, &out));
    assert_true(sunder_i_multiply_exactly(0, 0x1p600, &out) && out == 0);
    assert_false(sunder_i_subtract_exactly(1, 0x1p-60, &out));
    assert_true(sunder_i_subtract_exactly(0x1p-60, 0, &out) && out == 0x1p-60);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines_of_multiples_of_a_unit),
        cmocka_unit_test(test_lines_of_any_doubles),
        cmocka_unit_test(test_clearances),
        cmocka_unit_test(test_numbers_at_the_ends_of_doubles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
