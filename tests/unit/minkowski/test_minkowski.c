/* sunder_minkowski_sum() apart from its results: empty operands, the same operand twice, stopping, memory that runs out
 * at every allocation, numbers beyond the range of doubles. */
#include "failing.h"
#include "generate.h"
#include "sum_text.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define EMPTY_TEXT "{\"polygons\": [], \"degenerate_segments\": [], \"degenerate_points\": []}"

static sunder_shape *shape_of(const char *wkt)
{
    sunder_shape *shape = polyset_shape_of_wkt(wkt);
    assert_non_null(shape);
    return shape;
}

static void test_empty(void **state)
{
    (void)state;
    polyset none;
    sunder_sum *sum = NULL;
    polyset_init(&none);
    sunder_shape *empty = polyset_shape(&none), *square = shape_of("POLYGON((0 0,1 0,1 1,0 1,0 0))");
    assert_non_null(empty);
    assert_true(sunder_shape_is_empty(empty));
    for (int k = 0; k < 3; k++) {
        assert_int_equal(sunder_minkowski_sum(k == 1 ? square : empty, k == 0 ? square : empty, NULL, &sum, NULL),
                         SUNDER_OK);
        char *text = sum_text(sum), *area = NULL;
        assert_string_equal(text, EMPTY_TEXT);
        assert_int_equal(sunder_sum_area_text(sum, &area, NULL), SUNDER_OK);
        assert_string_equal(area, "0");
        sunder_free(area);
        free(text);
        sunder_sum_free(sum);
    }
    sunder_sum_free(NULL);
    sunder_shape_free(NULL);
    sunder_shape_free(empty);
    sunder_shape_free(square);
}

static void test_same_operand(void **state)
{
    (void)state;
    sunder_shape *p = shape_of("POLYGON((0 0,4 0,4 1,1 1,1 3,4 3,4 4,0 5,0 0))"),
                 *q = shape_of("POLYGON((0 0,4 0,4 1,1 1,1 3,4 3,4 4,0 5,0 0))");
    sunder_sum *once = NULL, *twice = NULL;
    assert_int_equal(sunder_minkowski_sum(p, p, NULL, &once, NULL), SUNDER_OK);
    assert_int_equal(sunder_minkowski_sum(p, q, NULL, &twice, NULL), SUNDER_OK);
    char *a = sum_text(once), *b = sum_text(twice);
    assert_string_equal(a, b);
    sunder_counts n;
    double decompose = -1, subsums = -1, unite = -1;
    sunder_sum_get_counts(once, &n);
    assert_true(n.comparisons + n.orientation_tests > 0);
    sunder_sum_seconds(once, &decompose, &subsums, &unite);
    assert_true(decompose >= 0 && subsums >= 0 && unite >= 0);
    free(a);
    free(b);
    sunder_sum_free(once);
    sunder_sum_free(twice);
    sunder_shape_free(p);
    sunder_shape_free(q);
}

/* Adds the ring of the square with half side r, whose corners (u, v) are mapped to (a u + c v, b u + d v). */
static void skewed_square(polyset *set, const double m[4], double r, bool hole)
{
    static const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < 4; i++) {
        const double *k = corner[hole ? 3 - i : i];
        polyset_vertex(set, r * (m[0] * k[0] + m[2] * k[1]), r * (m[1] * k[0] + m[3] * k[1]));
    }
    polyset_end_ring(set);
}

static void skewed_frame(polyset *set, const double m[4], double outer, double inner)
{
    skewed_square(set, m, outer, false);
    skewed_square(set, m, inner, true);
    polyset_end_polygon(set);
}

/* The area of each polygon, outer ring minus hole in units of its frame, tells which frame it is. */
static void expect_frames(const sunder_sum *sum, const double m[4])
{
    static const double outer[3] = {91, 61, 31}, inner[3] = {79, 49, 19};
    bool found[3] = {false, false, false};
    sunder_sum_size n;
    sunder_sum_get_size(sum, &n);
    assert_int_equal(n.polygons, 3);
    assert_int_equal(n.holes, 3);
    for (size_t p = 0; p < 3; p++) {
        double half[2];
        assert_int_equal(sunder_sum_rings(sum, p), 2);
        for (size_t r = 0; r < 2; r++) {
            size_t corners;
            const uint32_t *ring = sunder_sum_ring(sum, p, r, &corners);
            double a[2], b[2];
            assert_int_equal(corners, 4);
            sunder_sum_vertex(sum, ring[0], a);
            sunder_sum_vertex(sum, ring[2], b); /* the opposite corner: the difference is 2 r (+-(a, b) +- (c, d)) */
            half[r] = fabs(b[0] - a[0]) / (2 * (m[0] + m[2])); /* exact: all are integers below 2^53 */
        }
        for (int k = 0; k < 3; k++) found[k] = found[k] || (half[0] == outer[k] && half[1] == inner[k]);
    }
    assert_true(found[0] && found[1] && found[2]);
}

/* Three frames, each inside the hole of the next, sheared (by matrices of determinant 1) so much that their areas in
 * doubles are mostly rounding error: each hole is assigned to its own frame, for any order of the members. */
static void test_nested_slivers(void **state)
{
    (void)state;
    static const double slant[][4] = {{1, 0, 0, 1},
                                      {3, 5, 7, 12},
                                      {105306629, 118888914, 21388489, 24147143},
                                      {80940767, 92324486, 18670575, 21296453},
                                      {461049256, 472683321, 404719687, 414932338},
                                      {5432089498, 4394162675, 45677851, 36950037}};
    static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    static const double outer[3] = {90, 60, 30}, inner[3] = {80, 50, 20};
    for (size_t i = 0; i < sizeof slant / sizeof *slant; i++)
        for (int k = 0; k < 6; k++) {
            polyset frames, unit;
            sunder_sum *sum = NULL;
            polyset_init(&frames);
            polyset_init(&unit);
            for (int j = 0; j < 3; j++) skewed_frame(&frames, slant[i], outer[order[k][j]], inner[order[k][j]]);
            skewed_square(&unit, slant[i], 1, false);
            polyset_end_polygon(&unit);
            sunder_shape *p = polyset_shape(&frames), *q = polyset_shape(&unit);
            assert_non_null(p);
            assert_non_null(q);
            assert_int_equal(sunder_minkowski_sum(p, q, NULL, &sum, NULL), SUNDER_OK);
            expect_frames(sum, slant[i]);
            sunder_sum_free(sum);
            sunder_shape_free(p);
            sunder_shape_free(q);
            polyset_free(&frames);
            polyset_free(&unit);
        }
}

typedef struct watch {
    int calls, allowed;
    double last;
    bool monotone;
} watch;

static bool watching(double fraction, void *user)
{
    watch *w = user;
    w->calls++;
    w->monotone = w->monotone && fraction >= w->last && fraction >= 0 && fraction <= 1;
    w->last = fraction;
    return w->calls <= w->allowed;
}

static void test_progress(void **state)
{
    (void)state;
    polyset a, b;
    rng r = rng_start(1, 1);
    polyset_init(&a);
    polyset_init(&b);
    random_star(&a, &r, 200, 100000);
    random_star(&b, &r, 200, 100000);
    sunder_shape *p = polyset_shape(&a), *q = polyset_shape(&b);
    sunder_sum *sum = NULL;
    sunder_error err = {0};
    watch w = {0, 1 << 30, 0, true};
    sunder_sum_options options = {.size = sizeof options, .progress = watching, .progress_user = &w};
    assert_int_equal(sunder_minkowski_sum(p, q, &options, &sum, &err), SUNDER_OK);
    assert_true(w.calls > 0 && w.monotone && w.last > 0);
    sunder_sum_free(sum);
    sum = NULL;
    failing_begin();
    for (int stop = 0; stop < w.calls; stop += 1 + w.calls / 8) {
        watch v = {0, stop, 0, true};
        options.progress_user = &v;
        assert_int_equal(sunder_minkowski_sum(p, q, &options, &sum, &err), SUNDER_ECANCEL);
        assert_int_equal(err.status, SUNDER_ECANCEL);
        assert_null(sum);
        assert_int_equal(failing_outstanding(), 0);
    }
    failing_end();
    sunder_shape_free(p);
    sunder_shape_free(q);
    polyset_free(&a);
    polyset_free(&b);
}

/* ---- Out of memory ---- */

typedef struct attempt {
    polyset p, q;
} attempt;

static bool sum_run(void *context)
{
    const attempt *c = context;
    sunder_shape *p = NULL, *q = NULL;
    sunder_sum *sum = NULL;
    sunder_error err = {0};
    char *x = NULL, *y = NULL, *area = NULL;
    const polyset *s = &c->p, *t = &c->q;
    sunder_status status =
        sunder_shape_from_rings(s->xy, s->ring_end, s->poly_end, s->polygons, SUNDER_VALIDITY_STRICT, &p, &err);
    if (!status)
        status =
            sunder_shape_from_rings(t->xy, t->ring_end, t->poly_end, t->polygons, SUNDER_VALIDITY_STRICT, &q, &err);
    if (!status) status = sunder_minkowski_sum(p, q, NULL, &sum, &err);
    if (!status) status = sunder_sum_area_text(sum, &area, &err);
    if (!status) status = sunder_sum_vertex_text(sum, 0, &x, &y, &err);
    if (status && (status != SUNDER_ENOMEM || err.status != SUNDER_ENOMEM)) print_message("status %d\n", (int)status);
    /* A failed call leaves outputs untouched, so every pointer here is either valid or NULL. */
    sunder_free(x);
    sunder_free(y);
    sunder_free(area);
    sunder_sum_free(sum);
    sunder_shape_free(p);
    sunder_shape_free(q);
    return status == SUNDER_OK;
}

static void test_out_of_memory(void **state)
{
    (void)state;
    static const pair_kind kinds[] = {PAIR_PEG, PAIR_SLIDE, PAIR_HOLES, PAIR_BOARDS, PAIR_RAGGED, PAIR_HUGE, PAIR_SELF};
    const uint64_t seed = test_seed();
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        attempt c;
        rng r = rng_start(seed, k);
        random_pair(&c.p, &c.q, &r, kinds[k]);
        if (!failing_loop(sum_run, &c, false)) {
            char *p = polyset_wkt(&c.p), *q = polyset_wkt(&c.q);
            print_message("kind %s, SUNDER_SEED=%llu\n%s\n%s\n", pair_kind_string(kinds[k]), (unsigned long long)seed,
                          p, q);
            free(p);
            free(q);
            fail();
        }
        polyset_free(&c.p);
        polyset_free(&c.q);
    }
}

/* Members that are apart, that overlap after dilation, and that share a wall, which use three different algorithms; and
 * enough bars that only the needed sums are computed. */
static void test_out_of_memory_in_members(void **state)
{
    (void)state;
    const char *const text[] = {
        "MULTIPOLYGON(((0 0,9 1,8 9,4 3,0 0)),((10 0,19 1,18 9,14 3,10 0)),((99 0,109 0,109 9,99 9,99 0)),"
        "((109 0,119 0,119 9,109 9,109 0)),((200 0,209 1,208 9,204 3,200 0)))",
        "POLYGON((0 0,3 1,1 3,0 0))"};
    attempt c[2];
    assert_true(polyset_read_wkt(&c[0].p, text[0], NULL) && polyset_read_wkt(&c[0].q, text[1], NULL));
    polyset_init(&c[1].p);
    polyset_init(&c[1].q);
    for (int i = 0; i < 17; i++) {
        polyset_rectangle(&c[1].p, 10 * i, 7 * i, 10 * i + 9, 7 * i + 60);
        polyset_rectangle(&c[1].q, 3 * i, 11 * i, 3 * i + 50, 11 * i + 9);
    }
    for (int i = 0; i < 2; i++) {
        assert_true(failing_loop(sum_run, &c[i], false));
        polyset_free(&c[i].p);
        polyset_free(&c[i].q);
    }
}

/* The exact sum is beyond all doubles: the texts are right, the doubles are infinite. */
static void test_beyond_doubles(void **state)
{
    (void)state;
    polyset p;
    const double m = 0x1.8p1023;
    sunder_sum *sum = NULL;
    polyset_init(&p);
    polyset_rectangle(&p, -m, -m, m, m);
    sunder_shape *s = polyset_shape(&p);
    assert_non_null(s);
    assert_int_equal(sunder_minkowski_sum(s, s, NULL, &sum, NULL), SUNDER_OK);
    size_t n = 0;
    double xy[2];
    const uint32_t *v = sunder_sum_ring(sum, 0, 0, &n);
    assert_int_equal(n, 4);
    sunder_sum_vertex(sum, v[0], xy);
    assert_true(isinf(xy[0]) && xy[0] < 0 && isinf(xy[1]) && xy[1] < 0);
    char *text = sum_text(sum); /* checks that each double is the nearest to its text */
    assert_non_null(text);
    free(text);
    sunder_sum_free(sum);
    sunder_shape_free(s);
    polyset_free(&p);
}

/* The deviation of a ring as a whole is at least that of each of its vertices: at the origin, far from it, and where
 * doubles have no fractions; the doubles of each vertex are compared with its text. */
static void test_deviation(void **state)
{
    (void)state;
    const double out[] = {0, 0.1, 1234567.123, -4503599627370497.0, 0x1.123456789p60, 0x1.3p85, -0x1.7p120};
    size_t off_by_some = 0;
    for (size_t k = 0; k < sizeof out / sizeof *out; k++) {
        const double o = out[k], size = fmax(16.3, fabs(o) * 0x1p-45), xy[] = {o, -o, o + size, -o, o, -o + 0.7 * size};
        const size_t ring_end = 3, poly_end = 1;
        sunder_shape *p = NULL, *disc = NULL;
        sunder_sum *sum = NULL;
        assert_int_equal(sunder_shape_from_rings(xy, &ring_end, &poly_end, 1, SUNDER_VALIDITY_STRICT, &p, NULL), 0);
        assert_int_equal(sunder_shape_disc(size / 3, 60, false, &disc, NULL), 0);
        assert_int_equal(sunder_minkowski_sum(p, disc, NULL, &sum, NULL), 0);
        size_t n = 0;
        double at[2 * 200], all = 0, most = 0;
        const uint32_t *v = sunder_sum_ring(sum, 0, 0, &n);
        assert_true(n <= 200);
        assert_int_equal(sunder_sum_vertices(sum, v, n, at, &all, NULL), 0);
        for (size_t i = 0; i < n; i++) {
            double one[2], off = 0;
            assert_int_equal(sunder_sum_vertices(sum, v + i, 1, one, &off, NULL), 0);
            assert_true(one[0] == at[2 * i] && one[1] == at[2 * i + 1]);
            most = fmax(most, off);
        }
        assert_true(all == most);
        off_by_some += all > 0;
        char *text = sum_text(sum);
        assert_non_null(text);
        free(text);
        sunder_sum_free(sum);
        sunder_shape_free(disc);
        sunder_shape_free(p);
    }
    assert_true(off_by_some > 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_empty),          cmocka_unit_test(test_same_operand),
        cmocka_unit_test(test_nested_slivers), cmocka_unit_test(test_progress),
        cmocka_unit_test(test_out_of_memory),  cmocka_unit_test(test_out_of_memory_in_members),
        cmocka_unit_test(test_beyond_doubles), cmocka_unit_test(test_deviation)};
    return cmocka_run_group_tests_name("the interface of sums", tests, NULL, NULL);
}
