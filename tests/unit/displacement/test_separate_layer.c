/* Whole layers of few features with known results: which pairs are in conflict, which features move, and which
 * cannot. */
#include "scene.h"

#include "displacement/layer/model.h"

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

static void check_nothing(void **state)
{
    scene s;
    scene_begin(&s, 1);
    scene_separate(&s);
    assert_int_equal(s.summary.features, 0);
    assert_int_equal(s.summary.max_feature, SIZE_MAX);
    assert_true(s.summary.verified);
    scene_add(&s, NULL);
    sunder_shape *empty = NULL;
    assert_int_equal(sunder_shape_from_rings(NULL, NULL, NULL, 0, SUNDER_VALIDITY_STRICT, &empty, NULL), SUNDER_OK);
    scene_add(&s, NULL)->shape = empty;
    scene_separate(&s);
    assert_int_equal(s.summary.features, 2);
    assert_int_equal(s.summary.moved, 0);
    scene_end(&s);
}

static void check_two_squares(void **state)
{
    scene s;
    scene_begin(&s, 0);
    scene_add_box(&s, 0, 0, 10, 10);
    scene_add_box(&s, 8, 1, 10, 10);
    scene_separate(&s);
    assert_int_equal(s.summary.before.overlap, 1);
    assert_int_equal(scene_left(&s), 0);
    assert_int_equal(s.summary.moved, 2);
    /* Two squares separate along x, with equal moves: cost 1 + 1. */
    assert_near(scene_length(&s, 0), 1, HAIR);
    assert_near(scene_length(&s, 1), 1, HAIR);
    assert_near(s.summary.cost, 2, 10 * HAIR);
    assert_true(s.summary.lower_bound <= s.summary.cost);
    assert_near(s.summary.lower_bound, 2, 1e-6);
    scene_end(&s);
}

static void check_weights(void **state)
{
    scene s;
    scene_begin(&s, 0);
    scene_add_box(&s, 0, 0, 10, 10)->weight = 3;
    scene_add_box(&s, 8, 1, 10, 10);
    scene_separate(&s);
    /* The cost 3 a^2 + b^2 with a + b = 2 is least for a = 1/2. */
    assert_near(scene_length(&s, 0), 0.5, HAIR);
    assert_near(scene_length(&s, 1), 1.5, HAIR);
    assert_near(s.summary.lower_bound, 3, 1e-6);
    scene_end(&s);
}

static void check_fixed(void **state)
{
    scene s;
    scene_begin(&s, 1);
    scene_add_box(&s, 0, 0, 10, 10)->fixed = true;
    scene_add_box(&s, 10.5, 1, 10, 10);
    scene_separate(&s);
    assert_int_equal(s.summary.before.too_close, 1);
    assert_int_equal(scene_left(&s), 0);
    assert_int_equal(sunder_report_status(s.report, 0), SUNDER_FEATURE_FIXED);
    assert_int_equal(sunder_report_status(s.report, 1), SUNDER_FEATURE_MOVED);
    assert_near(scene_length(&s, 1), 0.5, HAIR);
    /* A conflict between two fixed features remains. */
    s.feature[1].fixed = true;
    scene_separate(&s);
    assert_int_equal(scene_left(&s), 1);
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 1);
    assert_int_equal(c->reason, SUNDER_REASON_FIXED);
    assert_near(c->distance, 0.5, HAIR);
    assert_near(c->required, 1, 0);
    scene_end(&s);
}

static void check_limits(void **state)
{
    scene s;
    scene_begin(&s, 0);
    scene_add_box(&s, 0, 0, 10, 10)->max_shift = 0.25;
    scene_add_box(&s, 8, 1, 10, 10)->max_shift = 3;
    scene_separate(&s);
    assert_int_equal(scene_left(&s), 0);
    assert_true(scene_length(&s, 0) <= 0.25);
    assert_near(scene_length(&s, 1), 1.75, 1e-6);
    /* Both limits together are too short: the pair is listed, and no body moves to reduce the overlap. */
    s.feature[1].max_shift = 0.5;
    scene_separate(&s);
    assert_int_equal(scene_left(&s), 1);
    assert_int_equal(s.summary.blocked, 2);
    assert_true(scene_length(&s, 0) == 0 && scene_length(&s, 1) == 0);
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 1);
    assert_int_equal(c->reason, SUNDER_REASON_MAX_SHIFT);
    assert_int_equal(c->kind, SUNDER_CONFLICT_OVERLAP);
    assert_near(c->depth, 2, HAIR);
    scene_end(&s);
}

/* The missing distance is less than the last bit of the sum of the limits in doubles. */
static void check_limits_short_by_a_bit(void **state)
{
    const double limit[][2] = {{1, 2}, {1, nextafter(2, 0)}, {0.1, 2.9}, {0, nextafter(3, 0)}, {0, 3}};
    const bool enough[] = {true, false, false, false, true};
    for (size_t k = 0; k < sizeof limit / sizeof *limit; k++) {
        scene s;
        scene_begin(&s, 0);
        scene_add_box(&s, 0, 0, 10, 10)->max_shift = limit[k][0];
        scene_add_box(&s, 7, 1, 10, 10)->max_shift = limit[k][1];
        if (limit[k][0] == 0) s.feature[0].fixed = true;
        scene_separate(&s);
        assert_int_equal(scene_left(&s), enough[k] ? 0 : 1);
        size_t n;
        const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
        if (n) assert_int_equal(c->reason, SUNDER_REASON_MAX_SHIFT);
        scene_end(&s);
    }
}

static void check_chain_without_room(void **state)
{
    scene s;
    scene_begin(&s, 1);
    /* Three squares between two walls 12 apart: four gaps of 1 and three widths of 3 need 13. With moves of 2 the
     * middle one could just pass below the others. A fourth, elsewhere, has room. */
    scene_add_box(&s, -10, -50, 10, 100)->fixed = true;
    scene_add_box(&s, 12, -50, 10, 100)->fixed = true;
    for (int k = 0; k < 3; k++) scene_add_box(&s, 1 + 3.5 * k, 0, 3, 3)->max_shift = 1.75;
    scene_add_box(&s, 22.5, 0, 3, 3);
    scene_separate(&s);
    assert_true(scene_left(&s) > 0);
    assert_int_equal(sunder_report_status(s.report, 5), SUNDER_FEATURE_MOVED);
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    /* Each of the gaps between the three could only grow if another one shrank, which is forbidden: all stay. */
    assert_int_equal(n, 2);
    for (size_t k = 0; k < n; k++) {
        assert_int_equal(c[k].kind, SUNDER_CONFLICT_TOO_CLOSE);
        assert_true(c[k].distance == 0.5 && c[k].before == 0.5);
    }
    for (size_t f = 2; f < 5; f++) assert_true(scene_length(&s, f) == 0);
    scene_end(&s);
}

/* Twelve houses wall to wall, each of which may move a third of the distance that would make room for the gaps: every
 * remaining conflict is proved, though each pair by itself could be separated. */
static void check_row_without_room(void **state)
{
    scene s;
    scene_begin(&s, 3);
    for (int k = 0; k < 12; k++)
        scene_add_box(&s, 11 * k + (k % 3) * 0x1p-6, (k % 2) * 0x1p-5, 10, 10)->max_shift = 3.5;
    scene_separate(&s);
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    assert_true(n > 0);
    for (size_t k = 0; k < n; k++) assert_int_equal(c[k].reason, SUNDER_REASON_NO_ROOM);
    scene_end(&s);
}

static void check_courtyard(void **state)
{
    scene s;
    scene_begin(&s, 1);
    scene_add(&s, "POLYGON ((0 0, 30 0, 30 30, 0 30, 0 0), (10 10, 20 10, 20 20, 10 20, 10 10))");
    scene_add_box(&s, 10.5, 11, 5, 5);
    s.options.touch_tolerance = 0.1;
    scene_separate(&s);
    assert_int_equal(s.summary.before.too_close, 1);
    assert_int_equal(scene_left(&s), 0);
    assert_true(s.summary.max < 1); /* there is enough room inside */
    scene_end(&s);
    /* Not enough room: the feature inside has to leave, if it may jump; otherwise it stays. */
    for (int jumps = 0; jumps < 2; jumps++) {
        scene_begin(&s, 3);
        scene_add(&s, "POLYGON ((0 0, 30 0, 30 30, 0 30, 0 0), (10 10, 20 10, 20 20, 10 20, 10 10))");
        scene_add_box(&s, 12, 12, 5, 5);
        s.options.allow_jumps = jumps;
        scene_separate(&s);
        assert_int_equal(scene_left(&s), jumps ? 0 : 1);
        assert_true((s.summary.moved > 0) == (jumps > 0));
        assert_true(s.summary.verified);
        scene_end(&s);
    }
}

/* A courtyard too narrow for the gap, and no move long enough to leave it: the house stays in it, no worse off than
 * before. */
static void check_narrow_yard(void **state)
{
    scene s;
    scene_begin(&s, 3);
    scene_add(&s, "POLYGON ((0 0, 20 0, 20 20, 0 20, 0 0), (5 5, 5 15, 15 15, 15 5, 5 5))")->max_shift = 5;
    scene_add_box(&s, 6.75, 7, 6, 6)->max_shift = 5;
    scene_separate(&s);
    size_t n = 0;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 1);
    assert_int_equal(c->kind, SUNDER_CONFLICT_TOO_CLOSE);
    assert_int_equal(c->reason, SUNDER_REASON_MAX_SHIFT);
    assert_true(c->before == 1.75);
    assert_true(c->distance >= 1.75);
    assert_int_equal(sunder_report_status(s.report, 1), SUNDER_FEATURE_BLOCKED);
    scene_end(&s);
}

/* The same, with moves long enough to leave it: the rule against jumps forbids that, with a proof; if the limit is too
 * short to leave it, that is the reported reason. */
static void check_yard_without_gate(void **state)
{
    for (int k = 0; k < 3; k++) {
        scene s;
        scene_begin(&s, 3);
        scene_add(&s, "POLYGON ((0 0, 20 0, 20 20, 0 20, 0 0), (5 5, 5 15, 15 15, 15 5, 5 5))")->max_shift = k ? 20 : 3;
        scene_add_box(&s, 6.75, 7, 6, 6)->max_shift = k ? 20 : 3;
        s.options.allow_jumps = k == 2;
        scene_separate(&s);
        size_t n = 0;
        const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
        assert_int_equal(n, k == 2 ? 0 : 1);
        if (n) assert_int_equal(c->reason, k ? SUNDER_REASON_JUMP : SUNDER_REASON_MAX_SHIFT);
        assert_true(s.summary.verified);
        scene_end(&s);
    }
    /* A courtyard with a gate: if the path of the anchor is free, the house may leave. */
    scene s;
    scene_begin(&s, 3);
    scene_add(&s, "POLYGON ((0 0, 20 0, 20 20, 0 20, 0 13, 5 13, 5 15, 15 15, 15 5, 5 5, 5 7, 0 7, 0 0))")->max_shift =
        0;
    scene_add_box(&s, 6.75, 7, 6, 6)->max_shift = 20;
    scene_separate(&s);
    assert_int_equal(scene_left(&s), 0);
    scene_end(&s);
}

/* A hut between two fixed walls that leave no room for the gap, and neighbours with room: none moves for the hut. */
static void check_nothing_worse(void **state)
{
    scene s;
    scene_begin(&s, 3);
    scene_add_box(&s, 0, 0, 10, 40)->fixed = true;
    scene_add_box(&s, 14.9, 0, 10, 40)->fixed = true;
    scene_add_box(&s, 10.9, 10, 3, 3)->max_shift = 10;
    for (int k = 0; k < 4; k++) scene_add_box(&s, 10.5, 50 + 12.0 * k, 4, 9)->max_shift = 10;
    scene_separate(&s);
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 2);
    for (size_t k = 0; k < n; k++) assert_true(c[k].distance >= c[k].before);
    assert_int_equal(s.summary.moved, 0);
    assert_true(s.summary.verified);
    scene_end(&s);
    /* An overlap does not get deeper, although a neighbour presses. */
    scene_begin(&s, 0);
    scene_add_box(&s, 0, 0, 10, 10)->fixed = true;
    scene_add_box(&s, 6, 0, 10, 10)->max_shift = 1;
    scene_add_box(&s, 15, 0, 10, 10)->max_shift = 9;
    scene_separate(&s);
    c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 1);
    assert_int_equal(c->reason, SUNDER_REASON_MAX_SHIFT);
    assert_near(c->depth, 4, HAIR);
    assert_true(c->depth <= 4);
    scene_end(&s);
}

static void check_ignored(void **state)
{
    scene s;
    scene_begin(&s, 1);
    scene_add_box(&s, 0, 0, 10, 10);
    scene_add_box(&s, 1, 1, 10, 10)->ignored = true;
    scene_separate(&s);
    assert_int_equal(s.summary.skipped, 1);
    assert_int_equal(s.summary.moved, 0);
    assert_int_equal(sunder_report_status(s.report, 1), SUNDER_FEATURE_SKIPPED);
    assert_int_equal(scene_left(&s), 0);
    scene_end(&s);
}

static void check_within(void **state)
{
    const double t[2] = {3, 4}, u[2] = {3, nextafter(4, 5)}, v[2] = {3e-200, 4e-200};
    assert_true(sunder_i_is_within_limit(t, 5));
    assert_false(sunder_i_is_within_limit(t, nextafter(5, 0)));
    assert_false(sunder_i_is_within_limit(u, 5));
    assert_true(sunder_i_is_within_limit(v, 5.0000001e-200));
    assert_false(sunder_i_is_within_limit(v, 4.9e-200));
    assert_true(sunder_i_is_within_limit(t, INFINITY));
    assert_true(sunder_i_is_within_limit((const double[2]){0, -0.0}, 0));
    assert_false(sunder_i_is_within_limit(v, 0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_nothing),
        cmocka_unit_test(check_two_squares),
        cmocka_unit_test(check_weights),
        cmocka_unit_test(check_fixed),
        cmocka_unit_test(check_limits),
        cmocka_unit_test(check_limits_short_by_a_bit),
        cmocka_unit_test(check_chain_without_room),
        cmocka_unit_test(check_row_without_room),
        cmocka_unit_test(check_courtyard),
        cmocka_unit_test(check_narrow_yard),
        cmocka_unit_test(check_yard_without_gate),
        cmocka_unit_test(check_nothing_worse),
        cmocka_unit_test(check_ignored),
        cmocka_unit_test(check_within),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
