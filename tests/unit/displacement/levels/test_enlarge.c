/* Blocks made larger: named cases with boxes known by hand. */
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

/* Calls sunder_layer_enlarge() for a layer of n features. The gap is 3, and the touch tolerance 0.3. */
static sunder_status enlarge(sunder_shape *const *feature, const int64_t *block, size_t n, const sunder_enlarging *how,
                             sunder_shape **out, int64_t *number)
{
    sunder_feature features[MOST];
    sunder_layer *layer;
    sunder_layer_options options;
    sunder_error err;
    for (size_t k = 0; k < n; k++)
        features[k] = (sunder_feature){.shape = feature[k],
                                       .weight = 1,
                                       .max_shift = INFINITY,
                                       .block = block ? block[k] : -1,
                                       .ignored = !feature[k]};
    sunder_layer_options_init(&options);
    options.gap = 3;
    assert_int_equal(sunder_layer_new(features, n, &layer, &err), SUNDER_OK);
    const sunder_status status = sunder_layer_enlarge(layer, &options, how, out, number, &err);
    sunder_layer_free(layer);
    return status;
}

static void free_all(sunder_shape **shape, size_t n)
{
    for (size_t k = 0; k < n; k++) sunder_shape_free(shape[k]);
}

static void assert_box(const sunder_shape *shape, double x0, double y0, double x1, double y1, double within)
{
    double box[4];
    assert_non_null(shape);
    sunder_shape_box(shape, box);
    const double want[4] = {x0, y0, x1, y1};
    for (int c = 0; c < 4; c++)
        if (fabs(box[c] - want[c]) > within) fail_msg("box %.17g %.17g %.17g %.17g", box[0], box[1], box[2], box[3]);
}

/* Single features, to a least size of 8: the sides of their boxes. */
static void check_single_features(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double xy[20], width, height, within; /* of the box after; 0: it keeps its shape */
        size_t n;
    } cases[] = {
        {"large enough", {96, 196, 104, 196, 104, 204, 96, 204}, 0, 0, 0, 4},
        {"below by a two-thousandth", {96.001, 196, 103.999, 196, 103.999, 204, 96.001, 204}, 0, 0, 0, 4},
        {"a square", {98, 198, 102, 198, 102, 202, 98, 202}, 8, 8, 0, 4},
        {"long: it becomes deeper, and not longer", {80, 199, 120, 199, 120, 201, 80, 201}, 40, 8, 0, 4},
        {"both sides too short", {98, 199, 102, 199, 102, 201, 98, 201}, 8, 8, 0, 4},
        {"a diamond", {100, 198, 102, 200, 100, 202, 98, 200}, 8 * 1.4142135623730951, 8 * 1.4142135623730951, 1e-9, 4},
        /* Stretched to a height of 8 it has sides of 10, 10 and 12, and a disc of diameter 6. */
        {"a triangle", {94, 198, 106, 198, 100, 202}, 16, 32 / 3., 0.03, 3},
        /* The inner corner of an L of arms of 4 lets in a disc of diameter 4 (2 + sqrt 2) / (1 + sqrt 2) = 4.6863. */
        {"an L",
         {90, 190, 110, 190, 110, 194, 94, 194, 94, 210, 90, 210},
         20 * 8 / 4.6862915,
         20 * 8 / 4.6862915,
         0.3,
         6},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        sunder_shape *shape = simple_polygon(cases[k].xy, cases[k].n), *out;
        int64_t block;
        const sunder_enlarging how = {8, NULL};
        print_message("%s\n", cases[k].name);
        assert_int_equal(enlarge(&shape, NULL, 1, &how, &out, &block), SUNDER_OK);
        assert_int_equal(block, -1);
        double box[4] = {0, 0, 0, 0};
        assert_int_equal(out != NULL, cases[k].width > 0);
        if (out) sunder_shape_box(out, box);
        if (fabs(box[2] - box[0] - cases[k].width) > cases[k].within ||
            fabs(box[3] - box[1] - cases[k].height) > cases[k].within)
            fail_msg("%.17g by %.17g", box[2] - box[0], box[3] - box[1]);
        sunder_shape_free(out);
        sunder_shape_free(shape);
    }
}

/* Two houses 4 m deep with a wall at x = 5.3 become 8 m deep; the wall stays, and so does one of a single house. */
static void check_blocks(void **state)
{
    (void)state;
    const double a[] = {0, 0, 5.3, 0, 5.3, 4, 0, 4}, b[] = {5.3, 0, 30, 0, 30, 4, 5.3, 4},
                 far[] = {40, 0, 44, 0, 44, 4, 40, 4};
    sunder_shape *shape[] = {simple_polygon(a, 4), simple_polygon(b, 4), simple_polygon(far, 4)}, *out[MOST];
    int64_t block[MOST];
    sunder_enlarging how = {8, NULL};
    assert_int_equal(enlarge(shape, NULL, 3, &how, out, block), SUNDER_OK);
    assert_true(block[0] == 0 && block[1] == 0 && block[2] == -1);
    assert_box(out[0], 0, -2, 5.3, 6, 0);
    assert_box(out[1], 5.3, -2, 30, 6, 0);
    assert_box(out[2], 38, -2, 46, 6, 0);
    free_all(out, 3);

    /* A rigid member keeps its whole block as it is; so does one that is ignored, which is in no block. */
    how.rigid = (const bool[]){false, true, false};
    assert_int_equal(enlarge(shape, NULL, 3, &how, out, block), SUNDER_OK);
    assert_true(!out[0] && !out[1] && out[2]);
    free_all(out, 3);

    /* Parts of a block of numbers grow by themselves, about their own middles. */
    assert_int_equal(enlarge(shape, (const int64_t[]){7, 7, 7}, 3, &(sunder_enlarging){8, NULL}, out, block),
                     SUNDER_OK);
    assert_true(block[2] == 0);
    assert_box(out[1], 5.3, -2, 30, 6, 0);
    assert_box(out[2], 38, -2, 46, 6, 0);
    free_all(out, 3);
    free_all(shape, 3);
}

/* A feature of two squares of 4 m: apart, each grows; so near that they would meet, they grow as one. */
static void check_parts(void **state)
{
    (void)state;
    for (int near = 0; near < 2; near++) {
        const double x = near ? 6 : 20, xy[] = {0, 0, 4, 0, 4, 4, 0, 4, x, 0, x + 4, 0, x + 4, 4, x, 4};
        const size_t ring_end[] = {4, 8}, poly_end[] = {1, 2};
        sunder_shape *shape, *out;
        sunder_error err;
        int64_t block;
        assert_int_equal(sunder_shape_from_rings(xy, ring_end, poly_end, 2, SUNDER_VALIDITY_STRICT, &shape, &err),
                         SUNDER_OK);
        assert_int_equal(enlarge(&shape, NULL, 1, &(sunder_enlarging){8, NULL}, &out, &block), SUNDER_OK);
        assert_int_equal(sunder_shape_polygons(out), 2);
        if (near)
            assert_box(out, -5, -2, 15, 6, 0.1);
        else
            assert_box(out, -2, -2, 26, 6, 0);
        sunder_shape_free(out);
        sunder_shape_free(shape);
    }
}

static void check_refusals(void **state)
{
    (void)state;
    const double xy[] = {0, 0, 5, 0, 5, 5, 0, 5};
    sunder_shape *shape = simple_polygon(xy, 4), *out;
    int64_t block;
    static const double wrong[] = {0, -1, INFINITY, NAN};
    for (size_t k = 0; k < 4; k++) {
        assert_int_equal(enlarge(&shape, NULL, 1, &(sunder_enlarging){wrong[k], NULL}, &out, &block), SUNDER_EARG);
        assert_null(out);
    }
    assert_int_equal(enlarge(&shape, NULL, 1, &(sunder_enlarging){1.7e308, NULL}, &out, &block), SUNDER_OK);
    sunder_shape_free(out);
    sunder_shape *thin = simple_polygon((const double[]){1.5e308, 0, 1.7e308, 0, 1.7e308, 1, 1.5e308, 1}, 4);
    assert_int_equal(enlarge(&thin, NULL, 1, &(sunder_enlarging){1.7e308, NULL}, &out, &block), SUNDER_ERANGE);
    assert_null(out);
    sunder_shape_free(thin);
    sunder_shape *none = NULL; /* ignored */
    assert_int_equal(enlarge(&none, NULL, 1, &(sunder_enlarging){8, NULL}, &out, &block), SUNDER_OK);
    assert_true(out == NULL && block == -1);
    sunder_shape_free(shape);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_single_features), cmocka_unit_test(check_blocks),
                                       cmocka_unit_test(check_parts), cmocka_unit_test(check_refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
