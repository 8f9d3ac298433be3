/* displacement/solve/search/descend: a body that is a rounding error too near to a wide barrier descends to the
 * adjacent free place, not to one elsewhere. */
#include "scene.h"

#include "displacement/solve/search/search_stages.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double width = 7, lower = 4, left = 6; /* of the bar: its width, and its lower left corner */
static const double half = 0.5;                     /* half the barrier's width */
static const double low[2] = {10, 2}, tip[2] = {13, 9};

/* The move of the bar for which its left corner touches, from above, the segment of the line from (x, 11) by `low` to
 * `tip`, and its right corner touches the round end. */
static void find_corner(double x, double t[2])
{
    const double along[2] = {low[0] - x, low[1] - 11}, length = hypot(along[0], along[1]);
    const double n[2] = {-along[1] / length, along[0] / length};
    const double from[2] = {x + half * n[0], 11 + half * n[1]};
    double far = 0;
    double near = ((tip[0] - width - from[0]) * along[0] + (tip[1] - from[1]) * along[1]) / (length * length);
    for (int k = 0; k < 60; k++) {
        const double s = (far + near) / 2, p[2] = {from[0] + s * along[0], from[1] + s * along[1]};
        const bool beyond = hypot(p[0] + width - tip[0], p[1] - tip[1]) > half;
        if (beyond)
            far = s;
        else
            near = s;
        t[0] = p[0] - left;
        t[1] = p[1] - lower;
    }
}

/* Descends from slightly below that place. */
static void go_down(double x)
{
    const sunder_i_relations none = {0};
    const double line[] = {x, 11, low[0], low[1], tip[0], tip[1]};
    const size_t points = 3;
    const sunder_barrier barrier = {{.xy = line, .line_end = &points, .lines = 1}, 2 * half, -1, false, 0};
    double corner[2], move[4] = {0};
    scene s;
    sunder_layer *layer, work;
    sunder_i_rules rules;
    sunder_i_barriers parts;
    sunder_i_model model;
    sunder_error err;
    bool found;
    find_corner(x, corner);
    scene_begin(&s, 0);
    s.options.no_blocks = s.options.allow_jumps = true;
    scene_add_box(&s, left, lower, width, 1);
    assert_int_equal(sunder_layer_new(s.feature, s.n, &layer, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_set_barriers(layer, &barrier, 1, &err), SUNDER_OK);
    assert_int_equal(sunder_i_rules_of(&s.options, &rules, &err), SUNDER_OK);
    assert_int_equal(sunder_i_barriers_make(layer, &(sunder_i_rules){0}, &parts, &err), SUNDER_OK);
    assert_int_equal(sunder_i_order_layer(layer, &parts, true, &work, &err), SUNDER_OK);
    assert_int_equal(sunder_i_model_init(&work, &parts, &rules, &model, &err), SUNDER_OK);
    assert_int_equal(sunder_i_model_join(&model, &none, &err), SUNDER_OK);
    assert_int_equal(sunder_i_model_cut(&model, &err), SUNDER_OK);
    assert_int_equal(sunder_i_model_anchor(&model, &err), SUNDER_OK);
    model.standing = &model.tree;
    assert_int_equal(model.bodies, 2);
    uint32_t body[] = {0, 1};
    const sunder_i_cluster cluster = {.body = body, .n = 2, .margin = 0x1p-45};
    move[0] = corner[0];
    move[1] = corner[1] - 0x1p-28;
    const double cost = corner[0] * corner[0] + corner[1] * corner[1];
    assert_int_equal(sunder_i_cluster_descend(&model, &cluster, cost * (1 + 1e-6), move, &found, &err), SUNDER_OK);
    assert_true(found);
    assert_true(hypot(move[0] - corner[0], move[1] - corner[1]) < 1e-9);
    assert_true(move[2] == 0 && move[3] == 0);
    sunder_i_model_free(&model);
    sunder_i_barriers_free(&parts);
    sunder_i_ordered_clear(&work);
    sunder_layer_free(layer);
    scene_end(&s);
}

static void test_between_an_edge_and_a_round_end(void **state)
{
    (void)state;
    for (int k = 0; k <= 8; k++) go_down(3.75 + k / 16.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_between_an_edge_and_a_round_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
