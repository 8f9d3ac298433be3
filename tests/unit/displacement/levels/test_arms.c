/* Arms that a cut leaves too thin: named cases with areas known by hand. */
#include "failing.h"
#include "random.h"
#include "simple_polygon.h"
#include "sunder_hiding.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Moves the outline of one house in by a half, with a least width of 3. */
static sunder_status move_in(const sunder_shape *house, sunder_shape **out)
{
    static const double half = 0.5;
    const sunder_feature feature = {.shape = house, .weight = 1, .max_shift = INFINITY, .block = -1};
    const sunder_inset how = {&half, 1, 3};
    sunder_layer *layer = NULL;
    sunder_layer_options options;
    sunder_layer_options_init(&options);
    *out = NULL;
    sunder_status status = sunder_layer_new(&feature, 1, &layer, NULL);
    if (!status) status = sunder_layer_inset(layer, &options, &how, NULL, out, NULL);
    sunder_layer_free(layer);
    return status;
}

static const double wing[] = {0, 0, 20, 0, 20, 3.5, 10, 3.5, 10, 10, 0, 10};

static void check_outlines(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double xy[24], area; /* 0: nothing is left */
        size_t n;
    } cases[] = {{"a wing is cut off in line with the house", {0, 0, 20, 0, 20, 3.5, 10, 3.5, 10, 10, 0, 10}, 81, 6},
                 {"a wing that is wide enough", {0, 0, 20, 0, 20, 4.25, 10, 4.25, 10, 10, 0, 10}, 81 + 10 * 3.25, 6},
                 {"a wing that is shorter than wide", {0, 0, 13, 0, 13, 3.5, 10, 3.5, 10, 10, 0, 10}, 81 + 3 * 2.5, 6},
                 {"a bridge: the larger half", {0, 0, 30, 0, 30, 9, 20, 9, 20, 3.5, 10, 3.5, 10, 10, 0, 10}, 81, 8},
                 {"two wings", {0, 0, 10, 0, 10, 6.5, 20, 6.5, 20, 10, -10, 10, -10, 6.5, 0, 6.5}, 81, 8},
                 {"a bent wing", {0, 0, 20, 0, 20, 12, 16.5, 12, 16.5, 3.5, 10, 3.5, 10, 10, 0, 10}, 81, 8},
                 {"nothing but thin", {0, 0, 20, 0, 20, 3.5, 0, 3.5}, 0, 4}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        sunder_shape *shape = simple_polygon(cases[k].xy, cases[k].n), *left;
        assert_int_equal(move_in(shape, &left), SUNDER_OK);
        const double area = left ? sunder_shape_area(left) : 0;
        if (fabs(area - cases[k].area) > 1e-9) fail_msg("%s: %.17g is left", cases[k].name, area);
        sunder_shape_free(left);
        sunder_shape_free(shape);
    }
}

/* A thin side of a yard: cut off at both ends, so that the yard is open, or the ring around two yards has one less. */
static void check_yards(void **state)
{
    (void)state;
    static const double yards[] = {0,  0,  40, 0,   40, 20, 0,  20, 5,  3.5, 5,  15,
                                   15, 15, 15, 3.5, 25, 5,  25, 15, 35, 15,  35, 5};
    for (size_t holes = 1; holes <= 2; holes++) {
        const size_t ring_end[] = {4, 8, 12}, poly_end = 1 + holes;
        sunder_shape *shape, *left;
        assert_int_equal(sunder_shape_from_rings(yards, ring_end, &poly_end, 1, SUNDER_VALIDITY_STRICT, &shape, NULL),
                         SUNDER_OK);
        assert_int_equal(move_in(shape, &left), SUNDER_OK);
        const double other = holes == 2 ? 11 * 11 : 0;
        assert_true(fabs(sunder_shape_area(left) - (39 * 19 - 11 * 15 - other)) < 1e-9);
        sunder_shape_free(left);
        sunder_shape_free(shape);
    }
}

/* A barrier beside one end of a house. A wing at its other end was as thin before, and stays; a wing that the barrier
 * makes thin goes. */
static void check_thin_before(void **state)
{
    (void)state;
    static const double roads[2][4] = {{-1, -50, -1, 50}, {-50, -1, 50, -1}};
    static const size_t line_end[] = {2};
    static const double house[] = {0, 0, 20, 0, 20, 2.9, 10, 2.9, 10, 10, 0, 10};
    for (int k = 0; k < 2; k++) {
        const sunder_barrier barrier = {{.xy = roads[k], .line_end = line_end, .lines = 1}, 0, 1.5, true, 0};
        sunder_shape *shape = simple_polygon(house, 6), *left;
        const sunder_feature feature = {.shape = shape, .weight = 1, .max_shift = INFINITY, .block = -1};
        sunder_layer *layer;
        sunder_layer_options options;
        sunder_layer_options_init(&options);
        assert_int_equal(sunder_layer_new(&feature, 1, &layer, NULL), SUNDER_OK);
        assert_int_equal(sunder_layer_set_barriers(layer, &barrier, 1, NULL), SUNDER_OK);
        assert_int_equal(sunder_layer_trim(layer, &options, &(sunder_trimming){0.5, 3}, &left, NULL), SUNDER_OK);
        const double area = k ? 10 * 9.5 : 9.5 * 10 + 10 * 2.9;
        assert_true(fabs(sunder_shape_area(left) - area) < 1e-9);
        sunder_shape_free(left);
        sunder_layer_free(layer);
        sunder_shape_free(shape);
    }
}

static double distance_to_edges(const double *xy, size_t n, double x, double y)
{
    double least = INFINITY;
    for (size_t k = 0, before = n - 1; k < n; before = k++) {
        const double *p = xy + 2 * before, *q = xy + 2 * k, u = q[0] - p[0], v = q[1] - p[1];
        const double t = fmax(0, fmin(1, (u * (x - p[0]) + v * (y - p[1])) / (u * u + v * v)));
        least = fmin(least, hypot(x - p[0] - t * u, y - p[1] - t * v));
    }
    return least;
}

/* Fails if what is left of a house has not its distance from the outline, also along the cuts. */
static void demand_distance(const double *xy, size_t corners, size_t number)
{
    enum { STEPS = 16 };
    sunder_shape *shape = simple_polygon(xy, corners), *left;
    assert_int_equal(move_in(shape, &left), SUNDER_OK);
    size_t n = 0;
    const double *ring = left ? sunder_shape_ring(left, 0, 0, &n) : NULL;
    for (size_t k = 0, before = n ? n - 1 : 0; k < n; before = k++)
        for (int step = 0; step < STEPS; step++) {
            const double t = (double)step / STEPS, *p = ring + 2 * before, *q = ring + 2 * k;
            const double x = p[0] + t * (q[0] - p[0]), y = p[1] + t * (q[1] - p[1]);
            const double distance = distance_to_edges(xy, corners, x, y);
            if (distance < 0.5 - 1e-9) fail_msg("house %zu: %.17g from the outline", number, distance);
        }
    sunder_shape_free(left);
    sunder_shape_free(shape);
}

/* A wall that bends away beyond the last disc: a cut at right angles to the other wall must not cross it. And stars. */
static void check_distance_kept(void **state)
{
    (void)state;
    enum { CORNERS = 9 };
    static const double bent[] = {0.2,  8.62, 1.58, 3.45, 2.35,  0.59, 3.48, 0.64, 3.05, 4.03,
                                  6.66, 4.9,  8.22, 1.43, 11.26, 2.68, 8.61, 6.87, 6.74, 10.6};
    demand_distance(bent, 10, 0);
    for (size_t i = 0; i < test_count(400); i++) {
        rng r = rng_start(test_seed(), i);
        double xy[2 * CORNERS];
        for (int k = 0; k < CORNERS; k++) {
            const double angle = 2 * acos(-1) * (k + 0.7 * rng_unit(&r)) / CORNERS, far = 4 + 12 * rng_unit(&r);
            xy[2 * k] = far * cos(angle);
            xy[2 * k + 1] = far * sin(angle);
        }
        demand_distance(xy, CORNERS, i + 1);
    }
}

static bool attempt(void *context)
{
    sunder_shape *left;
    const sunder_status status = move_in(context, &left);
    sunder_shape_free(left);
    assert_true(status == SUNDER_OK || status == SUNDER_ENOMEM);
    return status == SUNDER_OK;
}

static void check_without_memory(void **state)
{
    (void)state;
    sunder_shape *shape = simple_polygon(wing, 6);
    failing_begin();
    const bool sound = failing_loop(attempt, shape, true);
    failing_end();
    assert_true(sound);
    sunder_shape_free(shape);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_outlines), cmocka_unit_test(check_yards),
                                       cmocka_unit_test(check_thin_before), cmocka_unit_test(check_distance_kept),
                                       cmocka_unit_test(check_without_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
