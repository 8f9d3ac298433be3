/* separation/separating_line: if two sets are reported to be a given length apart, their exact distance is at least
 * that. Convex sets that are clearly farther apart are usually reported. */
#include "random.h"
#include "separation/separation.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

enum { CORNERS = 8 };

/* A star-shaped ring around a place: convex if all radii are equal to one. */
static sunder_shape *draw(rng *r, const double at[2], double size, bool convex)
{
    double xy[2 * CORNERS];
    const size_t n = (size_t)rng_int(r, 3, CORNERS), polygon_end = 1;
    const double turn = 6.28 * rng_unit(r);
    for (size_t k = 0; k < n; k++) {
        const double a = turn + 2 * 3.14159265358979 * (double)k / (double)n,
                     far = size * (convex ? 1 : 0.2 + rng_unit(r));
        xy[2 * k] = at[0] + far * cos(a);
        xy[2 * k + 1] = at[1] + far * sin(a);
    }
    sunder_shape *shape = NULL;
    assert_int_equal(sunder_shape_from_rings(xy, &n, &polygon_end, 1, SUNDER_VALIDITY_EVEN_ODD, &shape, NULL),
                     SUNDER_OK);
    return shape;
}

/* Draws lengths near the distance, including neighbouring doubles of it. */
static double length_about(rng *r, double distance)
{
    switch (rng_int(r, 0, 4)) {
    case 0: return distance;
    case 1: return nextafter(distance, INFINITY);
    case 2: return distance * (1 - 0x1p-40 * rng_unit(r));
    case 3: return distance * (1 - 0x1p-10 * rng_unit(r));
    default: return distance * 2 * rng_unit(r);
    }
}

static void test_against_distance(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(4000);
    size_t said = 0, clear = 0;
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(seed, i);
        const double size = pow(10, 8 * rng_unit(&r) - 4), far = rng_once_in(&r, 2) ? 0 : size * 1e5 * rng_unit(&r);
        const bool convex = rng_once_in(&r, 2);
        const double at[2] = {far, -far}, to[2] = {far + size * 5 * rng_unit(&r), -far + size * 5 * rng_unit(&r)};
        sunder_shape *p = draw(&r, at, size, convex), *q = draw(&r, to, size, convex);
        double distance, on_p[2], on_q[2];
        assert_int_equal(sunder_pair_distance(p, q, &distance, on_p, on_q, NULL), SUNDER_OK);
        const double length = length_about(&r, distance);
        const bool apart = sunder_i_surely_apart(p, NULL, q, NULL, length);
        /* The distance is the nearest double to the true one. */
        if (apart) assert_true(distance >= length && distance > 0);
        said += apart;
        clear += convex && length < 0.9 * distance;
        sunder_shape_free(p);
        sunder_shape_free(q);
    }
    print_message("seed %llu: said of %zu, clear of %zu of %zu\n", (unsigned long long)seed, said, clear, n);
    assert_true(said > clear / 2 && clear > 0);
}

/* Translations are applied: two squares, moved apart and together by amounts that doubles represent. */
static void test_translated(void **state)
{
    (void)state;
    const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, right[] = {2, 0}, left[] = {-2, 0};
    const size_t ring_end = 4, polygon_end = 1;
    sunder_shape *p = NULL;
    assert_int_equal(sunder_shape_from_rings(square, &ring_end, &polygon_end, 1, SUNDER_VALIDITY_EVEN_ODD, &p, NULL),
                     SUNDER_OK);
    assert_false(sunder_i_surely_apart(p, NULL, p, NULL, 0));
    assert_true(sunder_i_surely_apart(p, NULL, p, right, 0.999));
    assert_false(sunder_i_surely_apart(p, NULL, p, right, 1));
    assert_true(sunder_i_surely_apart(p, left, p, right, 2.999));
    assert_false(sunder_i_surely_apart(p, right, p, right, 0));
    sunder_shape_free(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_against_distance), cmocka_unit_test(test_translated)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
