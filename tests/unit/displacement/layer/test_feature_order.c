/* The order of processing depends on the positions of features only: for any order of the list, any distances, and
 * features that are equal. */
#include "random.h"
#include "scene.h"

#include "base/memory.h"
#include "displacement/layer/barrier_parts.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* Boxes, many with the same lower edge, on either side of 0 and on it; some are missing, some are equal, and some are
 * as far away as doubles allow. */
static void draw_scene(rng *g, scene *s)
{
    scene_begin(s, 1);
    const size_t n = (size_t)rng_int(g, 1, 60);
    const double scale = rng_once_in(g, 2) ? 1 : ldexp(1, (int)rng_int(g, -40, 40));
    for (size_t k = 0; k < n; k++) {
        const double x = scale * (double)rng_int(g, -2, 2), level = scale * (double)rng_int(g, -2, 2);
        double y = level != 0 ? level : rng_once_in(g, 2) ? 0.0 : -0.0;
        if (rng_once_in(g, 20)) y = rng_once_in(g, 2) ? 0x1p200 : -0x1p200;
        if (rng_once_in(g, 5)) y = nextafter(y, 1);
        const double high = fabs(y) > 0x1p100 ? fabs(y) : scale * (double)rng_int(g, 1, 3);
        scene_add_box(s, x, y, scale * (double)rng_int(g, 1, 2), high);
        s->feature[k].weight = (double)rng_int(g, 1, 3);
        s->feature[k].ignored = rng_once_in(g, 8);
    }
}

static int by_double(double a, double b) { return (a > b) - (a < b); }

/* The documented order (at the top of feature_order.c) of two entries of the list. */
static int by_place(const scene *s, size_t i, size_t j)
{
    const sunder_feature *a = &s->feature[i], *b = &s->feature[j];
    double p[4], q[4];
    if (a->ignored != b->ignored) return a->ignored ? 1 : -1;
    if (!a->ignored) {
        sunder_shape_box(a->shape, p);
        sunder_shape_box(b->shape, q);
        const int side[] = {1, 0, 3, 2};
        for (int k = 0; k < 4; k++)
            if (p[side[k]] != q[side[k]]) return by_double(p[side[k]], q[side[k]]);
        if (a->weight != b->weight) return by_double(a->weight, b->weight);
    }
    return 0;
}

static void check_order(const scene *s, bool as_given)
{
    sunder_layer *layer, work;
    sunder_i_barriers parts;
    sunder_error err;
    bool seen[100] = {false};
    assert_int_equal(sunder_layer_new(s->feature, s->n, &layer, &err), SUNDER_OK);
    assert_int_equal(sunder_i_barriers_make(layer, &(sunder_i_rules){.gap = 1}, &parts, &err), SUNDER_OK);
    assert_int_equal(sunder_i_order_layer(layer, &parts, as_given, &work, &err), SUNDER_OK);
    for (size_t k = 0; k < s->n; k++) {
        const size_t f = work.number[k];
        assert_true(f < s->n && !seen[f]);
        seen[f] = true;
        if (as_given) assert_int_equal(f, k);
        if (as_given || k == 0) continue;
        const size_t before = work.number[k - 1];
        const int order = by_place(s, before, f);
        assert_true(order <= 0);
        /* Features that are equal in everything keep the order of the list. Ignored ones are excepted: they are ordered
         * by corners and required distances first. */
        if (order == 0 && !s->feature[f].ignored) assert_true(before < f);
    }
    sunder_i_ordered_clear(&work);
    sunder_i_barriers_free(&parts);
    sunder_layer_free(layer);
}

static void test_by_place(void **state)
{
    (void)state;
    for (size_t round = 0; round < test_count(400); round++) {
        rng g = rng_start(test_seed(), round);
        scene s;
        draw_scene(&g, &s);
        check_order(&s, false);
        check_order(&s, true);
        scene_end(&s);
    }
}

/* All features are missing, or the list is empty. */
static void test_of_none(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 1);
    check_order(&s, false);
    for (int k = 0; k < 3; k++) scene_add_box(&s, k, k, 1, 1);
    for (int k = 0; k < 3; k++) s.feature[k].ignored = true;
    check_order(&s, false);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_by_place), cmocka_unit_test(test_of_none)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
