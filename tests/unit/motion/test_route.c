/* Routes through the public interface: arguments, reasons, exact results, coordinates of any size, all kinds of
 * numbers, and memory that runs out anywhere. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "failing.h"
#include "random.h"
#include "sunder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A ring of `n` corners as a shape. */
static sunder_shape *shape_of(const double *xy, size_t n)
{
    const size_t poly_end = 1;
    sunder_shape *s = NULL;
    assert_int_equal(sunder_shape_from_rings(xy, &n, &poly_end, 1, SUNDER_VALIDITY_STRICT, &s, NULL), SUNDER_OK);
    return s;
}

static const double wall[] = {2, -9, 4, -9, 4, 3, 2, 3}, robot[] = {-1, -1, 1, -1, 1, 1, -1, 1};

static sunder_place at(double x, double y) { return (sunder_place){{x, y}, {NULL, NULL}}; }

static void expect_path(const sunder_route *r, const char *text)
{
    char path[1024] = "";
    for (size_t i = 0; i < sunder_route_vertices(r); i++) {
        const char *x, *y;
        sunder_route_vertex_text(r, i, &x, &y);
        snprintf(path + strlen(path), sizeof path - strlen(path), "%s%s %s", i ? ", " : "", x, y);
    }
    assert_string_equal(path, text);
}

static sunder_route *find(const sunder_obstacle *o, size_t n, const sunder_shape *r, sunder_place from, sunder_place to)
{
    sunder_route *route = NULL;
    sunder_error err;
    const sunder_status status = sunder_route_find(o, n, r, &from, &to, NULL, &route, &err);
    if (status != SUNDER_OK) print_message("%s\n", err.message);
    assert_int_equal(status, SUNDER_OK);
    return route;
}

static void round_a_wall(void **state)
{
    sunder_shape *p = shape_of(wall, 4), *q = shape_of(robot, 4);
    const sunder_obstacle o = {p, NULL, NULL, 0};
    sunder_route *r = find(&o, 1, q, at(0, 0), at(6, 0));
    size_t obstacle;
    assert_int_equal(sunder_route_reason(r, &obstacle), SUNDER_ROUTE_FOUND);
    assert_true(obstacle == SIZE_MAX && sunder_route_rounded_is_free(r));
    expect_path(r, "0 0, 1 4, 5 4, 6 0");
    assert_true(sunder_route_length(r) == 4 + 2 * sqrt(17));
    double xy[2];
    sunder_route_vertex(r, 2, xy);
    assert_true(xy[0] == 5 && xy[1] == 4);
    sunder_route_free(r);
    sunder_shape_free(p);
    sunder_shape_free(q);
}

/* The obstacles of the configuration space are the Minkowski sum of the obstacles and the robot turned by half a
 * turn. */
static void obstacles_are_a_sum(void **state)
{
    static const double bent[] = {0, 0, 9, 0, 9, 2, 2, 2, 2, 6, 9, 6, 9, 8, 0, 8},
                        key[] = {0, 0, 5, 0, 5, 4, 3, 4, 3, 1, 0, 1};
    sunder_shape *p = shape_of(bent, 8), *q = shape_of(key, 6), *minus;
    const sunder_obstacle o = {p, NULL, NULL, 0};
    sunder_sum *sum;
    assert_int_equal(sunder_shape_reflect(q, &minus, NULL), SUNDER_OK);
    assert_int_equal(sunder_minkowski_sum(p, minus, NULL, &sum, NULL), SUNDER_OK);
    sunder_route *r = find(&o, 1, q, at(-20, 0), at(20, 1));
    const sunder_sum *united = sunder_route_obstacles(r);
    sunder_sum_size a, b;
    sunder_sum_get_size(sum, &a);
    sunder_sum_get_size(united, &b);
    assert_memory_equal(&a, &b, sizeof a);
    assert_true(a.degenerate_segments == 1); /* its hook fits the slot exactly */
    for (size_t p_i = 0; p_i < a.polygons; p_i++)
        for (size_t k = 0; k < sunder_sum_rings(sum, p_i); k++) {
            size_t m, n;
            const uint32_t *u = sunder_sum_ring(sum, p_i, k, &m), *v = sunder_sum_ring(united, p_i, k, &n);
            assert_true(m == n);
            for (size_t i = 0; i < n; i++) {
                double x[2], y[2];
                sunder_sum_vertex(sum, u[i], x);
                sunder_sum_vertex(united, v[i], y);
                assert_memory_equal(x, y, sizeof x);
            }
        }
    sunder_route_free(r);
    sunder_sum_free(sum);
    sunder_shape_free(p);
    sunder_shape_free(q);
    sunder_shape_free(minus);
}

/* A tie between above and below, for coordinates that need big integers: fractions with long numerators and
 * denominators. */
static void every_rung(void **state)
{
    static const double scale[] = {1, 0x1p-300, 0x1p300, 1e-9};
    for (size_t i = 0; i < sizeof scale / sizeof *scale; i++) {
        const double s = scale[i];
        double small[8], far[2] = {1e9, 1e-7}; /* a point far away, with many digits */
        for (int k = 0; k < 8; k++) small[k] = s * robot[k];
        const size_t end = 1;
        sunder_shape *q = shape_of(small, 4);
        const sunder_obstacle o[] = {{q, NULL, NULL, 0}, {NULL, far, &end, 1}};
        sunder_route *r = find(o, s == 1 ? 2 : 1, q, at(-5 * s, 0), at(5 * s, 0));
        double xy[2];
        assert_true(sunder_route_vertices(r) == 4);
        sunder_route_vertex(r, 1, xy);
        assert_true(xy[0] == -2 * s && xy[1] == -2 * s);
        assert_true(fabs(sunder_route_length(r) / s - (4 + 2 * sqrt(13))) < 1e-14);
        sunder_route_free(r);
        sunder_shape_free(q);
    }
    sunder_shape *q = shape_of(robot, 4);
    const sunder_obstacle o = {q, NULL, NULL, 0};
    /* A coordinate of 1/3, and one that is outside the obstacle by less than doubles can distinguish. */
    const sunder_place from = {
        {0, 0}, {"-200000000000000000000000000000000000000001/100000000000000000000000000000000000000000", "1/3"}};
    const sunder_place inside = {
        {0, 0}, {"-199999999999999999999999999999999999999999/100000000000000000000000000000000000000000", "+1/-3"}};
    sunder_route *r = find(&o, 1, q, from, at(-9, 3));
    const char *x, *y;
    assert_true(sunder_route_vertices(r) == 2);
    sunder_route_vertex_text(r, 0, &x, &y);
    assert_string_equal(x, from.text[0]);
    assert_string_equal(y, "1/3");
    sunder_route_free(r);
    r = find(&o, 1, q, at(-9, 3), inside);
    size_t obstacle;
    assert_int_equal(sunder_route_reason(r, &obstacle), SUNDER_ROUTE_GOAL_COLLIDES);
    assert_true(obstacle == 0 && sunder_route_vertices(r) == 0 && sunder_route_length(r) == 0);
    sunder_route_free(r);
    sunder_shape_free(q);
}

/* The lengths of the path above and the path below differ by less than a double can represent: differences down to
 * 2^-256 of the length are distinguished, smaller ones count as equal. */
static void nearly_tied(void **state)
{
    static const struct {
        unsigned digits;
        bool above, told;
    } cases[] = {{40, true, true}, {40, false, true}, {70, true, true}, {70, false, true}, {120, true, false}};
    sunder_shape *q = shape_of(robot, 4);
    const sunder_obstacle o = {q, NULL, NULL, 0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char y[200];
        snprintf(y, sizeof y, "%s1/1%0*d", cases[i].above ? "" : "-", (int)cases[i].digits, 0);
        const sunder_place from = {{-5, 0}, {NULL, y}};
        sunder_route *r = find(&o, 1, q, from, at(5, 0));
        double xy[2];
        assert_true(sunder_route_vertices(r) == 4);
        sunder_route_vertex(r, 1, xy);
        assert_true(xy[0] == -2 && xy[1] == (cases[i].above && cases[i].told ? 2 : -2));
        sunder_route_free(r);
    }
    sunder_shape_free(q);
}

/* A repaired shape has rational corners, and the lattice a denominator. */
static void rational_obstacles(void **state)
{
    static const double bow[] = {0, 0, 7, 5, 7, 0, 0, 3}; /* crosses itself */
    const size_t end = 4, one = 1;
    sunder_shape *p, *q = shape_of(robot, 4);
    assert_int_equal(sunder_shape_from_rings(bow, &end, &one, 1, SUNDER_VALIDITY_EVEN_ODD, &p, NULL), SUNDER_OK);
    assert_true(sunder_shape_repaired(p));
    const sunder_obstacle o = {p, NULL, NULL, 0};
    sunder_route *r = find(&o, 1, q, at(-3, 2), at(10, 2));
    assert_true(sunder_route_vertices(r) > 2 && sunder_route_length(r) > 13);
    sunder_route_free(r);
    /* At the crossing, where the obstacle has no width, a robot still collides. */
    r = find(&o, 1, q, at(2.625, 1.875), at(10, 2));
    assert_int_equal(sunder_route_reason(r, NULL), SUNDER_ROUTE_START_COLLIDES);
    sunder_route_free(r);
    sunder_shape_free(p);
    sunder_shape_free(q);
}

/* A point or a line on a diagonal between the robot's pieces, or on the common wall of two members, counts as
 * inside. */
static void lines_inside_the_robot(void **state)
{
    static const double ell[] = {0, 0, 4, 0, 4, 2, 2, 2, 2, 4, 0, 4}, dart[] = {0, 0, 8, 2, 0, 4, 2, 2};
    /* crosses itself, so that it has rational corners */
    static const double bow[] = {0, 0, 8, 0, 1, 5, 8, 7, 0, 7, 5, 2};
    static const double two[] = {0, 0, 2, 0, 2, 4, 0, 4, 2, 0, 4, 0, 4, 4, 2, 4};
    static const double inside[][2] = {{1, 1}, {4, 2}, {3, 1}, {2, 3}};
    static const size_t rings[][2] = {{6, 0}, {4, 0}, {6, 0}, {4, 8}}, polygons[][2] = {{1, 0}, {1, 0}, {1, 0}, {1, 2}};
    const double *const xy[] = {ell, dart, bow, two};
    const double scale[] = {1, 0x1p-1060, 0x1p1000};
    for (size_t i = 0; i < 4; i++)
        for (size_t k = 0; k < 3; k++) {
            double scaled[16], line[4] = {0, 0, scale[k] / 64 * inside[i][0], scale[k] / 64 * inside[i][1]};
            const size_t corners = i == 3 ? 8 : rings[i][0], n = i == 3 ? 2 : 1;
            for (size_t j = 0; j < 2 * corners; j++) scaled[j] = scale[k] * xy[i][j];
            sunder_shape *q;
            assert_int_equal(
                sunder_shape_from_rings(scaled, rings[i], polygons[i], n, SUNDER_VALIDITY_EVEN_ODD, &q, NULL),
                SUNDER_OK);
            for (size_t end = 1; end <= 2; end++) {
                const sunder_obstacle o = {NULL, line, &end, 1};
                const sunder_place in = at(-scale[k] * inside[i][0], -scale[k] * inside[i][1]);
                sunder_route *r = find(&o, 1, q, in, at(-20 * scale[k], 0));
                assert_int_equal(sunder_route_reason(r, NULL), SUNDER_ROUTE_START_COLLIDES);
                sunder_route_free(r);
            }
            sunder_shape_free(q);
        }
}

/* Writes all corners of a route as texts, "-" if there is none. */
static void tell(const sunder_route *r, char *out, size_t size)
{
    size_t n = (size_t)snprintf(out, size, "%s", sunder_route_vertices(r) ? "" : "-");
    for (size_t i = 0; i < sunder_route_vertices(r); i++) {
        const char *x, *y;
        sunder_route_vertex_text(r, i, &x, &y);
        n += (size_t)snprintf(out + n, size - n, "%s %s, ", x, y);
        assert_true(n < size);
    }
}

/* Obstacles on a small grid, and one so far away that doubles merge some or all of the others into one place: it
 * changes no route, and routes back have the same length. */
static void near_ones_beside_a_far_one(void **state)
{
    rng g = rng_start(test_seed(), 5);
    size_t found = 0;
    for (size_t round = 0; round < test_count(150); round++) {
        sunder_obstacle o[17];
        const size_t n = (size_t)rng_int(&g, 6, 16);
        for (size_t k = 0; k < n; k++) {
            const double x = (double)rng_int(&g, 0, 14), y = (double)rng_int(&g, 0, 14), w = (double)rng_int(&g, 1, 5),
                         h = (double)rng_int(&g, 1, 5);
            o[k] = (sunder_obstacle){
                shape_of((double[]){x, y, x + w, y, x + w, y + h, x + (double)rng_int(&g, 0, 1), y + h}, 4), NULL, NULL,
                0};
        }
        const double far = ldexp(rng_once_in(&g, 2) ? 1 : -1, (int)rng_int(&g, 30, 400)), size = fabs(far) / 16;
        o[n] = (sunder_obstacle){shape_of((double[]){far, far, far + size, far, far, far + size}, 3), NULL, NULL, 0};
        sunder_shape *q = shape_of((double[]){0, 0, 1, 0, 0, 1}, 3);
        const sunder_place from = at((double)rng_int(&g, -3, 18), (double)rng_int(&g, -3, 18)),
                           to = at((double)rng_int(&g, -3, 18), (double)rng_int(&g, -3, 18));
        sunder_route *alone = find(o, n, q, from, to), *there = find(o, n + 1, q, from, to),
                     *back = find(o, n + 1, q, to, from);
        char text[2][2048];
        tell(alone, text[0], sizeof text[0]);
        tell(there, text[1], sizeof text[1]);
        assert_string_equal(text[0], text[1]);
        assert_int_equal(sunder_route_vertices(back) > 0, sunder_route_vertices(there) > 0);
        if (sunder_route_vertices(there) > 2) found++;
        if (sunder_route_vertices(there)) {
            assert_true(sunder_route_length(alone) == sunder_route_length(there));
            assert_true(sunder_route_length(back) == sunder_route_length(there));
        }
        sunder_route_free(alone);
        sunder_route_free(there);
        sunder_route_free(back);
        for (size_t k = 0; k <= n; k++) sunder_shape_free((sunder_shape *)(uintptr_t)o[k].shape);
        sunder_shape_free(q);
    }
    assert_true(found > 10);
}

static void arguments(void **state)
{
    sunder_shape *q = shape_of(robot, 4), *none;
    sunder_route *r = NULL;
    sunder_error err;
    const sunder_place good = at(0, 0);
    const sunder_place bad[] = {at(NAN, 0),           at(0, INFINITY),         {{0, 0}, {"1/0", NULL}},
                                {{0, 0}, {"", NULL}}, {{0, 0}, {NULL, "1.5"}}, {{0, 0}, {"1/", NULL}},
                                {{0, 0}, {"-", NULL}}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(sunder_route_find(NULL, 0, q, &bad[i], &good, NULL, &r, &err), SUNDER_EARG);
        assert_int_equal(sunder_route_find(NULL, 0, q, &good, &bad[i], NULL, &r, &err), SUNDER_EARG);
    }
    const double gaps[] = {-1, NAN, INFINITY};
    for (size_t i = 0; i < 3; i++) {
        const sunder_route_options options = {.size = sizeof options, .gap = gaps[i]};
        assert_int_equal(sunder_route_find(NULL, 0, q, &good, &good, &options, &r, &err), SUNDER_EARG);
    }
    assert_int_equal(sunder_shape_from_rings(NULL, NULL, NULL, 0, SUNDER_VALIDITY_STRICT, &none, NULL), SUNDER_OK);
    assert_int_equal(sunder_route_find(NULL, 0, none, &good, &good, NULL, &r, &err), SUNDER_EARG);
    const double line[] = {0, 0, NAN, 1};
    const size_t end = 2;
    const sunder_obstacle o = {NULL, line, &end, 1};
    assert_int_equal(sunder_route_find(&o, 1, q, &good, &good, NULL, &r, &err), SUNDER_EINVALID);
    char large[400];
    memset(large, '9', sizeof large - 1);
    large[sizeof large - 1] = '\0';
    const sunder_place away = {{0, 0}, {large, NULL}};
    assert_int_equal(sunder_route_find(NULL, 0, q, &good, &away, NULL, &r, &err), SUNDER_ERANGE);
    assert_null(r);
    r = find(NULL, 0, q, at(1, 2), at(4, 6));
    assert_true(sunder_route_length(r) == 5);
    sunder_route_free(r);
    sunder_route_free(NULL);
    assert_string_equal(sunder_route_status_string(SUNDER_ROUTE_FOUND), "found");
    assert_string_equal(sunder_route_status_string(SUNDER_ROUTE_START_COLLIDES), "start_in_collision");
    assert_string_equal(sunder_route_status_string(SUNDER_ROUTE_GOAL_COLLIDES), "goal_in_collision");
    assert_string_equal(sunder_route_status_string(SUNDER_ROUTE_DISCONNECTED), "disconnected");
    sunder_shape_free(q);
    sunder_shape_free(none);
}

static bool refuse(double fraction, void *user)
{
    (void)fraction;
    ++*(int *)user;
    return false;
}

/* There are enough corners for the progress function to be called. */
static void stops(void **state)
{
    double xy[2 * 4000];
    size_t end[2000];
    uint32_t seed = 1;
    for (size_t i = 0; i < 2000; i++) {
        for (int k = 0; k < 2; k++) xy[2 * i + (size_t)k] = (double)((seed = seed * 1664525u + 1013904223u) >> 24) * 2;
        end[i] = i + 1;
    }
    sunder_shape *q = shape_of(robot, 4);
    const sunder_obstacle o = {NULL, xy, end, 2000};
    int calls = 0;
    const sunder_route_options options = {.size = sizeof options, .progress = refuse, .progress_user = &calls};
    const sunder_place from = at(-9, -9), to = at(600, 600);
    sunder_route *r = NULL;
    assert_int_equal(sunder_route_find(&o, 1, q, &from, &to, &options, &r, NULL), SUNDER_ECANCEL);
    assert_true(r == NULL && calls > 0);
    sunder_shape_free(q);
}

typedef struct attempt {
    sunder_obstacle o[2];
    const sunder_shape *robot;
    double gap;
} attempt;

static bool try_route(void *context)
{
    const attempt *a = context;
    const sunder_place from = at(0, 0), to = {{6, 0}, {NULL, "1/7"}};
    const sunder_route_options options = {.size = sizeof options, .gap = a->gap};
    sunder_route *r = NULL;
    const sunder_status status = sunder_route_find(a->o, 2, a->robot, &from, &to, &options, &r, NULL);
    assert_true(status == SUNDER_OK || status == SUNDER_ENOMEM);
    assert_true((status == SUNDER_OK) == (r != NULL));
    if (r) assert_int_equal(sunder_route_reason(r, NULL), SUNDER_ROUTE_FOUND);
    sunder_route_free(r);
    return status == SUNDER_OK;
}

static void memory_runs_out(void **state)
{
    static const double line[] = {2, 5, 4, 5, 4, 9, 3, 12}, fine[] = {2, 5, 0x1p-900, 5, 4, 9, 3, 12};
    const size_t end[] = {3, 4};
    sunder_shape *p = shape_of(wall, 4), *q = shape_of(robot, 4);
    attempt a = {{{p, NULL, NULL, 0}, {NULL, line, end, 2}}, q, 0};
    assert_true(failing_loop(try_route, &a, false));
    a.gap = 0.25;
    assert_true(failing_loop(try_route, &a, false));
    a.gap = 0;
    a.o[1].xy = fine; /* so fine that the lattice needs big integers */
    assert_true(failing_loop(try_route, &a, false));
    /* Components with holes of their own. */
    static const double fences[] = {20, 0, 29, 0, 29, 9, 20, 9, 20, 0, 40, 0, 49, 0, 49, 9, 40, 9, 40, 0};
    const size_t fence_end[] = {5, 10};
    a.o[1] = (sunder_obstacle){NULL, fences, fence_end, 2};
    assert_true(failing_loop(try_route, &a, false));
    /* Two members that touch, one of them not convex, together with lines and points. */
    static const double members[] = {-1, -1, 0, -1, 0, 1, -1, 1, 0, -1, 1, -1, 0.5, 0, 1, 1, 0, 1};
    const size_t rings[] = {4, 9}, polygons[] = {1, 2};
    sunder_shape *m;
    assert_int_equal(sunder_shape_from_rings(members, rings, polygons, 2, SUNDER_VALIDITY_STRICT, &m, NULL), SUNDER_OK);
    a.robot = m;
    a.o[1] = (sunder_obstacle){NULL, line, end, 2};
    assert_true(failing_loop(try_route, &a, false));
    sunder_shape_free(m);
    sunder_shape_free(p);
    sunder_shape_free(q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(round_a_wall),
        cmocka_unit_test(obstacles_are_a_sum),
        cmocka_unit_test(every_rung),
        cmocka_unit_test(nearly_tied),
        cmocka_unit_test(rational_obstacles),
        cmocka_unit_test(lines_inside_the_robot),
        cmocka_unit_test(near_ones_beside_a_far_one),
        cmocka_unit_test(arguments),
        cmocka_unit_test(stops),
        cmocka_unit_test(memory_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
