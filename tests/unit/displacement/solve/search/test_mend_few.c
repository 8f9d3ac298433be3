/* displacement/solve/search/mend_few: a crowd in which a body was moved back is repaired around the few resulting
 * clashes, and no other body moves. If no body was moved back, if there are many clashes, or if the crowd is not large,
 * it is left as it was. */
#include "scene_field.h"

#include "displacement/solve/search/search_stages.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 24 * 24 };

/* Squares of side 10 with a gap of 3, at distances of 4 in a square grid; each may move 2. */
static scene_field *begin(size_t side)
{
    scene_field *f = scene_field_new(side * side);
    for (size_t k = 0; k < side * side; k++) {
        char wkt[200];
        const double x = 14 * (double)(k % side), y = 14 * (double)(k / side);
        snprintf(wkt, sizeof wkt, "POLYGON ((%g %g, %g %g, %g %g, %g %g))", x, y, x + 10, y, x + 10, y + 10, x, y + 10);
        scene_field_add(f, wkt, 2);
    }
    scene_field_begin(f, 3);
    return f;
}

/* Moves every `every`-th square right by 1.5, which is too near to the next. Returns the number of clashes. */
static size_t disturb(scene_field *f, size_t every)
{
    for (size_t k = every / 2; k < f->n; k += every) f->search.t[2 * k] = 1.5;
    sunder_i_search_find_clashes(&f->search, f->search.t);
    return f->search.clashes;
}

static void test_few(void **state)
{
    (void)state;
    scene_field *f = begin(24);
    f->of.model.body[0].pinned = true;
    sunder_i_search *s = &f->search;
    const size_t clashes = disturb(f, 200);
    assert_true(clashes > 0 && clashes <= 3);
    double stood[2 * MOST];
    memcpy(stood, s->t, sizeof stood);
    assert_true(sunder_i_search_mend_few(s));
    assert_true(sunder_i_search_find_clashes(s, s->t) <= s->tolerance);
    assert_int_equal(s->relaxations.n, 0);
    size_t moved = 0;
    for (size_t k = 0; k < f->n; k++) moved += memcmp(stood + 2 * k, s->t + 2 * k, 2 * sizeof *stood) != 0;
    assert_true(moved > 0 && moved <= 8 * clashes);
    scene_field_free(f);
}

/* Demands that nothing changes. */
static void expect_left_alone(scene_field *f)
{
    double stood[2 * MOST];
    memcpy(stood, f->search.t, 2 * f->n * sizeof *stood);
    assert_false(sunder_i_search_mend_few(&f->search));
    assert_memory_equal(stood, f->search.t, 2 * f->n * sizeof *stood);
    assert_false(f->search.failed);
}

static void test_many_or_none(void **state)
{
    (void)state;
    scene_field *f = begin(24);
    f->of.model.body[0].pinned = true;
    expect_left_alone(f);
    assert_true(disturb(f, 20) > 20);
    expect_left_alone(f);
    scene_field_free(f);
}

static void test_nobody_sent_home(void **state)
{
    (void)state;
    scene_field *f = begin(24);
    assert_true(disturb(f, 200) > 0);
    expect_left_alone(f);
    scene_field_free(f);
}

static void test_no_crowd(void **state)
{
    (void)state;
    scene_field *f = begin(20);
    f->of.model.body[0].pinned = true;
    assert_true(disturb(f, 200) > 0);
    expect_left_alone(f);
    scene_field_free(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_few), cmocka_unit_test(test_many_or_none),
                                       cmocka_unit_test(test_nobody_sent_home), cmocka_unit_test(test_no_crowd)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
