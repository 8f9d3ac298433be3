/* displacement/solve/search: a pair that is free at its target uses the sides of the target, another pair those of its
 * present place. Violations by approximate solutions are corrected: a large crowd that first descends approximately is
 * free of conflicts at the end, to the last digit, and its cost cannot be improved further. */
#include "scene_field.h"

#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 33, MOST = SIDE * SIDE, CORNERS = 12 };

/* Adds a round polygon of radius 6. */
static void add_round(scene_field *f, double x, double y)
{
    char wkt[CORNERS * 60 + 100];
    size_t at = (size_t)snprintf(wkt, sizeof wkt, "POLYGON ((");
    for (int k = 0; k <= CORNERS; k++) {
        const double angle = 6.283185307179586 * (k % CORNERS) / CORNERS;
        at += (size_t)snprintf(wkt + at, sizeof wkt - at, "%s%.17g %.17g", k ? ", " : "", x + 6 * cos(angle),
                               y + 6 * sin(angle));
    }
    snprintf(wkt + at, sizeof wkt - at, "))");
    scene_field_add(f, wkt, INFINITY);
}

/* A grid of round bodies. */
static scene_field *begin(size_t columns, size_t rows, double apart)
{
    scene_field *f = scene_field_new(columns * rows);
    for (size_t k = 0; k < columns * rows; k++) {
        /* Each row is shifted by another fraction of the distance. */
        const double row = (double)(k / columns), x = apart * ((double)(k % columns) + fmod(0.381 * row, 1));
        add_round(f, x, apart * row);
    }
    scene_field_begin(f, 1);
    return f;
}

/* The mean direction of the sides between pairs, as its component to the right; in [-1, 1]. */
static double look_right(sunder_i_search *s, const double *lead)
{
    double right = 0;
    s->lead = lead;
    assert_false(sunder_i_search_constrain(s, 10, false));
    s->lead = NULL;
    assert_true(s->program.n > 0);
    for (size_t k = 0; k < s->program.n; k++) right += s->program.constraint[k].n[0] / (double)s->program.n;
    return right;
}

static void test_sides_of_the_way(void **state)
{
    (void)state;
    scene_field *f = begin(2, 1, 20);
    sunder_i_search *s = &f->search;
    const double above[] = {0, 0, -20, 20}, within[] = {0, 0, -15, 3}, as_is[4] = {0};
    assert_true(look_right(s, NULL) > 0.9);
    assert_true(look_right(s, as_is) > 0.9);
    assert_true(look_right(s, within) > 0.9);
    assert_true(fabs(look_right(s, above)) < 0.1 && s->program.constraint[0].n[1] > 0.9);
    scene_field_free(f);
}

static void test_what_is_missed_roughly(void **state)
{
    (void)state;
    scene_field *f = begin(2, 1, 13 - 0x1p-12);
    sunder_i_search *s = &f->search;
    s->tolerance = 0x1p-8;
    for (int roughly = 0; roughly < 2; roughly++) {
        double most = 0;
        s->roughly = roughly;
        assert_false(sunder_i_search_constrain(s, 1, false));
        for (size_t k = 0; k < s->program.n; k++) {
            const sunder_i_constraint *c = &s->program.constraint[k];
            most = fmax(most, c->d - sunder_i_stretch(c, s->t));
        }
        assert_true(roughly ? most > 0x1p-13 && most < 0x1p-11 : most <= 0);
    }
    scene_field_free(f);
}

static void test_a_large_crowd(void **state)
{
    (void)state;
    double found[2 * MOST];
    assert_true(MOST > LARGE_CROWD_LED);
    for (int run = 0; run < 2; run++) {
        scene_field *f = begin(SIDE, SIDE, 12.5);
        sunder_i_search *s = &f->search;
        const double tolerance = s->tolerance, settled = s->settled;
        assert_true(sunder_i_search_descend(s));
        assert_true(s->tolerance == tolerance && s->settled == settled && !s->roughly && !s->lead);
        assert_true(sunder_i_search_find_clashes(s, s->t) <= s->tolerance);
        if (run) assert_memory_equal(found, s->t, sizeof found);
        memcpy(found, s->t, sizeof found);
        const double cost = sunder_i_search_cost(s, s->t);
        assert_true(cost > 0 && sunder_i_search_descend(s));
        assert_true(sunder_i_search_cost(s, s->t) > (1 - 4 * SETTLED) * cost);
        scene_field_free(f);
    }
}

/* With one body that has a limit the crowd does not descend approximately, but still finds the solution. */
static void test_with_a_limit(void **state)
{
    (void)state;
    scene_field *f = begin(SIDE, SIDE, 12.9);
    sunder_i_search *s = &f->search;
    f->of.model.body[7].limit = 40;
    assert_true(sunder_i_search_descend(s));
    assert_true(sunder_i_search_find_clashes(s, s->t) <= s->tolerance);
    assert_true(hypot(s->t[14], s->t[15]) <= 40);
    scene_field_free(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_sides_of_the_way),
                                       cmocka_unit_test(test_what_is_missed_roughly),
                                       cmocka_unit_test(test_a_large_crowd), cmocka_unit_test(test_with_a_limit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
