/* If cheaper layouts of several groups collide with each other, a combination that is valid is accepted. */
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Containment counts as a conflict; there are no blocks. */
static void begin(scene *s)
{
    scene_begin(s, 0);
    s->options.no_blocks = true;
    s->options.contained = SUNDER_CONTAINMENT_SEPARATE;
}

/* Separates beside a line, to the west of the features, that they may not cross. */
static void separate_beside_a_line(scene *s)
{
    const double xy[] = {0, -2, 4, 14};
    const size_t end = 2;
    const sunder_barrier line = {{.xy = xy, .line_end = &end, .lines = 1}, 0, -1, true, 0};
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

/* An L within a frame within another frame, which the search moves far apart. By itself the L could return to its
 * original place, and so could the frames, which are another group; but not both. When the frames are examined again,
 * the L has to be at its original place. */
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

/* The same for a triangle, a U and a box, with jumps forbidden. */
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
