/* spatial/rtree.c, compared with a loop over all boxes: as built, and after boxes have moved. */
#include "random.h"

#include "spatial/rtree.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 600 };

typedef struct boxes {
    double box[4 * MOST];
    bool present[MOST];
    size_t n;
} boxes;

/* Boxes on a grid of quarters, so that they touch; some are points; a few are far away. */
static void random_box(rng *r, double box[4])
{
    const int64_t wide = rng_once_in(r, 50) ? 100000 : 400;
    for (int c = 0; c < 2; c++) {
        box[c] = (double)rng_int(r, -wide, wide) / 4;
        box[c + 2] = box[c] + (double)rng_int(r, 0, 20) / 4;
    }
}

static void check_query(rng *r, const boxes *b, const sunder_i_rtree *tree)
{
    double box[4];
    sunder_i_list hits = {0};
    random_box(r, box);
    assert_true(sunder_i_rtree_query(tree, box, &hits));
    if (hits.n) qsort(hits.item, hits.n, sizeof *hits.item, sunder_i_by_number);
    size_t at = 0;
    for (uint32_t k = 0; k < b->n; k++) {
        if (!b->present[k] || !sunder_i_box_meet(b->box + 4 * (size_t)k, box)) continue;
        assert_true(at < hits.n);
        assert_int_equal(hits.item[at++], k);
    }
    assert_int_equal(at, hits.n);
    sunder_i_free(hits.item);
}

static void test_queries_as_boxes_move(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_count(60); i++) {
        rng r = rng_start(test_seed(), i);
        boxes b = {.n = (size_t)rng_int(&r, 0, MOST)};
        sunder_i_rtree tree;
        for (size_t k = 0; k < b.n; k++) {
            random_box(&r, b.box + 4 * k);
            b.present[k] = !rng_once_in(&r, 8);
        }
        assert_int_equal(sunder_i_rtree_build(b.box, b.present, b.n, &tree, NULL), SUNDER_OK);
        assert_false(sunder_i_rtree_is_worn(&tree));
        for (int step = 0; step < 200; step++) {
            check_query(&r, &b, &tree);
            if (b.n == 0) continue;
            const uint32_t k = (uint32_t)rng_int(&r, 0, (int64_t)b.n - 1);
            if (!b.present[k]) continue;
            random_box(&r, b.box + 4 * (size_t)k);
            sunder_i_rtree_move(&tree, k, b.box + 4 * (size_t)k);
        }
        sunder_i_rtree_free(&tree);
    }
}

static void check_boxes(const boxes *b, const sunder_i_rtree *tree)
{
    static const double none[4] = {0};
    double *all = sunder_i_rtree_boxes(tree, b->n);
    assert_non_null(all);
    for (uint32_t k = 0; k < b->n; k++) {
        assert_memory_equal(all + 4 * (size_t)k, sunder_i_rtree_box(tree, k), sizeof none);
        assert_memory_equal(all + 4 * (size_t)k, b->present[k] ? b->box + 4 * (size_t)k : none, sizeof none);
    }
    sunder_i_free(all);
}

/* If the boxes of a borrowed tree move, those of the other do not. */
static void test_lent(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_count(60); i++) {
        rng r = rng_start(test_seed(), i);
        boxes b = {.n = (size_t)rng_int(&r, 0, MOST)}, moved;
        sunder_i_rtree tree, copy;
        for (size_t k = 0; k < b.n; k++) {
            random_box(&r, b.box + 4 * k);
            b.present[k] = !rng_once_in(&r, 8);
        }
        assert_int_equal(sunder_i_rtree_build(b.box, b.present, b.n, &tree, NULL), SUNDER_OK);
        copy = sunder_i_rtree_lend(&tree);
        check_query(&r, &b, &copy);
        if (rng_once_in(&r, 4)) sunder_i_rtree_free(&copy);
        if (!copy.levels) copy = sunder_i_rtree_lend(&tree);
        assert_int_equal(sunder_i_rtree_own(&copy, NULL), SUNDER_OK);
        moved = b;
        for (uint32_t k = 0; k < b.n; k++) {
            if (!b.present[k] || rng_once_in(&r, 2)) continue;
            random_box(&r, moved.box + 4 * (size_t)k);
            sunder_i_rtree_move(&copy, k, moved.box + 4 * (size_t)k);
        }
        check_boxes(&moved, &copy);
        check_query(&r, &moved, &copy);
        sunder_i_rtree_free(&copy);
        check_boxes(&b, &tree);
        check_query(&r, &b, &tree);
        sunder_i_rtree_free(&tree);
    }
}

/* If many boxes move far, the tree reports that it should be rebuilt; it does not if a single one does, or if all move
 * a little. */
static void test_wears_by_many(void **state)
{
    (void)state;
    enum { N = 400 };
    static double box[4 * N];
    sunder_i_rtree tree;
    for (size_t k = 0; k < N; k++) {
        const double x = 100 * (double)(k % 20), y = 100 * (double)(k / 20);
        memcpy(box + 4 * k, (double[4]){x, y, x + 10, y + 10}, 4 * sizeof *box);
    }
    assert_int_equal(sunder_i_rtree_build(box, NULL, N, &tree, NULL), SUNDER_OK);
    for (uint32_t k = 0; k < N; k++) {
        for (int c = 0; c < 4; c++) box[4 * k + (uint32_t)c] += k % 3 ? 2 : -2;
        sunder_i_rtree_move(&tree, k, box + 4 * (size_t)k);
    }
    assert_false(sunder_i_rtree_is_worn(&tree));
    for (uint32_t k = 0; k < N; k++) {
        sunder_i_rtree_move(&tree, k, box + 4 * (size_t)((k * 7u) % N));
        if (k == 0) assert_false(sunder_i_rtree_is_worn(&tree));
    }
    assert_true(sunder_i_rtree_is_worn(&tree));
    sunder_i_rtree_free(&tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_queries_as_boxes_move), cmocka_unit_test(test_lent),
                                       cmocka_unit_test(test_wears_by_many)};
    return cmocka_run_group_tests_name("spatial/rtree", tests, NULL, NULL);
}
