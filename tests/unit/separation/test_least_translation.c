/* Least translations, overlap, containment, gap and distance of small figures with known results. */
#include "polyset.h"

#include "separation/least_translation.h"
#include "separation/separation.h"

#include <gmp.h>
#include <inttypes.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static sunder_shape *shape(const char *wkt)
{
    polyset set;
    polyset_init(&set);
    if (!polyset_read_wkt(&set, wkt, NULL)) fail_msg("not WKT: %s", wkt);
    sunder_shape *s = polyset_shape(&set);
    assert_non_null(s);
    polyset_free(&set);
    return s;
}

typedef struct known {
    const char *what, *p, *q;
    double gap;
    const char *dx, *dy, *square, *contact;
    bool attained;
} known;

#define SQUARE "POLYGON((0 0,4 0,4 4,0 4,0 0))"
#define POCKET "POLYGON((-9 -9,13 -9,13 13,-9 13,-9 -9),(0 0,0 4,4 4,4 0,0 0))"
#define POCKET8 "POLYGON((-10 -10,18 -10,18 18,-10 18,-10 -10),(0 0,0 8,8 8,8 0,0 0))"

/* Nearly collinear walls: at the foot of the perpendicular on one wall the other one is nearer than the gap, by 1e-13
 * of it. */
#define NEAR_WALLS                                                                                                     \
    "POLYGON((-4096 -1024,4095.999999999999 -1024,4095.999999999999 0.0001220703125,0 0,-4096 0,-4096 -1024))"
#define NEAR_POST "POLYGON((-1 -1,2.384185791015625e-07 -1,2.384185791015625e-07 9,-1 9,-1 -1))"

static const known KNOWN[] = {
    {"apart", SQUARE, "POLYGON((5 0,6 0,6 1,5 1,5 0))", 0, "0", "0", "0", "none", true},
    {"touching along a side", SQUARE, "POLYGON((4 1,6 1,6 2,4 2,4 1))", 0, "0", "0", "0", "none", true},
    {"touching at a corner", SQUARE, "POLYGON((4 4,6 4,6 6,4 6,4 4))", 0, "0", "0", "0", "none", true},
    {"a side", SQUARE, "POLYGON((3 1,6 1,6 2,3 2,3 1))", 0, "1", "0", "1", "edge", true},
    {"the smallest of two ties", SQUARE, "POLYGON((1 1,3 1,3 3,1 3,1 1))", 0, "-3", "0", "9", "edge", true},
    {"identical shapes", SQUARE, SQUARE, 0, "-4", "0", "16", "edge", true},
    {"a slanted side", "POLYGON((0 0,10 0,0 10,0 0))", "POLYGON((4 4,9 4,9 9,4 9,4 4))", 0, "1", "1", "2", "edge",
     true},
    {"a rational foot", "POLYGON((0 0,9 0,0 3,0 0))", "POLYGON((3 1,20 1,20 9,3 9,3 1))", 0, "3/10", "9/10", "9/10",
     "edge", true},
    {"a corner of the obstacle", "POLYGON((0 0,10 0,10 2,2 2,2 10,0 10,0 0))", "POLYGON((1 1,4 1,4 4,1 4,1 1))", 0, "1",
     "1", "2", "vertex", true},
    {"a peg in its pocket", POCKET, "POLYGON((1 0,5 0,5 4,1 4,1 0))", 0, "-1", "0", "1", "degenerate_point", true},
    {"a pocket of three walls", "POLYGON((-9 -9,13 -9,13 4,4 4,4 0,0 0,0 4,-9 4,-9 -9))",
     "POLYGON((1 -1,5 -1,5 3,1 3,1 -1))", 0, "-1", "1", "2", "degenerate_segment", true},
    {"a pocket of three walls, its mouth", "POLYGON((-9 -9,13 -9,13 4,4 4,4 0,0 0,0 4,-9 4,-9 -9))",
     "POLYGON((1 3,5 3,5 13,1 13,1 3))", 0, "-1", "0", "1", "degenerate_segment", true},
    {"the end of a corridor", "MULTIPOLYGON(((0 0,2 0,2 9,0 9,0 0)),((3 0,5 0,5 9,3 9,3 0)))",
     "POLYGON((4 8,5 8,5 10,4 10,4 8))", 0, "0", "1", "1", "edge", true},
    {"a corridor", "MULTIPOLYGON(((-9 0,2 0,2 9,-9 9,-9 0)),((3 0,15 0,15 9,3 9,3 0)))",
     "POLYGON((3 4,4 4,4 5,3 5,3 4))", 0, "-1", "0", "1", "degenerate_segment", true},
    {"out of a courtyard", "POLYGON((0 0,30 0,30 30,0 30,0 0),(1 1,1 29,29 29,29 1,1 1))",
     "POLYGON((27 5,33 5,33 6,27 6,27 5))", 0, "3", "0", "9", "edge", true},
    {"inside a courtyard", "POLYGON((0 0,9 0,9 9,0 9,0 0),(1 1,1 8,8 8,8 1,1 1))", "POLYGON((2 2,3 2,3 3,2 3,2 2))", 0,
     "0", "0", "0", "none", true},
    {"members that touch", "MULTIPOLYGON(((0 0,2 0,2 4,0 4,0 0)),((2 0,4 0,4 4,2 4,2 0)))",
     "POLYGON((1 3,3 3,3 6,1 6,1 3))", 0, "0", "1", "1", "edge", true},
    {"members that overlap", "MULTIPOLYGON(((0 0,3 0,3 4,0 4,0 0)),((1 0,4 0,4 4,1 4,1 0)))",
     "POLYGON((1 3,3 3,3 6,1 6,1 3))", 0, "0", "1", "1", "edge", true},
    {"a hole that touches the outer ring", "POLYGON((8 0,8 14,0 14,0 0,8 0),(2 2,2 8,4 8,8 2,2 2))",
     "POLYGON((5 6,4 6,4 5,5 5,6 5,6 6,5 6))", 0, "-6/13", "-4/13", "4/13", "edge", true},
    {"a gap", SQUARE, "POLYGON((5 0,9 0,9 4,5 4,5 0))", 3, "2", "0", "4", "edge", true},
    {"a gap that is kept", SQUARE, "POLYGON((7 0,9 0,9 4,7 4,7 0))", 3, "0", "0", "0", "none", true},
    {"a gap kept at corners", SQUARE, "POLYGON((7 8,9 8,9 9,7 9,7 8))", 5, "0", "0", "0", "none", true},
    {"a gap round a corner", SQUARE, "POLYGON((7 8,9 8,9 9,7 9,7 8))", 10, "3", "4", "25", "arc", true},
    {"a gap that fits exactly", POCKET8, "POLYGON((1 3,5 3,5 7,1 7,1 3))", 2, "1", "-1", "2", "degenerate_point", true},
    {"a gap, corner against corner", POCKET8, "POLYGON((1 3,5 3,5 7,1 7,1 3))", 1.5, "1/2", "-1/2", "1/2", "vertex",
     true},
    {"a gap across a slanted wall", "POLYGON((0 0,40 0,0 30,0 0))", "POLYGON((16 18,99 18,99 99,16 99,16 18))", 5, "3",
     "4", "25", "edge", true},
    {"a covered foot is not the end", NEAR_WALLS, NEAR_POST, 32, "-3/4194304", "33", "19157890602369033/17592186044416",
     "vertex", true},
    {"a covered foot is not the end, another gap", NEAR_WALLS, NEAR_POST, 31, "-47/67108864", "32",
     "4611686018427390113/4503599627370496", "vertex", true},
};

static void check_known(const known *k, const sunder_i_least_options *options)
{
    sunder_shape *p = shape(k->p), *q = shape(k->q);
    sunder_separation s;
    sunder_error err;
    bool beyond = true;
    if (sunder_i_least(p, q, options, &s, &beyond, &err)) fail_msg("%s: %s", k->what, err.message);
    if (strcmp(s.dx_text, k->dx) || strcmp(s.dy_text, k->dy) || strcmp(s.distance_squared_text, k->square) ||
        strcmp(sunder_contact_string(s.contact), k->contact) || s.attained != k->attained)
        fail_msg("%s: (%s, %s), %s, %s", k->what, s.dx_text, s.dy_text, s.distance_squared_text,
                 sunder_contact_string(s.contact));
    assert_false(beyond);
    assert_int_equal(s.overlap, strcmp(k->contact, "none") != 0);
    assert_true(s.lower_bound <= s.distance && s.distance <= s.lower_bound * (1 + 1e-9));
    bool apart;
    assert_int_equal(sunder_pair_apart(p, q, k->gap, &apart, NULL), SUNDER_OK);
    assert_int_equal(apart, !s.overlap);
    if (s.rounded_is_free) {
        const double t[2] = {s.dx, s.dy};
        assert_int_equal(sunder_i_apart(p, NULL, q, t, k->gap, &apart, NULL), SUNDER_OK);
        assert_true(apart);
    }
    sunder_separation_clear(&s);
    sunder_shape_free(p);
    sunder_shape_free(q);
}

/* Long numbers in the computation, and a short result: a vector whose length is a double, and so is the lower bound. */
static void long_fractions(void **state)
{
    (void)state;
    const known k = {"long numbers on the way",
                     "POLYGON((2199023255559 4398046511103,3298534883336 4398046511103,3298534883336 5497558138880,"
                     "5 5497558138880,5 3298534883326,2199023255559 3298534883326,2199023255559 4398046511103))",
                     "POLYGON((1099511627781 2199023255550,3298534883335 2199023255550,3298534883335 3298534883327,"
                     "1099511627781 3298534883327,1099511627781 2199023255550))",
                     0,
                     "0",
                     "-1",
                     "1",
                     "edge",
                     true};
    const sunder_i_least_options options = {.upper = INFINITY, .texts = true};
    check_known(&k, &options);
    sunder_shape *p = shape(k.p), *q = shape(k.q);
    sunder_separation s;
    assert_int_equal(sunder_pair_separate(p, q, 0, &s, NULL), SUNDER_OK);
    assert_true(s.lower_bound == s.distance && s.distance == fabs(s.dx) + fabs(s.dy));
    sunder_separation_clear(&s);
    sunder_shape_free(p);
    sunder_shape_free(q);
}

static void known_answers(void **state)
{
    for (size_t i = 0; i < sizeof KNOWN / sizeof *KNOWN; i++)
        for (int wide = 0; wide < 2; wide++) {
            const sunder_i_least_options options = {
                .gap = KNOWN[i].gap, .upper = INFINITY, .texts = true, .force_wide = wide};
            check_known(KNOWN + i, &options);
        }
}

/* Translating both operands by the same vector changes nothing, exactly, even if they need more bits. */
static void translated_alike(void **state)
{
    static const double SHIFT[][2] = {{1, 2}, {451234.567, 5411234.567}, {0x1p60, -0x1p-60}, {1e300, 1e-300}};
    for (size_t i = 0; i < sizeof KNOWN / sizeof *KNOWN; i++)
        for (size_t k = 0; k < sizeof SHIFT / sizeof *SHIFT; k++) {
            const sunder_i_least_options options = {
                .tp = SHIFT[k], .tq = SHIFT[k], .gap = KNOWN[i].gap, .upper = INFINITY, .texts = true};
            check_known(KNOWN + i, &options);
        }
}

/* A pocket and a peg whose sizes do not fit on a narrow lattice together. */
static void huge_and_tiny(void **state)
{
    const double big = 1e300, small = 1e-300;
    polyset p, q;
    polyset_init(&p);
    polyset_init(&q);
    polyset_rectangle(&p, -big, -big, big, big);
    polyset_rectangle(&q, big - small, -big, 0x1.8p1000, big); /* the subtraction rounds: they touch */
    polyset_rectangle(&q, -small, big, small, 0x1.8p1000);
    sunder_shape *a = polyset_shape(&p), *b = polyset_shape(&q);
    sunder_separation s;
    assert_int_equal(sunder_pair_separate(a, b, 0, &s, NULL), SUNDER_OK);
    assert_false(s.overlap);
    sunder_separation_clear(&s);
    polyset_free(&q);
    polyset_init(&q);
    polyset_rectangle(&q, -small, -small, small, small);
    sunder_shape_free(b);
    b = polyset_shape(&q);
    assert_int_equal(sunder_pair_separate(a, b, 0, &s, NULL), SUNDER_OK);
    assert_true(s.overlap);
    assert_int_equal(s.contact, SUNDER_CONTACT_EDGE);
    assert_true(s.dx == -big && s.dy == 0 && !s.rounded_is_free); /* 1e300 + 1e-300 is not a double */
    assert_true(strlen(s.dx_text) > 600 && strchr(s.dx_text, '/'));
    assert_true(s.lower_bound <= s.distance && s.distance == big);
    sunder_separation_clear(&s);
    sunder_shape_free(a);
    sunder_shape_free(b);
    polyset_free(&p);
    polyset_free(&q);
}

/* A result beyond the range of doubles is exact as text, and the doubles are marked as unusable. */
static void beyond_doubles(void **state)
{
    sunder_shape *p = shape("POLYGON((-1e308 -1e308,1e308 -1e308,1e308 1e308,-1e308 1e308))");
    for (int k = 0; k < 2; k++) {
        sunder_separation s;
        assert_int_equal(sunder_pair_separate(p, p, k ? 1e308 : 0, &s, NULL), SUNDER_OK);
        assert_true(isinf(s.dx) && s.dy == 0 && !s.rounded_is_free);
        assert_int_equal(strlen(s.dx_text), 1 + 309);
        assert_int_equal(s.dx_text[1], k ? '3' : '2');
        sunder_separation_clear(&s);
    }
    sunder_shape_free(p);
}

static sunder_shape *triangle(double scale, bool swap)
{
    const double xy[6] = {0, -scale, scale, 0, -scale, scale};
    const double yx[6] = {-scale, 0, 0, scale, scale, -scale};
    const size_t end = 3, one = 1;
    sunder_shape *s = NULL;
    assert_int_equal(sunder_shape_from_rings(swap ? yx : xy, &end, &one, 1, SUNDER_VALIDITY_EVEN_ODD, &s, NULL),
                     SUNDER_OK);
    return s;
}

/* With a gap of 2^406, the sides of a triangle of size 2^-1000 cannot be represented in doubles in units of both. Its
 * top, above the origin, gives the least translation too many digits: the nearest doubles are below it by this much. */
static void tiny_beside_a_gap(void **state)
{
    const double gap = 0x1p406, bottom = gap * (1 - 0x1p-14);
    for (int e = 300; e <= 1074; e += 43)
        for (int swap = 0; swap < 2; swap++) {
            polyset set;
            polyset_init(&set);
            polyset_rectangle(&set, swap ? bottom : -gap, swap ? -gap : bottom, swap ? 2 * gap : gap,
                              swap ? gap : 2 * gap);
            sunder_shape *tiny = triangle(ldexp(1, -e), swap), *q = polyset_shape(&set);
            sunder_separation s;
            assert_int_equal(sunder_pair_separate(tiny, q, gap, &s, NULL), SUNDER_OK);
            assert_true(s.overlap && s.distance == gap * 0x1p-14);
            assert_true(swap ? s.dx == s.distance && s.dy == 0 : s.dy == s.distance && s.dx == 0);
            assert_false(s.rounded_is_free);
            sunder_separation_clear(&s);
            sunder_shape_free(tiny);
            sunder_shape_free(q);
            polyset_free(&set);
        }
}

/* The doubles nearest to a rational answer may fall on either side. */
static void rounded_or_not(void **state)
{
    sunder_shape *p = shape("POLYGON((0 0,9 0,0 3,0 0))"), *q = shape("POLYGON((3 1,20 1,20 9,3 9,3 1))");
    sunder_separation s;
    assert_int_equal(sunder_pair_separate(p, q, 0, &s, NULL), SUNDER_OK);
    assert_true(s.dx == 0.3 && s.dy == 0.9);
    const double t[2] = {s.dx, s.dy};
    bool meet;
    assert_int_equal(sunder_i_overlap(p, NULL, q, t, &meet, NULL), SUNDER_OK);
    assert_int_equal(s.rounded_is_free, !meet);
    sunder_separation_clear(&s);
    sunder_shape_free(p);
    sunder_shape_free(q);
}

/* A ring that crosses itself at (2, 2/3); scaled by three it is two triangles with integer corners. */
static void repaired_operands(void **state)
{
    static const double TIE[] = {0, 0, 3, 1, 3, 0, 0, 2};
    static const size_t END[] = {4}, ONE[] = {1};
    sunder_shape *tie, *thrice = shape("MULTIPOLYGON(((0 0,6 2,0 6,0 0)),((9 3,6 2,9 0,9 3)))");
    assert_int_equal(sunder_shape_from_rings(TIE, END, ONE, 1, SUNDER_VALIDITY_EVEN_ODD, &tie, NULL), SUNDER_OK);
    assert_true(sunder_shape_repaired(tie));
    static const char *Q[][2] = {{"POLYGON((1 0,4 0,4 1,1 1,1 0))", "POLYGON((3 0,12 0,12 3,3 3,3 0))"},
                                 {"POLYGON((2 1,3 2,1 2,2 1))", "POLYGON((6 3,9 6,3 6,6 3))"},
                                 {"POLYGON((2 0,3 1,1 1,2 0))", "POLYGON((6 0,9 3,3 3,6 0))"}};
    for (int i = 0; i < 3; i++)
        for (int gap = 0; gap < 2; gap++) {
            sunder_shape *q = shape(Q[i][0]), *larger = shape(Q[i][1]);
            sunder_separation s, t;
            assert_int_equal(sunder_pair_separate(tie, q, gap, &s, NULL), SUNDER_OK);
            assert_int_equal(sunder_pair_separate(thrice, larger, 3 * gap, &t, NULL), SUNDER_OK);
            assert_int_equal(s.overlap, t.overlap);
            assert_int_equal(s.contact, t.contact);
            assert_true(fabs(3 * s.distance - t.distance) <= 1e-9 * t.distance);
            assert_true(fabs(3 * s.dx - t.dx) <= 1e-8 && fabs(3 * s.dy - t.dy) <= 1e-8);
            const double move[2] = {s.dx, s.dy};
            bool apart;
            assert_int_equal(sunder_i_apart(tie, NULL, q, move, gap, &apart, NULL), SUNDER_OK);
            assert_int_equal(apart, s.rounded_is_free);
            double d, e, a[2], b[2];
            assert_int_equal(sunder_pair_distance(tie, q, &d, a, b, NULL), SUNDER_OK);
            assert_int_equal(sunder_pair_distance(thrice, larger, &e, a, b, NULL), SUNDER_OK);
            assert_true(fabs(3 * d - e) <= 1e-14 * e);
            sunder_separation_clear(&s);
            sunder_separation_clear(&t);
            sunder_shape_free(q);
            sunder_shape_free(larger);
        }
    sunder_shape_free(tie);
    sunder_shape_free(thrice);
}

static void upper_limit(void **state)
{
    sunder_shape *p = shape(SQUARE), *q = shape("POLYGON((1 1,3 1,3 3,1 3,1 1))");
    for (int gap = 0; gap < 2; gap++) {
        sunder_separation s;
        bool beyond;
        assert_int_equal(sunder_i_separate(p, NULL, q, NULL, gap, 2.5, &s, &beyond, NULL), SUNDER_OK);
        assert_true(beyond && s.lower_bound == 2.5 && s.overlap);
        assert_int_equal(sunder_i_separate(p, NULL, q, NULL, gap, 4.5, &s, &beyond, NULL), SUNDER_OK);
        assert_true(!beyond && s.dx == -3 - gap && s.dy == 0 && !s.dx_text);
    }
    sunder_shape_free(p);
    sunder_shape_free(q);
}

static void bad_arguments(void **state)
{
    sunder_shape *p = shape(SQUARE);
    sunder_separation s;
    sunder_error err;
    bool apart;
    static const double BAD[] = {-1, NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < sizeof BAD / sizeof *BAD; i++) {
        assert_int_equal(sunder_pair_separate(p, p, BAD[i], &s, &err), SUNDER_EARG);
        assert_int_equal(err.status, SUNDER_EARG);
        assert_int_equal(sunder_pair_apart(p, p, BAD[i], &apart, NULL), SUNDER_EARG);
    }
    sunder_separation_clear(NULL);
    sunder_shape_free(p);
}

static void empty_operands(void **state)
{
    sunder_shape *p = shape(SQUARE), *none;
    const size_t end[1] = {0};
    assert_int_equal(sunder_shape_from_rings(NULL, end, end, 0, SUNDER_VALIDITY_STRICT, &none, NULL), SUNDER_OK);
    sunder_separation s;
    assert_int_equal(sunder_pair_separate(p, none, 1, &s, NULL), SUNDER_OK);
    assert_true(!s.overlap && s.distance == 0);
    assert_string_equal(s.distance_squared_text, "0");
    sunder_separation_clear(&s);
    bool answer;
    assert_true(sunder_pair_overlap(p, none, &answer, NULL) == SUNDER_OK && !answer);
    assert_true(sunder_pair_apart(none, p, 9, &answer, NULL) == SUNDER_OK && answer);
    assert_true(sunder_i_contained(none, NULL, p, NULL, &answer, NULL) == SUNDER_OK && answer);
    assert_true(sunder_i_contained(p, NULL, none, NULL, &answer, NULL) == SUNDER_OK && !answer);
    sunder_shape_free(p);
    sunder_shape_free(none);
}

typedef struct inside {
    const char *p, *q;
    bool contained;
} inside;

static void containment(void **state)
{
    static const inside CASES[] = {
        {SQUARE, SQUARE, true},
        {SQUARE, "POLYGON((0 0,4 0,4 5,0 5,0 0))", true},
        {SQUARE, "POLYGON((0 0,4 0,4 3,0 3,0 0))", false},
        {SQUARE, "MULTIPOLYGON(((0 0,2 0,2 4,0 4,0 0)),((2 0,4 0,4 4,2 4,2 0)))", true},
        {SQUARE, "MULTIPOLYGON(((0 0,2 0,2 4,0 4,0 0)),((3 0,4 0,4 4,3 4,3 0)))", false},
        {SQUARE, "MULTIPOLYGON(((0 0,4 0,4 4,0 0)),((0 0,3 4,0 4,0 0)))", false},
        {SQUARE, "MULTIPOLYGON(((0 0,4 0,4 4,0 0)),((0 0,4 4,0 4,0 0)))", true},
        {"POLYGON((1 1,3 1,3 3,1 3,1 1))", "POLYGON((0 0,4 0,4 4,0 4,0 0),(1 1,1 3,3 3,3 1,1 1))", false},
        {SQUARE, "MULTIPOLYGON(((0 0,4 0,4 4,0 4,0 0),(1 1,1 3,3 3,3 1,1 1)),((1 1,3 1,3 3,1 3,1 1)))", true},
        {SQUARE, "MULTIPOLYGON(((0 0,4 0,4 4,0 4,0 0),(1 1,1 3,3 3,3 1,1 1)),((1 1,3 1,3 2,1 3,1 1)))", false},
        {"POLYGON((9 9,10 9,10 10,9 9))", SQUARE, false},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        sunder_shape *p = shape(CASES[i].p), *q = shape(CASES[i].q);
        bool answer;
        assert_int_equal(sunder_i_contained(p, NULL, q, NULL, &answer, NULL), SUNDER_OK);
        if (answer != CASES[i].contained) fail_msg("%s in %s: %d", CASES[i].p, CASES[i].q, answer);
        sunder_shape_free(p);
        sunder_shape_free(q);
    }
}

static void distances(void **state)
{
    sunder_shape *p = shape(SQUARE), *q = shape("POLYGON((7 8,9 8,9 9,7 9,7 8))"),
                 *r = shape("POLYGON((4 2,5 1,5 3,4 2))");
    double d, a[2], b[2];
    assert_int_equal(sunder_pair_distance(p, q, &d, a, b, NULL), SUNDER_OK);
    assert_true(d == 5 && a[0] == 4 && a[1] == 4 && b[0] == 7 && b[1] == 8);
    assert_int_equal(sunder_pair_distance(p, r, &d, a, b, NULL), SUNDER_OK);
    assert_true(d == 0 && a[0] == 4 && a[1] == 2 && b[0] == 4 && b[1] == 2);
    assert_int_equal(sunder_pair_distance(p, p, &d, a, b, NULL), SUNDER_OK);
    assert_true(d == 0 && a[0] == b[0] && a[1] == b[1] && a[0] > 0 && a[0] < 4);
    /* Far from the origin and close together: there is no cancellation. */
    const double t[2] = {4 + 0x1p-40, 0};
    assert_int_equal(sunder_i_distance(p, NULL, p, t, &d, a, b, NULL), SUNDER_OK);
    assert_true(d == 0x1p-40);
    sunder_shape_free(p);
    sunder_shape_free(q);
    sunder_shape_free(r);
}

/* ---- Allocations that fail ---- */

static long allocations_left = -1, allocations_out;

static void *failing_malloc(size_t n)
{
    if (allocations_left == 0) return NULL;
    if (allocations_left > 0) allocations_left--;
    void *m = malloc(n);
    allocations_out += m != NULL;
    return m;
}

static void *failing_realloc(void *old, size_t n)
{
    if (allocations_left == 0) return NULL;
    if (allocations_left > 0) allocations_left--;
    void *m = realloc(old, n);
    allocations_out += m && !old;
    return m;
}

static void counting_free(void *m)
{
    allocations_out -= m != NULL;
    free(m);
}

/* Runs the question with that number; returns the status. */
static sunder_status ask(int question, const sunder_shape *p, const sunder_shape *q, bool wide)
{
    bool answer;
    double d, a[2], b[2];
    sunder_separation s;
    const sunder_i_least_options options = {
        .gap = question == 0 ? 0 : 1.25, .upper = INFINITY, .texts = true, .force_wide = wide};
    sunder_status status;
    switch (question) {
    case 0:
    case 1:
        status = sunder_i_least(p, q, &options, &s, NULL, NULL);
        if (status == SUNDER_OK) sunder_separation_clear(&s);
        return status;
    case 2: return sunder_pair_overlap(p, q, &answer, NULL);
    case 3: return sunder_pair_apart(p, q, 1.25, &answer, NULL);
    case 4: return sunder_i_contained(p, NULL, q, NULL, &answer, NULL);
    default: return sunder_pair_distance(p, q, &d, a, b, NULL);
    }
}

static void memory_runs_out(void **state)
{
    sunder_set_allocator(failing_malloc, failing_realloc, counting_free);
    sunder_shape *p = shape(POCKET8), *q = shape("POLYGON((1 3,5 3,6 7,1 7,1 3))");
    for (int question = 0; question < 6; question++)
        for (int wide = 0; wide < 2; wide++) {
            const long before = allocations_out;
            long n = 0;
            for (;; n++) {
                allocations_left = n;
                const sunder_status status = ask(question, p, q, wide);
                allocations_left = -1;
                assert_int_equal(allocations_out, before);
                if (status == SUNDER_OK) break;
                assert_int_equal(status, SUNDER_ENOMEM);
            }
            assert_true(n > 0);
        }
    sunder_shape_free(p);
    sunder_shape_free(q);
    sunder_set_allocator(NULL, NULL, NULL);
}

/* A bound that is computed without the translation equals the one computed with it, for short coordinates and for those
 * of a map, whose numbers are put onto the lattice by other code. */
static void bound_alone(void **state)
{
    static const double gaps[] = {0, 0.1, 1, 3.7};
    const double far[][2] = {{0, 0}, {0x1p19 + 0x1p-20, 0x1p22 + 0x1p-12}, {0x1p30, -0x1p9}, {1e-3, 0}};
    for (size_t i = 0; i < sizeof KNOWN / sizeof *KNOWN; i++)
        for (size_t k = 0; k < sizeof far / sizeof *far; k++) {
            sunder_shape *given[2] = {shape(KNOWN[i].p), shape(KNOWN[i].q)}, *p, *q;
            bool exact, same;
            assert_int_equal(sunder_shape_translate(given[0], far[k][0], far[k][1], &p, &exact, NULL), SUNDER_OK);
            assert_int_equal(sunder_shape_translate(given[1], far[k][0], far[k][1], &q, &same, NULL), SUNDER_OK);
            for (size_t g = 0; exact && same && g < sizeof gaps / sizeof *gaps; g++) {
                sunder_separation wide, plain;
                sunder_i_least_options options = {.gap = gaps[g], .upper = INFINITY, .texts = true};
                assert_int_equal(sunder_i_least(p, q, &options, &plain, NULL, NULL), SUNDER_OK);
                options.force_wide = true;
                assert_int_equal(sunder_i_least(p, q, &options, &wide, NULL, NULL), SUNDER_OK);
                double bound, about[2];
                bool beyond;
                assert_int_equal(sunder_i_least_bound(p, q, gaps[g], INFINITY, &bound, about, &beyond, NULL),
                                 SUNDER_OK);
                assert_true(bound == plain.lower_bound && !beyond);
                assert_true(hypot(about[0] - plain.dx, about[1] - plain.dy) <= 1e-8 * plain.distance);
                assert_string_equal(plain.distance_squared_text, wide.distance_squared_text);
                if (bound > 0) {
                    assert_int_equal(sunder_i_least_bound(p, q, gaps[g], bound / 2, &bound, about, &beyond, NULL),
                                     SUNDER_OK);
                    assert_true(beyond && bound == plain.lower_bound / 2);
                }
                sunder_separation_clear(&plain);
                sunder_separation_clear(&wide);
            }
            for (int side = 0; side < 2; side++) sunder_shape_free(given[side]);
            sunder_shape_free(p);
            sunder_shape_free(q);
        }
}

/* A square of that side, with its lower side on the x axis, starting at x. */
static sunder_shape *square(double x, double side)
{
    const double xy[] = {x, 0, x + side, 0, x + side, side, x, side};
    const size_t ring_end = 4, poly_end = 1;
    sunder_shape *s = NULL;
    assert_int_equal(sunder_shape_from_rings(xy, &ring_end, &poly_end, 1, SUNDER_VALIDITY_STRICT, &s, NULL), SUNDER_OK);
    return s;
}

/* Texts of numbers with any number of digits, with zeros at all places, as printf() and GMP write them: for two squares
 * that overlap by half, which are separated by half a side. */
static void digits(void **state)
{
    (void)state;
    static const uint64_t odd_ones[] = {1, 7, 1001, 90909, 1000001, 10000001, 100000007, 120000034, 5000000000005};
    const size_t odd = sizeof odd_ones / sizeof *odd_ones;
    uint64_t power = 1;
    for (size_t k = 0; k < 3 * 15 + odd; k++) {
        if (k < 3 * 15 && k % 3 == 0) power *= 10;
        const uint64_t n = k < 3 * 15 ? power - 1 + k % 3 : odd_ones[k - 3 * 15];
        char text[2][32], norm[64];
        sunder_shape *p = square(0, (double)(2 * n)), *q = square((double)n, (double)(2 * n));
        sunder_separation s;
        assert_int_equal(sunder_pair_separate(p, q, 0, &s, NULL), SUNDER_OK);
        snprintf(text[0], sizeof text[0], "%" PRIu64, n);
        mpz_t v;
        mpz_init_set_str(v, text[0], 10);
        mpz_mul(v, v, v);
        mpz_get_str(norm, 10, v);
        mpz_clear(v);
        assert_string_equal(s.dx_text, text[0]);
        assert_string_equal(s.dy_text, "0");
        assert_string_equal(s.distance_squared_text, norm);
        sunder_separation_clear(&s);
        sunder_shape_free(p);
        sunder_shape_free(q);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_answers),     cmocka_unit_test(translated_alike), cmocka_unit_test(huge_and_tiny),
        cmocka_unit_test(beyond_doubles),    cmocka_unit_test(rounded_or_not),   cmocka_unit_test(upper_limit),
        cmocka_unit_test(bad_arguments),     cmocka_unit_test(empty_operands),   cmocka_unit_test(containment),
        cmocka_unit_test(distances),         cmocka_unit_test(memory_runs_out),  cmocka_unit_test(repaired_operands),
        cmocka_unit_test(bound_alone),       cmocka_unit_test(long_fractions),   cmocka_unit_test(digits),
        cmocka_unit_test(tiny_beside_a_gap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
