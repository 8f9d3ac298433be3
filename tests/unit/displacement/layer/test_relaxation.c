/* displacement/layer/relaxation: a remaining overlap is limited to its depth along the shortest way out at the present
 * places, if that is not longer than the first least translation. */
#include "polyset.h"
#include "scene.h"

#include "displacement/layer/model.h"
#include "displacement/layer/relaxation.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

typedef struct layer {
    scene scene;
    sunder_shape *bar;
    sunder_layer *layer;
    sunder_layer work;
    sunder_i_barriers parts;
    sunder_i_model model;
    sunder_i_relaxation relaxation; /* of features 0 and 1, at their original places */
} layer;

/* A box of 10 by 10, and another one, or a barrier, that reaches 3 into its side; the gap is 1. */
static void begin(layer *l, bool barrier)
{
    static const char bar[] = "POLYGON ((7 4, 17 4, 17 8, 7 8, 7 4))";
    sunder_i_rules rules;
    sunder_error err;
    memset(l, 0, sizeof *l);
    scene_begin(&l->scene, 1);
    scene_add_box(&l->scene, 0, 0, 10, 10);
    if (!barrier) scene_add(&l->scene, bar);
    assert_int_equal(sunder_layer_new(l->scene.feature, l->scene.n, &l->layer, &err), SUNDER_OK);
    l->bar = polyset_shape_of_wkt(bar);
    const sunder_barrier one = {{.shape = l->bar}, 0, -1, false, 0};
    if (barrier) assert_int_equal(sunder_layer_set_barriers(l->layer, &one, 1, &err), SUNDER_OK);
    assert_int_equal(sunder_i_rules_of(&l->scene.options, &rules, &err), SUNDER_OK);
    assert_int_equal(sunder_i_barriers_make(l->layer, &(sunder_i_rules){.gap = 1}, &l->parts, &err), SUNDER_OK);
    assert_int_equal(sunder_i_order_layer(l->layer, &l->parts, true, &l->work, &err), SUNDER_OK);
    assert_int_equal(sunder_i_model_init(&l->work, &l->parts, &rules, &l->model, &err), SUNDER_OK);
    assert_int_equal(sunder_i_relaxation_of(&l->model, 0, 1, &l->relaxation, &err), SUNDER_OK);
    assert_true(l->relaxation.shift[0] == 3 && l->relaxation.shift[1] == 0);
}

static void end(layer *l)
{
    sunder_i_model_free(&l->model);
    sunder_i_barriers_free(&l->parts);
    sunder_i_ordered_clear(&l->work);
    sunder_layer_free(l->layer);
    sunder_shape_free(l->bar);
    scene_end(&l->scene);
}

/* With the one moved relative to the other by (x, y): is there an equally short way out, and which is it? Up to a
 * rounding error. */
static void expect(const layer *l, double x, double y, bool fits, double dx, double dy)
{
    sunder_i_relaxation t = l->relaxation;
    const double still[2] = {0, 0}, forth[2] = {x, y}, back[2] = {-x, -y};
    const bool barrier = l->parts.n > 0;
    bool found;
    sunder_error err;
    assert_int_equal(
        sunder_i_relaxation_turn(&l->model, barrier ? back : still, barrier ? still : forth, &t, &found, &err),
        SUNDER_OK);
    assert_true(found == fits);
    assert_true(fabs(t.shift[0] - dx) <= 1e-11 && fabs(t.shift[1] - dy) <= 1e-11);
    assert_true(!fits || hypot(t.shift[0], t.shift[1]) < 3);
}

static void check(bool barrier)
{
    layer l;
    begin(&l, barrier);
    expect(&l, 2, 0, true, 3, 0);    /* less deep, in the same direction */
    expect(&l, -1, 4.5, true, 0, 3); /* 4 deep in the old direction, 1.5 in the other */
    expect(&l, -4, -6, true, 0, -3);
    expect(&l, -1, 0, false, 3, 0); /* deeper in each direction: unchanged */
    expect(&l, 5, 0, true, 0, 0);   /* no longer overlapping; it has to stay so */
    end(&l);
}

static void test_features(void **state)
{
    (void)state;
    check(false);
}

static void test_barrier(void **state)
{
    (void)state;
    check(true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_features), cmocka_unit_test(test_barrier)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
