/* Gaps by classes: which tables are refused, and which gap two features, or a feature and a barrier, have to keep. The
 * property test test_displacement_optimum asks whole layers. */
#include "sunder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { HOUSES = 3 };

typedef struct town {
    sunder_shape *shape[HOUSES];
    sunder_layer *layer;
    sunder_layer_options options;
    sunder_report *report;
} town;

static const double road[4] = {100, -50, 100, 50};
static const size_t road_end[1] = {2};

/* Three boxes of 10 m in a line, 1 m apart, and a road 1 m right of them. */
static void begin(town *t, double gap)
{
    sunder_feature feature[HOUSES];
    sunder_error err;
    memset(t, 0, sizeof *t);
    sunder_layer_options_init(&t->options);
    t->options.gap = gap;
    t->options.no_blocks = true;
    for (size_t k = 0; k < HOUSES; k++) {
        const double x = 67 + 11 * (double)k, xy[8] = {x, 0, x + 10, 0, x + 10, 10, x, 10};
        const size_t ring_end[1] = {4}, poly_end[1] = {1};
        assert_int_equal(sunder_shape_from_rings(xy, ring_end, poly_end, 1, SUNDER_VALIDITY_STRICT, &t->shape[k], &err),
                         SUNDER_OK);
        feature[k] = (sunder_feature){.shape = t->shape[k], .weight = 1, .max_shift = INFINITY, .block = -1};
    }
    feature[1].fixed = true;
    assert_int_equal(sunder_layer_new(feature, HOUSES, &t->layer, &err), SUNDER_OK);
    const sunder_barrier barrier = {.geometry = {.xy = road, .line_end = road_end, .lines = 1}, .gap = -1};
    assert_int_equal(sunder_layer_set_barriers(t->layer, &barrier, 1, &err), SUNDER_OK);
}

static void end(town *t)
{
    sunder_report_free(t->report);
    sunder_layer_free(t->layer);
    for (size_t k = 0; k < HOUSES; k++) sunder_shape_free(t->shape[k]);
}

/* Returns the move along x of a house. */
static double shift(town *t, size_t house)
{
    sunder_error err;
    double dx, dy;
    sunder_report_free(t->report);
    t->report = NULL;
    assert_int_equal(sunder_layer_separate(t->layer, &t->options, &t->report, &err), SUNDER_OK);
    sunder_report_move(t->report, house, &dx, &dy);
    return dx;
}

static const uint32_t of[HOUSES] = {0, 1, 2}, of_road[1] = {3};

static sunder_status set(town *t, const double *gap, const double *full)
{
    sunder_error err;
    const sunder_gaps gaps = {.classes = 4, .gap = gap, .full_gap = full, .feature = of, .barrier = of_road};
    return sunder_layer_set_gaps(t->layer, &gaps, &err);
}

/* Sets both entries of two classes. */
static void put(double *table, size_t i, size_t j, double gap) { table[4 * i + j] = table[4 * j + i] = gap; }

static void test_each_pair_keeps_its_own(void **state)
{
    (void)state;
    town t;
    double gap[16] = {0};
    begin(&t, 4);
    put(gap, 0, 1, 3);
    put(gap, 1, 2, 1.25);
    put(gap, 2, 3, 0.5);
    assert_int_equal(set(&t, gap, NULL), SUNDER_OK);
    assert_true(fabs(shift(&t, 0) + 2) < 1e-9);    /* 3 m from the fixed house, 1 m before */
    assert_true(fabs(shift(&t, 2) - 0.25) < 1e-9); /* 1.25 m from it, and 0.75 m from the road */
    t.options.gap = 1.5;                           /* no pair keeps more than the layer's gap */
    assert_true(fabs(shift(&t, 0) + 0.5) < 1e-9);
    assert_int_equal(sunder_layer_set_gaps(t.layer, NULL, NULL), SUNDER_OK);
    assert_true(fabs(shift(&t, 0) + 0.5) < 1e-9);
    end(&t);
}

/* The road's own gap counts more than that of its class, and setting barriers anew removes the gaps. */
static void test_barriers(void **state)
{
    (void)state;
    town t;
    double gap[16] = {0};
    sunder_error err;
    begin(&t, 4);
    put(gap, 2, 3, 2);
    assert_int_equal(set(&t, gap, NULL), SUNDER_OK);
    assert_true(fabs(shift(&t, 2) + 1) < 1e-9);
    const sunder_barrier barrier = {.geometry = {.xy = road, .line_end = road_end, .lines = 1}, .gap = 1.5};
    assert_int_equal(sunder_layer_set_barriers(t.layer, &barrier, 1, &err), SUNDER_OK);
    assert_int_equal(set(&t, gap, NULL), SUNDER_OK);
    assert_true(fabs(shift(&t, 2) + 0.5) < 1e-9);
    assert_int_equal(sunder_layer_set_barriers(t.layer, &barrier, 1, &err), SUNDER_OK);
    shift(&t, 0);
    sunder_layer_summary summary;
    sunder_report_summary(t.report, &summary);
    assert_true(summary.cost > 1); /* all keep 4 m again */
    end(&t);
}

/* With a full gap a pair is tight between the two. */
static void test_full_gaps(void **state)
{
    (void)state;
    town t;
    double gap[16] = {0}, full[16] = {0};
    begin(&t, 2);
    t.options.full_gap = 4;
    t.options.ease = 30;
    put(gap, 0, 1, 2);
    put(full, 0, 1, 3);
    assert_int_equal(set(&t, gap, full), SUNDER_OK);
    const double moved = -shift(&t, 0);
    assert_true(moved > 1 && moved <= 2 + 1e-9); /* 2 to 3 m from the fixed house, which is 1 m away */
    t.options.full_gap = 0;                      /* not asked for */
    assert_true(fabs(shift(&t, 0) + 1) < 1e-9);
    end(&t);
}

static void test_refused(void **state)
{
    (void)state;
    town t;
    double gap[16] = {0}, full[16] = {0};
    const double bad[] = {-1, INFINITY, NAN};
    sunder_error err;
    begin(&t, 4);
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        put(gap, 1, 2, bad[k]);
        assert_int_equal(set(&t, gap, NULL), SUNDER_EARG);
    }
    put(gap, 1, 2, 2);
    assert_int_equal(set(&t, gap, full), SUNDER_EARG); /* the full gap is less */
    gap[4 * 1 + 2] = 1;
    assert_int_equal(set(&t, gap, NULL), SUNDER_EARG); /* not symmetric */
    gap[4 * 1 + 2] = 2;
    sunder_gaps gaps = {.classes = 3, .gap = gap, .feature = of, .barrier = of_road};
    put(gap, 0, 0, 0);
    assert_int_equal(sunder_layer_set_gaps(t.layer, &gaps, &err), SUNDER_EARG); /* the road's class is not there */
    gaps.classes = 0;
    assert_int_equal(sunder_layer_set_gaps(t.layer, &gaps, &err), SUNDER_EARG);
    end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_pair_keeps_its_own),
        cmocka_unit_test(test_barriers),
        cmocka_unit_test(test_full_gaps),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
