/* Sums of two simple polygons by their reduced convolution, compared byte for byte with the oracle's, holes included.
 * The tracing is called directly, so that the general algorithm cannot replace it. If it declines there is nothing to
 * compare, and it must not decline always. */
#include "generate.h"
#include "minkowski/reduced_convolution.h"
#include "oracle.h"
#include "roads.h"
#include "sum_text.h"
#include "traced.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef enum subject { SMALL, TIGHT, STARS, COMBS, BAYS, FAR, SUBJECTS } subject;

static const char *const subject_name[SUBJECTS] = {
    "small polygons", "polygons on a few places", "stars", "combs", "bays that close", "beyond 32 bits",
};

/* A ring with an opening about as wide as the other operand, so that the sum often has a hole. */
static void random_bay(polyset *p, rng *r)
{
    enum { MOST = 8 };
    const int n = (int)rng_int(r, 4, MOST);
    double xy[4 * MOST];
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < n; i++) {
            const double angle = 0.2 + 5.9 * (side ? n - 1 - i : i) / (n - 1);
            const double radius = (side ? 30 : 55) + 12 * rng_unit(r);
            xy[2 * (side * n + i)] = rint(radius * cos(angle));
            xy[2 * (side * n + i) + 1] = rint(radius * sin(angle));
        }
    polyset_polygon(p, xy, 2 * (size_t)n);
}

static void random_operands(polyset *p, polyset *q, rng *r, subject kind)
{
    switch (kind) {
    case SMALL:
        random_simple(p, r, (int)rng_int(r, 4, 8), 60);
        random_simple(q, r, (int)rng_int(r, 4, 8), 40);
        break;
    case TIGHT: /* vertices of one on sides of the other, equal sums, three segments through a point */
        random_simple(p, r, (int)rng_int(r, 4, 8), (int)rng_int(r, 5, 12));
        random_simple(q, r, (int)rng_int(r, 4, 8), (int)rng_int(r, 4, 9));
        break;
    case COMBS:
        random_comb(p, r, (int)rng_int(r, 2, 5), 90, true);
        random_fork(q, r, (int)rng_int(r, 2, 3), 40, rng_once_in(r, 2));
        polyset_map(q, 3, 1, -1, 2);
        break;
    case BAYS:
        random_bay(p, r);
        random_star(q, r, (int)rng_int(r, 4, 9), (double)rng_int(r, 4, 30));
        break;
    default:
        random_star(p, r, (int)rng_int(r, 5, 14), 90);
        random_star(q, r, (int)rng_int(r, 5, 14), 70);
        break;
    }
    if (kind == FAR) { /* multiplied by odd numbers of 45 bits, so that coordinates need all their bits */
        polyset_scale(p, 0x1.23456789abcp+44, 0x1.abcdef12345p+44);
        polyset_scale(q, 0x1.23456789abcp+44, 0x1.abcdef12345p+44);
    }
    if (rng_once_in(r, 2)) {
        polyset t = *p;
        *p = *q;
        *q = t;
    }
}

/* Returns 1 if traced and equal to the oracle's sum, 0 if declined, -1 if wrong. */
static int trace_one(subject kind, uint64_t seed, size_t i, size_t *holes)
{
    rng r = rng_start(seed * 31 + (uint64_t)kind, i);
    polyset p, q;
    polyset_init(&p);
    polyset_init(&q);
    random_operands(&p, &q, &r, kind);
    char *ours = traced_text(sunder_i_reduced_convolution_sum, &p, &q, holes);
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
    const size_t n = test_count(200);
    size_t traced = 0, bad = 0, holes = 0;
    for (size_t i = 0; i < n && bad < 2; i++) {
        const int verdict = trace_one(kind, seed, i, &holes);
        traced += verdict > 0;
        bad += verdict < 0;
    }
    print_message("SUNDER_SEED=%llu, %zu of %zu traced, %zu holes\n", (unsigned long long)seed, traced, n, holes);
    assert_int_equal(bad, 0);
    assert_true(bad > 0 || traced >= n / 20);
    assert_true(bad > 0 || kind != BAYS || holes >= n / 20);
}

/* A round outline of n vertices at this distance from its centre: like a star, or like a jagged coast. */
static void random_round(polyset *p, rng *r, int n, double least, double most)
{
    double *xy = test_alloc(2 * (size_t)n, sizeof *xy);
    for (int i = 0; i < n; i++) {
        const double angle = 2 * acos(-1) * i / n, radius = least + (most - least) * rng_unit(r);
        xy[2 * i] = rint(radius * cos(angle));
        xy[2 * i + 1] = rint(radius * sin(angle));
    }
    polyset_polygon(p, xy, (size_t)n);
    free(xy);
}

/* Operands with some thousand segments, compared with an arrangement of all subsums: a few stars, whose segments have
 * many stops, and coasts of hundreds of vertices plus a star, whose segments are short. */
static void test_larger(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(6);
    size_t traced = 0;
    for (size_t i = 0; i < n; i++) {
        const bool shore = i % 2 == 1;
        rng r = rng_start(seed * 37, i);
        polyset p, q;
        size_t holes = 0;
        polyset_init(&p);
        polyset_init(&q);
        if (shore)
            random_round(&p, &r, 350, 60000, 62500);
        else
            random_round(&p, &r, 48, 15000, 90000);
        random_round(&q, &r, shore ? 9 : 44, shore ? 500 : 9000, shore ? 3000 : 70000);
        char *ours = traced_text(sunder_i_reduced_convolution_sum, &p, &q, &holes);
        if (ours) {
            sunder_shape *a = polyset_shape(&p), *b = polyset_shape(&q);
            const sunder_sum_options how = road_options(0, seed);
            char *expected = road_text(a, b, &how, false);
            assert_non_null(expected);
            assert_string_equal(ours, expected);
            traced++;
            free(expected);
            sunder_shape_free(a);
            sunder_shape_free(b);
        }
        free(ours);
        polyset_free(&p);
        polyset_free(&q);
    }
    print_message("SUNDER_SEED=%llu, %zu of %zu traced\n", (unsigned long long)seed, traced, n);
    assert_true(traced > n / 2);
}

/* One case for each condition on which it depends whether a sum is traced. */
static void test_cases(void **state)
{
    (void)state;
    static const char *const bay = "POLYGON ((40 2, 38 31, -21 40, -43 -2, -18 -39, 41 -37, 39 -5, 25 -6, 24 -23, "
                                   "-12 -26, -29 1, -13 27, 26 22, 27 3))";
    static const struct {
        const char *p, *q;
        bool traced;
        size_t holes;
    } cases[] = {
        /* two arrowheads */
        {"POLYGON ((0 0, 50 7, 3 41, 11 13))", "POLYGON ((0 0, 19 -22, 31 17, 17 5))", true, 0},
        /* a bay with a mouth of width eight: an arrowhead that closes it leaves a hole; a larger one fills it, a
         * smaller one fits through */
        {"", "POLYGON ((-6 -6, 7 -5, 1 0, 2 8))", true, 1},
        {"", "POLYGON ((-60 -60, 70 -50, 10 0, 20 80))", true, 0},
        {"", "POLYGON ((-1.5 -1.5, 1.5 -1.25, 0.25 0, 0.5 1))", true, 0},
        /* a side of one has the direction of a side of the other: along an axis, and not; opposite directions are
         * allowed */
        {"POLYGON ((0 0, 50 0, 3 41, 11 13))", "POLYGON ((0 0, 19 0, 31 17, 17 5))", false, 0},
        {"POLYGON ((0 0, 50 7, 3 41, 11 13))", "POLYGON ((0 0, 100 14, 31 37, 47 15))", false, 0},
        {"POLYGON ((0 0, 50 7, 3 41, 11 13))", "POLYGON ((0 0, -50 -7, -12 -43, -9 -11))", true, 0},
        /* the sum with itself: every sum of two vertices occurs twice */
        {"POLYGON ((0 0, 50 7, 3 41, 11 13))", "POLYGON ((0 0, 50 7, 3 41, 11 13))", false, 0},
        /* a hole, and a second polygon */
        {"POLYGON ((0 0, 50 7, 3 41, 11 13), (20 12, 18 18, 26 14))", "POLYGON ((0 0, 19 -22, 31 17, 17 5))", false, 0},
        {"MULTIPOLYGON (((0 0, 50 7, 3 41, 11 13)), ((90 0, 91 2, 92 1)))", "POLYGON ((0 0, 19 -22, 31 17, 17 5))",
         false, 0},
        /* a ring that touches itself */
        {"POLYGON ((0 0, 51 7, 20 20, 3 41, 11 13, 20 20, 17 9))", "POLYGON ((0 0, 19 -22, 31 17, 17 5))", false, 0},
        /* ends of segments on others, inside the sum; and three segments that cross in one point of the boundary */
        {"POLYGON ((0 0, 4 1, 8 0, 5 4, 4 9, 3 4))", "POLYGON ((0 0, 3 2, 6 -1, 2 6))", false, 0},
        {"POLYGON ((-55 -75, -34 -68, 74 -104, 82 -88, -26 -52, -14 -28, 85 -61, 93 -45, -6 -12, -15 5))",
         "POLYGON ((90 -11.25, 88 1, 82 81, 80 81, 74 0, 70 1, 65 84, 61 85, 56 0, 52 0, 46 77, 44 77, 38 0, 34 1, "
         "29 72, 25 73, 20 1, 16 1, 11 82, 7 83, 2 1, 0 -11.25))",
         false, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        polyset p, q;
        size_t holes = 0;
        assert_true(polyset_read_wkt(&p, *cases[i].p ? cases[i].p : bay, NULL) &&
                    polyset_read_wkt(&q, cases[i].q, NULL));
        char *ours = traced_text(sunder_i_reduced_convolution_sum, &p, &q, &holes),
             *expected = oracle_sum_text(&p, &q, false);
        if ((ours != NULL) != cases[i].traced || holes != cases[i].holes)
            print_message("case %zu: traced %d, holes %zu\n%s\n", i, ours != NULL, holes, expected);
        if (ours) assert_string_equal(ours, expected);
        assert_int_equal(ours != NULL, cases[i].traced);
        assert_int_equal(holes, cases[i].holes);
        free(ours);
        free(expected);
        polyset_free(&p);
        polyset_free(&q);
    }
}

/* A sum with a hole, with every allocation failing once. */
static void test_memory(void **state)
{
    (void)state;
    polyset operand[2];
    size_t holes = 0;
    assert_true(polyset_read_wkt(&operand[0],
                                 "POLYGON ((40 2, 38 31, -21 40, -43 -2, -18 -39, 41 -37, 39 -5, 25 -6, 24 -23, "
                                 "-12 -26, -29 1, -13 27, 26 22, 27 3))",
                                 NULL));
    assert_true(polyset_read_wkt(&operand[1], "POLYGON ((-6 -6, 7 -5, 1 0, 2 8))", NULL));
    char *text = traced_text(sunder_i_reduced_convolution_sum, &operand[0], &operand[1], &holes);
    assert_non_null(text);
    assert_int_equal(holes, 1);
    free(text);
    assert_true(library_sum_survives(operand));
    polyset_free(&operand[0]);
    polyset_free(&operand[1]);
}

int main(void)
{
    subject kinds[SUBJECTS];
    struct CMUnitTest tests[SUBJECTS + 3];
    for (int k = 0; k < SUBJECTS; k++) {
        kinds[k] = (subject)k;
        tests[k] = (struct CMUnitTest){subject_name[k], test_subject, NULL, NULL, &kinds[k]};
    }
    tests[SUBJECTS] = (struct CMUnitTest)cmocka_unit_test(test_cases);
    tests[SUBJECTS + 1] = (struct CMUnitTest)cmocka_unit_test(test_memory);
    tests[SUBJECTS + 2] = (struct CMUnitTest)cmocka_unit_test(test_larger);
    return cmocka_run_group_tests_name("sums off the reduced convolution", tests, NULL, NULL);
}
