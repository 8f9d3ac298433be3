/* displacement/hide/hiding: features with many levels, through the public functions; and levels that are refused. */
#include "sunder_hiding.h"

#include "scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { LEVELS = 50 };

/* Makes shapes, each a metre shorter than the one before: from 0 to 99, ..., 50. free_levels() frees them. */
static void make_levels(sunder_level *level)
{
    for (size_t k = 0; k < LEVELS; k++) {
        const double x = 99 - (double)k, xy[] = {0, 0, x, 0, x, 10, 0, 10};
        const size_t ring_end[] = {4}, poly_end[] = {1};
        sunder_shape *shape;
        sunder_error err;
        assert_int_equal(sunder_shape_from_rings(xy, ring_end, poly_end, 1, SUNDER_VALIDITY_STRICT, &shape, &err),
                         SUNDER_OK);
        level[k] = (sunder_level){shape, 1000 * (int64_t)(k + 1)};
    }
}

static void free_levels(sunder_level *level)
{
    for (size_t k = 0; k < LEVELS; k++) sunder_shape_free((sunder_shape *)(uintptr_t)level[k].shape);
}

/* A feature of 100 m, which no move frees, beside a fixed one that stands at this distance from its other end. Returns
 * the level that the feature gets. */
static size_t level_beside(scene *s, sunder_level *level, double wall, sunder_hiding_summary *summary)
{
    const size_t end[] = {LEVELS, LEVELS};
    const sunder_hiding_cost cost[] = {{1, 5}, {0, 1}};
    sunder_layer *layer;
    sunder_layer_summary all;
    sunder_error err;
    scene_begin(s, 0.5);
    scene_add_box(s, 0, 0, 100, 10)->max_shift = 0.25;
    scene_add_box(s, wall, 0, 10, 10)->fixed = true;
    s->options.no_blocks = true;
    s->options.contained = SUNDER_CONTAINMENT_SEPARATE;
    assert_int_equal(sunder_layer_new(s->feature, s->n, &layer, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_set_hiding(layer, cost, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_set_levels(layer, level, end, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_separate(layer, &s->options, &s->report, &err), SUNDER_OK);
    sunder_report_summary(s->report, &all);
    sunder_report_hiding(s->report, summary);
    assert_true(all.verified);
    assert_int_equal(scene_left(s), 0);
    const size_t found = sunder_report_level(s->report, 0);
    sunder_layer_free(layer);
    scene_end(s);
    return found;
}

static void finds_a_level_of_fifty(void **state)
{
    (void)state;
    sunder_level level[LEVELS];
    scene s;
    sunder_hiding_summary summary;
    make_levels(level);
    for (int lost = 0; lost <= LEVELS;
         lost += 7) { /* with the level `lost` there is room for half a metre, and a move */
        const size_t found = level_beside(&s, level, 100.375 - lost, &summary);
        assert_true(found >= (size_t)lost && found <= LEVELS);
        assert_true(lost > 7 || found == (size_t)lost); /* after some rounds it gets the smallest shape at once */
        assert_int_equal(summary.hidden, 0);
        assert_int_equal(summary.smaller, lost > 0);
        assert_true(summary.smaller_least <= 1000 * lost && summary.smaller_cost == 1000 * (int64_t)found);
        assert_true(lost > 7 || summary.smaller_least == 1000 * lost);
    }
    assert_int_equal(level_beside(&s, level, 45, &summary), LEVELS + 1); /* hidden, and proved so */
    assert_true(summary.hidden == 1 && summary.weight == 5 && summary.least == 5);
    free_levels(level);
}

/* Each shape has to lie in the one before it, and costs may not fall. */
static void refuses_levels(void **state)
{
    (void)state;
    sunder_level level[LEVELS];
    const size_t end[] = {LEVELS}, few[] = {2};
    sunder_layer *layer;
    sunder_error err;
    scene s;
    scene_begin(&s, 1);
    scene_add_box(&s, 0, 0, 100, 10);
    make_levels(level);
    assert_int_equal(sunder_layer_new(s.feature, s.n, &layer, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_set_levels(layer, level, end, &err), SUNDER_OK);
    const sunder_level larger[] = {level[1], {level[0].shape, 3000}}, cheaper[] = {level[0], {level[1].shape, 10}};
    assert_int_equal(sunder_layer_set_levels(layer, larger, few, &err), SUNDER_EARG);
    assert_non_null(strstr(err.message, "level 2 does not lie in the level before it"));
    assert_int_equal(sunder_layer_set_levels(layer, cheaper, few, &err), SUNDER_EARG);
    assert_int_equal(sunder_layer_set_levels(layer, NULL, NULL, &err), SUNDER_OK);
    sunder_layer_free(layer);
    free_levels(level);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(finds_a_level_of_fifty), cmocka_unit_test(refuses_levels)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
