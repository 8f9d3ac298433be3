/* displacement/solve/search/pushed: which bodies are pushed when a pair is separated, how far each has to move, and
 * when it fails; which given-up pairs of a row are restored that way. Also equalise_moves: bodies that moved by the
 * same vector up to rounding. */
#include "scene_board.h"

#include "displacement/solve/search/pushed.h"
#include "displacement/solve/search/search_stages.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double margin = 0x1p-30, right[2] = {1, 0};

/* Squares of side 10 in a row, at the distances `apart`, with a gap of 3 and this limit. */
static void begin_row(scene_board *b, sunder_i_search *s, const double *apart, size_t n, double limit)
{
    double x = 0;
    memset(b, 0, sizeof *b);
    scene_begin(&b->scene, 3);
    for (size_t k = 0; k <= n; k++) {
        scene_add_box(&b->scene, x, 0, 10, 10)->max_shift = limit;
        if (k < n) x += 10 + apart[k];
    }
    scene_board_begin(b);
    assert_true(sunder_i_search_init(s, &b->of.model, b->body, b->scene.n, margin, b->move));
    for (size_t k = 0; k < n; k++) {
        sunder_i_relaxation t;
        sunder_error err;
        if (apart[k] >= 3) continue;
        assert_int_equal(sunder_i_relaxation_of(&b->of.model, (uint32_t)k, (uint32_t)k + 1, &t, &err), SUNDER_OK);
        assert_true(sunder_i_relaxations_add(&s->relaxations, &t));
    }
    assert_true(sunder_i_relaxations_index(&s->relaxations, &b->of.model));
}

static void end_row(scene_board *b, sunder_i_search *s)
{
    sunder_i_search_free(s);
    scene_board_end(b);
}

static void assert_near(double a, double b) { assert_true(fabs(a - b) <= 1e-6); }

/* The first two lack 1; the third is pushed at once, the fourth after half a metre, the last after two metres. */
static void test_pushed_as_far_as_need_be(void **state)
{
    (void)state;
    static const double apart[] = {2, 2, 3.5, 5};
    scene_board b;
    sunder_i_search s;
    sunder_i_pushed p;
    double n[2];
    begin_row(&b, &s, apart, 4, 2);
    assert_true(sunder_i_pushed_init(&p, &s, 2));
    const double missing = sunder_i_pushed_missing(&p, 0, 1, n);
    assert_near(missing, 1);
    assert_near(n[0], 1);
    assert_true(sunder_i_pushed_reaches(&p, 0, 1, n, missing));
    assert_true(p.front[0].spare[1] == 0 && p.front[0].spare[2] == 0 && p.front[1].spare[0] == 0);
    assert_near(p.front[0].spare[3], 0.5);
    assert_true(p.front[0].spare[4] == INFINITY && p.front[1].spare[1] == INFINITY);
    assert_true(sunder_i_pushed_part(&p, missing));
    assert_near(sunder_i_pushed_missing(&p, 0, 1, n), 0);
    assert_near(s.t[0], -0.75); /* one body on the left, three on the right */
    assert_near(s.t[2], 0.25);
    assert_true(s.t[4] == s.t[2] && s.t[6] == 0 && s.t[8] == 0);
    sunder_i_pushed_free(&p);
    end_row(&b, &s);
}

/* Both ends of the row may move this far, and no farther: a greater violation fails, and no body has moved. */
static void test_limits(void **state)
{
    (void)state;
    static const double apart[] = {2.5, 2, 2.5};
    scene_board b;
    sunder_i_search s;
    sunder_i_pushed p;
    for (int k = 0; k < 2; k++) {
        begin_row(&b, &s, apart, 3, k ? 0.51 : 0.49);
        assert_true(sunder_i_pushed_init(&p, &s, 2));
        assert_int_equal(sunder_i_pushed_reaches(&p, 1, 2, right, 1), k);
        assert_true(s.t[0] == 0 && s.t[6] == 0);
        sunder_i_pushed_free(&p);
        end_row(&b, &s);
    }
}

/* Another body is not in the pushed direction, but obstructs one of the pushed bodies: the push fails. */
static void test_put_back(void **state)
{
    (void)state;
    static const double apart[] = {2};
    scene_board b;
    sunder_i_search s;
    sunder_i_neighbourhood about;
    begin_row(&b, &s, apart, 1, 2);
    assert_true(sunder_i_neighbourhood_init(&about, &s));
    about.n = 1;
    about.place[0] = 1;
    assert_false(sunder_i_neighbourhood_put(&about, (const double[]){-0.5, 0}));
    assert_true(s.t[2] == 0 && s.t[3] == 0 && !about.moves[1]);
    assert_true(sunder_i_neighbourhood_put(&about, (const double[]){0.5, 0}));
    assert_true(s.t[2] == 0.5);
    sunder_i_neighbourhood_free(&about);
    end_row(&b, &s);
}

/* A row of sixty, in which no small set of bodies could give way. As many pairs are restored as the limits allow, the
 * smallest violations first. With ten pairs that lack 0.5 and fifty that lack 1, and limits of 2 at either end, seven
 * of the former are restored, since margins take a little. */
static void test_row(void **state)
{
    (void)state;
    double apart[60];
    scene_board b;
    sunder_i_search s;
    for (size_t k = 0; k < 60; k++) apart[k] = k % 6 == 3 ? 2.5 : 2;
    begin_row(&b, &s, apart, 60, 2);
    sunder_i_search_push_back(&s);
    assert_false(s.failed);
    assert_int_equal(s.relaxations.n, 60 - 7);
    size_t missing_most = 0;
    for (size_t k = 0; k < s.relaxations.n; k++) missing_most += s.relaxations.item[k].gap == 2;
    assert_int_equal(missing_most, 50);
    assert_true(sunder_i_search_find_clashes(&s, s.t) <= s.tolerance);
    assert_near(s.t[2 * 60] - s.t[0], 3.5);
    end_row(&b, &s);
}

/* In a row without any room every attempt fails, after examining everything between the pair and the ends of the row.
 * After repeated attempts the obstruction is known, and a further attempt examines less, with the same result. Attempts
 * that succeed are not affected. */
static void test_known_in_vain(void **state)
{
    (void)state;
    double apart[70];
    scene_board b;
    sunder_i_search s;
    sunder_i_pushed p;
    for (size_t k = 0; k < 70; k++) apart[k] = 2;
    begin_row(&b, &s, apart, 70, 0.49);
    for (size_t k = 1; k < 70; k++) b.of.model.body[k].limit = 5;
    assert_true(sunder_i_pushed_init(&p, &s, 2));
    uint64_t steps = s.steps;
    assert_false(sunder_i_pushed_is_in_vain(&p, 30, 31, right, 1));
    assert_false(sunder_i_pushed_reaches(&p, 30, 31, right, 1));
    const uint64_t first = s.steps - steps;
    for (int k = 0; k < 100; k++) assert_false(sunder_i_pushed_reaches(&p, 30, 31, right, 1));
    steps = s.steps;
    for (uint32_t k = 0; k < 70; k++) {
        assert_true(sunder_i_pushed_is_in_vain(&p, k, k + 1, right, 1));
        assert_false(sunder_i_pushed_is_in_vain(&p, k, k + 1, right, 0.97));
        assert_false(sunder_i_pushed_reaches(&p, k, k + 1, right, 1));
    }
    assert_true(s.steps - steps < 70 * first);
    /* The room at the ends is taken from the present positions, even for obstructions that were found earlier. */
    s.t[2 * 70] = -0.4;
    assert_true(sunder_i_pushed_is_in_vain(&p, 69, 70, right, 1.39));
    s.t[2 * 70] = 0;
    assert_true(sunder_i_pushed_is_in_vain(&p, 69, 70, right, 0.99));
    s.t[2 * 70] = -0.4;
    assert_false(sunder_i_pushed_is_in_vain(&p, 69, 70, right, 1.37));
    sunder_i_pushed_free(&p);
    end_row(&b, &s);
}

/* The same with all bodies at their original places and all requirements in force, which is how such a crowd is
 * recognised. A crowd with more room is not. */
static void test_crowd(void **state)
{
    (void)state;
    double apart[60];
    scene_board b;
    sunder_i_search s;
    for (size_t k = 0; k < 60; k++) apart[k] = 2;
    for (int roomy = 0; roomy < 2; roomy++) {
        begin_row(&b, &s, apart, 60, roomy ? 20 : 2);
        sunder_i_relaxations_free(&s.relaxations);
        size_t n;
        sunder_i_clash *at_home = sunder_i_search_at_home(&s, &n);
        assert_non_null(at_home);
        assert_int_equal(n, 60);
        assert_int_equal(sunder_i_search_push_from_home(&s, b.move, at_home, n), !roomy);
        assert_int_equal(s.relaxations.n, roomy ? 0 : 57);
        free(at_home);
        end_row(&b, &s);
    }
}

/* The bodies of a row, to which a program gave slightly different moves, get one common move, and the last body makes
 * up the difference. */
static void test_together(void **state)
{
    (void)state;
    static const double apart[] = {2, 2, 2, 2.5, 2};
    scene_board b;
    sunder_i_search s;
    begin_row(&b, &s, apart, 5, 2);
    sunder_i_search_push_back(&s);
    for (size_t k = 0; k < 6; k++) s.t[2 * k] += (double)k * s.tolerance / 3;
    sunder_i_search_equalise_moves(&s);
    assert_false(s.failed);
    assert_true(sunder_i_search_find_clashes(&s, s.t) <= s.tolerance);
    size_t same = 0;
    for (size_t k = 1; k < 6; k++) same += s.t[2 * k] == s.t[2 * (k - 1)];
    assert_int_equal(same, s.relaxations.n); /* all except at the pairs that were separated */
    end_row(&b, &s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pushed_as_far_as_need_be),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_put_back),
        cmocka_unit_test(test_row),
        cmocka_unit_test(test_known_in_vain),
        cmocka_unit_test(test_crowd),
        cmocka_unit_test(test_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
