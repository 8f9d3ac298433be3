/* shape: a small valid polygon has an algorithm of its own. The same polygon with a repeated corner uses the general
 * algorithm. Both give the same shape, pieces included, or refuse the polygon for the same reason. */
#include "failing.h"
#include "random.h"
#include "shape/small_polygon.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define CASES 30000
#define MOST 36 /* corners, including closing ones: more than a small polygon has */
#define MOST_RINGS 5

typedef struct drawn {
    double xy[2 * (MOST + MOST_RINGS + 8)];
    size_t n, rings, ring_end[MOST_RINGS];
} drawn;

/* A ring around a centre, mostly valid; or random corners on a small grid, which may repeat, be collinear, or cross. */
static void add_ring(rng *g, drawn *d, size_t n, bool around, double mid_x, double mid_y, int64_t size)
{
    const bool back = rng_once_in(g, 2);
    double *xy = d->xy + 2 * d->n;
    for (size_t i = 0; i < n; i++) {
        const double angle = 6.283185307179586 * ((double)i + 0.8 * rng_unit(g)) / (double)n;
        const double r = (double)rng_int(g, (size + 2) / 3, size);
        const size_t k = back ? n - 1 - i : i;
        xy[2 * k] = mid_x + (around ? rint(r * cos(angle)) : (double)rng_int(g, 0, 4));
        xy[2 * k + 1] = mid_y + (around ? rint(r * sin(angle)) : (double)rng_int(g, 0, 4));
    }
    if (rng_once_in(g, 2)) memcpy(xy + 2 * n++, xy, 2 * sizeof *xy); /* repeats the first vertex */
    d->n += n;
    d->ring_end[d->rings++] = d->n;
}

/* Some are as large as orientation tests in 64 bits allow, or slightly larger, or as large as native integers allow;
 * some have holes, which may be side by side, nested, outside, or touching. */
static void draw(rng *g, drawn *d)
{
    const int64_t size = rng_once_in(g, 2)   ? 4
                         : rng_once_in(g, 2) ? 30
                         : rng_once_in(g, 2) ? 100000
                                             : (int64_t)1 << rng_int(g, 28, rng_once_in(g, 2) ? 32 : 58);
    const double unit = ldexp(1, (int)rng_int(g, -40, 20)), far = rng_once_in(g, 2) ? 0 : unit * 0x1p40;
    const bool around = !rng_once_in(g, 4), fine = rng_once_in(g, 20);
    *d = (drawn){.n = 0};
    add_ring(g, d, (size_t)rng_int(g, 3, !around ? 6 : rng_once_in(g, 3) ? 33 : 16), around, 0, 0, size);
    for (size_t holes = rng_once_in(g, 2) ? (size_t)rng_int(g, 1, MOST_RINGS - 1) : 0; holes > 0 && d->n < 24;
         holes--) {
        const int64_t third = (size + 1) / 3;
        add_ring(g, d, (size_t)rng_int(g, 3, 5), true, (double)rng_int(g, -third, third),
                 (double)rng_int(g, -third, third), rng_once_in(g, 2) ? (size + 7) / 8 : third);
    }
    for (size_t i = 0; i < d->n; i++) {
        const double x = d->xy[2 * i] + (fine ? rng_unit(g) : 0);
        d->xy[2 * i] = x * unit + far;
        d->xy[2 * i + 1] = d->xy[2 * i + 1] * unit - far;
    }
}

static sunder_status build(const drawn *d, sunder_shape **out, sunder_error *err)
{
    *out = NULL;
    return sunder_shape_from_rings(d->xy, d->ring_end, &d->rings, 1, SUNDER_VALIDITY_STRICT, out, err);
}

static bool take(const drawn *d, sunder_shape **out)
{
    const sunder_i_input in = {d->xy, d->ring_end, &d->rings, 1, d->rings, d->n};
    *out = NULL;
    return sunder_i_small_polygon(&in, out);
}

static drawn one_ring(const double *xy, size_t n)
{
    drawn d = {.n = n, .rings = 1, .ring_end = {n}};
    memcpy(d.xy, xy, 2 * n * sizeof *xy);
    return d;
}

static bool same(const sunder_shape *s, const sunder_shape *t)
{
    if (s->vertices != t->vertices || s->pieces != t->pieces || s->form->cleaned.rings != t->form->cleaned.rings ||
        s->form->cleaned.polygons != t->form->cleaned.polygons || s->low_bit != t->low_bit ||
        s->touches != t->touches || s->repaired != t->repaired)
        return false;
    for (int k = 0; k < 4; k++) /* zeros may differ in sign, since boxes begin with another corner */
        if (s->box[k] != t->box[k]) return false;
    const uint32_t corners = s->piece_end[s->pieces - 1];
    return memcmp(s->piece_end, t->piece_end, s->pieces * sizeof *s->piece_end) == 0 &&
           memcmp(sunder_i_piece_vertices(s), sunder_i_piece_vertices(t),
                  corners * sizeof *sunder_i_piece_vertices(s)) == 0 &&
           memcmp(s->xy, t->xy, 2 * s->vertices * sizeof *s->xy) == 0 &&
           memcmp(s->form->cleaned.next, t->form->cleaned.next, s->vertices * sizeof *s->form->cleaned.next) == 0 &&
           memcmp(s->form->cleaned.prev, t->form->cleaned.prev, s->vertices * sizeof *s->form->cleaned.prev) == 0 &&
           memcmp(s->form->cleaned.shared, t->form->cleaned.shared, s->vertices * sizeof *s->form->cleaned.shared) ==
               0 &&
           memcmp(s->form->cleaned.ring_end, t->form->cleaned.ring_end,
                  s->form->cleaned.rings * sizeof *s->form->cleaned.ring_end) == 0 &&
           s->form->cleaned.poly_end[0] == t->form->cleaned.poly_end[0];
}

/* Counts the polygons that the special algorithm accepts; if it refused all of them, the comparison could not fail. */
static void test_against_the_general_way(void **state)
{
    (void)state;
    size_t small = 0, many = 0, holed = 0, long_ones = 0, refused = 0;
    const size_t cases = test_count(CASES);
    for (uint64_t i = 0; i < cases; i++) {
        rng g = rng_start(test_seed(), i);
        drawn d, twice;
        draw(&g, &d);
        twice = d;
        memcpy(twice.xy + 2, d.xy, 2 * d.n * sizeof *d.xy);
        twice.n++;
        for (size_t k = 0; k < twice.rings; k++) twice.ring_end[k]++;
        sunder_shape *s, *t, *by_itself;
        sunder_error err = {0}, err_twice = {0};
        const sunder_status a = build(&d, &s, &err), b = build(&twice, &t, &err_twice);
        if (a != b)
            fail_msg("SUNDER_SEED=%llu, case %llu: %s", (unsigned long long)test_seed(), (unsigned long long)i,
                     err.message);
        const bool taken = take(&d, &by_itself);
        if (taken) {
            assert_int_equal(a, SUNDER_OK);
            assert_non_null(by_itself);
            small++;
            many += by_itself->pieces > 1;
            holed += by_itself->form->cleaned.rings > 1;
            long_ones += by_itself->vertices > 16;
        }
        refused += a != SUNDER_OK;
        if (a == SUNDER_OK) {
            const char *fault = sunder_i_shape_check(s);
            if (fault || (taken && !same(s, t)))
                fail_msg("SUNDER_SEED=%llu, case %llu: %s", (unsigned long long)test_seed(), (unsigned long long)i,
                         fault ? fault : "the shape differs from that of the general algorithm");
            assert_memory_equal(s->raw_xy, d.xy, 2 * d.n * sizeof *d.xy);
        }
        sunder_shape_free(by_itself);
        sunder_shape_free(s);
        sunder_shape_free(t);
    }
    print_message("%zu of %zu small, %zu of several pieces, %zu with holes, %zu of many corners, %zu refused\n", small,
                  cases, many, holed, long_ones, refused);
    assert_true(small > cases / 4 && many > cases / 8 && holed > cases / 40 && long_ones > cases / 80);
    assert_true(cases < 100 || refused > 0);
}

static bool take_ring(const double *xy, size_t n, sunder_shape **out)
{
    const drawn d = one_ring(xy, n);
    return take(&d, out);
}

/* What it refuses: corners that repeat, are straight or touch an edge, crossings, numbers that are too long. */
static void test_left_to_others(void **state)
{
    (void)state;
    sunder_shape *s;
    const double twice[] = {0, 0, 4, 0, 4, 0, 4, 4}, straight[] = {0, 0, 2, 0, 4, 0, 4, 4};
    const double spike[] = {0, 0, 4, 0, 2, 0, 2, 4}, bow[] = {0, 0, 4, 4, 4, 0, 0, 4};
    const double touch[] = {0, 0, 8, 0, 8, 8, 4, 0, 0, 8}, on_line[] = {0, 0, 4, 0, 4, 2, 2, 2, 6, 2, 6, 6, 0, 6};
    const double longer[] = {0, 0, 0x1p30, 0x1p-40, 0, 5}, nothing[] = {0, 0, 0, 0, 0, 0};
    assert_false(take_ring(twice, 4, &s));
    assert_false(take_ring(straight, 4, &s));
    assert_false(take_ring(spike, 4, &s));
    assert_false(take_ring(bow, 4, &s));
    assert_false(take_ring(touch, 5, &s));
    assert_false(take_ring(on_line, 7, &s));
    assert_false(take_ring(longer, 3, &s));
    assert_false(take_ring(nothing, 3, &s));
    assert_false(take_ring(twice, 2, &s));
    /* Separate edges on one line, as at a recess in a wall, are accepted. */
    const double recess[] = {0, 0, 2, 0, 2, 1, 3, 1, 3, 0, 5, 0, 5, 4, 0, 4};
    assert_true(take_ring(recess, 8, &s));
    assert_int_equal(s->vertices, 8);
    sunder_shape_free(s);
}

/* Nested holes, holes outside, holes that touch; and too many holes. */
static void test_holes(void **state)
{
    (void)state;
    sunder_shape *s;
    drawn d = {.n = 8, .rings = 2, .ring_end = {4, 8}};
    const double outer[] = {0, 0, 9, 0, 9, 9, 0, 9};
    const double hole[][8] = {{2, 2, 4, 2, 4, 4, 2, 4},         {12, 2, 14, 2, 14, 4, 12, 4},
                              {0, 2, 4, 2, 4, 4, 2, 4},         {4, 4, 6, 4, 6, 6, 4, 6},
                              {3, 3, 3, 2.5, 2.5, 2.5, 2.5, 3}, {-1, -1, 10, -1, 10, 10, -1, 10}};
    memcpy(d.xy, outer, sizeof outer);
    memcpy(d.xy + 8, hole[0], sizeof hole[0]);
    assert_true(take(&d, &s)); /* both rings have the same orientation in the input */
    assert_int_equal(s->form->cleaned.rings, 2);
    assert_null(sunder_i_shape_check(s));
    sunder_shape_free(s);
    for (int k = 1; k < 6; k += k == 2 ? 3 : 1) { /* outside, on the wall, around the outer ring */
        memcpy(d.xy + 8, hole[k], sizeof hole[k]);
        assert_false(take(&d, &s));
    }
    d = (drawn){.n = 12, .rings = 3, .ring_end = {4, 8, 12}};
    memcpy(d.xy, outer, sizeof outer);
    memcpy(d.xy + 8, hole[0], sizeof hole[0]);
    for (int k = 3; k < 5; k++) { /* corner to corner, one within the other */
        memcpy(d.xy + 16, hole[k], sizeof hole[k]);
        assert_false(take(&d, &s));
    }
}

static bool attempt(void *context)
{
    (void)context;
    const double el[] = {0, 0, 0, 4, 2, 4, 2, 2, 4, 2, 4, 0};
    const drawn d = one_ring(el, 6);
    sunder_error err;
    sunder_shape *s;
    const sunder_status status = build(&d, &s, &err);
    assert_true(status == SUNDER_OK || status == SUNDER_ENOMEM);
    sunder_shape_free(s);
    return status == SUNDER_OK;
}

static void test_no_memory(void **state)
{
    (void)state;
    assert_true(failing_loop(attempt, NULL, false));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_against_the_general_way),
                                       cmocka_unit_test(test_left_to_others), cmocka_unit_test(test_holes),
                                       cmocka_unit_test(test_no_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
