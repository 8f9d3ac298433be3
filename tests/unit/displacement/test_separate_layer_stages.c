/* The stages that the progress of a separation reports: questions about remaining conflicts belong to the stage
 * `explain`, not to `verify`. The amount of work is measured by the number of progress calls, which depends on steps
 * and not on time. */
#include "scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

typedef struct calls {
    size_t solve, explain, verify;
    double last;
} calls;

static bool count(double fraction, void *user)
{
    calls *c = user;
    assert_true(fraction >= c->last && fraction <= 1);
    c->last = fraction;
    if (fraction < SUNDER_PROGRESS_SOLVED)
        c->solve++;
    else if (fraction < SUNDER_PROGRESS_EXPLAINED)
        c->explain++;
    else
        c->verify++;
    return true;
}

/* Rows of overlapping houses with limits so short that most conflicts remain, at that effort. */
static calls separate(double effort)
{
    scene s;
    calls c = {0};
    scene_begin(&s, 2);
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < 6; j++) scene_add_box(&s, 9.5 * i, 9 * j, 10, 10)->max_shift = 0.5;
    s.options.no_blocks = true;
    s.options.effort = effort;
    s.options.threads = 1;
    s.options.progress = count;
    s.options.progress_user = &c;
    scene_separate(&s);
    assert_true(scene_left(&s) > 20);
    assert_true(s.summary.seconds_solve >= 0 && s.summary.seconds_explain >= 0 && s.summary.seconds_verify >= 0);
    scene_end(&s);
    return c;
}

static void check_questions_are_explaining(void **state)
{
    (void)state;
    const calls none = separate(0), some = separate(1);
    assert_true(none.last == 1 && some.last == 1);
    assert_true(some.solve > 0 && some.explain > 0 && some.verify > 0);
    /* At effort 0 no questions about conflicts are asked; the amount of verification is that of effort 1. */
    assert_true(some.explain > 20 * some.verify);
    assert_true(some.explain > 20 * none.explain);
    assert_true(some.verify < 2 * none.verify + 20);
    print_message("at effort 0: %zu, %zu, %zu; at effort 1: %zu, %zu, %zu\n", none.solve, none.explain, none.verify,
                  some.solve, some.explain, some.verify);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_questions_are_explaining)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
