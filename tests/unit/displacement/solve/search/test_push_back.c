/* displacement/solve/search/push_back: pairs that a search gave up and that have a solution are restored, the smallest
 * violation first, and nothing else is changed. displacement/solve/search/pair_margin: a pair that is left in
 * conflict gets a margin if there is room for one. */
#include "scene_board.h"

#include "displacement/solve/search/search_stages.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double margin = 0x1p-30;

static void relax(const scene_board *b, sunder_i_relaxations *list, uint32_t p, uint32_t q)
{
    sunder_i_relaxation t;
    sunder_error err;
    assert_int_equal(sunder_i_relaxation_of(&b->of.model, p, q, &t, &err), SUNDER_OK);
    assert_true(sunder_i_relaxations_add(list, &t) && sunder_i_relaxations_index(list, &b->of.model));
}

/* The distance by which q is to the right of p, both of width 10. */
static double between(const double *t, const double *x, size_t p, size_t q)
{
    return x[q] + t[2 * q] - x[p] - t[2 * p] - 10;
}

static void test_taken_back(void **state)
{
    (void)state;
    /* Two bodies that overlap by 2 and can be separated; two that overlap by 3 and cannot; and one between two fixed
     * ones, which cannot leave one without going deeper into the other. */
    static const double x[] = {0, 8, 100, 107, 200, 209, 218.5};
    scene_board b;
    memset(&b, 0, sizeof b);
    scene_begin(&b.scene, 0);
    for (size_t k = 0; k < sizeof x / sizeof *x; k++) {
        sunder_feature *f = scene_add_box(&b.scene, x[k], 0, 10, 10);
        f->max_shift = k < 2 ? 1.5 : k < 4 ? 1 : 0.75;
        f->fixed = k == 4 || k == 6;
    }
    scene_board_begin(&b);
    sunder_i_search s;
    assert_true(sunder_i_search_init(&s, &b.of.model, b.body, b.scene.n, margin, b.move));
    relax(&b, &s.relaxations, 0, 1);
    relax(&b, &s.relaxations, 2, 3);
    relax(&b, &s.relaxations, 4, 5);
    relax(&b, &s.relaxations, 5, 6);
    sunder_i_search_push_back(&s);
    assert_false(s.failed);
    assert_null(sunder_i_relaxations_find(&s.relaxations, 0, 1));
    assert_non_null(sunder_i_relaxations_find(&s.relaxations, 2, 3));
    assert_non_null(sunder_i_relaxations_find(&s.relaxations, 4, 5));
    assert_non_null(sunder_i_relaxations_find(&s.relaxations, 5, 6));
    assert_true(between(s.t, x, 0, 1) >= 0);
    for (size_t k = 4; k < 2 * b.scene.n; k++) assert_true(s.t[k] == 0);
    assert_true(s.patience == UINT64_MAX);
    sunder_i_search_free(&s);
    scene_board_end(&b);
}

/* A pair given up with a body that is far from all bodies of the search, and so not part of it: like a far part of a
 * barrier that a feature was near to before. */
static void test_stranger(void **state)
{
    (void)state;
    scene_board b;
    memset(&b, 0, sizeof b);
    scene_begin(&b.scene, 0);
    scene_add_box(&b.scene, 0, 0, 10, 10)->max_shift = 1.5;
    scene_add_box(&b.scene, 8, 0, 10, 10)->max_shift = 1.5;
    scene_add_box(&b.scene, 300, 0, 10, 10)->fixed = true;
    scene_board_begin(&b);
    sunder_i_search s;
    assert_true(sunder_i_search_init(&s, &b.of.model, b.body, 2, margin, b.move));
    relax(&b, &s.relaxations, 0, 1);
    relax(&b, &s.relaxations, 1, 2);
    sunder_i_search_push_back(&s);
    assert_false(s.failed);
    assert_null(sunder_i_relaxations_find(&s.relaxations, 0, 1));
    assert_non_null(sunder_i_relaxations_find(&s.relaxations, 1, 2));
    sunder_i_search_free(&s);
    scene_board_end(&b);
}

/* If two pairs cannot both be solved, the one with the smaller violation is restored, whatever the order of the list.
 * The second body has to move right, away from the first, and up, away from the third; its limit allows the longer of
 * these moves, but not both. */
static void test_least_first(void **state)
{
    (void)state;
    for (int mirrored = 0; mirrored < 2; mirrored++) {
        const double right = mirrored ? 1.5 : 1, up = mirrored ? 1 : 1.5;
        scene_board b;
        memset(&b, 0, sizeof b);
        scene_begin(&b.scene, 0);
        scene_add_box(&b.scene, right - 10, 0, 10, 10)->fixed = true;
        scene_add_box(&b.scene, 0, 0, 10, 10)->max_shift = 1.6;
        scene_add_box(&b.scene, 0, up - 10, 10, 10)->fixed = true;
        scene_board_begin(&b);
        sunder_i_search s;
        assert_true(sunder_i_search_init(&s, &b.of.model, b.body, b.scene.n, margin, b.move));
        relax(&b, &s.relaxations, 0, 1);
        relax(&b, &s.relaxations, 1, 2);
        sunder_i_search_push_back(&s);
        assert_false(s.failed);
        assert_true((sunder_i_relaxations_find(&s.relaxations, 0, 1) == NULL) == !mirrored);
        assert_true((sunder_i_relaxations_find(&s.relaxations, 1, 2) == NULL) == mirrored);
        assert_true(s.t[2 + mirrored] >= 1 && hypot(s.t[2], s.t[3]) <= 1.6 && fabs(s.t[3 - mirrored]) < 0.5);
        sunder_i_search_free(&s);
        scene_board_end(&b);
    }
}

/* Two bodies with a gap of 3 that were 1 apart are left in conflict, and are slightly nearer now; a fixed one is to
 * their right, 3 away or farther. */
static void ask_for_margin(double room, bool others, bool expected)
{
    const double x[] = {0, 11, 24 + room}, hair = 0x1p-40;
    scene_board b;
    sunder_error err;
    bool done;
    memset(&b, 0, sizeof b);
    scene_begin(&b.scene, 3);
    for (size_t k = 0; k < 3; k++) scene_add_box(&b.scene, x[k], 0, 10, 10)->fixed = k != 1;
    b.scene.feature[1].max_shift = 1;
    scene_board_begin(&b);
    relax(&b, &b.of.model.relaxations, 0, 1);
    b.move[2] = b.of.model.move[2] = -hair;
    const sunder_i_cluster c = {.body = b.body, .n = 3, .margin = margin, .limited = true};
    assert_int_equal(sunder_i_cluster_demand_margin(&b.of.model, &c, 0, 1, others, b.move, &done, &err), SUNDER_OK);
    assert_int_equal(done, expected);
    if (done) {
        assert_true(between(b.move, x, 0, 1) >= 1 + margin / 2);
        assert_true(between(b.move, x, 0, 1) <= 1 + 4 * margin);
        assert_true(between(b.move, x, 1, 2) >= 3);
    } else {
        assert_true(b.move[2] == -hair && b.move[3] == 0);
    }
    assert_true(b.move[0] == 0 && b.move[4] == 0);
    scene_board_end(&b);
}

static void test_eased(void **state)
{
    (void)state;
    for (int others = 0; others < 2; others++) {
        ask_for_margin(1, others, true);
        ask_for_margin(8 * margin, others, true);
    }
}

static void test_no_room_for_a_margin(void **state)
{
    (void)state;
    for (int others = 0; others < 2; others++) ask_for_margin(0, others, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_taken_back),  cmocka_unit_test(test_stranger),
        cmocka_unit_test(test_least_first), cmocka_unit_test(test_eased),
        cmocka_unit_test(test_no_room_for_a_margin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
