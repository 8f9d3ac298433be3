/* Sorted sets of numbers, small and large, compared with an array that marks each number. */
#include "base/list.h"

#include "random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define MOST 80

static void test_sets(void **state)
{
    (void)state;
    rng g = rng_start(test_seed(), 7);
    for (size_t round = 0; round < test_count(4000); round++) {
        uint32_t number[MOST];
        bool marked[MOST] = {false};
        const size_t n = (size_t)rng_int(&g, 0, MOST), below = (size_t)rng_int(&g, 1, MOST);
        for (size_t k = 0; k < n; k++) {
            number[k] = (uint32_t)rng_int(&g, 0, (int)below - 1);
            marked[number[k]] = true;
        }
        const size_t left = sunder_i_set_make(number, n);
        size_t at = 0;
        for (uint32_t k = 0; k < MOST; k++) {
            assert_int_equal(sunder_i_set_has(number, left, k), marked[k]);
            if (marked[k]) assert_int_equal(number[at++], k);
        }
        assert_int_equal(at, left);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_sets)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
