/* Layers for which the conflicts without room, and their report, are known. Independent code (support/proof_check.c)
 * verifies each proof in rationals. */
#include "proof_town.h"
#include "random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static const sunder_conflict *find(const sunder_report *report, size_t a, size_t b, size_t *k)
{
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    for (*k = 0; *k < n; ++*k)
        if (c[*k].a == a && c[*k].b == b) return &c[*k];
    return NULL;
}

/* A square of side 10 km at coordinates of 5,000 km; on one side it overlaps a fixed square by 2^-20 more than its
 * limit, and another fixed one is behind it: plain doubles with a tolerance of 1e-7 cannot decide this. */
static void check_huge_and_small(void **state)
{
    (void)state;
    proof_town t;
    memset(&t, 0, sizeof t);
    const double limit = ldexp(1, -12), hair = ldexp(1, -20);
    proof_town_add_box(&t, 4990000, 5000000, 10000, 10000, 0);
    proof_town_add_box(&t, 5000000 - limit / 2, 5000000, 10000, 10000, limit);
    proof_town_add_box(&t, 5010000 - hair, 5000000, 10000, 10000, 0);
    sunder_report *report = proof_town_separate(&t);
    size_t open = 0, k;
    assert_true(proof_town_check(&t, report, 0, &open) > 0);
    assert_int_equal(open, 0);
    const sunder_conflict *c = find(report, 0, 1, &k);
    assert_non_null(c);
    assert_int_equal(c->reason, SUNDER_REASON_NO_ROOM);
    assert_int_equal(c->n_blocked_by, 1);
    assert_int_equal(c->blocked_by[0], 2);
    sunder_report_free(report);
    proof_town_free(&t);
    /* Without the 2^-20 there is exactly enough room. */
    memset(&t, 0, sizeof t);
    proof_town_add_box(&t, 4990000, 5000000, 10000, 10000, 0);
    proof_town_add_box(&t, 5000000 - limit / 2, 5000000, 10000, 10000, limit);
    proof_town_add_box(&t, 5010000, 5000000, 10000, 10000, 0);
    report = proof_town_separate(&t);
    sunder_layer_summary s;
    sunder_report_summary(report, &s);
    assert_int_equal(s.blocked, 0);
    sunder_report_free(report);
    proof_town_free(&t);
}

/* A house between two fixed blocks that are too near to each other, and two houses with enough room, connected with it
 * through another house. The missing room at the first house explains the conflicts there, and no others. */
static void check_explains_its_own(void **state)
{
    (void)state;
    proof_town t;
    memset(&t, 0, sizeof t);
    proof_town_add_box(&t, 0, 0, 10, 40, 0);
    proof_town_add_box(&t, 9, 5, 12, 30, 2);
    proof_town_add_box(&t, 20.5, 0, 10, 40, 0);
    /* It overlaps the house that has no room, and the one that has enough. */
    proof_town_add_box(&t, 12, 34.5, 6, 6, 2);
    proof_town_add_box(&t, 12, 40, 6, 6, 4);
    sunder_report *report = proof_town_separate(&t);
    size_t open = 0, n;
    proof_town_check(&t, report, 0, &open);
    assert_int_equal(open, 0);
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    assert_true(n > 0);
    for (size_t k = 0; k < n; k++) {
        assert_true(c[k].a < 3 && c[k].b < 3);
        assert_int_equal(c[k].reason, SUNDER_REASON_NO_ROOM);
        assert_int_equal(c[k].n_blocked_by, 1);
        assert_int_equal(c[k].blocked_by[0], 3 - c[k].a - c[k].b);
    }
    sunder_report_free(report);
    proof_town_free(&t);
}

/* Two places without room that are connected: each conflict is blocked by the features at its own place. */
static void check_two_lanes(void **state)
{
    (void)state;
    proof_town t;
    memset(&t, 0, sizeof t);
    for (int lane = 0; lane < 2; lane++) {
        const double y = 100 * lane;
        proof_town_add_box(&t, 0, y, 10, 60, 0);
        proof_town_add_box(&t, 9.5, y + 10, 11, 45, 1);
        proof_town_add_box(&t, 20, y, 10, 60, 0);
    }
    proof_town_add_box(&t, 12, 54, 6, 56.5, 2);
    sunder_report *report = proof_town_separate(&t);
    size_t open = 0, n;
    assert_true(proof_town_check(&t, report, 0, &open) >= 4);
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    for (size_t k = 0; k < n; k++) {
        if (c[k].reason != SUNDER_REASON_NO_ROOM) continue;
        for (size_t b = 0; b < c[k].n_blocked_by && c[k].b < 6; b++) assert_true(c[k].blocked_by[b] / 3 == c[k].a / 3);
    }
    sunder_report_free(report);
    proof_town_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_huge_and_small), cmocka_unit_test(check_explains_its_own),
                                       cmocka_unit_test(check_two_lanes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
