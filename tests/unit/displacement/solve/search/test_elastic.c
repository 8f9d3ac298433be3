/* displacement/solve/search/elastic: which pairs of a cluster without a solution are given up. They are few, the others
 * keep their distance, and no body passes its limit. */
#include "scene_board.h"

#include "base/memory.h"
#include "displacement/solve/search/search_stages.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define GAP 3.0
static const double margin = 0x1p-30;

enum { HOUSES = 6 };

/* HOUSES squares of 10 m in a row between two fixed ones, at the distances `apart`. *left: the pairs that stay relaxed;
 * t: [2 (HOUSES + 2)] the moves. */
static void solve_row(const double *apart, double limit, size_t *left, double *t)
{
    scene_board b;
    sunder_i_search s;
    double x = 0;
    memset(&b, 0, sizeof b);
    scene_begin(&b.scene, GAP);
    for (size_t k = 0; k < HOUSES + 2; k++) {
        sunder_feature *f = scene_add_box(&b.scene, x, 0, 10, 40);
        f->fixed = k == 0 || k == HOUSES + 1;
        f->max_shift = limit;
        if (k <= HOUSES) x += 10 + apart[k];
    }
    scene_board_begin(&b);
    assert_true(sunder_i_search_init(&s, &b.of.model, b.body, b.scene.n, margin, b.move));
    sunder_i_search_give_up(&s);
    assert_false(s.failed);
    assert_true(sunder_i_search_find_clashes(&s, s.t) <= s.tolerance);
    assert_int_equal(s.shortfalls, 0);
    *left = s.relaxations.n;
    memcpy(t, s.t, 2 * (HOUSES + 2) * sizeof *t);
    for (size_t k = 0; k <= HOUSES; k++)
        if (!sunder_i_relaxations_find(&s.relaxations, (uint32_t)k, (uint32_t)k + 1))
            assert_true(apart[k] + t[2 * k + 2] - t[2 * k] >= GAP);
    for (size_t k = 0; k < HOUSES + 2; k++) assert_true(hypot(t[2 * k], t[2 * k + 1]) <= limit + margin);
    sunder_i_search_free(&s);
    scene_board_end(&b);
}

/* The fewest pairs that can stay in conflict: no pair may stand worse than at the start, so what the wide gaps can
 * spare goes to the pairs that lack least. */
static size_t fewest_left(const double *apart)
{
    double spare = 0, lacking[HOUSES + 1];
    size_t n = 0;
    for (size_t k = 0; k <= HOUSES; k++) {
        if (apart[k] >= GAP) {
            spare += apart[k] - GAP;
            continue;
        }
        size_t at = n++;
        for (; at > 0 && lacking[at - 1] > GAP - apart[k]; at--) lacking[at] = lacking[at - 1];
        lacking[at] = GAP - apart[k];
    }
    size_t solved = 0;
    while (solved < n && (spare -= lacking[solved]) >= 0) solved++;
    return n - solved;
}

/* Random rows: in sum hardly more pairs are left than the fewest. Without prices that fall with what a pair lacks it is
 * 80 % more. */
static void test_nearly_the_fewest(void **state)
{
    (void)state;
    size_t fewest = 0, all = 0;
    uint32_t random = 1;
    for (int row = 0; row < 200; row++) {
        double apart[HOUSES + 1], t[2 * (HOUSES + 2)];
        size_t left;
        for (size_t k = 0; k <= HOUSES; k++) {
            random = random * 1664525u + 1013904223u;
            apart[k] = 1 + (double)(random >> 24) / 64;
        }
        solve_row(apart, 20, &left, t);
        assert_true(left >= fewest_left(apart));
        fewest += fewest_left(apart);
        all += left;
    }
    assert_true(100 * all <= 105 * fewest);
}

/* There is room at the end of the row, within the limits: no pair is given up. */
static void test_none_where_there_is_room(void **state)
{
    (void)state;
    static const double apart[] = {3, 2, 2, 2, 3, 3, 6.5};
    double t[2 * (HOUSES + 2)];
    size_t left;
    solve_row(apart, 5, &left, t);
    assert_int_equal(left, 0);
    solve_row(apart, 1, &left, t); /* too far for the limits */
    assert_true(left >= 1 && left <= 3);
}

/* Bodies of a pair that stays relaxed need not move, and do not, if nothing else pushes them. */
static void test_no_way(void **state)
{
    (void)state;
    static const double apart[] = {20, 1, 20, 20, 20, 20, 20};
    double t[2 * (HOUSES + 2)];
    size_t left;
    solve_row(apart, 0.5, &left, t);
    assert_int_equal(left, 1);
}

/* A row of sixty pairs that all lack 1, whose bodies may move 2: only the two ends have room. It would do for three
 * pairs; margins take what a fourth would need. At least two are solved, and whole parts of the row move for them. */
static void test_a_row_without_room(void **state)
{
    (void)state;
    scene_board b;
    sunder_i_search s;
    memset(&b, 0, sizeof b);
    scene_begin(&b.scene, GAP);
    for (size_t k = 0; k <= 60; k++) scene_add_box(&b.scene, 12 * (double)k, 0, 10, 10)->max_shift = 2;
    scene_board_begin(&b);
    assert_true(sunder_i_search_init(&s, &b.of.model, b.body, b.scene.n, margin, b.move));
    sunder_i_search_give_up(&s);
    assert_false(s.failed);
    assert_true(s.relaxations.n >= 60 - 3 && s.relaxations.n <= 60 - 2);
    assert_true(sunder_i_search_find_clashes(&s, s.t) <= s.tolerance);
    for (size_t k = 0; k <= 60; k++) assert_true(hypot(s.t[2 * k], s.t[2 * k + 1]) <= 2 + margin);
    sunder_i_search_free(&s);
    scene_board_end(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nearly_the_fewest),
        cmocka_unit_test(test_none_where_there_is_room),
        cmocka_unit_test(test_no_way),
        cmocka_unit_test(test_a_row_without_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
