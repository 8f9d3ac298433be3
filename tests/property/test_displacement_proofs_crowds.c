/* Grids of houses that all lack room: the remaining conflicts are proved crowded, that is, a few features cannot all be
 * solved together. Independent code (support/proof_check.c) verifies each proof, and without any one of the features
 * that it names, with very few exceptions, the rest has a solution. */
#include "proof_town.h"
#include "random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* Rows of boxes about 2 apart, with a gap of 3; a few are fixed. */
static void add_grid(rng *r, proof_town *t)
{
    const size_t columns = (size_t)rng_int(r, 8, 10), rows = PROOF_TOWN_MOST / columns;
    const double limit = 1.75 + (double)rng_int(r, 0, 4) / 8;
    memset(t, 0, sizeof *t);
    t->gap = 3;
    for (size_t k = 0; k < rows * columns; k++) {
        const double x = 12 * (double)(k % columns) + (double)rng_int(r, -3, 3) / 8,
                     y = 12 * (double)(k / columns) + (double)rng_int(r, -3, 3) / 8;
        const bool fixed = rng_once_in(r, 48);
        const double h = 9.75 + (double)rng_int(r, 0, 4) / 8, w = 9.75 + (double)rng_int(r, 0, 4) / 8;
        proof_town_add_box(t, x, y, w, h, fixed ? 0 : limit);
    }
}

/* Separates the features of a conflict's proof without one of them: how many pairs remain, and with which reasons? */
static size_t ask_without(const proof_town *t, const sunder_conflict *c, size_t out, bool *proved)
{
    proof_town part;
    size_t n;
    memset(&part, 0, sizeof part);
    part.gap = t->gap;
    for (size_t f = 0; f < t->n; f++) {
        bool in = f == c->a || f == c->b;
        for (size_t b = 0; b < c->n_blocked_by; b++) in = in || c->blocked_by[b] == f;
        if (in && f != out) proof_town_add(&part, t->xy[f], t->plain[f].corners, t->plain[f].max_shift);
    }
    sunder_report *report = proof_town_separate(&part);
    const sunder_conflict *d = sunder_report_conflicts(report, &n);
    *proved = false;
    for (size_t k = 0; k < n; k++) *proved = *proved || d[k].reason != SUNDER_REASON_UNRESOLVED || d[k].crowded;
    sunder_report_free(report);
    proof_town_free(&part);
    return n;
}

typedef struct tally {
    size_t proved, crowded, open, named, solved, asked, proved_without;
} tally;

/* All of them are necessary: without one the others have a solution. */
static void demand_irreducible(const proof_town *t, const sunder_conflict *c, size_t trial, tally *sum)
{
    for (size_t b = 0; b < c->n_blocked_by; b++) {
        bool proved;
        const size_t left = ask_without(t, c, c->blocked_by[b], &proved);
        sum->asked++;
        sum->solved += left == 0;
        sum->proved_without += proved;
    }
}

static void check_grids(void **state)
{
    (void)state;
    tally sum = {0};
    const size_t trials = test_count(1);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        proof_town t;
        size_t n;
        add_grid(&r, &t);
        sunder_report *report = proof_town_separate(&t);
        sum.proved += proof_town_check(&t, report, trial, &sum.open);
        const sunder_conflict *c = sunder_report_conflicts(report, &n);
        for (size_t k = 0; k < n; k++) {
            if (!c[k].crowded) continue;
            assert_int_equal(c[k].reason, SUNDER_REASON_UNRESOLVED);
            sum.crowded++;
            sum.named += c[k].n_blocked_by;
            demand_irreducible(&t, &c[k], trial, &sum);
        }
        sunder_report_free(report);
        proof_town_free(&t);
    }
    print_message("%zu with a proof, %zu of a crowd, of %.1f besides the pair, %zu without; %zu of %zu without one "
                  "solved, %zu proved\n",
                  sum.proved, sum.crowded, (double)sum.named / (double)sum.crowded, sum.open, sum.solved, sum.asked,
                  sum.proved_without);
    assert_true(sum.crowded > 10 * trials && sum.open * 10 < sum.proved);
    /* Proofs are reduced only as far as the effort allows, so a few exceptions are accepted. */
    assert_true(sum.solved * 50 >= sum.asked * 49);
}

/* If there is room for all when all move by their limits, no pair is proved crowded. */
static void check_that_fit(void **state)
{
    (void)state;
    const size_t trials = test_count(10);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        proof_town t;
        size_t n, open = 0;
        const size_t columns = (size_t)rng_int(&r, 3, 6), rows = (size_t)rng_int(&r, 1, 6);
        const double lack = (double)rng_int(&r, 1, 8) / 8;
        memset(&t, 0, sizeof t);
        t.gap = 3;
        /* The limit of each box is half of what all gaps of its row lack, so a row can solve its conflicts by moves
         * along x, from its middle outwards. */
        const double limit = lack * (double)(columns - 1) / 2;
        for (size_t k = 0; k < rows * columns; k++)
            proof_town_add_box(&t, (13 - lack) * (double)(k % columns), 13 * (double)(k / columns), 10, 10, limit);
        sunder_report *report = proof_town_separate(&t);
        assert_int_equal(proof_town_check(&t, report, trial, &open), 0);
        const sunder_conflict *c = sunder_report_conflicts(report, &n);
        for (size_t k = 0; k < n; k++) assert_true(c[k].reason == SUNDER_REASON_UNRESOLVED && !c[k].crowded);
        sunder_report_free(report);
        proof_town_free(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_grids), cmocka_unit_test(check_that_fit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
