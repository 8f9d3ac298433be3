/* What convex polygons leave of a shape: named cases, and random ones asked at random points. */
#include "shape/difference.h"
#include "simple_polygon.h"

#include "base/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { CORNERS = 9, CUTS = 4 };

static double unit(uint64_t *stream) { return (double)(sunder_i_draw(stream) >> 11) * 0x1p-53; }

static sunder_shape *without(const sunder_shape *shape, double *xy, size_t *end, size_t n)
{
    const sunder_i_cuts cuts = {.xy = xy, .corners = n ? end[n - 1] : 0, .end = end, .n = n};
    sunder_shape *left;
    sunder_error err;
    assert_int_equal(sunder_i_shape_subtract(shape, &cuts, &left, &err), SUNDER_OK);
    return left;
}

static void check_squares(void **state)
{
    (void)state;
    const double square[] = {0, 0, 10, 0, 10, 10, 0, 10};
    const struct {
        double cut[8], area; /* 0: nothing is left */
        size_t vertices;
    } cases[] = {{{20, 0, 30, 0, 30, 10, 20, 10}, 100, 4}, /* apart */
                 {{10, 0, 20, 0, 20, 10, 10, 10}, 100, 4}, /* a common wall */
                 {{-1, -1, 11, -1, 11, 11, -1, 11}, 0, 0}, /* all of it */
                 {{0, 0, 10, 0, 10, 10, 0, 10}, 0, 0},     /* exactly all of it */
                 {{-1, -1, 11, -1, 11, 3, -1, 3}, 70, 4},  /* a side */
                 {{3, -1, 4, -1, 4, 11, 3, 11}, 60, 4},    /* the larger half remains */
                 {{4, 4, 6, 4, 6, 6, 4, 6}, 96, 8},        /* a hole */
                 {{-5, 5, 5, -5, 15, 5, 5, 15}, 0, 0},     /* corners of the square touch the sides of the cut */
                 {{0, 5, 5, 0, 10, 5, 5, 10}, 12.5, 3},    /* four equal corners are left: the first one */
                 {{-2, 4, 2, 4, 2, 6, -2, 6}, 96, 8}};     /* a notch */
    sunder_shape *shape = simple_polygon(square, 4);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double cut[8];
        size_t end = 4;
        memcpy(cut, cases[k].cut, sizeof cut);
        sunder_shape *left = without(shape, cut, &end, 1);
        assert_int_equal(left != NULL, cases[k].area > 0);
        if (left) assert_true(sunder_shape_area(left) == cases[k].area);
        if (left) assert_int_equal(sunder_shape_vertices(left), cases[k].vertices);
        sunder_shape_free(left);
    }
    sunder_shape_free(shape);
}

/* Is the point inside the polygon of n corners, and farther from its sides than `margin`? */
static bool is_deep_inside(const double *xy, size_t n, const double p[2], double margin)
{
    bool odd = false;
    for (size_t i = 0, j = n - 1; i < n; j = i++) {
        const double *a = xy + 2 * i, *b = xy + 2 * j, d[2] = {b[0] - a[0], b[1] - a[1]};
        const double t = fmin(1, fmax(0, ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1])));
        if (hypot(a[0] + t * d[0] - p[0], a[1] + t * d[1] - p[1]) < margin) return false;
        if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < d[0] * (p[1] - a[1]) / d[1] + a[0]) odd = !odd;
    }
    return odd;
}

/* A star around the origin, or with `convex` a polygon in a circle, moved by `at`. */
static void draw_polygon(uint64_t *stream, bool convex, const double at[2], double *xy, size_t n)
{
    const double radius = 2 + 3 * unit(stream), turn = 6 * unit(stream);
    for (size_t k = 0; k < n; k++) {
        const double r = convex ? radius : radius * (0.4 + unit(stream));
        const double angle = turn + 2 * acos(-1) * ((double)k + 0.5 * unit(stream)) / (double)n;
        xy[2 * k] = at[0] + r * cos(angle);
        xy[2 * k + 1] = at[1] + r * sin(angle);
    }
}

/* What is left lies in the shape and in no cut; a corner of it that is on a side of the shape is not outside of it. */
static void check_random(void **state)
{
    (void)state;
    uint64_t stream = 5;
    for (int round = 0; round < 2000; round++) {
        const double middle[2] = {1e6 * (round % 3), 1e5};
        double xy[2 * CORNERS], cut[2 * CUTS * CORNERS];
        size_t end[CUTS], cuts = 1 + (size_t)(sunder_i_draw(&stream) % CUTS), n = 0;
        draw_polygon(&stream, false, middle, xy, CORNERS);
        for (size_t k = 0; k < cuts; k++) {
            const size_t corners = 3 + (size_t)(sunder_i_draw(&stream) % (CORNERS - 2));
            const double at[2] = {middle[0] + 10 * unit(&stream) - 5, middle[1] + 10 * unit(&stream) - 5};
            draw_polygon(&stream, true, at, cut + 2 * n, corners);
            end[k] = n += corners;
        }
        sunder_shape *shape = simple_polygon(xy, CORNERS), *left = without(shape, cut, end, cuts);
        for (int k = 0; left && k < 50; k++) {
            size_t corners;
            const double *ring = sunder_shape_ring(left, 0, 0, &corners);
            const double p[2] = {middle[0] + 12 * unit(&stream) - 6, middle[1] + 12 * unit(&stream) - 6};
            bool inside = sunder_shape_rings(left, 0) == 1 && is_deep_inside(ring, corners, p, 1e-6);
            if (!inside) continue;
            assert_true(is_deep_inside(xy, CORNERS, p, 0));
            for (size_t i = 0, first = 0; i < cuts; first = end[i++])
                assert_false(is_deep_inside(cut + 2 * first, end[i] - first, p, 1e-6));
        }
        assert_true(!left || sunder_shape_area(left) <= sunder_shape_area(shape));
        sunder_shape_free(left);
        sunder_shape_free(shape);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_squares), cmocka_unit_test(check_random)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
