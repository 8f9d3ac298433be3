/* Which features join a block, and how blocks are numbered: by their first members. Joining by touch can be switched
 * off; with the tolerance 0 overlaps that a small tolerance would join are counted. */
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void test_numbers(void **state)
{
    scene s;
    scene_begin(&s, 0);
    for (int i = 0; i < 5; i++) scene_add_box(&s, 20 * i, 0, 10, 10);
    scene_add_box(&s, 60, 10, 10, 10); /* touches the fourth */
    s.feature[1].block = s.feature[4].block = 7;
    for (int separate = 0; separate < 2; separate++) {
        static const int64_t expected[] = {-1, 1, -1, 3, 1, 3};
        scene_check(&s);
        if (separate) {
            scene_separate(&s);
        }
        assert_int_equal(s.summary.blocks, 2);
        for (size_t i = 0; i < s.n; i++) assert_int_equal(sunder_report_block(s.report, i), expected[i]);
    }
    scene_end(&s);
}

static void test_thin(void **state)
{
    scene s;
    scene_begin(&s, 0);
    scene_add_box(&s, 0, 0, 10, 10);
    scene_add_box(&s, 9.75, 0, 10, 10);
    scene_add_box(&s, 19, 0, 10, 10); /* 0.75 deep in the second */
    scene_add_box(&s, 28, 0, 10, 10); /* 1 deep in the third */
    scene_add_box(&s, 5, 5, 1, 1);    /* contained: containment is handled apart from overlaps */
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    s.options.thin = 0.75;
    scene_check(&s);
    assert_int_equal(s.summary.before.overlap, 3);
    assert_int_equal(s.summary.thin, 2);
    s.feature[0].block = s.feature[1].block = 3; /* features that are in one block already are not counted */
    scene_check(&s);
    assert_int_equal(s.summary.thin, 1);
    s.options.no_touch = true; /* with this option no tolerance joins anything, so none is proposed */
    scene_check(&s);
    assert_int_equal(s.summary.thin, 0);
    s.options.no_touch = false;
    s.options.touch_tolerance = 0.8; /* with a tolerance nothing is proposed, either */
    scene_check(&s);
    assert_int_equal(s.summary.thin, 0);
    assert_int_equal(s.summary.before.overlap, 1);
    scene_end(&s);
}

static void test_thin_out_of_range(void **state)
{
    static const double wrong[] = {-1, NAN, INFINITY};
    scene s;
    scene_begin(&s, 0);
    scene_add_box(&s, 0, 0, 1, 1);
    sunder_layer *layer;
    assert_int_equal(sunder_layer_new(s.feature, s.n, &layer, NULL), SUNDER_OK);
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        s.options.thin = wrong[k];
        assert_int_equal(sunder_layer_check(layer, &s.options, &s.report, NULL), SUNDER_EARG);
    }
    sunder_layer_free(layer);
    scene_end(&s);
}

/* A symbol on a house stays apart from it, and no row that is found has it; the houses beside it join as ever. */
static void test_joins_none(void **state)
{
    scene s;
    scene_begin(&s, 1);
    for (int i = 0; i < 2; i++) scene_add_box(&s, 10 * i, 0, 10, 10);
    scene_add_box(&s, 4, 4, 2, 2);   /* in the first */
    scene_add_box(&s, 20, 2, 10, 6); /* touches the second */
    for (int alone = 0; alone < 2; alone++) {
        s.feature[2].joins_none = s.feature[3].joins_none = alone;
        scene_check(&s);
        assert_int_equal(s.summary.blocks, 1);
        assert_int_equal(sunder_report_block(s.report, 1), 0);
        for (size_t i = 2; i < 4; i++) assert_int_equal(sunder_report_block(s.report, i), alone ? -1 : 0);
        assert_int_equal(s.summary.before.contained, alone);
        assert_int_equal(s.summary.before.too_close, alone);
    }
    s.feature[2].block = s.feature[1].block = 5; /* numbers of blocks hold in any case */
    scene_check(&s);
    assert_int_equal(sunder_report_block(s.report, 2), 0);
    scene_end(&s);
}

static void test_in_no_row(void **state)
{
    scene s;
    scene_begin(&s, 3);
    s.options.rows = SUNDER_ROWS_FOUND;
    for (int i = 0; i < 4; i++) scene_add_box(&s, 12 * i, 0, 10, 10);
    for (int without = 0; without < 2; without++) {
        s.feature[3].in_no_row = without;
        scene_separate(&s);
        assert_int_equal(s.summary.rows, 1);
        assert_int_equal(s.summary.row_features, without ? 3 : 4);
    }
    scene_end(&s);
}

static void test_no_touch(void **state)
{
    scene s;
    scene_begin(&s, 0);
    scene_add_box(&s, 0, 0, 10, 10);
    scene_add_box(&s, 10, 0, 10, 10);
    scene_add_box(&s, 2, 2, 1, 1);
    s.options.no_touch = true; /* containment joins even so */
    scene_check(&s);
    assert_int_equal(s.summary.blocks, 1);
    assert_int_equal(sunder_report_block(s.report, 2), 0);
    assert_int_equal(sunder_report_block(s.report, 1), -1);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_numbers),           cmocka_unit_test(test_thin),
                                       cmocka_unit_test(test_thin_out_of_range), cmocka_unit_test(test_joins_none),
                                       cmocka_unit_test(test_in_no_row),         cmocka_unit_test(test_no_touch)};
    return cmocka_run_group_tests_name("what joins features", tests, NULL, NULL);
}
