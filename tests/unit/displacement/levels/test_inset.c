/* Blocks with their outlines moved in: named cases with areas known by hand. */
#include "random.h"
#include "simple_polygon.h"
#include "sunder_hiding.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 3 };

/* Moves the outline of the block of these features in by each length. */
static void inset(sunder_shape *const *feature, size_t n, double tolerance, const sunder_inset *how, sunder_shape **out)
{
    sunder_feature features[MOST];
    sunder_layer *layer;
    sunder_layer_options options;
    sunder_error err;
    for (size_t k = 0; k < n; k++)
        features[k] = (sunder_feature){.shape = feature[k], .weight = 1, .max_shift = INFINITY, .block = -1};
    sunder_layer_options_init(&options);
    options.gap = 3;
    options.touch_tolerance = tolerance;
    assert_int_equal(sunder_layer_new(features, n, &layer, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_inset(layer, &options, how, NULL, out, &err), SUNDER_OK);
    sunder_layer_free(layer);
}

static void free_all(sunder_shape **shape, size_t n)
{
    for (size_t k = 0; k < n; k++) sunder_shape_free(shape[k]);
}

static void check_single_polygons(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double xy[24], area; /* by an inset of 1; 0: nothing is left */
        size_t n;
    } cases[] = {{"square", {0, 0, 10, 0, 10, 10, 0, 10}, 64, 4},
                 {"too narrow", {0, 0, 10, 0, 10, 2, 0, 2}, 0, 4},
                 {"L: the inner corner stays sharp", {0, 0, 10, 0, 10, 5, 5, 5, 5, 10, 0, 10}, 39, 6},
                 {"a slit, of no width at its tip", {0, 0, 12, 0, 12, 12, 7, 12, 6, 4, 5, 12, 0, 12}, -1, 7},
                 {"two halves: the larger one",
                  {0, 0, 10, 0, 10, 4, 11, 4, 11, 0, 17, 0, 17, 6, 11, 6, 11, 5, 10, 5, 10, 10},
                  -1,
                  11}};
    const double one = 1;
    const sunder_inset how = {&one, 1, 0};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        sunder_shape *shape = simple_polygon(cases[k].xy, cases[k].n), *left;
        inset(&shape, 1, -1, &how, &left);
        const double area = left ? sunder_shape_area(left) : 0;
        if (cases[k].area >= 0 && fabs(area - cases[k].area) > 1e-9) fail_msg("%s: %.17g is left", cases[k].name, area);
        assert_true(cases[k].area >= 0 || (area > 0 && area < sunder_shape_area(shape)));
        sunder_shape_free(left);
        sunder_shape_free(shape);
    }
}

/* What is left of two or three houses: the walls between them stay. */
static void check_blocks(void **state)
{
    (void)state;
    const double a[] = {0, 0, 10, 0, 10, 10, 0, 10}, b[] = {10, 0, 20, 0, 20, 10, 10, 10},
                 apart[] = {10.1, 0, 20.1, 0, 20.1, 10, 10.1, 10}, lower[] = {10, 2, 20, 2, 20, 8, 10, 8},
                 part[] = {2, 2, 4, 2, 4, 10, 2, 10};
    const double lengths[] = {1, 2};
    const sunder_inset how = {lengths, 2, 0};
    sunder_shape *house[MOST] = {simple_polygon(a, 4), simple_polygon(b, 4), NULL}, *left[2 * MOST];
    inset(house, 2, 0, &how, left);
    assert_true(fabs(sunder_shape_area(left[0]) - 9 * 8) < 1e-9 && fabs(sunder_shape_area(left[3]) - 8 * 6) < 1e-9);
    free_all(left, 4);
    sunder_shape_free(house[1]);

    house[1] = simple_polygon(apart, 4); /* walls that gape: inner within the tolerance */
    inset(house, 2, 0.2, &how, left);
    assert_true(fabs(sunder_shape_area(left[0]) - 9 * 8) < 1e-9 && fabs(sunder_shape_area(left[2]) - 9 * 8) < 1e-9);
    free_all(left, 4);
    inset(house, 2, 0.05, &how, left);
    assert_true(fabs(sunder_shape_area(left[0]) - 8 * 8) < 1e-9);
    free_all(left, 4);
    sunder_shape_free(house[1]);

    house[1] = simple_polygon(lower, 4); /* a wall that is longer on one side: its ends are outline */
    inset(house, 2, 0, &how, left);
    assert_true(fabs(sunder_shape_area(left[2]) - 9 * 4) < 1e-9);
    assert_true(fabs(sunder_shape_area(left[0]) - (9 * 8 - 2 * 2)) < 1e-9);
    free_all(left, 4);
    sunder_shape_free(house[1]);

    house[1] = simple_polygon(part, 4); /* inside of the other one, up to its outline */
    inset(house, 2, 0, &how, left);
    assert_true(fabs(sunder_shape_area(left[0]) - 8 * 8) < 1e-9 && fabs(sunder_shape_area(left[2]) - 2 * 7) < 1e-9);
    free_all(left, 4);
    free_all(house, 2);
}

/* Rungs from other shapes; a least width; lengths out of range. */
static void check_conditions(void **state)
{
    (void)state;
    const double a[] = {0, 0, 10, 0, 10, 10, 0, 10}, half[] = {0, 0, 5, 0, 5, 10, 0, 10};
    const double lengths[] = {1, 2, 2.4}, wrong[] = {1, 1}, negative = -1;
    sunder_shape *house = simple_polygon(a, 4), *from = simple_polygon(half, 4), *left[3];
    const sunder_feature feature = {.shape = house, .weight = 1, .max_shift = INFINITY, .block = -1};
    sunder_layer *layer;
    sunder_layer_options options;
    sunder_error err;
    sunder_layer_options_init(&options);
    assert_int_equal(sunder_layer_new(&feature, 1, &layer, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_inset(layer, &options, &(sunder_inset){lengths, 3, 1}, &from, left, &err), SUNDER_OK);
    assert_true(fabs(sunder_shape_area(left[0]) - 3 * 8) < 1e-9);
    assert_true(left[1] == NULL && left[2] == NULL); /* 1 m wide: the polygon around the disc does not fit */
    sunder_shape_free(left[0]);
    assert_int_equal(sunder_layer_inset(layer, &options, &(sunder_inset){wrong, 2, 0}, NULL, left, &err), SUNDER_EARG);
    assert_int_equal(sunder_layer_inset(layer, &options, &(sunder_inset){&negative, 1, 0}, NULL, left, &err),
                     SUNDER_EARG);
    assert_int_equal(sunder_layer_inset(layer, &options, &(sunder_inset){lengths, 1, NAN}, NULL, left, &err),
                     SUNDER_EARG);
    assert_null(left[0]);
    sunder_layer_free(layer);
    sunder_shape_free(house);
    sunder_shape_free(from);
}

/* One of two houses is trimmed. What it no longer covers of their wall is outline. */
static void check_trimmed_neighbour(void **state)
{
    (void)state;
    const double a[] = {0, 0, 10, 0, 10, 10, 0, 10}, b[] = {10, 0, 20, 0, 20, 10, 10, 10},
                 less[] = {0, 3, 10, 3, 10, 10, 0, 10}, one = 1;
    sunder_shape *const house[] = {simple_polygon(a, 4), simple_polygon(b, 4)};
    sunder_shape *from[] = {simple_polygon(less, 4), NULL}, *left[2];
    const sunder_feature feature[] = {{.shape = house[0], .weight = 1, .max_shift = INFINITY, .block = -1},
                                      {.shape = house[1], .weight = 1, .max_shift = INFINITY, .block = -1}};
    sunder_layer *layer;
    sunder_layer_options options;
    sunder_error err;
    sunder_layer_options_init(&options);
    assert_int_equal(sunder_layer_new(feature, 2, &layer, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_inset(layer, &options, &(sunder_inset){&one, 1, 0}, from, left, &err), SUNDER_OK);
    assert_true(fabs(sunder_shape_area(left[0]) - 9 * 5) < 1e-9);
    assert_true(fabs(sunder_shape_area(left[1]) - (9 * 8 - 1 * 3)) < 1e-9);
    sunder_layer_free(layer);
    free_all(left, 2);
    free_all(from, 1);
    sunder_shape_free(house[0]);
    sunder_shape_free(house[1]);
}

static double shortest_edge(const sunder_shape *shape)
{
    double least = INFINITY;
    size_t n;
    const double *xy = sunder_shape_ring(shape, 0, 0, &n);
    for (size_t k = 0, before = n - 1; k < n; before = k++)
        least = fmin(least, hypot(xy[2 * k] - xy[2 * before], xy[2 * k + 1] - xy[2 * before + 1]));
    return least;
}

/* Two houses whose fronts are in one line, with a wall between them whose ends differ by rounding: one house may end
 * beside the other one, by less than rounding. That is no side of the block, and leaves no spike between strips. */
static void check_wall_off_by_rounding(void **state)
{
    (void)state;
    static const double local[2][8] = {{0, 0, 15, 0, 11, 9, 0, 9}, {15, 0, 30, 0, 30, 9, 11, 9}};
    const double length = 1.25;
    for (size_t i = 0; i < test_count(300); i++) {
        rng r = rng_start(test_seed(), i);
        const double a = 6.3 * rng_unit(&r), x = 545480 + rng_unit(&r), y = 5361868 + rng_unit(&r);
        sunder_shape *house[2], *left[2];
        for (int h = 0; h < 2; h++) {
            double xy[8];
            for (int k = 0; k < 4; k++) {
                const double *p = local[h] + 2 * k, off = ldexp((double)rng_int(&r, -2, 2), -30);
                xy[2 * k] = x + cos(a) * p[0] - sin(a) * p[1] + off;
                xy[2 * k + 1] = y + sin(a) * p[0] + cos(a) * p[1] - off;
            }
            house[h] = simple_polygon(xy, 4);
        }
        inset(house, 2, 0.05, &(sunder_inset){&length, 1, 0}, left);
        for (int h = 0; h < 2; h++)
            if (!left[h] || shortest_edge(left[h]) < 0.1) fail_msg("house %d of case %zu has a spike", h, i);
        free_all(left, 2);
        free_all(house, 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_single_polygons), cmocka_unit_test(check_blocks),
                                       cmocka_unit_test(check_trimmed_neighbour), cmocka_unit_test(check_conditions),
                                       cmocka_unit_test(check_wall_off_by_rounding)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
