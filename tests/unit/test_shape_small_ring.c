/* shape: a small ring that is sound as it was given has a way of its own. The same ring with a corner given twice goes
 * the general way: both give the same shape, pieces included, or refuse the ring for the same reason. */
#include "failing.h"
#include "random.h"
#include "shape/small_ring.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define CASES 20000
#define MOST 16

/* Rings round a middle, mostly sound, some as large as turns in 64 bits allow, or a little larger; or any corners on a
 * small grid, which may repeat, lie on one line, or cross. */
static void draw(rng *g, double xy[2 * MOST + 4], size_t *n)
{
    const int64_t size = rng_once_in(g, 2)   ? 4
                         : rng_once_in(g, 2) ? 30
                         : rng_once_in(g, 2) ? 100000
                                             : (int64_t)1 << rng_int(g, 28, 32);
    const double unit = ldexp(1, (int)rng_int(g, -40, 20)), far = rng_once_in(g, 2) ? 0 : unit * 0x1p40;
    const bool around = !rng_once_in(g, 4), back = rng_once_in(g, 2), fine = rng_once_in(g, 20);
    *n = (size_t)rng_int(g, 3, around ? MOST : 6);
    for (size_t i = 0; i < *n; i++) {
        const double angle = 6.283185307179586 * ((double)i + 0.8 * rng_unit(g)) / (double)*n;
        const double r = (double)rng_int(g, 1, size);
        double x = around ? rint(r * cos(angle)) : (double)rng_int(g, 0, 4);
        double y = around ? rint(r * sin(angle)) : (double)rng_int(g, 0, 4);
        if (fine) x += rng_unit(g);
        const size_t k = back ? *n - 1 - i : i;
        xy[2 * k] = x * unit + far;
        xy[2 * k + 1] = y * unit - far;
    }
}

static sunder_status build(const double *xy, size_t n, sunder_shape **out, sunder_error *err)
{
    const size_t one = 1;
    *out = NULL;
    return sunder_shape_from_rings(xy, &n, &one, 1, SUNDER_VALIDITY_STRICT, out, err);
}

static bool same(const sunder_shape *s, const sunder_shape *t)
{
    if (s->vertices != t->vertices || s->pieces != t->pieces || s->rings != t->rings || s->polygons != t->polygons ||
        s->low_bit != t->low_bit || s->touches != t->touches || s->repaired != t->repaired)
        return false;
    for (int k = 0; k < 4; k++) /* zeros may differ in sign: boxes begin with another corner */
        if (s->box[k] != t->box[k]) return false;
    const uint32_t corners = s->piece_end[s->pieces - 1];
    return memcmp(s->piece_end, t->piece_end, s->pieces * sizeof *s->piece_end) == 0 &&
           memcmp(s->piece_vertex, t->piece_vertex, corners * sizeof *s->piece_vertex) == 0 &&
           memcmp(s->xy, t->xy, 2 * s->vertices * sizeof *s->xy) == 0 &&
           memcmp(s->next, t->next, s->vertices * sizeof *s->next) == 0 &&
           memcmp(s->prev, t->prev, s->vertices * sizeof *s->prev) == 0 &&
           memcmp(s->shared, t->shared, s->vertices * sizeof *s->shared) == 0 && s->ring_end[0] == t->ring_end[0] &&
           s->poly_end[0] == t->poly_end[0];
}

/* Of a small way that refuses what it should not, the comparison would say nothing: it is counted. */
static void test_against_the_general_way(void **state)
{
    (void)state;
    size_t small = 0, many = 0, refused = 0;
    const size_t cases = test_count(CASES);
    for (uint64_t i = 0; i < cases; i++) {
        rng g = rng_start(test_seed(), i);
        double xy[2 * MOST + 4], twice[2 * MOST + 6];
        size_t n;
        draw(&g, xy, &n);
        if (rng_once_in(&g, 2)) { /* closed */
            memcpy(xy + 2 * n, xy, 2 * sizeof *xy);
            n++;
        }
        memcpy(twice, xy, 2 * sizeof *xy);
        memcpy(twice + 2, xy, 2 * n * sizeof *xy);
        sunder_shape *s, *t, *by_itself = NULL;
        sunder_error err = {0}, err_twice = {0};
        const sunder_status a = build(xy, n, &s, &err), b = build(twice, n + 1, &t, &err_twice);
        if (a != b)
            fail_msg("SUNDER_SEED=%llu, case %llu: %s", (unsigned long long)test_seed(), (unsigned long long)i,
                     err.message);
        const bool taken = sunder_i_small_ring(xy, n, &by_itself);
        if (taken) {
            assert_int_equal(a, SUNDER_OK);
            assert_non_null(by_itself);
            small++;
            many += by_itself->pieces > 1;
        }
        refused += a != SUNDER_OK;
        if (a == SUNDER_OK) {
            const char *fault = sunder_i_shape_check(s);
            if (fault || (taken && !same(s, t)))
                fail_msg("SUNDER_SEED=%llu, case %llu: %s", (unsigned long long)test_seed(), (unsigned long long)i,
                         fault ? fault : "not the shape of the general way");
            assert_memory_equal(s->raw_xy, xy, 2 * n * sizeof *xy);
        }
        sunder_shape_free(by_itself);
        sunder_shape_free(s);
        sunder_shape_free(t);
    }
    assert_true(small > cases / 4 && many > cases / 8);
    assert_true(cases < 100 || refused > 0);
}

/* What it leaves to others: corners that repeat, are straight or touch an edge, crossings, numbers too long. */
static void test_left_to_others(void **state)
{
    (void)state;
    sunder_shape *s;
    const double twice[] = {0, 0, 4, 0, 4, 0, 4, 4}, straight[] = {0, 0, 2, 0, 4, 0, 4, 4};
    const double spike[] = {0, 0, 4, 0, 2, 0, 2, 4}, bow[] = {0, 0, 4, 4, 4, 0, 0, 4};
    const double touch[] = {0, 0, 8, 0, 8, 8, 4, 0, 0, 8}, on_line[] = {0, 0, 4, 0, 4, 2, 2, 2, 6, 2, 6, 6, 0, 6};
    const double longer[] = {0, 0, 0x1p30, 0x1p-40, 0, 5}, nothing[] = {0, 0, 0, 0, 0, 0};
    assert_false(sunder_i_small_ring(twice, 4, &s));
    assert_false(sunder_i_small_ring(straight, 4, &s));
    assert_false(sunder_i_small_ring(spike, 4, &s));
    assert_false(sunder_i_small_ring(bow, 4, &s));
    assert_false(sunder_i_small_ring(touch, 5, &s));
    assert_false(sunder_i_small_ring(on_line, 7, &s));
    assert_false(sunder_i_small_ring(longer, 3, &s));
    assert_false(sunder_i_small_ring(nothing, 3, &s));
    assert_false(sunder_i_small_ring(twice, 2, &s));
    /* Edges on one line that are apart, as of a recess in a wall, are no trouble. */
    const double recess[] = {0, 0, 2, 0, 2, 1, 3, 1, 3, 0, 5, 0, 5, 4, 0, 4};
    assert_true(sunder_i_small_ring(recess, 8, &s));
    assert_int_equal(s->vertices, 8);
    sunder_shape_free(s);
}

static bool attempt(void *context)
{
    (void)context;
    const double el[] = {0, 0, 0, 4, 2, 4, 2, 2, 4, 2, 4, 0};
    sunder_error err;
    sunder_shape *s;
    const sunder_status status = build(el, 6, &s, &err);
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
                                       cmocka_unit_test(test_left_to_others), cmocka_unit_test(test_no_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
