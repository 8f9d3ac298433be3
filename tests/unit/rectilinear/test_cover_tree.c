/* The tree of covered elements compared with a plain array of counts. */
#include "random.h"
#include "rectilinear/cover_tree.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#define MOST_ELEMENTS 9000 /* enough for three levels of nodes: two levels hold 64^2 = 4,096 */
#define SOME_ELEMENTS 700
#define RANGES 60

static void compare_runs(const sunder_i_cover_tree *t, const int *count, uint32_t from, uint32_t to,
                         sunder_i_element_runs *runs)
{
    size_t n = 0;
    runs->n = 0;
    assert_true(sunder_i_cover_tree_free_runs(t, from, to, runs));
    for (uint32_t i = from; i < to;) {
        uint32_t j = i;
        while (j < to && count[j] == 0) j++;
        if (j > i) {
            assert_true(n < runs->n);
            assert_int_equal(runs->item[n].from, i);
            assert_int_equal(runs->item[n++].to, j);
        }
        i = j > i ? j : i + 1;
    }
    assert_int_equal(n, runs->n);
}

static void test_random(void **state)
{
    (void)state;
    sunder_i_element_runs runs = {0};
    for (size_t i = 0; i < test_count(200); i++) {
        rng r = rng_start(test_seed(), i);
        const uint32_t n = (uint32_t)rng_int(&r, 1, i % 16 == 0 ? MOST_ELEMENTS : i % 3 ? SOME_ELEMENTS : 70);
        sunder_i_cover_tree t;
        int count[MOST_ELEMENTS] = {0};
        uint32_t range[RANGES][2], ranges = 0;
        assert_true(sunder_i_cover_tree_init(&t, n));
        for (int step = 0; step < 200; step++) {
            if (ranges < RANGES && (ranges == 0 || !rng_once_in(&r, 3))) {
                uint32_t *add = range[ranges++];
                add[0] = (uint32_t)rng_int(&r, 0, n - 1);
                add[1] = (uint32_t)rng_int(&r, add[0] + 1, n);
                sunder_i_cover_tree_add(&t, add[0], add[1]);
                for (uint32_t k = add[0]; k < add[1]; k++) count[k]++;
            } else {
                uint32_t *drop = range[rng_int(&r, 0, ranges - 1)];
                sunder_i_cover_tree_remove(&t, drop[0], drop[1]);
                for (uint32_t k = drop[0]; k < drop[1]; k++) count[k]--;
                memcpy(drop, range[--ranges], sizeof *range);
            }
            const uint32_t from = (uint32_t)rng_int(&r, 0, n - 1), to = (uint32_t)rng_int(&r, from + 1, n);
            compare_runs(&t, count, from, to, &runs);
            compare_runs(&t, count, 0, n, &runs);
        }
        sunder_i_cover_tree_free(&t);
    }
    sunder_i_free(runs.item);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_random)};
    return cmocka_run_group_tests_name("rectilinear_cover_tree", tests, NULL, NULL);
}
