/* Sums with a convex operand, traced along the outline, compared byte for byte with the oracle's: polygons of all
 * kinds, with holes and bays that close, and convex shapes from small to larger than the polygon. The tracing is called
 * directly, so that the general algorithm cannot replace it. If it declines there is nothing to compare, and it must
 * not decline always. */
#include "generate.h"
#include "minkowski/convolution.h"
#include "oracle.h"
#include "sum_text.h"
#include "traced.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef enum subject { SIMPLE, STAR, COMB, FORK, BUILDING, BOARD, PATCHES, SLANTED, SUBJECTS } subject;

static const char *const subject_name[SUBJECTS] = {"simple polygons", "stars",  "combs",        "forks",
                                                   "buildings",       "boards", "half squares", "slanted boards"};

static void random_subject(polyset *p, rng *r, subject kind)
{
    cells board;
    switch (kind) {
    case SIMPLE: random_simple(p, r, (int)rng_int(r, 4, 8), 12); return;
    case STAR: random_star(p, r, (int)rng_int(r, 5, 14), 40); return;
    case COMB: random_comb(p, r, (int)rng_int(r, 2, 5), 60, rng_once_in(r, 2)); return;
    case FORK: random_fork(p, r, (int)rng_int(r, 2, 4), 40, rng_once_in(r, 2)); return;
    case BUILDING: random_building(p, r); return;
    default: break;
    }
    /* Decimal coordinates as in maps would be rounded, which makes sides that are not axis-parallel cross. */
    const spacing lines = kind == SLANTED || rng_once_in(r, 2) ? SPACING_SMALL : SPACING_MAP;
    random_cells(&board, r, (int)rng_int(r, 2, 6), (int)rng_int(r, 2, 5), lines, kind != BOARD, 80);
    cells_outline(p, &board, false, true);
    if (kind == SLANTED) polyset_map(p, 3, 1, -1, 2);
}

/* A convex polygon of about the size `size`; some of its sides have directions of the subject's sides. */
static void random_brush(polyset *q, rng *r, double size)
{
    if (rng_once_in(r, 3)) {
        const double w = rint(size * rng_unit(r)) + 1, h = rng_once_in(r, 2) ? w : rint(size * rng_unit(r)) + 1;
        polyset_rectangle(q, 0, 0, w, h);
    } else
        random_convex(q, r, (int)rng_int(r, 3, 12), size + 2);
    if (rng_once_in(r, 4)) polyset_map(q, 3, 1, -1, 2);
    polyset_move(q, (double)rng_int(r, -9, 9), (double)rng_int(r, -9, 9));
}

static double width_of(const polyset *p)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < p->vertices; i++) {
        low = fmin(low, p->xy[2 * i]);
        high = fmax(high, p->xy[2 * i]);
    }
    return high - low;
}

/* Returns 1 if traced and equal to the oracle's sum, 0 if declined, -1 if wrong. */
static int trace_one(subject kind, uint64_t seed, size_t i)
{
    static const double share[] = {0.02, 0.1, 0.2, 0.4, 1.5};
    rng r = rng_start(seed * 29 + (uint64_t)kind, i);
    polyset p, q;
    polyset_init(&p);
    polyset_init(&q);
    random_subject(&p, &r, kind);
    random_brush(&q, &r, width_of(&p) * share[i % (sizeof share / sizeof *share)]);
    char *ours = p.polygons == 1 ? traced_text(sunder_i_convolution_sum, &p, &q, NULL) : NULL;
    const int verdict = ours ? oracle_verdict(ours, &p, &q, subject_name[kind], seed, i) : 0;
    free(ours);
    polyset_free(&p);
    polyset_free(&q);
    return verdict;
}

static void test_subject(void **state)
{
    const subject kind = *(const subject *)*state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(150);
    size_t traced = 0, bad = 0;
    for (size_t i = 0; i < n && bad < 2; i++) {
        const int verdict = trace_one(kind, seed, i);
        traced += verdict > 0;
        bad += verdict < 0;
    }
    print_message("SUNDER_SEED=%llu, %zu of %zu traced\n", (unsigned long long)seed, traced, n);
    assert_int_equal(bad, 0);
    assert_true(bad > 0 || traced >= n / 20);
}

/* One case for each condition on which it depends whether a sum is traced. */
static void test_cases(void **state)
{
    (void)state;
    static const struct {
        const char *p, *q;
        bool traced;
    } cases[] = {
        /* a small step in the outline that disappears in the sum */
        {"POLYGON ((0 0, 40 0, 40 20, 21 20, 20 21, 0 21))", "POLYGON ((-9 0, 0 -8, 8 0, 0 9))", true},
        /* a bay that stays open, and one whose mouth closes, which makes a hole */
        {"POLYGON ((0 0, 40 0, 40 30, 30 30, 30 10, 10 10, 10 30, 0 30))", "POLYGON ((-3 0, 0 -4, 5 0, 0 3))", true},
        {"POLYGON ((0 0, 40 0, 40 30, 22 30, 22 25, 30 25, 30 10, 10 10, 10 25, 18 25, 18 31, 0 31))",
         "POLYGON ((-3 0, 0 -4, 5 0, 0 3))", true},
        /* bays whose floor is shorter than the shape's side along it: between steep walls, between walls so gentle that
         * the shape touches both corners, and one of each; and floors of equal length: an exact fit, or not */
        {"POLYGON ((0 0, 40 0, 40 30, 28 30, 22 20, 18 20, 12 30, 0 30))", "POLYGON ((-4 -3, 4 -3, 4 3, -4 3))", true},
        {"POLYGON ((0 0, 40 0, 40 30, 22 20, 18 20, 0 30))", "POLYGON ((-4 -4, 4 -4, 6 0, 4 4, -4 4, -6 0))", true},
        {"POLYGON ((0 0, 40 0, 40 30, 22 20, 18 20, 17 30, 0 30))", "POLYGON ((-4 -4, 4 -4, 6 0, 4 4, -4 4, -6 0))",
         true},
        {"POLYGON ((0 0, 40 0, 40 30, 24 20, 16 20, 0 30))", "POLYGON ((-4 -4, 4 -4, 6 0, 4 4, -4 4, -6 0))", false},
        /* a mouth that closes exactly: a degenerate segment */
        {"POLYGON ((0 0, 40 0, 40 30, 22 30, 22 25, 30 25, 30 10, 10 10, 10 25, 18 25, 18 30, 0 30))",
         "POLYGON ((-2 -2, 2 -2, 2 2, -2 2))", false},
        /* a courtyard that remains as a hole; some that are too small, or narrow, and are filled; one that the shape's
         * bounding box fits exactly, and one that the shape fits exactly from side to side, which is degenerate */
        {"POLYGON ((0 0, 40 0, 40 40, 0 40), (10 10, 12 29, 30 30, 28 11))", "POLYGON ((-3 0, 0 -4, 5 0, 0 3))", true},
        {"POLYGON ((0 0, 40 0, 40 40, 0 40), (10 10, 10 13, 13 13, 13 10))", "POLYGON ((-3 0, 0 -4, 5 0, 0 3))", true},
        {"POLYGON ((0 0, 40 0, 40 40, 0 40), (10 10, 10 30, 15 30, 15 10))", "POLYGON ((-3 0, 0 -4, 5 0, 0 3))", true},
        {"POLYGON ((0 0, 40 0, 40 40, 0 40), (10 10, 10 16, 35 16, 35 10), (9 20, 8 27, 15 30), (20 18, 20 38, 38 38, "
         "38 18))",
         "POLYGON ((-3 0, 0 -4, 5 0, 0 3))", true},
        {"POLYGON ((0 0, 40 0, 40 40, 0 40), (10 10, 10 17, 18 17, 18 10))", "POLYGON ((-3 0, 0 -4, 5 0, 0 3))", false},
        {"POLYGON ((0 0, 40 0, 40 40, 0 40), (10 10, 10 17, 18 17, 18 10))", "POLYGON ((-3 -4, 5 -4, 5 3, -3 3))",
         false},
        {"POLYGON ((0 0, 40 0, 40 40, 0 40), (10 10, 10 30, 18 30, 18 10))", "POLYGON ((-3 -4, 5 -4, 5 3, -3 3))",
         false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        polyset p, q;
        assert_true(polyset_read_wkt(&p, cases[i].p, NULL) && polyset_read_wkt(&q, cases[i].q, NULL));
        char *ours = traced_text(sunder_i_convolution_sum, &p, &q, NULL), *expected = oracle_sum_text(&p, &q, false);
        assert_int_equal(ours != NULL, cases[i].traced);
        if (ours) assert_string_equal(ours, expected);
        free(ours);
        free(expected);
        polyset_free(&p);
        polyset_free(&q);
    }
}

/* A step, a mouth that closes, and a courtyard, with each allocation failing in turn. */
static void test_memory(void **state)
{
    (void)state;
    polyset operand[2];
    assert_true(polyset_read_wkt(&operand[0],
                                 "POLYGON ((0 -50, 40 -50, 40 30, 22 30, 22 25, 30 25, 30 10, 10 10, 10 25, 18 25, "
                                 "18 31, 1 31, 1 30, 0 30), (10 -20, 28 -19, 30 -40, 12 -39))",
                                 NULL));
    assert_true(polyset_read_wkt(&operand[1], "POLYGON ((-3.125 0.25, 0.375 -4.5, 5.75 0.125, 0.25 3.25))", NULL));
    char *text = traced_text(sunder_i_convolution_sum, &operand[0], &operand[1], NULL);
    assert_non_null(text);
    free(text);
    assert_true(library_sum_survives(operand));
    polyset_free(&operand[0]);
    polyset_free(&operand[1]);
}

int main(void)
{
    subject kinds[SUBJECTS];
    struct CMUnitTest tests[SUBJECTS + 2];
    for (int k = 0; k < SUBJECTS; k++) {
        kinds[k] = (subject)k;
        tests[k] = (struct CMUnitTest){subject_name[k], test_subject, NULL, NULL, &kinds[k]};
    }
    tests[SUBJECTS] = (struct CMUnitTest)cmocka_unit_test(test_cases);
    tests[SUBJECTS + 1] = (struct CMUnitTest)cmocka_unit_test(test_memory);
    return cmocka_run_group_tests_name("sums traced along the outline", tests, NULL, NULL);
}
