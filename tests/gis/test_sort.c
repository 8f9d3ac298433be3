/* The order of features in a spool: records are sorted by their keys, with any amount of memory, where keys are
 * positions on a space-filling curve. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "disk/external_sort.h"
#include "geometry/hilbert.h"
#include "random.h"
#include "scratch.h"

#include <stdlib.h>
#include <string.h>

enum { MOST = 3000 };

/* Records of several sizes, with keys that are often equal. */
typedef struct keyed {
    gis_sort_head head;
    uint64_t number, more[3];
} keyed;

typedef struct keyed_list {
    keyed at[MOST];
    size_t n;
} keyed_list;

static bool note_keyed(void *user, const unsigned char *record, gis_error *error)
{
    keyed_list *to = user;
    gis_sort_head head;
    (void)error;
    memcpy(&head, record, sizeof head);
    memcpy(&to->at[to->n++], record, (size_t)head.bytes);
    return true;
}

static void test_keys(void **state)
{
    static const size_t most[] = {1, 200, 5000, GIS_SORT_BYTES};
    static keyed_list list;
    for (size_t n = 0; n < MOST; n = 3 * n + 1)
        for (size_t m = 0; m < sizeof most / sizeof *most; m++) {
            gis_sorter *sorter;
            gis_error error = {0};
            rng random = rng_start(test_seed(), n);
            assert_true(gis_sorter_new(scratch_directory(), "keys.runs", most[m], &sorter, &error));
            for (size_t i = 0; i < n; i++) {
                const uint64_t more = (uint64_t)rng_int(&random, 0, 3);
                const keyed one = {.head = {sizeof one - 8 * more, (uint64_t)rng_int(&random, -2, 2),
                                            (uint64_t)rng_int(&random, 0, 3) << rng_int(&random, 0, 62)},
                                   .number = i};
                assert_true(gis_sorter_add(sorter, &one, &error));
            }
            list.n = 0;
            assert_true(gis_sorter_take(sorter, note_keyed, &list, &error));
            gis_sorter_free(sorter);
            assert_int_equal(list.n, n);
            for (size_t i = 1; i < n; i++) {
                const keyed *a = &list.at[i - 1], *b = &list.at[i];
                const bool same = a->head.first == b->head.first;
                assert_true(a->head.first <= b->head.first);
                assert_true(!same || a->head.second <= b->head.second);
                assert_true(!same || a->head.second < b->head.second || a->number < b->number);
            }
        }
}

/* Each position occurs once, and consecutive positions are in neighbouring cells: these properties define such a
 * curve. */
static void test_curve(void **state)
{
    enum { BITS = 6, SIDE = 1 << BITS };
    static uint32_t at[SIDE * SIDE][2];
    static bool taken[SIDE * SIDE];
    for (uint32_t x = 0; x < SIDE; x++)
        for (uint32_t y = 0; y < SIDE; y++) {
            const uint64_t along = gis_curve_position(x, y, BITS);
            assert_true(along < SIDE * SIDE && !taken[along]);
            taken[along] = true;
            at[along][0] = x;
            at[along][1] = y;
        }
    for (size_t k = 1; k < SIDE * SIDE; k++)
        assert_int_equal(abs((int)at[k][0] - (int)at[k - 1][0]) + abs((int)at[k][1] - (int)at[k - 1][1]), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_keys), cmocka_unit_test(test_curve)};
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
