/* Places with no room to spare: the cheapest layout leads through a passage just as wide as what goes in, which a
 * margin for rounding would close. */
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

/* A U that is open to the top, its slot 6 wide from x = 6 to 12, and a box 6 wide that stands in its left arm. */
static void begin_slot(scene *s, double dx, double dy)
{
    char wkt[400];
    scene_begin(s, 0);
    snprintf(wkt, sizeof wkt,
             "POLYGON((%.17g %.17g,%.17g %.17g,%.17g %.17g,%.17g %.17g,%.17g %.17g,%.17g %.17g,%.17g %.17g,%.17g "
             "%.17g,%.17g %.17g))",
             dx + 5, dy + 4, dx + 13, dy + 4, dx + 13, dy + 12, dx + 12, dy + 12, dx + 12, dy + 5, dx + 6, dy + 5,
             dx + 6, dy + 12, dx + 5, dy + 12, dx + 5, dy + 4);
    scene_add(s, wkt);
    scene_add_box(s, dx + 5, dy + 6, 6, 9);
}

static void check_optimal(scene *s, double cost)
{
    scene_separate(s);
    assert_int_equal(scene_left(s), 0);
    assert_true(fabs(s->summary.cost - cost) <= 1e-6 * cost);
    assert_true(s->summary.lower_bound >= s->summary.cost * (1 - 2e-6));
    assert_int_equal(s->summary.clusters_optimal, s->summary.clusters);
    assert_true(s->summary.verified);
}

/* Half a unit each, into the slot; up and out of it would be 18. */
static void test_slot(void **state)
{
    (void)state;
    scene s;
    begin_slot(&s, 0, 0);
    check_optimal(&s, 0.5);
    scene_end(&s);
}

/* Where coordinates are large, and their sums with thirds are rounded: the weights ask for 2/3 and 1/3. */
static void test_slot_far_away(void **state)
{
    (void)state;
    scene s;
    begin_slot(&s, 400000, 5200000);
    s.feature[0].weight = 2;
    check_optimal(&s, 2. / 3);
    scene_end(&s);
}

/* A row of three between walls, just as long as there is room. */
static void test_row_between_walls(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 0.5);
    scene_add_box(&s, -10, -20, 10, 40)->fixed = true;
    scene_add_box(&s, 14, -20, 10, 40)->fixed = true;
    scene_add_box(&s, 1, 0, 4, 16);
    scene_add_box(&s, 4, 0, 4, 16);
    scene_add_box(&s, 9, 0, 4, 16);
    check_optimal(&s, 0.25 + 1 + 0.25); /* at 0.5, 5 and 9.5 */
    scene_end(&s);
}

/* A slot narrower than what would go in by the last bit of its coordinates is none. */
static void test_too_narrow(void **state)
{
    (void)state;
    scene s;
    begin_slot(&s, 0, 0);
    scene_add_box(&s, nextafter(12, 0), 4, 1, 8)->block = 3; /* a facing, of one block with the U */
    s.feature[0].block = 3;
    scene_separate(&s);
    assert_int_equal(scene_left(&s), 0);
    assert_true(s.summary.cost > 1);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_slot),
        cmocka_unit_test(test_slot_far_away),
        cmocka_unit_test(test_row_between_walls),
        cmocka_unit_test(test_too_narrow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
