/* Arguments that the calls for a layer refuse, and how the calls end when they are stopped. */
#include "scene.h"
#include "upheld.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void check_arguments(void **state)
{
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    sunder_error err;
    sunder_feature f = {.weight = 1, .max_shift = INFINITY, .block = -1};
    const double bad_weight[] = {0, -1, NAN, INFINITY}, bad_limit[] = {-1, NAN};
    for (size_t k = 0; k < 4; k++) {
        f.weight = bad_weight[k];
        assert_int_equal(sunder_layer_new(&f, 1, &layer, &err), SUNDER_EARG);
    }
    f.weight = 1;
    for (size_t k = 0; k < 2; k++) {
        f.max_shift = bad_limit[k];
        assert_int_equal(sunder_layer_new(&f, 1, &layer, &err), SUNDER_EARG);
    }
    f.max_shift = INFINITY;
    assert_int_equal(sunder_layer_new(&f, 1, &layer, &err), SUNDER_OK);
    const struct {
        double gap, tolerance;
    } bad[] = {{-1, -1}, {NAN, -1}, {INFINITY, -1}, {1, 1}, {1, 2}, {1, NAN}, {0, INFINITY}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        sunder_layer_options o;
        sunder_layer_options_init(&o);
        o.gap = bad[k].gap;
        o.touch_tolerance = bad[k].tolerance;
        assert_int_equal(sunder_layer_check(layer, &o, &report, &err), SUNDER_EARG);
        assert_int_equal(sunder_layer_separate(layer, &o, &report, &err), SUNDER_EARG);
    }
    const double bad_effort[3] = {-1, NAN, INFINITY};
    for (size_t k = 0; k < 3; k++) {
        sunder_layer_options o;
        sunder_layer_options_init(&o);
        o.effort = bad_effort[k];
        assert_int_equal(sunder_layer_check(layer, &o, &report, &err), SUNDER_EARG);
    }
    assert_null(report);
    static const double point[2] = {0, NAN}, line[4] = {0, 0, 1, 1};
    static const size_t one[1] = {1}, back[2] = {2, 1}, both[2] = {1, 2};
    const sunder_barrier bad_barrier[] = {
        {.width = -1}, {.width = NAN}, {.width = INFINITY}, {.gap = NAN}, {.gap = INFINITY}, {.gap = -INFINITY},
    };
    for (size_t k = 0; k < sizeof bad_barrier / sizeof *bad_barrier; k++)
        assert_int_equal(sunder_layer_set_barriers(layer, &bad_barrier[k], 1, &err), SUNDER_EARG);
    sunder_barrier b = {.geometry = {.xy = point, .line_end = one, .lines = 1}, .gap = -1};
    assert_int_equal(sunder_layer_set_barriers(layer, &b, 1, &err), SUNDER_EINVALID);
    b.geometry = (sunder_obstacle){.xy = line, .line_end = back, .lines = 2};
    assert_int_equal(sunder_layer_set_barriers(layer, &b, 1, &err), SUNDER_EARG);
    b.geometry.line_end = both;
    assert_int_equal(sunder_layer_set_barriers(layer, &b, 1, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_set_barriers(layer, NULL, 0, &err), SUNDER_OK);
    sunder_layer_free(layer);
    sunder_layer_free(NULL);
    sunder_report_free(NULL);
}

static bool stop(double fraction, void *user)
{
    (void)user;
    return fraction < 0.05;
}

static void check_cancel(void **state)
{
    scene s;
    scene_begin(&s, 0);
    scene_add_box(&s, 0, 0, 10, 10);
    scene_add_box(&s, 8, 1, 10, 10);
    s.options.progress = stop;
    sunder_layer *layer = NULL;
    sunder_error err;
    assert_int_equal(sunder_layer_new(s.feature, s.n, &layer, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_separate(layer, &s.options, &s.report, &err), SUNDER_ECANCEL);
    assert_null(s.report);
    sunder_layer_free(layer);
    scene_end(&s);
}

static bool stop_later(double fraction, void *user)
{
    (void)fraction;
    return --*(long *)user > 0;
}

/* The progress function stops the run at each of its calls in turn: there is no report, no leak, and the right
 * status. */
static void check_cancel_anywhere(void **state)
{
    scene s;
    scene_begin(&s, 1);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            sunder_feature *f = scene_add_box(&s, 8 * i, 7 * j, 10, 10);
            if (j < 2) f->max_shift = 3;
        }
    s.options.progress = stop_later;
    s.options.effort = 0x1p-5; /* every stage runs, in a tenth of the time */
    sunder_layer *layer = NULL;
    sunder_error err;
    assert_int_equal(sunder_layer_new(s.feature, s.n, &layer, &err), SUNDER_OK);
    sunder_status status = SUNDER_ECANCEL;
    long calls = 1;
    for (; status && calls < 1000000; calls += 1 + calls / 2) {
        long left = calls;
        s.options.progress_user = &left;
        s.options.threads = calls % 2 ? 1 : 3;
        status = sunder_layer_separate(layer, &s.options, &s.report, &err);
        if (!status) break;
        assert_int_equal(status, SUNDER_ECANCEL);
        assert_null(s.report);
    }
    assert_int_equal(status, SUNDER_OK);
    assert_null(upheld_breach(s.feature, s.n, &s.options, s.report));
    assert_true(calls > 100); /* the search called it, too */
    sunder_layer_free(layer);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_arguments),
        cmocka_unit_test(check_cancel),
        cmocka_unit_test(check_cancel_anywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
