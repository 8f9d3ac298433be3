/* Passages without clearance: the cheapest layout leads through a passage exactly as wide as the body, which a margin
 * for rounding would close. */
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

/* A U that is open at the top, with a slot of width 6 from x = 6 to 12, and a box of width 6 that overlaps its left
 * arm. */
static void begin_slot(scene *s, double dx, double dy)
{
    char wkt[800];
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

/* Each moves half a unit, which brings the box into the slot; upwards out of the slot would cost 18. */
static void test_slot(void **state)
{
    (void)state;
    scene s;
    begin_slot(&s, 0, 0);
    check_optimal(&s, 0.5);
    scene_end(&s);
}

/* Coordinates are large, and their sums with thirds are rounded: by the weights the moves are 2/3 and 1/3. */
static void test_slot_far_away(void **state)
{
    (void)state;
    scene s;
    begin_slot(&s, 400000, 5200000);
    s.feature[0].weight = 2;
    check_optimal(&s, 2. / 3);
    scene_end(&s);
}

/* A row of three between walls that are exactly as far apart as the row needs. */
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
    check_optimal(&s, 0.25 + 1 + 0.25); /* the places are 0.5, 5 and 9.5 */
    scene_end(&s);
}

/* A slot that is too narrow by the last bit of the coordinates is not used. */
static void test_too_narrow(void **state)
{
    (void)state;
    scene s;
    begin_slot(&s, 0, 0);
    scene_add_box(&s, nextafter(12, 0), 4, 1, 8)->block = 3; /* an inner wall, in one block with the U */
    s.feature[0].block = 3;
    scene_separate(&s);
    assert_int_equal(scene_left(&s), 0);
    assert_true(s.summary.cost > 1);
    scene_end(&s);
}

static void separate_beside_all(scene *s, const sunder_barrier *barrier, size_t n)
{
    sunder_layer *layer = NULL;
    sunder_report_free(s->report);
    s->report = NULL;
    assert_int_equal(sunder_layer_new(s->feature, s->n, &layer, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_set_barriers(layer, barrier, n, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_separate(layer, &s->options, &s->report, NULL), SUNDER_OK);
    sunder_layer_free(layer);
    sunder_report_summary(s->report, &s->summary);
}

/* Separates beside lines of these widths, without sides; gap: that of the lines; negative: the layer's. */
static void separate_beside(scene *s, const double *const *xy, const size_t *points, const double *width, double gap,
                            size_t n)
{
    sunder_barrier barrier[4];
    assert_true(n <= 4);
    for (size_t k = 0; k < n; k++)
        barrier[k] = (sunder_barrier){{.xy = xy[k], .line_end = &points[k], .lines = 1}, width[k], gap, false, 0};
    separate_beside_all(s, barrier, n);
}

static void check_optimum(const scene *s, double cost)
{
    assert_int_equal(scene_left(s), 0);
    assert_true(fabs(s->summary.cost - cost) <= 1e-6 * cost);
    assert_int_equal(s->summary.clusters_optimal, 1);
}

/* A triangle exactly as wide as the slot of a U, near a slanted line with a rounded end. The place in the slot violated
 * a tangent of the line's obstacle by a rounding error. */
static void test_slot_beside_a_line(void **state)
{
    (void)state;
    const double first[] = {14, 6, 2, 13}, second[] = {12, 8, 2, 4, 0, 9}, width[] = {0.25, 0.75};
    const double *const xy[] = {first, second};
    const size_t points[] = {2, 3};
    scene s;
    scene_begin(&s, 0);
    s.options.allow_jumps = true;
    scene_add(&s, "POLYGON((4 2,12 2,12 8,11 8,11 3,5 3,5 8,4 8,4 2))")->weight = 2.25;
    scene_add(&s, "POLYGON((6 0,12 1,7 5,6 0))")->weight = 0.875;
    separate_beside(&s, xy, points, width, -1, 2);
    check_optimum(&s, 25.2308555);
    scene_end(&s);
}

/* Obstacles that may not be jumped over have shadows that overlap in narrow strips, so it takes long to prove that
 * halves of a region are covered; a slot ends at these strips. */
static void test_slot_among_shadows(void **state)
{
    (void)state;
    const double line[] = {12, 1, 4, 10, 4, 6}, width[] = {0};
    const double *const xy[] = {line};
    const size_t points[] = {3};
    scene s;
    scene_begin(&s, 0);
    scene_add_box(&s, 7, 5, 4, 8);
    scene_add(&s, "POLYGON((5 9,11 9,11 16,10 16,10 10,6 10,6 16,5 16,5 9))");
    scene_add(&s, "POLYGON((7 9,11 9,11 10,8 10,8 17,7 17,7 9))");
    separate_beside(&s, xy, points, width, -1, 1);
    check_optimum(&s, 16.940678);
    scene_end(&s);
}

/* A body moves along an axis by exactly its limit, to the last bit, so that its other coordinate may not change at
 * all. */
static void test_all_of_a_limit(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 0);
    s.options.allow_jumps = true;
    scene_add_box(&s, 2, 4, 7, 8);
    scene_add(&s, "POLYGON((0 9,4 9,4 16,3 16,3 10,1 10,1 16,0 16,0 9))")->max_shift = 1;
    scene_add(&s, "POLYGON((1 5,4 5,1 10,1 5))")->max_shift = 4.75;
    scene_add_box(&s, 10, 11, 1, 3)->fixed = true;
    scene_separate(&s);
    assert_int_equal(scene_left(&s), 0);
    assert_true(s.summary.cost < 3.7354);
    scene_end(&s);
}

/* A line and a point without width lie on diagonals between the convex pieces of a U: not inside either piece, but
 * inside the U. */
static void test_lines_hide_on_no_diagonal(void **state)
{
    (void)state;
    const double line[] = {5.625, 11.25, 3.375, 9, 11.25, 1.125}, grain[] = {5.625, 5.625}, width[] = {0, 0};
    const double *const xy[] = {line, grain};
    const size_t points[] = {3, 1};
    scene s;
    scene_begin(&s, 1.96875);
    scene_add(&s, "POLYGON((2.25 5.625,9 5.625,9 9,7.875 9,7.875 6.75,3.375 6.75,3.375 9,2.25 9,2.25 5.625))");
    separate_beside(&s, xy, points, width, 0, 2);
    check_optimum(&s, 10.7578125); /* the move is (2.8125, 1.6875) */
    scene_end(&s);
}

/* Beside a point that requires no distance, with gap 0: the search radius has to grow from zero. */
static void test_beside_a_point(void **state)
{
    (void)state;
    const double line[] = {12, 9, 5, -2, -1, 9}, point[] = {11, 6}, width[] = {0, 0};
    const double *const xy[] = {line, point};
    const size_t points[] = {3, 1};
    scene s;
    scene_begin(&s, 0);
    s.options.allow_jumps = true;
    scene_add(&s, "POLYGON((5 7,10 7,5 13,5 7))")->max_shift = 1.25;
    scene_add_box(&s, 6, 3, 8, 6)->max_shift = 5;
    separate_beside(&s, xy, points, width, -1, 2);
    assert_true(s.summary.cost == 9);
    scene_end(&s);
}

/* A body that fits exactly into a courtyard along one axis, and exactly beside a neighbour along the other, moves by
 * its full limit, in a slanted direction. */
static void test_limit_in_a_row(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 0);
    s.options.allow_jumps = true;
    scene_add(&s, "POLYGON((400000.125 5200000.75,400001 5200000.75,400001 5200001.75,400000.125 5200001.75,400000.125 "
                  "5200000.75),(400000.25 5200000.875,400000.25 5200001.625,400000.875 5200001.625,400000.875 "
                  "5200000.875,400000.25 5200000.875))")
        ->max_shift = 0.03125;
    scene_add(&s, "POLYGON((400000.375 5200001.125,400001 5200001.125,400001 5200001.625,400000.875 5200001.625,"
                  "400000.875 5200001.25,400000.5 5200001.25,400000.5 5200001.625,400000.375 5200001.625,400000.375 "
                  "5200001.125))");
    scene_add_box(&s, 400000.625, 5200000, 0.5, 0.875);
    scene_separate(&s);
    check_optimum(&s, 0.0221545815);
    scene_end(&s);
}

/* Two bodies that overlap each other and a fixed one, with jumps forbidden: the result is proved optimal. */
static void test_two_on_a_fixed_one(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 0.9375);
    s.options.no_blocks = true;
    s.options.touch_tolerance = 0;
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    scene_add(&s, "POLYGON((2.5 0,4.375 0,4.375 0.625,3.125 0.625,3.125 3.75,2.5 3.75,2.5 0))");
    scene_add(&s, "POLYGON((1.875 1.25,3.75 1.25,3.75 1.875,2.5 1.875,2.5 6.25,1.875 6.25,1.875 1.25))");
    scene_add(&s, "POLYGON((0.625 0.625,5 1.875,1.875 3.125,0.625 0.625))")->fixed = true;
    check_optimal(&s, 18.9192205076);
    scene_end(&s);
}

/* A move of two millimetres, without a gap, away from a feature 800 m long: proved like any other. */
static void test_small_move_beside_what_is_long(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 0);
    s.options.no_blocks = true;
    scene_add_box(&s, -400, -5, 800, 5)->fixed = true;
    scene_add_box(&s, 0, -0.001953125, 10, 8);
    scene_separate(&s);
    check_optimum(&s, 0.001953125 * 0.001953125);
    assert_true(s.summary.lower_bound > 0.9 * s.summary.cost);
    scene_end(&s);
}

/* If the two move half a unit each, the box is in the slot, and exactly half a unit from a line that was in contact
 * with nothing before. */
static void test_slot_beside_a_stranger(void **state)
{
    (void)state;
    const double line[] = {12, 14, 8, 14}, width[] = {0};
    const double *const xy[] = {line};
    const size_t points[] = {2};
    scene s;
    scene_begin(&s, 0);
    s.options.no_blocks = true;
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    scene_add(&s, "POLYGON((1 8,9 8,9 12,8 12,8 9,2 9,2 12,1 12,1 8))");
    scene_add_box(&s, 1, 8, 6, 8);
    separate_beside(&s, xy, points, width, 0.5, 1);
    check_optimum(&s, 1);
    scene_end(&s);
}

/* A triangle in a U is pushed away from a line, and the U has to stay within its limit: the two constraints meet at a
 * very small angle, so that alternating between them converges slowly. */
static void test_limit_beside_a_line(void **state)
{
    (void)state;
    const double line[] = {0.5, 1.75, 1.25, 0.875}, width[] = {0.03125};
    const double *const xy[] = {line};
    const size_t points[] = {2};
    scene s;
    scene_begin(&s, 0);
    s.options.no_blocks = true;
    s.options.allow_jumps = true;
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    scene_add(&s, "POLYGON((0.75 0.25,1.75 0.25,1.75 1.125,1.625 1.125,1.625 0.375,0.875 0.375,0.875 1.125,0.75 1.125,"
                  "0.75 0.25))")
        ->max_shift = 0.0625;
    scene_add(&s, "POLYGON((1 0.625,1.75 0.625,1 1.625,1 0.625))")->max_shift = 0.625;
    scene_add(&s, "POLYGON((1.125 1.125,1.625 1.25,1.75 1.75,1.25 1.625,1.125 1.125))")->max_shift = 0.53125;
    separate_beside(&s, xy, points, width, -1, 1);
    check_optimum(&s, 0.10905587915);
    scene_end(&s);
}

/* A body passes the corner of another as far as a third one pushes it: exactly there it would count as a jump, a
 * rounding error beside it not. The third has no clearance in x, in its courtyard. */
static void test_by_a_corner(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 0);
    s.options.no_blocks = true;
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    scene_add(&s, "POLYGON((400001 5200009,400006 5200009,400006 5200016,400001 5200016,400001 5200009),(400002 "
                  "5200010,400002 5200015,400005 5200015,400005 5200010,400002 5200010))");
    scene_add_box(&s, 400002, 5200004, 5, 8);
    scene_add(&s, "POLYGON((400002 5200006,400007 5200006,400007 5200007,400003 5200007,400003 5200010,400002 5200010,"
                  "400002 5200006))");
    const sunder_feature *pool = scene_add_box(&s, 400003, 5200011, 3, 1);
    s.n--; /* a barrier, not a feature */
    separate_beside_all(&s, &(sunder_barrier){.geometry = {.shape = pool->shape}, .gap = -1}, 1);
    check_optimum(&s, 18.5);
    s.n++;
    scene_end(&s);
}

/* To be separated from an obstacle, a box has to move by exactly its limit. */
static void test_all_of_a_limit_to_part(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 0);
    s.options.no_blocks = true;
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    scene_add(&s, "POLYGON((1 0,7 0,7 1,2 1,2 3,1 3,1 0))")->max_shift = 1;
    scene_add(&s, "POLYGON((4 9,11 11,13 14,6 12,4 9))")->max_shift = 4.5;
    scene_add(&s, "POLYGON((1 1,6 1,6 2,2 2,2 4,1 4,1 1))")->fixed = true;
    scene_separate(&s);
    check_optimum(&s, 1);
    scene_end(&s);
}

/* A box that fits exactly into a courtyard, gaps included, together with another body that is in its way. */
static void test_into_a_yard(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 2.25);
    s.options.no_blocks = true;
    s.options.allow_jumps = true;
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    scene_add_box(&s, 13.5, 3, 4.5, 4.5);
    scene_add(&s, "POLYGON((10.5 1.5,22.5 1.5,22.5 10.5,21 10.5,21 3,12 3,12 10.5,10.5 10.5,10.5 1.5))");
    scene_add_box(&s, 1.5, 9, 9, 7.5);
    const sunder_feature *pool = scene_add_box(&s, 7.5, 15, 3, 3);
    s.n--; /* a barrier, not a feature */
    separate_beside_all(&s, &(sunder_barrier){.geometry = {.shape = pool->shape}, .gap = 0.75}, 1);
    check_optimum(&s, 12.46875);
    s.n++;
    scene_end(&s);
}

/* A slot of zero width, along which a ray of the branching leads: a place on the ray may not be lost from both of its
 * cones. */
static void test_a_ray_along_a_slot(void **state)
{
    (void)state;
    const double line[] = {8, -1, -1, -1, 3, 14};
    const size_t points = 3;
    scene s;
    scene_begin(&s, 0);
    s.options.no_blocks = true;
    s.options.allow_jumps = true;
    scene_add(&s, "POLYGON((5 4,11 4,11 7,10 7,10 5,6 5,6 7,5 7,5 4))");
    scene_add(&s, "POLYGON((0 3,3 3,0 10,0 3))");
    const sunder_feature *pool = scene_add_box(&s, 7, 5, 2, 1);
    s.n--; /* a barrier, not a feature */
    const sunder_barrier barrier[] = {{{.xy = line, .line_end = &points, .lines = 1}, 0, 1, false, 0},
                                      {{.shape = pool->shape}, 1.5, 0.25, false, 0}};
    separate_beside_all(&s, barrier, 2);
    check_optimum(&s, 9.68350024);
    s.n++;
    scene_end(&s);
}

/* Four boxes press on each other in slanted directions, and one just passes a corner. Branching ends a few parts in ten
 * million below the cost, and further division improves nothing there. */
static void test_no_nearer_by_dividing(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 0);
    s.options.no_blocks = true;
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    scene_add(&s, "POLYGON((6 7,9 7,6 15,6 7))")->weight = 0.625;
    scene_add(&s, "POLYGON((7 9,11 11,9 14,7 9))")->weight = 3;
    sunder_feature *u = scene_add(&s, "POLYGON((5 3,12 3,12 11,11 11,11 4,6 4,6 11,5 11,5 3))");
    u->weight = 4;
    u->max_shift = 1;
    scene_add(&s, "POLYGON((4 8,8 9,9 12,5 11,4 8))")->weight = 3;
    scene_separate(&s);
    check_optimum(&s, 21.97375633);
    scene_end(&s);
}

/* Without limits the box would leave the ring by half a unit; with a limit of its own it stays inside, and the ring
 * moves: a pair that has a solution without limits is examined once more within them. */
static void test_within_limits_too(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 0);
    s.options.no_blocks = true;
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    scene_add(&s, "POLYGON((8 1,13 1,13 9,8 9,8 1),(9 2,9 8,12 8,12 2,9 2))");
    scene_add(&s, "POLYGON((2 8,6 8,6 15,2 15,2 8),(3 9,3 14,5 14,5 9,3 9))");
    scene_add(&s, "POLYGON((9 3,12 3,12 9,9 9,9 3),(10 4,10 8,11 8,11 4,10 4))")->max_shift = 0.25;
    scene_separate(&s);
    check_optimum(&s, 0.25 * 0.25 + 0.75 * 0.75);
    scene_end(&s);
}

/* A triangle moves along an axis by nearly its limit: the tiny amount by which the move is shorter than the limit
 * allows a move across the axis that is a thousand times larger. */
static void test_nothing_left_of_a_limit(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 0);
    s.options.no_blocks = true;
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    scene_add(&s, "POLYGON((5 5,10 6,6 11,5 5))");
    scene_add_box(&s, 3, 4, 8, 3)->max_shift = 1.25;
    scene_add(&s, "POLYGON((8 4,11 4,11 5,9 5,9 11,8 11,8 4))")->max_shift = 1.75;
    scene_separate(&s);
    assert_int_equal(scene_left(&s), 0);
    assert_true(s.summary.cost < 8.6875 * (1 + 1e-4) && s.summary.verified);
    scene_end(&s);
}

/* Two limits meet in one row: a house, which moves by its full limit, within a wall that is within another wall; its
 * limit leaves the row only positions along a circle. Found with random layers, where it cost five times as much. */
static void test_two_limits_in_a_row(void **state)
{
    (void)state;
    const double y = sqrt(2.25 * 2.25 - 1.6875 * 1.6875);
    scene s;
    scene_begin(&s, 0);
    scene_add(&s, "POLYGON((5.625 3.375,12.375 3.375,12.375 12.375,11.25 12.375,11.25 4.5,6.75 4.5,6.75 12.375,"
                  "5.625 12.375,5.625 3.375))");
    scene_add(&s, "POLYGON((6.75 7.875,12.375 7.875,12.375 12.375,11.25 12.375,11.25 9,7.875 9,7.875 12.375,"
                  "6.75 12.375,6.75 7.875))");
    scene_add(&s, "POLYGON((9 3.375,13.5 3.375,13.5 4.5,10.125 4.5,10.125 7.875,9 7.875,9 3.375))")->max_shift = 0.5625;
    scene_add(&s, "POLYGON((10.125 10.125,14.625 10.125,10.125 18,10.125 10.125))");
    s.feature[0].max_shift = 2.8125;
    s.feature[3].max_shift = 2.25;
    s.feature[0].block = s.feature[3].block = 7;
    s.options.allow_jumps = s.options.no_blocks = true;
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    scene_separate(&s);
    check_optimum(&s, 2 * 2.25 * 2.25 + 2 * 0.5625 * 0.5625 + (4.5 - y) * (4.5 - y));
    scene_end(&s);
}

/* Two limits that pull a row in opposite directions, far from the origin: the intersection of both limit discs is
 * narrow, but has room. Found with random layers. */
static void test_between_two_limits(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 0);
    scene_add(&s, "POLYGON((400001.5 5200000.75,400004.5 5200001.5,400005.25 5200006.75,400002.25 5200006,"
                  "400001.5 5200000.75))");
    scene_add(&s, "POLYGON((400001.5 5200002.25,400005.25 5200002.25,400005.25 5200003,400002.25 5200003,"
                  "400002.25 5200006.75,400001.5 5200006.75,400001.5 5200002.25))");
    scene_add(&s, "POLYGON((400002.25 5200000.75,400006.75 5200000.75,400006.75 5200003.75,400006 5200003.75,"
                  "400006 5200001.5,400003 5200001.5,400003 5200003.75,400002.25 5200003.75,400002.25 5200000.75))");
    scene_add_box(&s, 400005.25, 5200000.75, 3, 2.25);
    const double weight[] = {2.25, 2.875, 1, 1.625}, limit[] = {3, INFINITY, 1.875, 1.5};
    for (size_t k = 0; k < 4; k++) {
        s.feature[k].weight = weight[k];
        s.feature[k].max_shift = limit[k];
    }
    s.feature[0].block = s.feature[3].block = 7;
    s.options.allow_jumps = s.options.no_blocks = true;
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    scene_separate(&s);
    check_optimum(&s, 19.5714335818);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_slot_beside_a_line),
        cmocka_unit_test(test_slot_among_shadows),
        cmocka_unit_test(test_all_of_a_limit),
        cmocka_unit_test(test_slot),
        cmocka_unit_test(test_slot_far_away),
        cmocka_unit_test(test_row_between_walls),
        cmocka_unit_test(test_too_narrow),
        cmocka_unit_test(test_lines_hide_on_no_diagonal),
        cmocka_unit_test(test_limit_in_a_row),
        cmocka_unit_test(test_beside_a_point),
        cmocka_unit_test(test_small_move_beside_what_is_long),
        cmocka_unit_test(test_two_on_a_fixed_one),
        cmocka_unit_test(test_slot_beside_a_stranger),
        cmocka_unit_test(test_limit_beside_a_line),
        cmocka_unit_test(test_by_a_corner),
        cmocka_unit_test(test_all_of_a_limit_to_part),
        cmocka_unit_test(test_into_a_yard),
        cmocka_unit_test(test_a_ray_along_a_slot),
        cmocka_unit_test(test_no_nearer_by_dividing),
        cmocka_unit_test(test_within_limits_too),
        cmocka_unit_test(test_nothing_left_of_a_limit),
        cmocka_unit_test(test_two_limits_in_a_row),
        cmocka_unit_test(test_between_two_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
