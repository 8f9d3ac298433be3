/* shape: refused inputs and their messages; cleaning; standard shapes; moved copies; the getters. */
#include "polyset.h"
#include "shape/shape.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static sunder_status build(const char *wkt, sunder_validity validity, sunder_shape **out, sunder_error *err)
{
    polyset set;
    polyset_init(&set);
    assert_true(polyset_read_wkt(&set, wkt, NULL));
    const sunder_status status =
        sunder_shape_from_rings(set.xy, set.ring_end, set.poly_end, set.polygons, validity, out, err);
    polyset_free(&set);
    return status;
}

/* Makes a shape, demanding validity, and checks its invariants. */
static sunder_shape *sound(const char *wkt)
{
    sunder_shape *s = NULL;
    sunder_error err;
    if (build(wkt, SUNDER_VALIDITY_STRICT, &s, &err)) fail_msg("%s: %s", wkt, err.message);
    const char *fault = sunder_i_shape_check(s);
    if (fault) fail_msg("%s: %s", wkt, fault);
    assert_false(sunder_shape_repaired(s));
    return s;
}

static void refused(const char *wkt, const char *sentence, size_t ring, size_t vertex)
{
    sunder_shape *s = NULL;
    sunder_error err;
    assert_int_equal(build(wkt, SUNDER_VALIDITY_STRICT, &s, &err), SUNDER_EINVALID);
    assert_null(s);
    assert_string_equal(err.message, sentence);
    assert_int_equal(err.status, SUNDER_EINVALID);
    assert_int_equal(err.ring, ring);
    assert_int_equal(err.vertex, vertex);
    assert_int_equal(build(wkt, SUNDER_VALIDITY_STRICT, &s, NULL), SUNDER_EINVALID);
}

static void test_refusals(void **state)
{
    (void)state;
    refused("POLYGON((0 0,4 4,4 0,0 4,0 0))", "polygon 0, ring 0, vertex 2 (4 0): crosses segment 0", 0, 2);
    refused("POLYGON((0 0,1 0,0 0))", "polygon 0, ring 0, vertex 0 (0 0): the ring has under three distinct vertices",
            0, 0);
    refused("POLYGON((5 5,5 5,5 5,5 5))",
            "polygon 0, ring 0, vertex 0 (5 5): the ring has under three distinct vertices", 0, 0);
    refused("POLYGON((0 0,1 1,2 2,0 0))", "polygon 0, ring 0, vertex 0 (0 0): the ring has no area", 0, 0);
    refused("POLYGON((0 0,4 0,6 0,4 0,4 4,0 4))",
            "polygon 0, ring 0, vertex 2 (6 0): a spike: the ring runs back along itself", 0, 2);
    refused("POLYGON((0 0,4 0,4 4,0 4,0 8,0 4))",
            "polygon 0, ring 0, vertex 4 (0 8): a spike: the ring runs back along itself", 0, 4);
    refused("POLYGON((0 0,9 0,9 9,6 9,6 0,3 0,3 9,0 9))",
            "polygon 0, ring 0, vertex 4 (6 0): shares a piece of edge with "
            "segment 0",
            0, 4);
    refused("POLYGON((0 0,9 0,9 9,0 9),(2 2,4 2,4 12,2 12))",
            "polygon 0, ring 1, vertex 1 (4 2): crosses segment 2 of ring 0", 1, 1);
    refused("POLYGON((0 0,9 0,9 9,0 9),(0 2,4 2,4 4,0 4))",
            "polygon 0, ring 1, vertex 0 (0 2): shares a piece of edge with segment 3 of ring 0", 1, 0);
    refused("POLYGON((0 0,9 0,9 9,0 9),(10 2,14 2,14 4,10 4))",
            "polygon 0, ring 1, vertex 0 (10 2): the hole lies outside "
            "ring 0",
            1, 0);
    refused("POLYGON((2 2,4 2,4 4,2 4),(0 0,9 0,9 9,0 9))",
            "polygon 0, ring 1, vertex 0 (0 0): the hole lies outside ring 0", 1, 0);
    refused("POLYGON((0 0,9 0,9 9,0 9),(1 1,8 1,8 8,1 8),(2 2,3 2,3 3,2 3))",
            "polygon 0, ring 2, vertex 0 (2 2): the hole lies inside ring 1", 2, 0);
}

/* Rings without vertices, which WKT cannot express: first, last, alone. */
static void test_empty_rings(void **state)
{
    (void)state;
    static const double xy[] = {0, 0, 9, 0, 0, 9};
    static const size_t ends[3][2] = {{0, 3}, {3, 3}, {0, 0}};
    for (size_t i = 0; i < 3; i++) {
        const size_t poly_end[] = {2};
        sunder_shape *s = NULL;
        sunder_error err;
        assert_int_equal(sunder_shape_from_rings(xy, ends[i], poly_end, 1, SUNDER_VALIDITY_STRICT, &s, &err),
                         SUNDER_EINVALID);
        assert_int_equal(err.ring, i == 1);
        assert_true(err.vertex == SIZE_MAX);
        assert_string_equal(err.message,
                            i == 1 ? "polygon 0, ring 1: the ring is empty" : "polygon 0, ring 0: the ring is empty");
        assert_int_equal(sunder_shape_from_rings(xy, ends[i], poly_end, 1, SUNDER_VALIDITY_EVEN_ODD, &s, &err),
                         SUNDER_OK);
        assert_true(sunder_shape_area(s) == (i == 2 ? 0 : 40.5));
        assert_true(sunder_shape_repaired(s));
        sunder_shape_free(s);
    }
    /* A polygon without rings among others is allowed. */
    const size_t ring_end[] = {3}, poly_end[] = {0, 1, 1};
    sunder_shape *s = NULL;
    assert_int_equal(sunder_shape_from_rings(xy, ring_end, poly_end, 3, SUNDER_VALIDITY_STRICT, &s, NULL), SUNDER_OK);
    assert_int_equal(sunder_shape_polygons(s), 1);
    sunder_shape_free(s);
}

static void test_not_finite(void **state)
{
    (void)state;
    const double bad[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        for (size_t k = 0; k < 12; k++)
            for (int validity = SUNDER_VALIDITY_STRICT; validity <= SUNDER_VALIDITY_EVEN_ODD; validity++) {
                double xy[] = {0, 0, 9, 0, 0, 9, 1, 1, 2, 1, 1, 2};
                const size_t ring_end[] = {3, 6}, poly_end[] = {2};
                sunder_shape *s = NULL;
                sunder_error err;
                xy[k] = bad[i];
                assert_int_equal(
                    sunder_shape_from_rings(xy, ring_end, poly_end, 1, (sunder_validity)validity, &s, &err),
                    SUNDER_EINVALID);
                assert_null(s);
                assert_int_equal(err.ring, k / 6);
                assert_int_equal(err.vertex, k % 6 / 2);
                assert_non_null(strstr(err.message, "not finite"));
            }
}

static void test_cleaning(void **state)
{
    (void)state;
    /* Closing, repeated and collinear vertices, also at the start of the ring; either orientation. */
    static const char *const square[] = {"POLYGON((0 0,4 0,4 4,0 4,0 0))", "POLYGON((0 0,0 4,4 4,4 0))",
                                         "POLYGON((2 0,2 0,4 0,4 0,4 0,4 4,2 4,1 4,0 4,0 0,1 0,2 0,2 0))",
                                         "POLYGON((0 2,0 1,0 0,4 0,4 4,0 4,0 3))"};
    for (size_t i = 0; i < sizeof square / sizeof *square; i++) {
        sunder_shape *s = sound(square[i]);
        assert_int_equal(sunder_shape_vertices(s), 4);
        assert_int_equal(sunder_shape_polygons(s), 1);
        assert_int_equal(s->pieces, 1);
        assert_true(sunder_shape_area(s) == 16);
        double box[4], anchor[2];
        sunder_shape_box(s, box);
        assert_true(box[0] == 0 && box[1] == 0 && box[2] == 4 && box[3] == 4);
        sunder_shape_anchor(s, anchor);
        assert_true(anchor[0] == 2 && anchor[1] == 2);
        sunder_shape_free(s);
    }
    /* Numbers at both ends of the range of doubles. */
    sunder_shape *s = sound("POLYGON((0 0,1e300 0,1e300 1e-300,0 1e-300))");
    assert_true(sunder_shape_area(s) == 1e300 * 1e-300 || fabs(sunder_shape_area(s) - 1) < 1e-15);
    sunder_shape_free(s);
    /* A difference of one ulp makes it non-collinear. */
    s = sound("POLYGON((0 0,1 1,2 2.0000000000000004,0 3))");
    assert_int_equal(sunder_shape_vertices(s), 4);
    sunder_shape_free(s);
}

/* The extent is that of the corners, whether or not a vertex was removed. */
static void test_extent(void **state)
{
    (void)state;
    static const struct {
        const char *wkt;
        int low_bit;
    } cases[] = {{"POLYGON((0 0,8 0,8 8,0 8,0 0))", 3},
                 {"POLYGON((0 0,8 0,8 8,0 8,0 0),(2 2,2 4.5,4 4,2 2))", -1},
                 {"POLYGON((0 0,4.5 0,8 0,8 8,0 8,0 0))", 3},
                 {"POLYGON((0 0,8 0,8 0,8 8,0 8,0 4.25,0 0))", 3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sunder_shape *s = sound(cases[i].wkt);
        assert_int_equal(s->low_bit, cases[i].low_bit);
        assert_true(s->box[0] == 0 && s->box[1] == 0 && s->box[2] == 8 && s->box[3] == 8);
        sunder_shape_free(s);
    }
}

static void test_touching(void **state)
{
    (void)state;
    static const struct {
        const char *wkt;
        size_t polygons, vertices;
        double area;
    } good[] = {
        /* A hole that touches its outer ring in the middle of an edge, and in a corner. */
        {"POLYGON((0 0,8 0,8 8,0 8),(4 0,6 2,4 4,2 2))", 1, 9, 56},
        {"POLYGON((0 0,8 0,8 8,0 8),(0 0,4 1,1 4))", 1, 7, 56.5},
        /* Holes that touch each other: corner to corner, corner to edge. */
        {"POLYGON((0 0,9 0,9 9,0 9),(1 1,4 1,4 4,1 4),(4 4,7 4,7 7,4 7))", 1, 12, 63},
        {"POLYGON((0 0,9 0,9 9,0 9),(1 1,4 1,4 4,1 4),(4 2,7 1,7 3))", 1, 12, 69},
        /* A chain of holes that cuts the interior into two parts. */
        {"POLYGON((0 0,8 0,8 8,0 8),(4 0,6 4,4 8,2 4))", 2, 10, 48},
        /* A ring that touches itself from outside, and from inside. */
        {"POLYGON((0 0,2 2,4 0,4 4,2 2,0 4))", 2, 6, 8},
        {"POLYGON((0 0,8 0,8 8,4 8,6 4,2 4,4 8,0 8))", 1, 8, 56},
        {"POLYGON((0 0,4 0,8 0,8 8,0 8,0 6,2 6,4 0,2 2))", 2, 9, 50},
        /* A vertex that touches an edge of the same ring from outside: nothing is split. */
        {"POLYGON((0 0,8 0,8 2,2 2,2 6,4 6,5 2,6 6,8 6,8 8,0 8))", 1, 11, 44},
        /* Members may touch, overlap and coincide. */
        {"MULTIPOLYGON(((0 0,4 0,4 4,0 4)),((2 2,6 2,6 6,2 6)),((0 0,4 0,4 4,0 4)))", 3, 12, 48},
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        sunder_shape *s = sound(good[i].wkt);
        assert_int_equal(sunder_shape_polygons(s), good[i].polygons);
        assert_int_equal(sunder_shape_vertices(s), good[i].vertices);
        assert_true(sunder_shape_area(s) == good[i].area);
        sunder_shape_free(s);
    }
}

/* The checker has to find each fault. Each fault is undone before the next one. */
static void test_check_finds(void **state)
{
    (void)state;
    sunder_shape *s = sound("POLYGON((0 0,9 0,9 9,4 4,0 9),(4 0,5 1,4 2))");
    double *const xy = s->xy;
    bool *const shared = (bool *)s->form->cleaned.shared; /* it has arrays of its own, since it has two rings */
    uint32_t *const piece_vertex = (uint32_t *)sunder_i_piece_vertices(s), *const along =
                                                                               (uint32_t *)s->form->cleaned.next;
    const double keep = xy[1];
    xy[1] = -1;
    assert_non_null(sunder_i_shape_check(s)); /* outside its box, and no longer at a place shared with another ring */
    xy[1] = keep;
    shared[1] = !shared[1];
    assert_non_null(sunder_i_shape_check(s));
    shared[1] = !shared[1];
    const uint32_t corner = sunder_i_piece_vertices(s)[0];
    piece_vertex[0] = piece_vertex[1];
    assert_non_null(sunder_i_shape_check(s));
    piece_vertex[0] = corner;
    const uint32_t pieces = s->pieces;
    s->pieces--;
    assert_non_null(sunder_i_shape_check(s));
    s->pieces = pieces;
    const uint32_t next = s->form->cleaned.next[0];
    along[0] = along[next];
    assert_non_null(sunder_i_shape_check(s));
    along[0] = next;
    s->box[2] = 8;
    assert_non_null(sunder_i_shape_check(s));
    s->box[2] = 9;
    assert_null(sunder_i_shape_check(s));
    sunder_shape_free(s);
}

/* Rings of few corners share data, and a ring that needs no cleaning is stored once. The results must not depend on
 * that, if the first corner is repeated, a vertex is not a corner, or the ring is clockwise. */
static void test_few_corners(void **state)
{
    (void)state;
    for (uint32_t n = 3; n <= 20; n++)
        for (int kind = 0; kind < 8; kind++) {
            double xy[2 * 24];
            size_t m = 0;
            for (uint32_t k = 0; k < n; k++, m++) { /* corners on a parabola, so strictly convex */
                const double x = kind & 1 ? (double)n - 1 - k : k;
                xy[2 * m] = 4 * x;
                xy[2 * m + 1] = 4 * x * x;
                if (!(kind & 2) || k) continue;
                xy[2 * ++m] = kind & 1 ? 4 * x - 2 : 2; /* a vertex on the edge to the next corner */
                xy[2 * m + 1] = kind & 1 ? 4 * x * x - 2 * (2 * x - 1) : 2;
            }
            if (kind & 4) {
                xy[2 * m] = xy[0];
                xy[2 * m++ + 1] = xy[1];
            }
            const size_t ring_end[] = {m}, poly_end[] = {1};
            sunder_shape *s, *moved, *turned;
            bool exact;
            assert_int_equal(sunder_shape_from_rings(xy, ring_end, poly_end, 1, SUNDER_VALIDITY_STRICT, &s, NULL),
                             SUNDER_OK);
            assert_int_equal(sunder_shape_translate(s, 3, -5, &moved, &exact, NULL), SUNDER_OK);
            assert_int_equal(sunder_shape_reflect(s, &turned, NULL), SUNDER_OK);
            assert_int_equal(sunder_shape_vertices(s), n);
            assert_int_equal(sunder_i_shape_raw_vertices(s), m);
            for (size_t k = 0; k < 2 * m; k++) {
                assert_true(s->raw_xy[k] == xy[k]);
                assert_true(moved->raw_xy[k] == xy[k] + (k & 1 ? -5 : 3));
                assert_true(turned->raw_xy[k] == -xy[k]);
            }
            for (uint32_t k = 0; k < 2 * n; k++) {
                assert_true(moved->xy[k] == s->xy[k] + (k & 1 ? -5 : 3));
                assert_true(turned->xy[k] == -s->xy[k]);
            }
            assert_null(sunder_i_shape_check(s));
            assert_null(sunder_i_shape_check(moved));
            assert_null(sunder_i_shape_check(turned));
            sunder_shape_free(s);
            sunder_shape_free(moved);
            sunder_shape_free(turned);
        }
}

static void repaired_to(const char *wkt, size_t polygons, size_t vertices, double area, bool rational)
{
    sunder_shape *s = NULL;
    sunder_error err;
    if (build(wkt, SUNDER_VALIDITY_EVEN_ODD, &s, &err)) fail_msg("%s: %s", wkt, err.message);
    const char *fault = sunder_i_shape_check(s);
    if (fault) fail_msg("%s: %s", wkt, fault);
    assert_true(sunder_shape_repaired(s));
    assert_int_equal(sunder_shape_polygons(s), polygons);
    assert_int_equal(sunder_shape_vertices(s), vertices);
    assert_true(sunder_shape_area(s) == area);
    assert_int_equal(s->rational, rational);
    sunder_shape_free(s);
}

static void test_repairs(void **state)
{
    (void)state;
    repaired_to("POLYGON((0 0,4 4,4 0,0 4,0 0))", 2, 6, 8, false);      /* crosses itself at a dyadic point */
    repaired_to("POLYGON((0 0,3 3,3 0,0 2,0 0))", 2, 6, 3.9, true);     /* crosses itself at 6/5 */
    repaired_to("POLYGON((0 0,4 0,6 0,4 0,4 4,0 4))", 1, 4, 16, false); /* a spike */
    repaired_to("POLYGON((0 0,1 0,0 0))", 0, 0, 0, false);              /* nothing is left */
    repaired_to("POLYGON((0 0,1 1,2 2,0 0))", 0, 0, 0, false);
    repaired_to("POLYGON((0 0,8 0,8 8,0 8,0 0,8 0,8 8,0 8))", 0, 0, 0, false); /* a ring traversed twice */
    repaired_to("POLYGON((0 0,8 0,8 8,0 8),(0 0,8 0,8 8,0 8))", 0, 0, 0, false);
    repaired_to("POLYGON((0 0,8 0,8 8,0 8),(0 0,4 0,4 8,0 8))", 1, 4, 32, false);   /* shared edges cancel */
    repaired_to("POLYGON((0 0,8 0,8 8,0 8),(9 0,10 0,10 1,9 1))", 2, 8, 65, false); /* a hole outside is filled */
    repaired_to("POLYGON((0 0,9 0,9 9,0 9),(1 1,8 1,8 8,1 8),(2 2,3 2,3 3,2 3))", 2, 12, 33, false);
    repaired_to("POLYGON((0 0,8 0,8 8,0 8),(5 5,5 5,5 5))", 1, 4, 64, false); /* a hole that is a point */
    /* Members are repaired separately: the valid one stays, overlaps of members count twice. */
    repaired_to("MULTIPOLYGON(((0 0,4 4,4 0,0 4,0 0)),((0 0,4 0,4 4,0 4)))", 3, 10, 24, false);
}

static void test_empty(void **state)
{
    (void)state;
    sunder_shape *s = NULL;
    assert_int_equal(sunder_shape_from_rings(NULL, NULL, NULL, 0, SUNDER_VALIDITY_STRICT, &s, NULL), SUNDER_OK);
    assert_true(sunder_shape_is_empty(s));
    assert_int_equal(sunder_shape_vertices(s), 0);
    double box[4] = {1, 1, 1, 1}, anchor[2] = {1, 1};
    sunder_shape_box(s, box);
    assert_true(box[0] == 0 && box[1] == 0 && box[2] == 0 && box[3] == 0);
    sunder_shape_anchor(s, anchor);
    assert_true(anchor[0] == 0 && anchor[1] == 0);
    assert_true(sunder_shape_area(s) == 0);
    assert_null(sunder_i_shape_check(s));
    sunder_shape *t = NULL;
    bool exact = false;
    assert_int_equal(sunder_shape_reflect(s, &t, NULL), SUNDER_OK);
    sunder_shape_free(t);
    assert_int_equal(sunder_shape_translate(s, 3, 4, &t, &exact, NULL), SUNDER_OK);
    assert_true(exact && sunder_shape_is_empty(t));
    sunder_shape_free(t);
    sunder_shape_free(s);
    sunder_shape_free(NULL);
}

/* The unit of rounding of long doubles at run time: an emulator may compute them as doubles, whatever the header
 * says. */
static long double unit_of_rounding(void)
{
    volatile long double unit = 1, sum = 2;
    for (; sum > 1; sum = 1 + unit) unit /= 2;
    return 2 * unit;
}

static bool has_corner(const sunder_shape *s, double x, double y)
{
    bool found = false;
    for (uint32_t v = 0; v < s->vertices; v++) found = found || (s->xy[2 * v] == x && s->xy[2 * v + 1] == y);
    return found;
}

/* The distance from the origin to the line through two points is compared with the radius, in long doubles: their 11
 * additional bits are enough to detect an error of an ulp of the radius. Only the truth of the bound is checked, not
 * its tightness. */
static void check_disc(double radius, unsigned n, bool inside)
{
    sunder_shape *s = NULL;
    sunder_error err;
    if (sunder_shape_disc(radius, n, inside, &s, &err)) fail_msg("disc %.17g %u: %s", radius, n, err.message);
    const char *fault = sunder_i_shape_check(s);
    if (fault) fail_msg("disc %.17g %u: %s", radius, n, fault);
    assert_int_equal(s->vertices, n);
    assert_int_equal(s->pieces, 1);
    const long double unit = unit_of_rounding(), tight = inside ? 1 : 1 / cosl(acosl(-1.0L) / n);
    const long double scale = radius;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t j = s->form->cleaned.next[i];
        const long double ax = s->xy[2 * i] / scale, ay = s->xy[2 * i + 1] / scale;
        const long double bx = s->xy[2 * j] / scale, by = s->xy[2 * j + 1] / scale;
        const long double corner = hypotl(ax, ay);
        if (inside) {
            assert_true(corner <= 1 + 2 * unit);
        } else {
            const long double dx = bx - ax, dy = by - ay; /* the differences have no cancellation, however short the
                                                           * side */
            const long double edge = (ax * dy - ay * dx) / hypotl(dx, dy);
            assert_true(edge >= 1 - 8 * unit);
        }
        /* With few segments, corners are multiples of a coarse unit, at most 2^-25 of the radius, which the factor
         * allows for. */
        assert_true(fabsl(corner / tight - 1) < (n <= 256 ? 0x1p-21L : 1e-12L));
        /* Symmetric about the x axis: the mirror image of each corner is a corner. */
        assert_true(has_corner(s, s->xy[2 * i], -s->xy[2 * i + 1]));
        if (n % 2 == 0) assert_true(has_corner(s, -s->xy[2 * i], -s->xy[2 * i + 1]));
    }
    sunder_shape_free(s);
}

static void test_disc(void **state)
{
    (void)state;
    static const double radius[] = {1, 3, 0.1, 1e-3, 12345.678, 1.0 / 3, 1e100, 1e-200};
    static const unsigned n[] = {3, 4, 5, 6, 7, 8, 12, 16, 31, 32, 33, 64, 100, 1000};
    for (size_t i = 0; i < sizeof radius / sizeof *radius; i++)
        for (size_t j = 0; j < sizeof n / sizeof *n; j++) {
            check_disc(radius[i], n[j], false);
            check_disc(radius[i], n[j], true);
        }
    sunder_shape *s = NULL;
    sunder_error err;
    static const double wrong[] = {0, -1, NAN, INFINITY};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(sunder_shape_disc(wrong[i], 32, false, &s, &err), SUNDER_EARG);
    assert_int_equal(sunder_shape_disc(1, 2, false, &s, &err), SUNDER_EARG);
    assert_int_equal(sunder_shape_disc(DBL_MAX, 3, false, &s, &err), SUNDER_ERANGE);
    assert_int_equal(sunder_shape_disc(DBL_TRUE_MIN, 32, true, &s, &err), SUNDER_ERANGE);
    assert_null(s);
}

static void test_rectangle(void **state)
{
    (void)state;
    sunder_shape *s = NULL;
    sunder_error err;
    assert_int_equal(sunder_shape_rectangle(3, 5, &s, &err), SUNDER_OK);
    assert_null(sunder_i_shape_check(s));
    double box[4];
    sunder_shape_box(s, box);
    assert_true(box[0] == -1.5 && box[1] == -2.5 && box[2] == 1.5 && box[3] == 2.5);
    sunder_shape_free(s);
    s = NULL;
    static const double wrong[] = {0, -1, NAN, INFINITY};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(sunder_shape_rectangle(wrong[i], 1, &s, &err), SUNDER_EARG);
        assert_int_equal(sunder_shape_rectangle(1, wrong[i], &s, &err), SUNDER_EARG);
    }
    assert_int_equal(sunder_shape_rectangle(DBL_TRUE_MIN, 1, &s, &err), SUNDER_ERANGE);
    assert_null(s);
}

static void test_reflect(void **state)
{
    (void)state;
    static const char *const wkt[] = {"POLYGON((0 0,9 0,9 9,4 7,0 9),(2 2,3 2,3 3))", "POLYGON((0 0,3 3,3 0,0 2,0 0))"};
    for (size_t i = 0; i < 2; i++) {
        sunder_shape *s = NULL, *r = NULL, *back = NULL;
        assert_int_equal(build(wkt[i], SUNDER_VALIDITY_EVEN_ODD, &s, NULL), SUNDER_OK);
        assert_int_equal(sunder_shape_reflect(s, &r, NULL), SUNDER_OK);
        assert_int_equal(sunder_shape_reflect(r, &back, NULL), SUNDER_OK);
        assert_null(sunder_i_shape_check(r));
        assert_null(sunder_i_shape_check(back));
        assert_int_equal(sunder_shape_repaired(r), sunder_shape_repaired(s));
        assert_true(sunder_shape_area(r) == sunder_shape_area(s));
        for (size_t k = 0; k < 2 * (size_t)s->vertices; k++) {
            assert_true(r->xy[k] == -s->xy[k]);
            assert_true(back->xy[k] == s->xy[k]);
            assert_false(signbit(r->xy[k]) && r->xy[k] == 0);
        }
        double a[4], b[4];
        sunder_shape_box(s, a);
        sunder_shape_box(r, b);
        for (int k = 0; k < 4; k++) assert_true(b[k] == -a[(k + 2) % 4]);
        sunder_shape_free(s);
        sunder_shape_free(r);
        sunder_shape_free(back);
    }
}

static void test_translate(void **state)
{
    (void)state;
    sunder_shape *s = sound("POLYGON((0.5 0.25,9 0,9 9,0 9,0.25 4),(2 2,3 2,3 3))"), *t = NULL;
    sunder_error err;
    bool exact = false;
    assert_int_equal(sunder_shape_translate(s, 1024.125, -7.5, &t, &exact, &err), SUNDER_OK);
    assert_true(exact);
    assert_null(sunder_i_shape_check(t));
    assert_int_equal(t->vertices, s->vertices);
    for (size_t k = 0; k < 2 * (size_t)s->vertices; k++) assert_true(t->xy[k] == s->xy[k] + (k & 1 ? -7.5 : 1024.125));
    assert_true(sunder_shape_area(t) == sunder_shape_area(s));
    sunder_shape_free(t);
    /* 0.1 is not a sum of few powers of two. */
    assert_int_equal(sunder_shape_translate(s, 0.1, 0, &t, &exact, &err), SUNDER_OK);
    assert_false(exact);
    assert_null(sunder_i_shape_check(t));
    sunder_shape_free(t);
    /* Far away all vertices coincide, and the shape is empty. */
    assert_int_equal(sunder_shape_translate(s, 1e30, 1e30, &t, &exact, &err), SUNDER_OK);
    assert_false(exact);
    assert_true(sunder_shape_is_empty(t));
    sunder_shape_free(t);
    t = NULL;
    assert_int_equal(sunder_shape_translate(s, NAN, 0, &t, &exact, &err), SUNDER_EARG);
    sunder_shape_free(s);
    s = sound("POLYGON((0 0,1.7e308 0,0 1.7e308))");
    assert_int_equal(sunder_shape_translate(s, 1e308, 0, &t, &exact, &err), SUNDER_ERANGE);
    assert_null(t);
    sunder_shape_free(s);
    /* Rational corners are translated exactly, too. */
    assert_int_equal(build("POLYGON((0 0,3 3,3 0,0 2,0 0))", SUNDER_VALIDITY_EVEN_ODD, &s, NULL), SUNDER_OK);
    assert_int_equal(sunder_shape_translate(s, 0.125, -16, &t, &exact, &err), SUNDER_OK);
    assert_true(exact && t->rational);
    assert_null(sunder_i_shape_check(t));
    assert_true(sunder_shape_area(t) == 3.9);
    sunder_shape_free(t);
    sunder_shape_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_refusals),  cmocka_unit_test(test_empty_rings), cmocka_unit_test(test_not_finite),
        cmocka_unit_test(test_cleaning),  cmocka_unit_test(test_touching),    cmocka_unit_test(test_extent),
        cmocka_unit_test(test_repairs),   cmocka_unit_test(test_empty),       cmocka_unit_test(test_disc),
        cmocka_unit_test(test_rectangle), cmocka_unit_test(test_check_finds), cmocka_unit_test(test_few_corners),
        cmocka_unit_test(test_reflect),   cmocka_unit_test(test_translate)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
