/* The obstacle of two convex pieces, A + (-B), corner by corner. */
#include "base/memory.h"
#include "displacement/geometry/obstacle.h"
#include "random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { CORNERS = 24 };

/* Draws a polygon on an ellipse, counter-clockwise. */
static void draw(rng *r, double *xy, size_t n)
{
    const double a = rng_unit(r) + 0.1, b = rng_unit(r) + 0.1, turn = rng_unit(r), x = 8 * rng_unit(r);
    for (size_t k = 0; k < n; k++) {
        const double angle = turn + 6.283185307179586 * (double)k / (double)n;
        xy[2 * k] = x + a * cos(angle);
        xy[2 * k + 1] = b * sin(angle) - x;
    }
}

static bool is_difference(const double *a, size_t na, const double *b, size_t nb, const double offset[2],
                          const double *corner)
{
    for (size_t i = 0; i < na; i++)
        for (size_t j = 0; j < nb; j++)
            if (corner[0] == a[2 * i] - b[2 * j] - offset[0] && corner[1] == a[2 * i + 1] - b[2 * j + 1] - offset[1])
                return true;
    return false;
}

/* Every corner is the difference of two corners, rounded once, whatever the number of edges before it. */
static void test_corners_are_differences(void **state)
{
    (void)state;
    for (size_t k = 0; k < test_count(200); k++) {
        rng r = rng_start(test_seed(), k);
        double a[2 * CORNERS], b[2 * CORNERS];
        const size_t na = (size_t)rng_int(&r, 3, CORNERS), nb = (size_t)rng_int(&r, 1, CORNERS);
        const double offset[2] = {rng_unit(&r) / 3, 1e5 * rng_unit(&r)};
        draw(&r, a, na);
        draw(&r, b, nb);
        sunder_i_scratch scratch = {0};
        const size_t n = sunder_i_obstacle_corners(a, na, b, nb, offset, &scratch);
        assert_int_equal(n, na + nb);
        for (size_t m = 0; m < n; m++) assert_true(is_difference(a, na, b, nb, offset, scratch.xy + 2 * m));
        sunder_i_free(scratch.xy);
    }
}

/* Rounding must not leave an edge between the last corner and the first, since its normal would be noise: places deep
 * inside would count as outside of it. */
static void test_no_edge_of_noise(void **state)
{
    (void)state;
    const double box[] = {-0.45, -0.35, 0.15, -0.35, 0.15, 0.85, -0.45, 0.85}, point[] = {0.1, 0.7}, u[] = {-0.2, -0.2};
    for (int k = 0; k < 100; k++) {
        const double offset[] = {k / 30., -k / 70.}, at[] = {u[0] - offset[0], u[1] - offset[1]};
        sunder_i_scratch scratch = {0};
        sunder_i_obstacle_edge edge[5];
        const size_t n = sunder_i_obstacle_corners(box, 4, point, 1, offset, &scratch);
        assert_int_equal(n, 5);
        assert_int_equal(sunder_i_obstacle_edges(scratch.xy, n, edge), 4);
        assert_true(sunder_i_support_at(edge, 4, at).distance < 0);
        sunder_i_free(scratch.xy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_corners_are_differences),
        cmocka_unit_test(test_no_edge_of_noise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
