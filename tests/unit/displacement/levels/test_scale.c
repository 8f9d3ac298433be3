/* Scaled features and squares, and the largest disc in a shape: named cases known by hand. */
#include "sunder_hiding.h"
#include "simple_polygon.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void check_discs(void **state)
{
    (void)state;
    static const struct {
        double xy[16], radius;
        size_t n;
    } cases[] = {{{0, 0, 10, 0, 10, 10, 0, 10}, 5, 4},
                 {{0, 0, 100, 0, 100, 4, 0, 4}, 2, 4},
                 {{0, 0, 3, 0, 0, 4}, 1, 3},                                  /* 3, 4, 5: the inscribed circle */
                 {{0, 0, 12, 0, 12, 4, 4, 4, 4, 12, 0, 12}, 2.3431457505, 6}, /* an L: against its inner corner */
                 {{1e6, 5e6, 1e6 + 7, 5e6 + 7, 1e6, 5e6 + 14, 1e6 - 7, 5e6 + 7}, 4.9497474683, 4}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        sunder_shape *shape = simple_polygon(cases[k].xy, cases[k].n);
        double at[2], radius;
        sunder_error err;
        assert_int_equal(sunder_shape_largest_disc(shape, at, &radius, &err), SUNDER_OK);
        if (radius > cases[k].radius * (1 + 1e-9) || radius < cases[k].radius * 0.995)
            fail_msg("case %zu: %.17g", k, radius);
        sunder_shape_free(shape);
    }
}

static void check_rungs(void **state)
{
    (void)state;
    const double square[] = {0, 0, 10, 0, 10, 10, 0, 10}, beside[] = {10, 0, 20, 0, 20, 10, 10, 10},
                 u[] = {40, 0, 60, 0, 60, 20, 55, 20, 55, 5, 45, 5, 45, 20, 40, 20};
    const double factor[] = {0.8, 0.6};
    sunder_shape *shape[] = {simple_polygon(square, 4), simple_polygon(u, 8), simple_polygon(beside, 4)}, *out[9];
    sunder_feature feature[3];
    sunder_layer *layer;
    sunder_layer_options options;
    sunder_error err;
    for (size_t k = 0; k < 3; k++)
        feature[k] = (sunder_feature){.shape = shape[k], .weight = 1, .max_shift = INFINITY, .block = -1};
    sunder_layer_options_init(&options);
    assert_int_equal(sunder_layer_new(feature, 2, &layer, &err), SUNDER_OK);
    sunder_scaling how = {factor, 2, 4, 0};
    assert_int_equal(sunder_layer_scale(layer, &options, &how, NULL, out, &err), SUNDER_OK);
    const double area[] = {64, 36, 16};
    for (size_t k = 0; k < 3; k++) {
        assert_true(out[k] && fabs(sunder_shape_area(out[k]) - area[k]) < 0.3);
        sunder_shape_free(out[k]);
    }
    assert_true(out[3] == NULL && out[4] == NULL && out[5] != NULL); /* a U leaves itself */
    sunder_shape_free(out[5]);
    sunder_layer_free(layer);

    assert_int_equal(sunder_layer_new(feature, 3, &layer, &err), SUNDER_OK); /* a block of two is not scaled */
    how.width = 5;
    assert_int_equal(sunder_layer_scale(layer, &options, &how, NULL, out, &err), SUNDER_OK);
    for (size_t k = 0; k < 9; k++) assert_int_equal(out[k] != NULL, k % 3 == 2);
    for (size_t k = 0; k < 9; k++) sunder_shape_free(out[k]);
    how.factor = (const double[]){0.5, 0.9};
    assert_int_equal(sunder_layer_scale(layer, &options, &how, NULL, out, &err), SUNDER_EARG);
    how = (sunder_scaling){NULL, 0, -1, 0};
    assert_int_equal(sunder_layer_scale(layer, &options, &how, NULL, out, &err), SUNDER_EARG);
    sunder_layer_free(layer);
    for (size_t k = 0; k < 3; k++) sunder_shape_free(shape[k]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_discs), cmocka_unit_test(check_rungs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
