/* Hidden features are shown again where they fit, the most important ones first. */
#include "displacement/hide/hiding.h"

#include "scene_model.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 6 };

/* Hides features by their numbers in the layer, and asks which of them fit. */
static void ask(scene *s, const sunder_hiding_cost *cost, const bool *hidden, bool *shown)
{
    scene_model m;
    sunder_i_hiding hiding;
    sunder_error err;
    bool own[MOST], any, expected = false;
    scene_model_related(&m, s);
    assert_int_equal(sunder_layer_set_hiding(m.layer, cost, &err), SUNDER_OK);
    assert_int_equal(sunder_i_hiding_begin(m.layer, &hiding, &err), SUNDER_OK);
    for (size_t f = 0; f < s->n; f++) hiding.level[f] = hidden[f];
    sunder_i_hiding_take_levels(&hiding);
    for (size_t f = 0; f < s->n; f++) own[f] = hidden[m.work.number[f]];
    assert_int_equal(sunder_i_placement_lower(&m.model, &m.placement, &m.start, own, &err), SUNDER_OK);
    assert_int_equal(sunder_i_hiding_unhide(&hiding, &m.model, &m.placement, m.work.number, &any, &err), SUNDER_OK);
    for (size_t f = 0; f < s->n; f++) {
        shown[f] = hidden[f] && hiding.level[f] == 0;
        expected = expected || shown[f];
    }
    assert_int_equal(any, expected);
    sunder_i_hiding_free(&hiding);
    scene_model_end(&m);
}

static void shows_what_fits(void **state)
{
    (void)state;
    scene s;
    bool shown[MOST];
    scene_begin(&s, 1);
    scene_add_box(&s, 0, 0, 10, 10);   /* visible */
    scene_add_box(&s, 5, 0, 10, 10);   /* too near to it */
    scene_add_box(&s, 40, 0, 10, 10);  /* fits, but not beside the next one, which is more important */
    scene_add_box(&s, 45, 0, 10, 10);
    scene_add_box(&s, 100, 0, 10, 10); /* of two that exclude each other the heavier one fits */
    scene_add_box(&s, 105, 0, 10, 10);
    const sunder_hiding_cost cost[MOST] = {{1, 5}, {1, 5}, {2, 5}, {1, 5}, {1, 5}, {1, 6}};
    const bool hidden[MOST] = {false, true, true, true, true, true};
    const bool fits[MOST] = {false, false, false, true, false, true};
    ask(&s, cost, hidden, shown);
    for (size_t f = 0; f < MOST; f++) assert_int_equal(shown[f], fits[f]);
    const bool near[MOST] = {false, true, false, false, false, false};
    ask(&s, cost, near, shown);
    for (size_t f = 0; f < MOST; f++) assert_false(shown[f]);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(shows_what_fits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
