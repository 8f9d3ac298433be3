/* The cache of violations of pairs: an entry in the slot of a pair at a place is the violation of that pair at that
 * place, and the last entry is found again. */
#include "random.h"

#include "displacement/solve/search/measures.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { BODIES = 9, QUESTIONS = 20000 };

static double told(uint32_t i, uint32_t j, const double u[2]) { return i + 16 * j + 256 * u[0] + 4096 * u[1]; }

static void test_nobody_else(void **state)
{
    (void)state;
    rng r = rng_start(test_seed(), 0);
    sunder_i_measures all = {0};
    size_t hits = 0;
    for (size_t k = 0; k < QUESTIONS; k++) {
        const uint32_t i = (uint32_t)rng_int(&r, 0, BODIES - 2), j = (uint32_t)rng_int(&r, i + 1, BODIES - 1);
        const double u[2] = {(double)rng_int(&r, -2, 2) / 4, (double)rng_int(&r, -2, 2) / 4};
        sunder_i_measure *m = sunder_i_measures_slot(&all, BODIES, i, j, u);
        assert_non_null(m);
        if (sunder_i_measure_is_of(m, i, j, u)) {
            hits++;
            assert_true(m->missed == told(i, j, u));
            assert_int_equal(m->steps, i + j);
        }
        *m = (sunder_i_measure){i, j, {u[0], u[1]}, told(i, j, u), i + j};
        assert_ptr_equal(sunder_i_measures_slot(&all, BODIES, i, j, u), m);
        assert_true(sunder_i_measure_is_of(m, i, j, u));
    }
    assert_true(hits > 0 && hits < QUESTIONS);
    sunder_i_measures_free(&all);
    assert_null(all.slot);
}

static void test_an_empty_one_is_nobodys(void **state)
{
    (void)state;
    const double home[2] = {0, 0};
    sunder_i_measures all = {0};
    for (uint32_t i = 0; i < BODIES; i++)
        for (uint32_t j = 0; j < BODIES; j++)
            assert_false(sunder_i_measure_is_of(sunder_i_measures_slot(&all, BODIES, i, j, home), i, j, home));
    sunder_i_measures_free(&all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_nobody_else),
                                       cmocka_unit_test(test_an_empty_one_is_nobodys)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
