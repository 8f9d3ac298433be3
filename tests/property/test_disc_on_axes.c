/* Discs whose number of segments is a multiple of four. The corners of an inside disc on the axes are exactly at the
 * radius, all its corners lie in the disc, those of an outside disc lie outside, and both polygons are symmetric about
 * the axes. Squared lengths are compared as rationals. */
#include "polyset.h"
#include "random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gmp.h>

/* Compares x^2 + y^2 with r^2. */
static int compare_to_radius(mpq_t work[2], const double *xy, double radius)
{
    for (int k = 0; k < 2; k++) {
        mpq_set_d(work[k], xy[k]);
        mpq_mul(work[k], work[k], work[k]);
    }
    mpq_add(work[0], work[0], work[1]);
    mpq_set_d(work[1], radius);
    mpq_mul(work[1], work[1], work[1]);
    return mpq_cmp(work[0], work[1]);
}

static bool is_point(const double *xy, double x, double y) { return xy[0] == x && xy[1] == y; }

/* The ring, starting at the corner on the positive x axis. */
static double *ring_from_axis(const sunder_shape *shape, size_t *corners)
{
    const double *xy = sunder_shape_ring(shape, 0, 0, corners);
    double *out = test_alloc(2 * *corners, sizeof *out);
    size_t first = 0;
    while (!(xy[2 * first] > 0 && xy[2 * first + 1] == 0)) first++;
    for (size_t i = 0; i < *corners; i++) memcpy(out + 2 * i, xy + 2 * ((first + i) % *corners), 2 * sizeof *out);
    return out;
}

static size_t count_faults(unsigned n, double radius, bool inside)
{
    sunder_shape *shape;
    size_t corners, faults = 0;
    mpq_t work[2];
    for (int k = 0; k < 2; k++) mpq_init(work[k]);
    assert_int_equal(sunder_shape_disc(radius, n, inside, &shape, NULL), SUNDER_OK);
    double *xy = ring_from_axis(shape, &corners);
    assert_int_equal(corners, n);
    for (unsigned i = 0; i < n; i++) {
        const double *p = xy + 2 * (size_t)i, *across = xy + 2 * (size_t)((n - i) % n),
                     *up = xy + 2 * (size_t)((n / 2 + n - i) % n);
        faults += inside ? compare_to_radius(work, p, radius) > 0 : compare_to_radius(work, p, radius) <= 0;
        faults += !is_point(across, p[0], -p[1]) || !is_point(up, -p[0], p[1]);
    }
    if (inside && !(is_point(xy, radius, 0) && is_point(xy + n / 2, 0, radius) && is_point(xy + n, -radius, 0) &&
                    is_point(xy + 3 * (size_t)n / 2, 0, -radius)))
        faults++;
    if (faults) print_message("%sdisc:%.17g:%u: %zu faults\n", inside ? "inside-" : "", radius, n, faults);
    for (int k = 0; k < 2; k++) mpq_clear(work[k]);
    free(xy);
    sunder_shape_free(shape);
    return faults;
}

/* All multiples of four up to 1024, then some thousands. */
static void test_axis_corners_are_on_the_circle(void **state)
{
    static const double plain[] = {5, 2, 1, 0.1, 0.15, 1.0 / 3, 12345.678};
    size_t faults = 0;
    for (unsigned i = 0; i < 400; i++) {
        rng r = rng_start(test_seed() + 60, i);
        const unsigned n = i < 256 ? 4 * (i + 1) : 4 * (unsigned)rng_int(&r, 256, 1024);
        const double radius = rng_once_in(&r, 2) ? plain[rng_int(&r, 0, 6)] : 0.001 + 100 * rng_unit(&r);
        faults += count_faults(n, radius, true) + count_faults(n, radius, false);
        faults += n % 64 == 0 && count_faults(n, 5, true);
    }
    assert_int_equal(faults, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_axis_corners_are_on_the_circle)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
