/* sunder_morphology() and sunder_shape_union(): known results, refused arguments, stopping, and memory that runs
 * out. */
#include "failing.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define EMPTY "POLYGON EMPTY"

static sunder_shape *shape_of(const char *wkt)
{
    polyset set;
    if (strcmp(wkt, EMPTY) == 0)
        polyset_init(&set);
    else
        assert_true(polyset_read_wkt(&set, wkt, NULL));
    sunder_shape *shape = polyset_shape(&set);
    polyset_free(&set);
    assert_non_null(shape);
    return shape;
}

static void expect_text(const char *p, const char *b, sunder_operation operation, const char *expected)
{
    sunder_shape *sp = shape_of(p), *sb = shape_of(b);
    sunder_sum *sum;
    assert_int_equal(sunder_morphology(sp, sb, operation, NULL, &sum, NULL), SUNDER_OK);
    char *text = sum_text(sum);
    assert_string_equal(text, expected);
    free(text);
    sunder_sum_free(sum);
    sunder_shape_free(sp);
    sunder_shape_free(sb);
}

#define HALL "POLYGON ((0 0, 4 0, 4 10, 0 10))"
#define SQUARE "POLYGON ((-2 -2, 2 -2, 2 2, -2 2))"
#define ELL "POLYGON ((0 0, 2 0, 2 1, 1 1, 1 2, 0 2))"
#define NOTHING "{\"polygons\": [], \"degenerate_segments\": [], \"degenerate_points\": []}"
#define RECTANGLE(x0, y0, x1, y1)                                                                                      \
    "{\"polygons\": [{\"outer\": [[\"" x0 "\", \"" y0 "\"], [\"" x1 "\", \"" y0 "\"], [\"" x1 "\", \"" y1              \
    "\"], [\"" x0 "\", \"" y1 "\"]], \"holes\": []}], \"degenerate_segments\": [], \"degenerate_points\": []}"

/* A hall exactly as wide as the square: the erosion is the segment along which the square slides, and the opening is
 * the hall. */
static void test_hall(void **state)
{
    expect_text(
        HALL, SQUARE, SUNDER_OPERATION_ERODE,
        "{\"polygons\": [], \"degenerate_segments\": [[[\"2\", \"2\"], [\"2\", \"8\"]]], \"degenerate_points\": []}");
    expect_text(HALL, SQUARE, SUNDER_OPERATION_OPEN, RECTANGLE("0", "0", "4", "10"));
    expect_text(HALL, SQUARE, SUNDER_OPERATION_CLOSE, RECTANGLE("0", "0", "4", "10"));
    expect_text(HALL, SQUARE, SUNDER_OPERATION_DILATE, RECTANGLE("-2", "-2", "6", "12"));
}

/* A shape fits into itself in exactly one place. */
static void test_key(void **state)
{
    expect_text(ELL, ELL, SUNDER_OPERATION_ERODE,
                "{\"polygons\": [], \"degenerate_segments\": [], \"degenerate_points\": [[\"0\", \"0\"]]}");
    expect_text(ELL, HALL, SUNDER_OPERATION_ERODE, NOTHING);
    expect_text(ELL, HALL, SUNDER_OPERATION_OPEN, NOTHING);
    expect_text(EMPTY, HALL, SUNDER_OPERATION_ERODE, NOTHING);
    expect_text(EMPTY, HALL, SUNDER_OPERATION_CLOSE, NOTHING);
}

/* A room and a corridor exactly as wide as the square: the erosion is a polygon with an attached segment. */
static void test_room_and_corridor(void **state)
{
    expect_text("POLYGON ((0 0, 10 0, 10 3, 20 3, 20 7, 10 7, 10 10, 0 10))", SQUARE, SUNDER_OPERATION_ERODE,
                "{\"polygons\": [{\"outer\": [[\"2\", \"2\"], [\"8\", \"2\"], [\"8\", \"8\"], [\"2\", \"8\"]], "
                "\"holes\": []}], "
                "\"degenerate_segments\": [[[\"8\", \"5\"], [\"18\", \"5\"]]], \"degenerate_points\": []}");
}

/* Rationals are kept from stage to stage: a slanted wall and a triangle. */
static void test_rational(void **state)
{
    expect_text(
        "POLYGON ((0 0, 7 0, 7 3, 0 3))", "POLYGON ((0 0, 3 0, 0 1))", SUNDER_OPERATION_OPEN,
        "{\"polygons\": [{\"outer\": [[\"0\", \"0\"], [\"7\", \"0\"], [\"7\", \"2\"], [\"4\", \"3\"], [\"0\", \"3\"]], "
        "\"holes\": []}], \"degenerate_segments\": [], \"degenerate_points\": []}");
}

/* Gaps exactly as wide as the square are closed, wider ones are not. */
static void test_gap(void **state)
{
    expect_text("MULTIPOLYGON (((0 0, 10 0, 10 10, 0 10)), ((14 0, 20 0, 20 10, 14 10)))", SQUARE,
                SUNDER_OPERATION_CLOSE, RECTANGLE("0", "0", "20", "10"));
    sunder_shape *p = shape_of("MULTIPOLYGON (((0 0, 10 0, 10 10, 0 10)), ((14.000000000000002 0, 20 0, 20 10, "
                               "14.000000000000002 10)))"),
                 *b = shape_of(SQUARE);
    sunder_sum *sum;
    sunder_sum_size size;
    assert_int_equal(sunder_morphology(p, b, SUNDER_OPERATION_CLOSE, NULL, &sum, NULL), SUNDER_OK);
    sunder_sum_get_size(sum, &size);
    assert_int_equal(size.polygons, 2);
    sunder_sum_free(sum);
    sunder_shape_free(p);
    sunder_shape_free(b);
}

/* Far from the origin, on a fine lattice, and repaired by the even-odd rule: the result is the same, translated. */
static void test_places(void **state)
{
    const double bow[10] = {0, 0, 3, 3, 3, 0, 0, 3, 0, 0};
    const size_t ring_end = 5, poly_end = 1;
    sunder_shape *p, *b = shape_of("POLYGON ((0 0, 0.5 0, 0 0.5))");
    assert_int_equal(sunder_shape_from_rings(bow, &ring_end, &poly_end, 1, SUNDER_VALIDITY_EVEN_ODD, &p, NULL),
                     SUNDER_OK);
    for (int op = SUNDER_OPERATION_ERODE; op <= SUNDER_OPERATION_CLOSE; op++) {
        sunder_shape *moved;
        sunder_sum *here, *there;
        bool exact;
        assert_int_equal(sunder_shape_translate(p, 0x1p40, -0x1p44, &moved, &exact, NULL), SUNDER_OK);
        assert_int_equal(sunder_morphology(p, b, (sunder_operation)op, NULL, &here, NULL), SUNDER_OK);
        assert_int_equal(sunder_morphology(moved, b, (sunder_operation)op, NULL, &there, NULL), SUNDER_OK);
        char *one = sum_text(here), *two = sum_text(there), *shifted = sum_text_moved(one, 0, 0x1p40, -0x1p44);
        assert_string_equal(shifted, two);
        free(one);
        free(two);
        free(shifted);
        sunder_sum_free(here);
        sunder_sum_free(there);
        sunder_shape_free(moved);
    }
    sunder_shape_free(p);
    sunder_shape_free(b);
}

/* A member that touches itself in a point, a hole that touches its ring, members that share a wall. */
static void test_union(void **state)
{
    sunder_shape *p = shape_of("MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4), (0 2, 1 1, 2 2, 1 3)), ((4 0, 6 0, 6 4, 4 4)))");
    sunder_sum *sum;
    assert_true(sunder_shape_touches(p));
    assert_int_equal(sunder_shape_union(p, NULL, &sum, NULL), SUNDER_OK);
    char *text = sum_text(sum);
    assert_string_equal(text,
                        "{\"polygons\": [{\"outer\": [[\"0\", \"0\"], [\"6\", \"0\"], [\"6\", \"4\"], [\"0\", \"4\"]], "
                        "\"holes\": [[[\"0\", \"2\"], [\"1\", \"3\"], [\"2\", \"2\"], [\"1\", \"1\"]]]}], "
                        "\"degenerate_segments\": [], \"degenerate_points\": []}");
    free(text);
    sunder_sum_free(sum);
    sunder_shape_free(p);
    p = shape_of(ELL);
    assert_false(sunder_shape_touches(p));
    sunder_shape_free(p);
}

/* ---- Vertices in doubles ---- */

static void test_vertices(void **state)
{
    sunder_shape *p = shape_of("POLYGON ((0 0, 7 0, 7 3, 0 3))"), *b = shape_of("POLYGON ((0 0, 0.1 0, 0 0.3))");
    sunder_sum *sum;
    assert_int_equal(sunder_minkowski_sum(p, b, NULL, &sum, NULL), SUNDER_OK);
    size_t n;
    const uint32_t *ring = sunder_sum_ring(sum, 0, 0, &n);
    double *xy = test_alloc(2 * n, sizeof *xy), off = 0, one[2];
    assert_int_equal(sunder_sum_vertices(sum, ring, n, xy, &off, NULL), SUNDER_OK);
    for (size_t i = 0; i < n; i++) {
        sunder_sum_vertex(sum, ring[i], one);
        assert_memory_equal(one, xy + 2 * i, sizeof one);
    }
    /* 7 + 0.1 and 3 + 0.3 are not doubles; the error is at most half a unit in the last place of 8 and of 4. */
    assert_true(off > 0 && off <= 0x1p-51);
    sunder_sum_free(sum);
    sunder_shape_free(p);
    sunder_shape_free(b);
    p = shape_of("POLYGON ((0 0, 1.7e308 0, 0 1.7e308))");
    assert_int_equal(sunder_minkowski_sum(p, p, NULL, &sum, NULL), SUNDER_OK);
    ring = sunder_sum_ring(sum, 0, 0, &n);
    free(xy);
    xy = test_alloc(2 * n, sizeof *xy);
    assert_int_equal(sunder_sum_vertices(sum, ring, n, xy, &off, NULL), SUNDER_OK);
    assert_true(off > 1.7e308 * 10 || off == off / 2);
    free(xy);
    sunder_sum_free(sum);
    sunder_shape_free(p);
}

/* ---- Refusals ---- */

static void test_arguments(void **state)
{
    sunder_shape *p = shape_of(HALL), *none = shape_of(EMPTY);
    sunder_sum *sum = NULL;
    sunder_error err;
    for (int op = SUNDER_OPERATION_DILATE; op <= SUNDER_OPERATION_CLOSE; op++)
        assert_int_equal(sunder_morphology(p, none, (sunder_operation)op, NULL, &sum, &err), SUNDER_EARG);
    assert_int_equal(sunder_morphology(p, p, (sunder_operation)4, NULL, &sum, &err), SUNDER_EARG);
    assert_null(sum);
    assert_string_equal(sunder_operation_string(SUNDER_OPERATION_CLOSE), "close");
    assert_string_equal(sunder_operation_string((sunder_operation)9), "");
    sunder_shape_free(p);
    sunder_shape_free(none);
}

typedef struct stopping {
    int left;
    double reached;
} stopping;

/* The reported progress never decreases. */
static bool stop_at(double fraction, void *user)
{
    stopping *s = user;
    assert_true(fraction >= s->reached && fraction <= 1);
    s->reached = fraction;
    return s->left-- > 0;
}

/* Stopped at each possible call in turn, until it completes. */
static void test_stopping(void **state)
{
    sunder_shape *p = shape_of("MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4)), ((3 3, 8 3, 8 8)))"), *b = shape_of(ELL);
    for (int op = SUNDER_OPERATION_ERODE; op <= SUNDER_OPERATION_CLOSE; op++) {
        sunder_status status = SUNDER_ECANCEL;
        int chances = 0;
        for (; status == SUNDER_ECANCEL; chances++) {
            stopping left = {chances, 0};
            const sunder_sum_options how = {.size = sizeof how, .progress = stop_at, .progress_user = &left};
            sunder_sum *sum = NULL;
            status = sunder_morphology(p, b, (sunder_operation)op, &how, &sum, NULL);
            sunder_sum_free(sum);
        }
        assert_int_equal(status, SUNDER_OK);
        assert_true(chances > 10);
    }
    sunder_shape_free(p);
    sunder_shape_free(b);
}

/* A union rarely calls the progress function, so this takes many members. */
static void test_stopping_a_union(void **state)
{
    enum { MEMBERS = 2000 };
    static double xy[MEMBERS][8];
    static size_t ring_end[MEMBERS], poly_end[MEMBERS];
    for (size_t i = 0; i < MEMBERS; i++) {
        const double x = (double)(i * 37 % 101), y = (double)(i * 61 % 97),
                     corner[] = {x, y, x + 3, y, x + 3, y + 2, x, y + 2};
        memcpy(xy[i], corner, sizeof corner);
        ring_end[i] = 4 * (i + 1);
        poly_end[i] = i + 1;
    }
    sunder_shape *p;
    assert_int_equal(sunder_shape_from_rings(xy[0], ring_end, poly_end, MEMBERS, SUNDER_VALIDITY_STRICT, &p, NULL),
                     SUNDER_OK);
    stopping now = {0, 0};
    const sunder_sum_options how = {.size = sizeof how, .progress = stop_at, .progress_user = &now};
    sunder_sum *sum = NULL;
    assert_int_equal(sunder_shape_union(p, &how, &sum, NULL), SUNDER_ECANCEL);
    assert_null(sum);
    sunder_shape_free(p);
}

typedef struct attempt {
    sunder_shape *p, *b;
    int operation; /* one past the last operation: the union */
} attempt;

static bool try_it(void *context)
{
    const attempt *a = context;
    sunder_sum *sum = NULL;
    double xy[2], off = 0;
    const sunder_status status = a->operation > SUNDER_OPERATION_CLOSE
                                     ? sunder_shape_union(a->p, NULL, &sum, NULL)
                                     : sunder_morphology(a->p, a->b, (sunder_operation)a->operation, NULL, &sum, NULL);
    const uint32_t first = 0;
    const bool ok = status == SUNDER_OK && sunder_sum_vertices(sum, &first, 1, xy, &off, NULL) == SUNDER_OK;
    assert_true(ok || status == SUNDER_ENOMEM || status == SUNDER_OK);
    if (status != SUNDER_OK) assert_null(sum);
    sunder_sum_free(sum);
    return ok;
}

static void test_memory(void **state)
{
    attempt a = {shape_of("MULTIPOLYGON (((0 0, 6 0, 6 5, 1 4)), ((3 3, 8 3, 8 8)))"),
                 shape_of("POLYGON ((0 0, 1 0, 0 2))"), 0};
    for (a.operation = SUNDER_OPERATION_DILATE; a.operation <= SUNDER_OPERATION_CLOSE + 1; a.operation++)
        assert_true(failing_loop(try_it, &a, false));
    sunder_shape_free(a.p);
    sunder_shape_free(a.b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hall),
        cmocka_unit_test(test_key),
        cmocka_unit_test(test_room_and_corridor),
        cmocka_unit_test(test_rational),
        cmocka_unit_test(test_gap),
        cmocka_unit_test(test_places),
        cmocka_unit_test(test_union),
        cmocka_unit_test(test_vertices),
        cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_stopping),
        cmocka_unit_test(test_stopping_a_union),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests_name("morphology, call by call", tests, NULL, NULL);
}
