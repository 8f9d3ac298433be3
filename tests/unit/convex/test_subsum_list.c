/* A list of pairs of pieces: each pair is stored once, is found again at any size of the list, and the result is
 * sorted. */
#include "convex/subsum_list.h"
#include "failing.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

enum { PAIRS = 5000 };

/* Pairs of two small numbers, so that many share a first or a second number; every third pair occurs twice. */
static uint64_t pair_of(uint64_t k) { return (k * 7 % 64) << 32 | (k * 13 % 911); }

static void check_each_once(void **state)
{
    (void)state;
    sunder_i_subsum_list list = {0};
    size_t different = 0;
    assert_false(sunder_i_subsum_list_has(&list, pair_of(0)));
    for (uint64_t k = 0; k < PAIRS; k++) {
        bool known = false;
        for (size_t i = 0; i < list.n && !known; i++) known = list.pair[i] == pair_of(k);
        assert_int_equal(sunder_i_subsum_list_has(&list, pair_of(k)), known);
        different += !known;
        assert_true(sunder_i_subsum_list_add(&list, pair_of(k)));
        if (k % 3 == 0) assert_true(sunder_i_subsum_list_add(&list, pair_of(k)));
        assert_true(sunder_i_subsum_list_has(&list, pair_of(k)));
        assert_int_equal(list.n, different);
    }
    assert_true(sunder_i_subsum_list_finish(&list));
    for (size_t i = 1; i < list.n; i++) assert_true(list.pair[i - 1] < list.pair[i]);
    sunder_i_subsum_list_free(&list);
}

static bool attempt(void *context)
{
    (void)context;
    sunder_i_subsum_list list = {0};
    bool ok = true;
    for (uint64_t k = 0; k < PAIRS && ok; k++) ok = sunder_i_subsum_list_add(&list, pair_of(k));
    ok = ok && sunder_i_subsum_list_finish(&list);
    sunder_i_subsum_list_free(&list);
    return ok;
}

static void check_memory(void **state)
{
    (void)state;
    failing_begin();
    const bool sound = failing_loop(attempt, NULL, false);
    failing_end();
    assert_true(sound);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_each_once),
        cmocka_unit_test(check_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
