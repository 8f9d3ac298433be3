/* If cheaper layouts of several groups collide, a layout that holds is accepted. */
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Boxes and frames may not lie in one another; there are no other rules. */
static void begin(scene *s)
{
    scene_begin(s, 0);
    s->options.no_blocks = true;
    s->options.contained = SUNDER_CONTAINMENT_SEPARATE;
}

/* To their west is a line that no feature may cross. */
static void separate_beside_a_line(scene *s)
{
    const double xy[] = {0, -2, 4, 14};
    const size_t end = 2;
    const sunder_barrier line = {{.xy = xy, .line_end = &end, .lines = 1}, 0, -1, true};
    sunder_layer *layer = NULL;
    assert_int_equal(sunder_layer_new(s->feature, s->n, &layer, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_set_barriers(layer, &line, 1, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_separate(layer, &s->options, &s->report, NULL), SUNDER_OK);
    sunder_layer_free(layer);
    sunder_report_summary(s->report, &s->summary);
}

static void check_optimum(scene *s, double cost)
{
    assert_int_equal(scene_left(s), 0);
    assert_true(fabs(s->summary.cost - cost) <= 1e-6 * cost);
    assert_int_equal(s->summary.clusters_optimal, s->summary.clusters);
    scene_end(s);
}

/* An L within a frame within another frame, which the search sends far from each other. Then the L may go home, and so
 * may the frames, which are another group; together they are in each other's way. The L has to be home when the frames
 * are examined again. */
static void test_who_goes_home_first(void **state)
{
    (void)state;
    scene s;
    begin(&s);
    s.options.allow_jumps = true;
    scene_add(&s, "POLYGON((9 4,14 4,14 5,10 5,10 7,9 7,9 4))")->weight = 0.625;
    scene_add(&s, "POLYGON((8 2,11 2,11 10,8 10,8 2),(9 3,9 9,10 9,10 3,9 3))")->weight = 0.25;
    scene_add(&s, "POLYGON((9 2,16 2,16 10,9 10,9 2),(10 3,10 9,15 9,15 3,10 3))")->weight = 1.375;
    separate_beside_a_line(&s);
    check_optimum(&s, 1.6180555555555556);
}

/* The same of a triangle, a U and a box, without jumps. */
static void test_who_stays_in_a_court(void **state)
{
    (void)state;
    scene s;
    begin(&s);
    scene_add(&s, "POLYGON((4 4,10 6,6 12,4 4))");
    scene_add(&s, "POLYGON((1 6,9 6,9 12,8 12,8 7,2 7,2 12,1 12,1 6))");
    scene_add(&s, "POLYGON((1 3,5 3,5 9,1 9,1 3))");
    scene_separate(&s);
    check_optimum(&s, 12.5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_who_goes_home_first),
        cmocka_unit_test(test_who_stays_in_a_court),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
