/* Blocks and contained features, in small layers with known results. */
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Compares in doubles; assert_float_equal() uses floats. */
#define assert_near(a, b, tolerance) assert_true(fabs((a) - (b)) <= (tolerance))

/* Moves are rounded outward by some units in the last place; nothing here is larger than a few hundred. */
#define HAIR 1e-9

static void check_blocks(void **state)
{
    scene s;
    scene_begin(&s, 0);
    /* Two features that touch, and a third that overlaps one of them. */
    scene_add_box(&s, 0, 0, 10, 10);
    scene_add_box(&s, 10, 0, 10, 10);
    scene_add_box(&s, 19, 1, 10, 10);
    scene_separate(&s);
    assert_int_equal(s.summary.blocks, 1);
    assert_int_equal(sunder_report_block(s.report, 0), 0);
    assert_int_equal(sunder_report_block(s.report, 1), 0);
    assert_int_equal(sunder_report_block(s.report, 2), -1);
    double a[2], b[2];
    sunder_report_move(s.report, 0, &a[0], &a[1]);
    sunder_report_move(s.report, 1, &b[0], &b[1]);
    assert_memory_equal(a, b, sizeof a);
    /* The block has weight 2, so it moves a third of the way. */
    assert_near(hypot(a[0], a[1]), 1.0 / 3, HAIR);
    assert_near(scene_length(&s, 2), 2.0 / 3, HAIR);
    assert_int_equal(scene_left(&s), 0);
    /* Without blocks each feature is a body of its own, and touching is no conflict. */
    s.options.no_blocks = true;
    scene_separate(&s);
    assert_int_equal(s.summary.blocks, 0);
    assert_int_equal(s.summary.before.overlap, 1);
    assert_int_equal(scene_left(&s), 0);
    /* Block numbers given by the caller are still used. */
    s.feature[0].block = s.feature[2].block = 7;
    scene_separate(&s);
    assert_int_equal(s.summary.blocks, 1);
    assert_int_equal(sunder_report_block(s.report, 2), 0);
    assert_int_equal(sunder_report_block(s.report, 1), -1);
    scene_end(&s);
}

static void check_inside_blocks(void **state)
{
    scene s;
    scene_begin(&s, 1);
    scene_add_box(&s, 0, 0, 10, 10)->block = 1;
    scene_add_box(&s, 5, 5, 10, 10)->block = 1;
    scene_add_box(&s, 10.05, 0, 10, 4);
    scene_check(&s);
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(s.summary.blocks, 1);               /* 0 and 1 have the same number, 2 is within the tolerance of
                                                          * 0.1 */
    assert_int_equal(s.summary.before.inside_blocks, 2); /* 1 and 2 are exactly the gap apart */
    assert_int_equal(s.summary.before.overlap + s.summary.before.too_close, 0);
    assert_int_equal(n, 1);
    assert_int_equal(c->kind, SUNDER_CONFLICT_OVERLAP);
    assert_int_equal(c->reason, SUNDER_REASON_SAME_BLOCK);
    assert_true(c->inside_block);
    assert_near(c->depth, 5, HAIR);
    s.options.list_inside = true;
    scene_check(&s);
    sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 2);
    scene_end(&s);
}

/* Two outlines have to be separated; the house in one of them is near the edge that is pushed inwards, and stays
 * inside. */
static void check_kept_inside(void **state)
{
    scene s;
    scene_begin(&s, 0);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    scene_add_box(&s, 0, 0, 100, 100);
    scene_add_box(&s, 97, 0, 100, 100);
    scene_add_box(&s, 90, 40, 6, 6);
    s.feature[0].weight = s.feature[2].weight = 1;
    s.feature[1].weight = 1000;
    scene_separate(&s);
    assert_int_equal(s.summary.before.overlap, 1);
    assert_int_equal(scene_left(&s), 0);
    /* The outline moves by nearly 3, which would leave the house 1 of its 4; the house need not move. */
    assert_near(scene_length(&s, 0), 3, 0.01);
    assert_int_equal(sunder_report_status(s.report, 2), SUNDER_FEATURE_UNMOVED);
    /* A house near the edge is pushed inwards, by the distance that the edge comes beyond it. */
    scene_end(&s);
    scene_begin(&s, 0);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    scene_add_box(&s, 0, 0, 100, 100);
    scene_add_box(&s, 97, 0, 100, 100)->weight = 1000;
    scene_add_box(&s, 0.5, 40, 6, 6);
    scene_add_box(&s, 90.5, 40, 6, 6);
    scene_add_box(&s, 0, 60, 6, 6)->weight = 1e-3; /* touches the edge that moves away from it, so it may stay */
    scene_separate(&s);
    assert_int_equal(scene_left(&s), 0);
    assert_near(scene_length(&s, 0), 3, 0.02);
    assert_int_equal(sunder_report_status(s.report, 2), SUNDER_FEATURE_UNMOVED);
    assert_int_equal(sunder_report_status(s.report, 4), SUNDER_FEATURE_UNMOVED);
    double dx, dy;
    sunder_report_move(s.report, 3, &dx, &dy);
    assert_near(dx, 0, HAIR);
    scene_end(&s);
    /* The edge is pushed across the whole house: the house, which has to stay inside, moves with it. */
    scene_begin(&s, 0);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    scene_add_box(&s, 0, 0, 100, 100);
    scene_add_box(&s, 80, 0, 100, 100)->weight = 1000;
    scene_add_box(&s, 79, 40, 6, 6)->weight = 1e-3;
    scene_separate(&s);
    assert_int_equal(scene_left(&s), 0);
    sunder_report_move(s.report, 2, &dx, &dy);
    assert_near(dx, -5, 0.1);
    scene_end(&s);
    /* A house in both of two outlines that are separated: it stays in the one whose edge is farther away. */
    scene_begin(&s, 0);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    scene_add_box(&s, 0, 0, 100, 100);
    scene_add_box(&s, 80, 0, 100, 100);
    scene_add_box(&s, 81, 40, 4, 4)->weight = 1e-3;
    scene_separate(&s);
    assert_int_equal(s.summary.before.overlap, 1);
    assert_int_equal(scene_left(&s), 0);
    assert_true(s.summary.max < 11);
    scene_end(&s);
}

static void check_contained(void **state)
{
    scene s;
    scene_begin(&s, 0);
    scene_add_box(&s, 0, 0, 20, 20);
    scene_add_box(&s, 5, 6, 4, 4);
    scene_check(&s);
    assert_int_equal(s.summary.blocks, 1);
    assert_int_equal(s.summary.before.contained, 0);
    assert_int_equal(s.summary.before.inside_blocks, 1);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    scene_separate(&s);
    assert_int_equal(s.summary.blocks, 0);
    assert_int_equal(scene_left(&s), 0);
    assert_int_equal(s.summary.moved, 0);
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    scene_separate(&s);
    assert_int_equal(s.summary.before.contained, 1);
    assert_int_equal(scene_left(&s), 0);
    assert_near(s.summary.total, 9, HAIR); /* leaves to the left: 5 + 4 */
    scene_end(&s);
    /* Containment up to the tolerance: 0.2 beyond the wall, with a tolerance of 0.3. */
    scene_begin(&s, 3);
    scene_add_box(&s, 0, 0, 20, 20);
    scene_add_box(&s, -0.2, 6, 8, 8);
    scene_check(&s);
    assert_int_equal(s.summary.blocks, 1);
    s.options.touch_tolerance = 0.1;
    scene_check(&s);
    assert_int_equal(s.summary.blocks, 0);
    assert_int_equal(s.summary.before.overlap, 1);
    scene_end(&s);
}

static void check_duplicates(void **state)
{
    scene s;
    scene_begin(&s, 0);
    for (int k = 0; k < 4; k++) scene_add_box(&s, 3, 4, 2, 2);
    scene_check(&s);
    assert_int_equal(s.summary.blocks, 1);
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    scene_check(&s);
    assert_int_equal(s.summary.before.duplicate, 6);
    scene_separate(&s);
    assert_int_equal(scene_left(&s), 0);
    assert_int_equal(s.summary.rounded, 0);
    scene_end(&s);
}

/* A house that projects from its outline and is too near to a block beside it: moving it into the outline resolves both
 * conflicts. */
static void check_way_inside(void **state)
{
    scene s;
    scene_begin(&s, 3);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    scene_add_box(&s, 0, 0, 100, 100)->fixed = true;
    scene_add_box(&s, 94, 40, 10, 10)->max_shift = 7;
    scene_add_box(&s, 105, 20, 15, 50)->fixed = true;
    scene_separate(&s);
    assert_int_equal(scene_left(&s), 0);
    assert_near(scene_length(&s, 1), 4, HAIR);
    assert_true(s.summary.lower_bound <= s.summary.cost);
    /* The limit 3.5 is too short for either solution. Away from the block it would only get deeper into the outline's
     * wall: it stays. */
    s.feature[1].max_shift = 3.5;
    scene_separate(&s);
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 2);
    assert_int_equal(c->reason, SUNDER_REASON_MAX_SHIFT);
    assert_true(scene_length(&s, 1) == 0);
    scene_end(&s);
    /* Neither fits into the other, so the only solution is to be the gap apart. */
    scene_begin(&s, 3);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    scene_add_box(&s, 0, 0, 8, 100)->fixed = true;
    scene_add_box(&s, 4, 40, 10, 10)->max_shift = 6;
    scene_separate(&s);
    c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 1);
    assert_int_equal(c->reason, SUNDER_REASON_MAX_SHIFT);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_blocks),      cmocka_unit_test(check_inside_blocks), cmocka_unit_test(check_contained),
        cmocka_unit_test(check_kept_inside), cmocka_unit_test(check_way_inside),    cmocka_unit_test(check_duplicates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
