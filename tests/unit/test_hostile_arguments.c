/* Arguments that no correct program passes: arrays that contradict each other, values outside of enumerations, texts of
 * any length, sizes and gaps over the whole range of doubles. */
#include "random.h"
#include "sunder.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static sunder_shape *rectangle(double x, double y, double width, double height)
{
    const double xy[] = {x, y, x + width, y, x + width, y + height, x, y + height};
    const size_t ring_end = 4, poly_end = 1;
    sunder_shape *s = NULL;
    sunder_shape_from_rings(xy, &ring_end, &poly_end, 1, SUNDER_VALIDITY_STRICT, &s, NULL);
    return s;
}

static void test_ends(void **state)
{
    (void)state;
    static const double xy[] = {0, 0, 9, 0, 9, 9, 0, 9, 1, 1, 2, 1, 2, 2};
    static const size_t rings[][3] = {{7, 4, 7}, {4, 3, 7}, {SIZE_MAX, 4, 7}, {4, SIZE_MAX, 7}};
    static const size_t polygons[][3] = {{2, 1, 2}, {SIZE_MAX, 1, 2}, {1, SIZE_MAX, 2}};
    const size_t rings_fine[] = {4, 7}, polygons_fine[] = {1, 2};
    sunder_shape *s = NULL;
    sunder_error err;
    for (int validity = 0; validity < 2; validity++) {
        for (size_t i = 0; i < sizeof rings / sizeof *rings; i++) {
            const size_t three[] = {3};
            assert_int_equal(sunder_shape_from_rings(xy, rings[i], three, 1, (sunder_validity)validity, &s, &err),
                             SUNDER_EARG);
        }
        for (size_t i = 0; i < sizeof polygons / sizeof *polygons; i++)
            assert_int_equal(
                sunder_shape_from_rings(xy, rings_fine, polygons[i], 3, (sunder_validity)validity, &s, &err),
                SUNDER_EARG);
    }
    assert_int_equal(sunder_shape_from_rings(xy, rings_fine, polygons_fine, 2, (sunder_validity)2, &s, &err),
                     SUNDER_EARG);
    assert_null(s);
    const size_t lines[] = {3, 2, 4};
    const sunder_obstacle o = {NULL, xy, lines, 3};
    const sunder_place from = {{0, 0}, {NULL, NULL}}, to = {{9, 0}, {NULL, NULL}};
    sunder_shape *robot = rectangle(0, 0, 1, 1);
    sunder_route *route = NULL;
    assert_int_equal(sunder_route_find(&o, 1, robot, &from, &to, NULL, &route, &err), SUNDER_EARG);
    assert_null(route);
    sunder_shape_free(robot);
}

/* ---- Long texts ---- */

static size_t spent;

/* Allocations fail after 64 MB in total, including freed memory. */
static void *within_means(size_t size)
{
    spent += size;
    return spent > (size_t)64 << 20 ? NULL : malloc(size);
}

static void *within_means_again(void *old, size_t size)
{
    spent += size;
    return spent > (size_t)64 << 20 ? NULL : realloc(old, size);
}

/* One third, written with 200,000 digits in numerator and denominator. */
static void test_long_text(void **state)
{
    (void)state;
    enum { DIGITS = 200000 };
    char *text = malloc(2 * DIGITS + 2);
    memset(text, '1', DIGITS);
    text[DIGITS] = '/';
    memset(text + DIGITS + 1, '3', DIGITS);
    text[2 * DIGITS + 1] = '\0';
    const sunder_place from = {{0, 0}, {text, "-7"}}, to = {{0, 0}, {"1/3", "-7"}};
    sunder_set_allocator(within_means, within_means_again, free);
    sunder_shape *robot = rectangle(0, 0, 1, 1);
    sunder_route *route = NULL;
    const char *x, *y;
    assert_int_equal(sunder_route_find(NULL, 0, robot, &from, &to, NULL, &route, NULL), SUNDER_OK);
    assert_int_equal(sunder_route_vertices(route), 1);
    sunder_route_vertex_text(route, 0, &x, &y);
    assert_string_equal(x, "1/3");
    assert_string_equal(y, "-7");
    sunder_route_free(route);
    sunder_shape_free(robot);
    sunder_set_allocator(NULL, NULL, NULL);
    free(text);
}

/* ---- Sizes ---- */

/* A random size, sometimes the least or the greatest double. */
static double random_size(rng *r)
{
    switch (rng_int(r, 0, 9)) {
    case 0: return DBL_TRUE_MIN;
    case 1: return DBL_MAX / 4;
    case 2: return ldexp(1 + rng_unit(r), (int)rng_int(r, -4, 4));
    default: return ldexp(1 + rng_unit(r), (int)rng_int(r, -1074, 1020));
    }
}

/* Three questions about one pair agree, for all sizes. There is an answer unless the gap is more than 2^700 times as
 * long as the least length: then the search may report a failure, but must not return anything false. */
static void test_sizes(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(1500);
    size_t bad = 0, answers = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (size_t i = 0; i < n && bad < 3; i++) {
        rng r = rng_start(seed * 43, i);
        const double a = random_size(&r), b = random_size(&r), at = rng_once_in(&r, 2) ? random_size(&r) : 0;
        const double height = rng_once_in(&r, 2) ? a : random_size(&r), gap = rng_once_in(&r, 4) ? 0 : random_size(&r);
        const double least = fmin(fmin(a, b), fmin(height, at > 0 ? at : a));
        sunder_shape *p = rectangle(0, 0, a, height), *q = rectangle(at, -at, b, b);
        sunder_separation s;
        bool apart = false, overlap = false;
        if (p && q) {
            const sunder_status status = sunder_pair_separate(p, q, gap, &s, NULL);
            assert_int_equal(sunder_pair_apart(p, q, gap, &apart, NULL), SUNDER_OK);
            assert_int_equal(sunder_pair_overlap(p, q, &overlap, NULL), SUNDER_OK);
            bool right = status == SUNDER_OK || gap > ldexp(least, 700);
            if (status == SUNDER_OK) {
                right = s.overlap == !apart && (gap > 0 || s.overlap == overlap) && s.lower_bound <= s.distance;
                sunder_separation_clear(&s);
                answers++;
            }
            if (!right)
                print_message("case %zu: %g x %g and %g at %g, gap %g: %s\n", i, a, height, b, at, gap,
                              sunder_status_string(status));
            bad += !right;
        }
        sunder_shape_free(p);
        sunder_shape_free(q);
    }
    assert_int_equal(bad, 0);
    assert_true(answers > n / 3);
}

/* Sides that underflow relative to the gap must not affect distant features: these two are 0.14 apart, not 1. */
static void test_least_square(void **state)
{
    (void)state;
    const double x = 0.1, xy[] = {x, x, nextafter(x, 1), x, x, nextafter(x, 0)};
    const size_t ring_end = 3, poly_end = 1;
    sunder_shape *p = rectangle(0, 0, DBL_TRUE_MIN, DBL_TRUE_MIN), *q = NULL;
    assert_int_equal(sunder_shape_from_rings(xy, &ring_end, &poly_end, 1, SUNDER_VALIDITY_STRICT, &q, NULL), SUNDER_OK);
    sunder_separation s;
    assert_int_equal(sunder_pair_separate(p, q, 1, &s, NULL), SUNDER_OK);
    assert_true(s.overlap && s.distance > 0.85 && s.distance < 0.86);
    sunder_separation_clear(&s);
    sunder_shape_free(p);
    sunder_shape_free(q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_ends), cmocka_unit_test(test_long_text),
                                       cmocka_unit_test(test_sizes), cmocka_unit_test(test_least_square)};
    return cmocka_run_group_tests_name("hostile arguments", tests, NULL, NULL);
}
