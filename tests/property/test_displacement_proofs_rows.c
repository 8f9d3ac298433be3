/* Rows of houses with limits that let a few pairs separate. A remaining pair has a proof exactly if a sum along the row
 * shows that there is no room, and the proof names the houses of that sum and no more. Proofs are also verified for
 * rows of rotated houses. Independent code verifies each proof (support/proof_check.c). */
#include "proof_town.h"
#include "random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* ---- Straight rows ----------------------------------------------------------------------------------------------- */

enum { LONGEST = 20 };

typedef struct row {
    proof_town town;
    double lack[LONGEST]; /* the distance that each pair of neighbours lacks */
    double owed[LONGEST]; /* the same for pairs that are solved, otherwise 0 */
} row;

/* Boxes in a row, so tall that none can pass another; every third row ends at a fixed house, or contains one. With gap
 * 0 they overlap. */
static void add_row(rng *r, row *out)
{
    proof_town *t = &out->town;
    memset(out, 0, sizeof *out);
    const size_t n = (size_t)rng_int(r, 8, LONGEST),
                 still = rng_once_in(r, 3) ? (size_t)rng_int(r, 0, (int64_t)n - 1) : n;
    const double limit = 1 + (double)rng_int(r, 0, 16) / 8;
    t->gap = rng_once_in(r, 3) ? 0 : 2;
    double x = (double)rng_int(r, 0, 1 << 20);
    for (size_t k = 0; k < n; k++) {
        const double width = 6 + (double)rng_int(r, 0, 32) / 8;
        proof_town_add_box(t, x, (double)rng_int(r, 0, 8) / 8, width, 20, k == still ? 0 : limit);
        out->lack[k] = (double)rng_int(r, 2, 12) / 8;
        x += width + t->gap - out->lack[k];
    }
}

/* The distance that the houses from `first` to `last` lack beyond their limits if `pair` has to be solved, too. */
static double excess(const row *r, size_t pair, size_t first, size_t last)
{
    double sum = -r->town.plain[first].max_shift - r->town.plain[last].max_shift;
    for (size_t k = first; k < last; k++) sum += k == pair ? r->lack[k] : r->owed[k];
    return sum;
}

static double most_excess(const row *r, size_t pair)
{
    double most = -INFINITY;
    for (size_t first = 0; first <= pair; first++)
        for (size_t last = pair + 1; last < r->town.n; last++) most = fmax(most, excess(r, pair, first, last));
    return most;
}

/* The houses of a proof are consecutive, and without the first or the last there is room. */
static void check_named(const row *r, const sunder_conflict *c, size_t pair)
{
    size_t first = pair, last = pair + 1;
    for (size_t k = 0; k < c->n_blocked_by; k++) {
        if (c->blocked_by[k] < first) first = c->blocked_by[k];
        if (c->blocked_by[k] > last) last = c->blocked_by[k];
    }
    assert_int_equal(c->n_blocked_by, last - first - 1);
    assert_true(excess(r, pair, first, last) > 0);
    if (first < pair) assert_true(excess(r, pair, first + 1, last) <= 0);
    if (last > pair + 1) assert_true(excess(r, pair, first, last - 1) <= 0);
}

static void check_rows(void **state)
{
    (void)state;
    size_t proved = 0, open = 0, longest = 0;
    const size_t trials = test_count(2);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        row of;
        size_t n;
        add_row(&r, &of);
        sunder_report *report = proof_town_separate(&of.town);
        proved += proof_town_check(&of.town, report, trial, &open);
        const sunder_conflict *c = sunder_report_conflicts(report, &n);
        memcpy(of.owed, of.lack, sizeof of.owed);
        for (size_t k = 0; k < n; k++) of.owed[c[k].a < c[k].b ? c[k].a : c[k].b] = 0;
        for (size_t k = 0; k < n; k++) {
            const size_t pair = c[k].a < c[k].b ? c[k].a : c[k].b;
            const double most = most_excess(&of, pair);
            if (c[k].reason != SUNDER_REASON_NO_ROOM && c[k].reason != SUNDER_REASON_UNRESOLVED) continue;
            if ((c[k].reason == SUNDER_REASON_NO_ROOM) != (most > 0))
                fail_msg("trial %zu: %zu and %zu are %s, and %g too long", trial, c[k].a, c[k].b,
                         sunder_reason_string(c[k].reason), most);
            if (c[k].reason != SUNDER_REASON_NO_ROOM) continue;
            check_named(&of, &c[k], pair);
            if (c[k].n_blocked_by > longest) longest = c[k].n_blocked_by;
        }
        sunder_report_free(report);
        proof_town_free(&of.town);
    }
    print_message("%zu with a proof, the longest of %zu besides the pair, %zu without\n", proved, longest, open);
    assert_true(proved > 3 * trials && longest > 6);
}

/* ---- Turned houses ----------------------------------------------------------------------------------------------- */

/* A row in any direction, each house rotated by a few degrees: at most pairs two walls face each other, and one house
 * can pass the other. */
static void check_turned(void **state)
{
    (void)state;
    size_t proved = 0, open = 0, longest = 0;
    const size_t trials = test_count(2);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        proof_town t;
        memset(&t, 0, sizeof t);
        t.gap = 3;
        const size_t n = (size_t)rng_int(&r, 6, LONGEST);
        const double along = 6.25 * rng_unit(&r), turn = ldexp(0.2, -(int)rng_int(&r, 0, 6)), far = 1e6 * rng_unit(&r);
        for (size_t k = 0; k < n; k++) {
            const double x = 12 * (double)k + 0.5 * rng_unit(&r), y = rng_unit(&r),
                         own = along + turn * (rng_unit(&r) - 0.5);
            static const double corner[8] = {-5, -5, 5, -5, 5, 5, -5, 5};
            double xy[8];
            for (size_t m = 0; m < 4; m++) {
                const double u = corner[2 * m], v = corner[2 * m + 1];
                xy[2 * m] = far + x * cos(along) - y * sin(along) + u * cos(own) - v * sin(own);
                xy[2 * m + 1] = far + x * sin(along) + y * cos(along) + u * sin(own) + v * cos(own);
            }
            proof_town_add(&t, xy, 4, 2);
        }
        sunder_report *report = proof_town_separate(&t);
        proved += proof_town_check(&t, report, trial, &open);
        size_t conflicts;
        const sunder_conflict *c = sunder_report_conflicts(report, &conflicts);
        for (size_t k = 0; k < conflicts; k++)
            if (c[k].reason == SUNDER_REASON_NO_ROOM && c[k].n_blocked_by > longest) longest = c[k].n_blocked_by;
        sunder_report_free(report);
        proof_town_free(&t);
    }
    print_message("%zu with a proof, the longest of %zu besides the pair, %zu without\n", proved, longest, open);
    assert_true(proved > 3 * trials && longest > 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_rows), cmocka_unit_test(check_turned)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
