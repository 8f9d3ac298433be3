/* Boxes beside a road, with known results: kinds, reasons, links, moves. */
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

/* One box of 10 by 10 at the origin, beside a vertical road at x that has width 2 and gap 1, so the required distance
 * from its centre line is 2. The report is valid until the next call. */
static const sunder_conflict *beside_road(double x, double limit, sunder_layer_summary *summary, double t[2])
{
    static sunder_report *report;
    const double xy[4] = {x, -100, x, 100};
    const size_t line_end = 2;
    const sunder_barrier road = {{.xy = xy, .line_end = &line_end, .lines = 1}, 2, 1, false, 0};
    scene s;
    size_t n;
    sunder_layer *layer = NULL;
    sunder_report_free(report);
    report = NULL;
    scene_begin(&s, 5);
    scene_add_box(&s, 0, 0, 10, 10)->max_shift = limit;
    assert_int_equal(sunder_layer_new(s.feature, 1, &layer, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_set_barriers(layer, &road, 1, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_separate(layer, &s.options, &report, NULL), SUNDER_OK);
    sunder_layer_free(layer);
    sunder_report_summary(report, summary);
    sunder_report_move(report, 0, &t[0], &t[1]);
    scene_end(&s);
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    if (n == 0) sunder_report_free(report), report = NULL;
    return n ? c : NULL;
}

static void check_beside_barrier(void **state)
{
    sunder_layer_summary s;
    double t[2];
    assert_null(beside_road(-1, INFINITY, &s, t)); /* the distance is 1, so 1 more is needed */
    assert_int_equal(s.before.barrier_near, 1);    /* it touches the drawn edge, which is not an overlap */
    assert_int_equal(s.before.barrier_drawn, 0);
    assert_near(t[0], 1, HAIR);
    assert_near(s.lower_bound, 1, 1e-6);
    assert_null(beside_road(-2, INFINITY, &s, t)); /* exactly the required distance */
    assert_int_equal(s.before.barrier_near, 0);
    assert_null(beside_road(nextafter(-1, 0), INFINITY, &s, t)); /* just inside the drawn edge */
    assert_int_equal(s.before.barrier_drawn, 1);
    assert_null(beside_road(0, INFINITY, &s, t)); /* along a wall: the road does not meet the interior */
    assert_int_equal(s.before.barrier_drawn, 1);
    assert_int_equal(s.before.barrier_near, 0);
    assert_near(t[0], 2, HAIR);
    assert_null(beside_road(3, INFINITY, &s, t)); /* the road cuts the box: moving the box off at its nearer side, at x
                                                   * = 3, is shorter */
    assert_int_equal(s.before.barrier, 1);
    assert_near(t[0], 5, HAIR);
    assert_near(s.cost, 25, 100 * HAIR);
    assert_near(s.lower_bound, 25, 1e-5);
}

static void check_barrier_without_room(void **state)
{
    sunder_layer_summary s;
    double t[2];
    const sunder_conflict *c = beside_road(3, 0.125, &s, t);
    assert_non_null(c);
    assert_int_equal(c->a, 0);
    assert_int_equal(c->b, 1);
    assert_int_equal(c->kind, SUNDER_CONFLICT_BARRIER);
    assert_int_equal(c->reason, SUNDER_REASON_MAX_SHIFT);
    assert_near(c->depth, 3, HAIR);
    assert_near(c->required, 2, HAIR);
    assert_near(c->missing, 5, HAIR);
    assert_true(t[0] == 0 && t[1] == 0 && s.verified);
    assert_int_equal(s.blocked, 1);
    c = beside_road(-1, 0, &s, t);
    assert_non_null(c);
    assert_int_equal(c->kind, SUNDER_CONFLICT_BARRIER_NEAR);
    assert_int_equal(c->reason, SUNDER_REASON_FIXED);
    assert_near(c->distance, 1, HAIR);
    assert_near(c->missing, 1, HAIR);
    assert_near(c->to[0], -1, HAIR);
    assert_null(beside_road(-50, INFINITY, &s, t)); /* frees the last report */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_beside_barrier),
        cmocka_unit_test(check_barrier_without_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
