/* Crowds: many features at one place. Their lower bound by area is compared with the cost of the layout that is
 * found. */
#include "random.h"
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Boxes of sizes from `least` to `most` within the distance `within`; jumps are allowed. */
static void begin_crowd(scene *s, rng *g, size_t n, double gap, double least, double most, double within)
{
    scene_begin(s, gap);
    s->options.no_blocks = s->options.allow_jumps = true;
    for (size_t k = 0; k < n; k++) {
        const double w = least + (most - least) * rng_unit(g), h = least + (most - least) * rng_unit(g);
        scene_add_box(s, 500000 + within * rng_unit(g), 5000000 + within * rng_unit(g), w, h);
    }
}

static void test_bound_is_near(void **state)
{
    (void)state;
    rng g = {1};
    scene s;
    begin_crowd(&s, &g, 70, 0, 10, 10, 5);
    s.options.effort = 0x1p-5;
    scene_separate(&s);
    assert_int_equal(scene_left(&s), 0);
    assert_true(s.summary.lower_bound > 0.85 * s.summary.cost && s.summary.lower_bound <= s.summary.cost);
    scene_end(&s);
}

/* If no prices are used, the crowd costs more than the bound that prices prove, and more than a crowd that starts from
 * the positions that prices give. */
static void test_bound_holds_of_other_layouts(void **state)
{
    (void)state;
    rng g = {2};
    for (int round = 0; round < 6; round++) {
        scene s;
        begin_crowd(&s, &g, (size_t)rng_int(&g, 5, 60), round % 2 ? 1.5 : 0, 2 + round, 12, 3 + 6 * round);
        s.options.effort = 0;
        scene_separate(&s);
        const double before = s.summary.cost, pairs = s.summary.lower_bound;
        assert_int_equal(scene_left(&s), 0);
        s.options.effort = 0x1p-7;
        scene_separate(&s);
        assert_int_equal(scene_left(&s), 0);
        assert_true(s.summary.lower_bound <= before && s.summary.lower_bound >= pairs);
        scene_end(&s);
    }
}

static void test_limits_and_weights_count(void **state)
{
    (void)state;
    rng g = {3};
    scene s;
    begin_crowd(&s, &g, 30, 0, 8, 12, 4);
    for (size_t k = 0; k < s.n; k++) s.feature[k].weight = k % 3 ? 1 : 40;
    s.feature[7].max_shift = 0;
    s.feature[11].max_shift = 9;
    s.options.effort = 0x1p-6;
    scene_separate(&s);
    assert_true(scene_length(&s, 7) == 0 && scene_length(&s, 11) <= 9);
    assert_true(s.summary.lower_bound <= s.summary.cost && s.summary.lower_bound > 0.3 * s.summary.cost);
    scene_end(&s);
}

/* The bound of two crowds that are far apart is the sum of both bounds. */
static void test_far_crowds_add_up(void **state)
{
    (void)state;
    double bound[3], cost[3];
    for (int which = 0; which < 3; which++) { /* the first crowd, the second, both */
        scene s;
        scene_begin(&s, 0);
        s.options.no_blocks = s.options.allow_jumps = true;
        s.options.effort = 0x1p-7;
        for (int part = 0; part < 2; part++) {
            if (which != 2 && which != part) continue;
            rng g = {(uint64_t)(10 + part)};
            for (int k = 0; k < 12; k++)
                scene_add_box(&s, 100000 * part + 3 * rng_unit(&g), 3 * rng_unit(&g), 10, 7 + 3 * part);
        }
        scene_separate(&s);
        bound[which] = s.summary.lower_bound;
        cost[which] = s.summary.cost;
        scene_end(&s);
    }
    assert_true(fabs(bound[0] + bound[1] - bound[2]) <= 1e-12 * bound[2]);
    assert_true(fabs(cost[0] + cost[1] - cost[2]) <= 1e-12 * cost[2]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bound_is_near), cmocka_unit_test(test_bound_holds_of_other_layouts),
        cmocka_unit_test(test_limits_and_weights_count), cmocka_unit_test(test_far_crowds_add_up)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
