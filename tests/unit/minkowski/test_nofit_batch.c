/* sunder_nofit_batch(): results are shared where parts and rotations repeat, are those of single sums, and are exact
 * for rational rotations; wrong numbers, threads, memory that runs out at every allocation. */
#include "failing.h"
#include "minkowski/rotated_copies.h"
#include "polyset.h"
#include "sum_text.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { PARTS = 4 };

static const char *const texts[PARTS] = {
    "POLYGON((0 0,6 0,6 3,4 3,4 1,2 1,2 3,0 3,0 0))", /* a slot */
    "POLYGON((0 0,2 0,2 2,0 2,0 0))",                 /* that this square fits */
    "POLYGON((0 0,2 0,2 2,0 2,0 0))",                 /* the same */
    "POLYGON((0.1 0,3.3 0.7,1.9 2.3,0.1 0))",
};

/* 0 and 3 are the same; 4 is not rational; 5 looks like one, but is longer. */
static const sunder_rotation turns[] = {{1, 0, 1},   {0, 1, 1},   {3, 4, 5}, {1, 0, 1}, {0.8660254037844387, 0.5, 1},
                                        {3, 4, 5.5}, {-5, 12, 13}};
enum { TURNS = sizeof turns / sizeof *turns };

static sunder_shape *parts[PARTS];

static int make_parts(void **state)
{
    (void)state;
    for (int k = 0; k < PARTS; k++) parts[k] = polyset_shape_of_wkt(texts[k]);
    return 0;
}

static int free_parts(void **state)
{
    (void)state;
    for (int k = 0; k < PARTS; k++) sunder_shape_free(parts[k]);
    return 0;
}

static sunder_nofits *run(const sunder_nofit *pair, size_t n, unsigned threads)
{
    sunder_nofits *out = NULL;
    sunder_error why;
    const sunder_sum_options how = {.size = sizeof how, .threads = threads};
    if (sunder_nofit_batch((const sunder_shape *const *)parts, PARTS, turns, TURNS, pair, n, &how, &out, &why) !=
        SUNDER_OK)
        fail_msg("%s", why.message);
    return out;
}

/* The text of the sum of two shapes, which are freed. */
static char *text_of(sunder_shape *fixed, sunder_shape *moving)
{
    sunder_shape *reflected;
    sunder_sum *sum;
    assert_int_equal(sunder_shape_reflect(moving, &reflected, NULL), SUNDER_OK);
    assert_int_equal(sunder_minkowski_sum(fixed, reflected, NULL, &sum, NULL), SUNDER_OK);
    char *text = sum_text(sum);
    sunder_sum_free(sum);
    sunder_shape_free(reflected);
    sunder_shape_free(fixed);
    sunder_shape_free(moving);
    return text;
}

static void assert_result(const sunder_nofits *nofits, size_t pair, double wanted_scale, bool wanted_exact,
                          char *wanted)
{
    double scale;
    bool exact;
    const sunder_sum *sum = sunder_nofits_sum(nofits, sunder_nofits_result(nofits, pair), &scale, &exact);
    assert_true(scale == wanted_scale);
    assert_int_equal(exact, wanted_exact);
    char *text = sum_text(sum);
    assert_string_equal(text, wanted);
    free(text);
    free(wanted);
}

static void test_shared(void **state)
{
    (void)state;
    const sunder_nofit pair[] = {{0, 1, 0, 0}, {0, 2, 0, 3}, {0, 1, 3, 0}, {0, 1, 0, 1}, {1, 0, 0, 0}, {2, 0, 0, 0}};
    sunder_nofits *nofits = run(pair, 6, 1);
    assert_int_equal(sunder_nofits_distinct(nofits), 3);
    const size_t number[] = {0, 0, 0, 1, 2, 2};
    for (size_t i = 0; i < 6; i++) assert_int_equal(sunder_nofits_result(nofits, i), number[i]);
    assert_result(nofits, 0, 1, true, text_of(polyset_shape_of_wkt(texts[0]), polyset_shape_of_wkt(texts[1])));
    assert_result(nofits, 3, 1, true,
                  text_of(polyset_shape_of_wkt(texts[0]), polyset_shape_of_wkt("POLYGON((0 0,0 2,-2 2,-2 0,0 0))")));
    sunder_nofits_free(nofits);
    sunder_nofits_free(NULL);
    nofits = run(NULL, 0, 1);
    assert_int_equal(sunder_nofits_distinct(nofits), 0);
    sunder_nofits_free(nofits);
}

static void test_rational(void **state)
{
    (void)state;
    /* By 3 + 4 i over 5, in the scale 5; both rotated, in the scale 65; coordinates that are too long for it. */
    const sunder_nofit pair[] = {{0, 1, 0, 2}, {0, 1, 6, 2}, {0, 3, 0, 2}};
    sunder_nofits *nofits = run(pair, 3, 1);
    assert_int_equal(sunder_nofits_distinct(nofits), 3);
    assert_result(nofits, 0, 5, true,
                  text_of(polyset_shape_of_wkt("POLYGON((0 0,30 0,30 15,20 15,20 5,10 5,10 15,0 15,0 0))"),
                          polyset_shape_of_wkt("POLYGON((0 0,6 8,-2 14,-8 6,0 0))")));
    assert_result(nofits, 1, 65, true,
                  text_of(polyset_shape_of_wkt("POLYGON((0 0,-150 360,-330 285,-280 165,-160 215,-110 95,-230 45,"
                                               "-180 -75,0 0))"),
                          polyset_shape_of_wkt("POLYGON((0 0,78 104,-26 182,-104 78,0 0))")));
    double scale;
    bool exact;
    sunder_nofits_sum(nofits, 2, &scale, &exact);
    assert_false(exact);
    assert_true(scale == 1);
    sunder_nofits_free(nofits);
}

static void test_rounded(void **state)
{
    (void)state;
    const sunder_nofit pair[] = {{1, 1, 0, 4}, {1, 1, 0, 5}};
    sunder_nofits *nofits = run(pair, 2, 1);
    const double c = turns[4].cosine, s = turns[4].sine;
    char wkt[200];
    snprintf(wkt, sizeof wkt, "POLYGON((0 0,%.17g %.17g,%.17g %.17g,%.17g %.17g,0 0))", 2 * c, 2 * s, 2 * c - 2 * s,
             2 * s + 2 * c, -2 * s, 2 * c);
    assert_result(nofits, 0, 1, false, text_of(polyset_shape_of_wkt(texts[1]), polyset_shape_of_wkt(wkt)));
    double scale;
    bool exact;
    sunder_nofits_sum(nofits, 1, &scale, &exact);
    assert_true(scale == 1);
    assert_false(exact);
    sunder_nofits_free(nofits);
}

/* A rotation is exact only if no product and no sum is rounded, nor any error is too small for doubles. */
static void test_copies(void **state)
{
    (void)state;
    static const struct {
        double x, c, s;
        bool exact;
    } cases[] = {{3, 3, 4, true},    {0x1p52 + 1, 1, 1, true},   {0x1p53 - 1, 3, 4, false},
                 {0.1, 3, 4, false}, {0x1p-1000, 0.1, 0, false}, {0x1p-540, 0x1p-600, 0x1p-540, false}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const double x = cases[k].x, xy[] = {0, 0, x, 0, 0, x};
        const size_t ring_end[] = {3}, poly_end[] = {1};
        sunder_shape *shape, *copy;
        bool exact;
        assert_int_equal(sunder_shape_from_rings(xy, ring_end, poly_end, 1, SUNDER_VALIDITY_STRICT, &shape, NULL), 0);
        if (sunder_i_rotated_copy(shape, cases[k].c, cases[k].s, &copy, &exact, NULL) == SUNDER_OK) {
            assert_int_equal(exact, cases[k].exact);
            sunder_shape_free(copy);
        } else {
            assert_false(cases[k].exact);
        }
        sunder_shape_free(shape);
    }
    const sunder_rotation whole[] = {{3, 4, 5}, {-1, 0, 1}, {67108863, 0, 67108863}},
                          other[] = {{3, 4, 6}, {0.6, 0.8, 1}, {6, 8, -10}, {67108865, 0, 67108865}, {0, 0, 1}};
    for (size_t k = 0; k < 3; k++) assert_true(sunder_i_rotation_is_rational(&whole[k]));
    for (size_t k = 0; k < 5; k++) assert_false(sunder_i_rotation_is_rational(&other[k]));
}

static void assert_refused(const sunder_rotation *rotation, sunder_nofit pair, sunder_status wanted)
{
    sunder_nofits *out = NULL;
    sunder_error why;
    assert_int_equal(
        sunder_nofit_batch((const sunder_shape *const *)parts, PARTS, rotation, 1, &pair, 1, NULL, &out, &why), wanted);
    assert_null(out);
    assert_true(strlen(why.message) > 10);
}

static void test_refused(void **state)
{
    (void)state;
    const sunder_rotation good = {1, 0, 1}, bad[] = {{NAN, 0, 1}, {1, INFINITY, 1}, {1, 0, 0}, {1, 0, -1}, {1, 0, NAN}},
                          far = {1e308, 1e308, 1e-3};
    assert_refused(&good, (sunder_nofit){PARTS, 0, 0, 0}, SUNDER_EARG);
    assert_refused(&good, (sunder_nofit){0, PARTS, 0, 0}, SUNDER_EARG);
    assert_refused(&good, (sunder_nofit){0, 0, 1, 0}, SUNDER_EARG);
    assert_refused(&good, (sunder_nofit){0, 0, 0, 1}, SUNDER_EARG);
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        assert_refused(&bad[k], (sunder_nofit){0, 0, 0, 0}, SUNDER_EARG);
    assert_refused(&far, (sunder_nofit){0, 0, 0, 0}, SUNDER_ERANGE);
}

static bool attempt(void *context)
{
    const sunder_nofit pair[] = {{0, 1, 0, 2}, {3, 1, 0, 2}, {0, 2, 0, 2}, {0, 3, 4, 1}};
    sunder_nofits *out = NULL;
    sunder_error why;
    (void)context;
    const sunder_status status =
        sunder_nofit_batch((const sunder_shape *const *)parts, PARTS, turns, TURNS, pair, 4, NULL, &out, &why);
    if (status != SUNDER_OK && (status != SUNDER_ENOMEM || out)) fail_msg("%s", why.message);
    sunder_nofits_free(out);
    return status == SUNDER_OK;
}

static void test_no_memory(void **state)
{
    (void)state;
    assert_true(failing_loop(attempt, NULL, false));
}

/* All pairs at all rotations: the same on four threads, and the same number of results. */
static void test_threads(void **state)
{
    (void)state;
    sunder_nofit pair[PARTS * PARTS * TURNS * TURNS];
    size_t n = 0;
    for (uint32_t a = 0; a < PARTS; a++)
        for (uint32_t b = 0; b < PARTS; b++)
            for (uint32_t r = 0; r < TURNS; r++)
                for (uint32_t s = 0; s < TURNS; s++) pair[n++] = (sunder_nofit){a, b, r, s};
    sunder_nofits *one = run(pair, n, 1), *four = run(pair, n, 4);
    assert_int_equal(sunder_nofits_distinct(one), sunder_nofits_distinct(four));
    /* Two parts are the same, and two rotations. */
    assert_in_range(sunder_nofits_distinct(one), 3 * 3 * 6 * 6 / 2, 3 * 3 * 6 * 6);
    for (size_t i = 0; i < n; i++) {
        double scale;
        bool exact;
        char *text = sum_text(sunder_nofits_sum(four, sunder_nofits_result(four, i), &scale, &exact));
        assert_result(one, i, scale, exact, text);
    }
    sunder_nofits_free(one);
    sunder_nofits_free(four);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shared),  cmocka_unit_test(test_rational), cmocka_unit_test(test_rounded),
        cmocka_unit_test(test_copies),  cmocka_unit_test(test_refused),  cmocka_unit_test(test_no_memory),
        cmocka_unit_test(test_threads),
    };
    return cmocka_run_group_tests(tests, make_parts, free_parts);
}
