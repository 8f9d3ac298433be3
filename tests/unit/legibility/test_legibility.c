/* legibility/legibility: which parts of a shape are below a limit? Each measure has shapes for which its value is
 * known, and is asked at that value, which passes, and one unit of the last place above, which does not. */
#include "failing.h"
#include "shape/shape.h"
#include "simple_polygon.h"
#include "sunder_legible.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static double *limit_for(sunder_legible_limits *limits, sunder_illegible_kind kind)
{
    double *const limit[] = {&limits->width, &limits->area, &limits->neck, &limits->inner_gap, &limits->edge};
    return limit[kind];
}

/* The number of parts below the limit; *first becomes the first one. */
static size_t below(const sunder_shape *shape, sunder_illegible_kind kind, double limit, sunder_illegible *first)
{
    sunder_legible_limits limits = {0};
    sunder_illegible *found;
    size_t n;
    *limit_for(&limits, kind) = limit;
    assert_int_equal(sunder_shape_illegible(shape, &limits, &found, &n, NULL), SUNDER_OK);
    for (size_t k = 0; k < n; k++) {
        assert_int_equal(found[k].kind, kind);
        assert_true(found[k].required == limit);
    }
    if (n && first) *first = found[0];
    sunder_free(found);
    return n;
}

/* The shape passes at `value` and at less, and fails one unit of the last place above it. */
static void is_tie(const sunder_shape *shape, sunder_illegible_kind kind, double value)
{
    sunder_illegible one;
    assert_int_equal(below(shape, kind, value, &one), 0);
    assert_int_equal(below(shape, kind, nextafter(value, 0), &one), 0);
    assert_int_equal(below(shape, kind, nextafter(value, INFINITY), &one), 1);
    assert_true(fabs(one.has - value) <= value * (kind == SUNDER_ILLEGIBLE_NARROW ? 1e-6 : 0));
    assert_int_equal(below(shape, kind, 1e3 * value, &one), 1);
}

/* The shape has no link of this kind. */
static void has_none(const sunder_shape *shape, sunder_illegible_kind kind)
{
    assert_int_equal(below(shape, kind, 1e9, NULL), 0);
}

static sunder_shape *polygon(const double *xy, const size_t *ring_end, size_t rings)
{
    sunder_shape *shape;
    const sunder_validity validity = SUNDER_VALIDITY_EVEN_ODD;
    assert_int_equal(sunder_shape_from_rings(xy, ring_end, &rings, 1, validity, &shape, NULL), SUNDER_OK);
    return shape;
}

#define SHAPE(...) simple_polygon((double[]){__VA_ARGS__}, sizeof((double[]){__VA_ARGS__}) / (2 * sizeof(double)))

/* ---- Each measure ------------------------------------------------------------------------------------------------ */

static void test_rectangle(void **state)
{
    (void)state;
    sunder_shape *s = SHAPE(0.1, 0.2, 7.1, 0.2, 7.1, 3.2, 0.1, 3.2);
    sunder_illegible one;
    is_tie(s, SUNDER_ILLEGIBLE_NARROW, 3.2 - 0.2); /* 3.2 - 0.2 is exact, and so is 3.2 - (double)0.2 */
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_NECK, 4, &one), 1);
    assert_true(one.has == 3.2 - 0.2);
    assert_true(one.from[0] == one.to[0] && one.from[0] > 0.1 && one.from[0] < 7.1);
    has_none(s, SUNDER_ILLEGIBLE_INNER_GAP);
    sunder_shape_free(s);
}

/* The largest disc of a triangle with the sides 3, 4, 5 has the radius 1: its centre is a single point. */
static void test_triangle(void **state)
{
    (void)state;
    sunder_shape *s = SHAPE(0, 0, 12, 0, 0, 9);
    is_tie(s, SUNDER_ILLEGIBLE_NARROW, 6);
    is_tie(s, SUNDER_ILLEGIBLE_SMALL, 54);
    is_tie(s, SUNDER_ILLEGIBLE_SHORT_EDGE, 9);
    has_none(s, SUNDER_ILLEGIBLE_NECK);
    has_none(s, SUNDER_ILLEGIBLE_INNER_GAP);
    sunder_shape_free(s);
}

/* Irrational widths: a limit that is a double is never met, but the nearest doubles on either side differ. */
static void test_irrational_width(void **state)
{
    (void)state;
    sunder_shape *s = SHAPE(0, 0, 1, 0, 0, 1); /* radius 1 - 1 / sqrt(2) */
    const double width = 2 - sqrt(2);
    sunder_illegible one;
    /* 2 - sqrt(2) = 0.58578643762690495119...; these doubles are below and above it */
    assert_true(width == 0x1.2bec333018867p-1 || width == 0x1.2bec333018866p-1);
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_NARROW, 0x1.2bec333018866p-1, &one), 0);
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_NARROW, 0x1.2bec333018867p-1, &one), 1);
    sunder_shape_free(s);
}

/* Two rooms and a passage 1 wide between them, whose walls are not over each other but for a part. */
static void test_neck(void **state)
{
    (void)state;
    sunder_shape *s =
        SHAPE(0, 0, 10, 0, 10, 4.5, 16, 4.5, 16, 0, 26, 0, 26, 10, 16, 10, 16, 5.5, 10, 5.5, 10, 10, 0, 10);
    sunder_illegible one;
    is_tie(s, SUNDER_ILLEGIBLE_NECK, 1);
    is_tie(s, SUNDER_ILLEGIBLE_INNER_GAP, 6); /* across both bays */
    is_tie(s, SUNDER_ILLEGIBLE_NARROW, 10);
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_NECK, 2, &one), 1);
    assert_true(one.from[0] == one.to[0] && one.from[0] >= 10 && one.from[0] <= 16);
    sunder_shape_free(s);
}

/* A link from corner to corner, and one from a corner to a slanted side: 3-4-5 triangles. */
static void test_corners(void **state)
{
    (void)state;
    sunder_shape *s;
    /* the interior angles at (6, 8) and (9, 12) are reflex, and the link between them is 5 long */
    s = SHAPE(0, 8, 6, 8, 0, -20, 40, -20, 40, 12, 9, 12, 12, 40, 0, 40);
    is_tie(s, SUNDER_ILLEGIBLE_NECK, 5);
    sunder_shape_free(s);
    /* from the corner (5, 5) to the side from (0, 25) to (25, 0) or beyond: the slanted side is 3-4-5 */
    s = SHAPE(0, 0, 40, 0, 40, 5, 5, 5, 4, 45, 0, 45);
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_NECK, 5, NULL), 0);
    sunder_shape_free(s);
}

/* A wall that stands in the way of a link, and one that leaves only a part of it clear. */
static void test_sight(void **state)
{
    (void)state;
    /* a yard 10 wide, with a tongue from below to a height of 4, 6 or 10 of 10 */
    static const size_t end[2] = {4, 12};
    double xy[] = {-5, -5, 15, -5, 15, 15, -5, 15, 0, 0, 0, 10, 10, 10, 10, 0, 6, 0, 6, 4, 3, 4, 3, 0};
    sunder_shape *s = polygon(xy, end, 2);
    sunder_illegible one;
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_INNER_GAP, 20, &one), 1);
    assert_true(one.has == 3 && one.from[1] == one.to[1]);
    is_tie(s, SUNDER_ILLEGIBLE_INNER_GAP, 3);
    is_tie(s, SUNDER_ILLEGIBLE_NECK, 3); /* across the tongue */
    sunder_shape_free(s);
}

/* A tip that tapers has no neck; one that widens towards its end has. */
static void test_tip(void **state)
{
    (void)state;
    sunder_shape *s = SHAPE(0, 0, 10, 0, 10, 4, 20, 4.5, 20, 5.5, 10, 6, 10, 10, 0, 10);
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_NECK, 10, NULL), 0);
    is_tie(s, SUNDER_ILLEGIBLE_SHORT_EDGE, 1);
    sunder_shape_free(s);
    s = SHAPE(0, 0, 10, 0, 10, 4.5, 20, 4, 20, 6, 10, 5.5, 10, 10, 0, 10);
    is_tie(s, SUNDER_ILLEGIBLE_NECK, 1);
    sunder_shape_free(s);
}

/* ---- Degenerate shapes ------------------------------------------------------------------------------------------- */

/* A hole that touches the outer ring in a point; the wall beside it has a neck of length 0, and so has the outside. */
static void test_touching(void **state)
{
    (void)state;
    static const size_t end[2] = {4, 8};
    const double xy[] = {0, 0, 10, 0, 10, 10, 0, 10, 5, 0, 2, 4, 5, 8, 8, 4};
    sunder_shape *s = polygon(xy, end, 2);
    sunder_illegible one;
    for (sunder_illegible_kind kind = SUNDER_ILLEGIBLE_NECK; kind <= SUNDER_ILLEGIBLE_INNER_GAP; kind++) {
        assert_int_equal(below(s, kind, 0x1p-1074, &one), 1);
        assert_true(one.has == 0 && one.from[0] == 5 && one.from[1] == 0);
    }
    sunder_shape_free(s);
    /* two parts that touch in a point are examined alone */
    s = SHAPE(0, 0, 4, 0, 4, 4, 8, 4, 8, 8, 4, 8, 4, 4, 0, 4);
    assert_int_equal(sunder_shape_polygons(s), 2);
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_NECK, 4, &one), 0);
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_NECK, 5, &one), 2);
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_SMALL, 17, &one), 2);
    sunder_shape_free(s);
}

/* Collinear and repeated vertices do not make edges shorter. */
static void test_collinear(void **state)
{
    (void)state;
    sunder_shape *s = SHAPE(0, 0, 1, 0, 1, 0, 6, 0, 6, 5, 6, 5, 6, 7, 0, 7, 0, 6);
    is_tie(s, SUNDER_ILLEGIBLE_SHORT_EDGE, 6);
    is_tie(s, SUNDER_ILLEGIBLE_NARROW, 6);
    is_tie(s, SUNDER_ILLEGIBLE_NECK, 6);
    sunder_shape_free(s);
}

/* A ring that crosses itself: two triangles with a corner at (2, 2), and one whose corner is no double. */
static void test_repaired(void **state)
{
    (void)state;
    sunder_illegible one;
    sunder_shape *s = polygon((double[]){0, 0, 4, 4, 4, 0, 0, 4}, (size_t[]){4}, 1);
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_SMALL, 4, &one), 0);
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_SMALL, nextafter(4, 5), &one), 2);
    sunder_shape_free(s);
    /* the diagonals of a trapezium meet in (2/3, 1/3), and the triangles have the areas 1/6, 2/3 */
    s = polygon((double[]){0, 0, 2, 1, 0, 1, 1, 0}, (size_t[]){4}, 1);
    assert_true(s->rational);
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_SMALL, 1.0 / 6, &one), 0); /* 1 / 6 rounded down */
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_SMALL, nextafter(1.0 / 6, 1), &one), 1);
    assert_true(one.has == 1.0 / 6);
    /* sqrt(2) / 3 is between these two doubles */
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_SHORT_EDGE, 0.4714045207910317, &one), 0);
    assert_int_equal(below(s, SUNDER_ILLEGIBLE_SHORT_EDGE, nextafter(0.4714045207910317, 1), &one), 1);
    sunder_shape_free(s);
}

/* Shapes over the whole range of doubles. */
static void test_sizes(void **state)
{
    (void)state;
    for (int e = -1000; e <= 1000; e += 250) {
        const double u = ldexp(1, e);
        sunder_shape *s = SHAPE(0, 0, 12 * u, 0, 12 * u, 3 * u, 5 * u, 3 * u, 5 * u, 9 * u, 0, 9 * u);
        is_tie(s, SUNDER_ILLEGIBLE_NECK, 3 * u);
        is_tie(s, SUNDER_ILLEGIBLE_SHORT_EDGE, 3 * u);
        if (e >= -500 && e <= 500) is_tie(s, SUNDER_ILLEGIBLE_SMALL, 66 * u * u);
        sunder_shape_free(s);
    }
    sunder_shape *s = SHAPE(0, 0, 1e300, 0, 1e300, 1e-300, 0, 1e-300);
    is_tie(s, SUNDER_ILLEGIBLE_NECK, 1e-300);
    sunder_shape_free(s);
    s = SHAPE(5e6, 5e6, 5e6 + 8, 5e6, 5e6 + 8, 5e6 + 0.1, 5e6, 5e6 + 0.1);
    is_tie(s, SUNDER_ILLEGIBLE_NECK, (5e6 + 0.1) - 5e6);
    is_tie(s, SUNDER_ILLEGIBLE_NARROW, (5e6 + 0.1) - 5e6);
    sunder_shape_free(s);
}

/* ---- Arguments and memory ---------------------------------------------------------------------------------------- */

static void test_arguments(void **state)
{
    (void)state;
    sunder_illegible *found = NULL;
    size_t n;
    sunder_shape *s = SHAPE(0, 0, 1, 0, 0, 1), *empty;
    const double bad[] = {-1, INFINITY, NAN};
    for (size_t k = 0; k < 3; k++)
        for (sunder_illegible_kind kind = 0; kind < SUNDER_ILLEGIBLE_KINDS; kind++) {
            sunder_legible_limits limits = {0};
            *limit_for(&limits, kind) = bad[k];
            assert_int_equal(sunder_shape_illegible(s, &limits, &found, &n, NULL), SUNDER_EARG);
        }
    const sunder_legible_limits all = {9, 9, 9, 9, 9};
    assert_int_equal(sunder_shape_illegible(NULL, &all, &found, &n, NULL), SUNDER_EARG);
    assert_int_equal(sunder_shape_illegible(s, &all, &found, &n, NULL), SUNDER_OK);
    assert_int_equal(n, 3); /* narrow, small, and with a short edge */
    sunder_free(found);
    assert_int_equal(sunder_shape_from_rings(NULL, NULL, NULL, 0, SUNDER_VALIDITY_STRICT, &empty, NULL), SUNDER_OK);
    assert_int_equal(sunder_shape_illegible(empty, &all, &found, &n, NULL), SUNDER_OK);
    assert_int_equal(n, 0);
    assert_null(found);
    sunder_shape_free(empty);
    sunder_shape_free(s);
    assert_string_equal(sunder_illegible_kind_string(SUNDER_ILLEGIBLE_INNER_GAP), "inner_gap");
    assert_string_equal(sunder_illegible_kind_string((sunder_illegible_kind)9), "");
}

static bool attempt(void *context)
{
    const sunder_legible_limits limits = {10, 500, 4, 6, 7};
    sunder_illegible *found = NULL;
    size_t n;
    const sunder_status status = sunder_shape_illegible(context, &limits, &found, &n, NULL);
    sunder_free(found);
    return status == SUNDER_OK;
}

static void test_memory(void **state)
{
    (void)state;
    failing_begin();
    sunder_shape *s =
        SHAPE(0, 0, 10, 0, 10, 4.5, 16, 4.5, 16, 0, 26, 0, 26, 10, 16, 10, 16, 5.5, 10, 5.5, 10, 10, 0, 10);
    assert_true(failing_loop(attempt, s, false));
    sunder_shape_free(s);
    failing_end();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rectangle), cmocka_unit_test(test_triangle), cmocka_unit_test(test_irrational_width),
        cmocka_unit_test(test_neck),      cmocka_unit_test(test_corners),  cmocka_unit_test(test_sight),
        cmocka_unit_test(test_tip),       cmocka_unit_test(test_touching), cmocka_unit_test(test_collinear),
        cmocka_unit_test(test_repaired),  cmocka_unit_test(test_sizes),    cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
