/* Operands of every kind, repaired by the even-odd rule: all kinds of arithmetic (plain numbers with filters; all
 * numbers in the pool) and all algorithms for the sum give the same bytes, sums commute, a translation by exact doubles
 * moves the result exactly, and least translations do not depend on the arithmetic, either. */
#include "generate.h"
#include "minkowski/minkowski.h"
#include "separation/least_translation.h"
#include "separation/separation.h"
#include "sum_text.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct pair {
    polyset set[2];
    sunder_shape *shape[2];
    uint64_t seed;
    size_t i;
} pair;

static sunder_shape *even_odd(const polyset *p)
{
    sunder_shape *s = NULL;
    sunder_error err;
    if (sunder_shape_from_rings(p->xy, p->ring_end, p->poly_end, p->polygons, SUNDER_VALIDITY_EVEN_ODD, &s, &err))
        fail_msg("%s", err.message);
    return s;
}

static void open_pair(pair *p, uint64_t seed, size_t i)
{
    rng r = rng_start(seed + 4711, i);
    *p = (pair){.seed = seed, .i = i};
    for (int k = 0; k < 2; k++) {
        polyset_init(&p->set[k]);
        const invalid_kind kind = (invalid_kind)(k ? (size_t)rng_int(&r, 0, INVALID_KINDS - 1) : i % INVALID_KINDS);
        if (k && rng_once_in(&r, 3))
            random_simple(&p->set[k], &r, (int)rng_int(&r, 3, 5), 5);
        else
            random_invalid(&p->set[k], &r, kind, k ? 8 : 14);
        p->shape[k] = even_odd(&p->set[k]);
    }
}

static void close_pair(pair *p)
{
    for (int k = 0; k < 2; k++) {
        sunder_shape_free(p->shape[k]);
        polyset_free(&p->set[k]);
    }
}

static void differ(const pair *p, const char *what)
{
    char *a = polyset_wkt(&p->set[0]), *b = polyset_wkt(&p->set[1]);
    print_message("%s\n%s\n", a, b);
    free(a);
    free(b);
    fail_msg("SUNDER_SEED=%llu, case %zu: %s", (unsigned long long)p->seed, p->i, what);
}

static char *sum_of(const sunder_shape *a, const sunder_shape *b, bool force_wide, const sunder_sum_options *options)
{
    sunder_sum *sum = NULL;
    assert_int_equal(sunder_i_minkowski_sum(a, b, force_wide, options, &sum, NULL), SUNDER_OK);
    char *text = sum_text(sum);
    sunder_sum_free(sum);
    return text;
}

static void expect_same(const pair *p, char *expected, char *got, const char *what)
{
    if (strcmp(expected, got) != 0) differ(p, what);
    free(got);
}

static void test_sums(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(140);
    for (size_t i = 0; i < n; i++) {
        pair p;
        open_pair(&p, seed, i);
        char *plain = sum_of(p.shape[0], p.shape[1], false, NULL);
        const sunder_sum_options road = {.size = sizeof road,
                                         .algorithm = (sunder_algorithm)(SUNDER_ALGORITHM_ARRANGEMENT + i % 3),
                                         .decomposition = (sunder_decomposition)(i % (SUNDER_DECOMPOSITION_MIXED + 1))};
        expect_same(&p, plain, sum_of(p.shape[0], p.shape[1], true, NULL), "the sum depends on the kind of numbers");
        expect_same(&p, plain, sum_of(p.shape[1], p.shape[0], false, NULL), "P + Q and Q + P differ");
        if (sunder_shape_vertices(p.shape[0]) < 40)
            expect_same(&p, plain, sum_of(p.shape[0], p.shape[1], false, &road), "the sum depends on the algorithm");
        free(plain);
        close_pair(&p);
    }
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
}

static void least_of(const pair *p, bool force_wide, sunder_separation *out)
{
    const sunder_i_least_options o = {.upper = INFINITY, .texts = true, .force_wide = force_wide};
    assert_int_equal(sunder_i_least(p->shape[0], p->shape[1], &o, out, NULL, NULL), SUNDER_OK);
}

static void test_least(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(200);
    for (size_t i = 0; i < n; i++) {
        pair p;
        sunder_separation a, b;
        open_pair(&p, seed + 1, i);
        if (!sunder_shape_is_empty(p.shape[0]) && !sunder_shape_is_empty(p.shape[1])) {
            least_of(&p, false, &a);
            least_of(&p, true, &b);
            if (strcmp(a.dx_text, b.dx_text) || strcmp(a.dy_text, b.dy_text) ||
                strcmp(a.distance_squared_text, b.distance_squared_text))
                differ(&p, "the translation depends on the kind of numbers");
            /* A bound is rounded down; short numbers may lose another ulp. */
            if (!(fabs(a.lower_bound - b.lower_bound) <= 0x1p-52 * b.lower_bound))
                differ(&p, "the bound depends on the kind of numbers");
            sunder_separation_clear(&a);
            sunder_separation_clear(&b);
        }
        close_pair(&p);
    }
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
}

/* Translated by a power of two and back, so that every coordinate stays exact unless it is far smaller. */
static void test_moves(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(200);
    for (size_t i = 0; i < n; i++) {
        pair p;
        open_pair(&p, seed + 2, i);
        sunder_shape *there = NULL, *back = NULL, *turned = NULL, *again = NULL;
        bool exact = false;
        assert_int_equal(sunder_shape_translate(p.shape[0], 4, -8, &there, &exact, NULL), SUNDER_OK);
        if (exact) {
            assert_int_equal(sunder_shape_translate(there, -4, 8, &back, &exact, NULL), SUNDER_OK);
            assert_int_equal(sunder_shape_reflect(p.shape[0], &turned, NULL), SUNDER_OK);
            assert_int_equal(sunder_shape_reflect(turned, &again, NULL), SUNDER_OK);
            if (sunder_shape_area(there) != sunder_shape_area(p.shape[0]) ||
                sunder_shape_area(turned) != sunder_shape_area(p.shape[0]))
                differ(&p, "the area changes after a translation or reflection");
            char *plain = sum_of(p.shape[0], p.shape[1], false, NULL);
            expect_same(&p, plain, sum_of(back, p.shape[1], false, NULL), "translating there and back changes the set");
            expect_same(&p, plain, sum_of(again, p.shape[1], false, NULL), "reflecting twice changes the set");
            free(plain);
        }
        sunder_shape_free(there);
        sunder_shape_free(back);
        sunder_shape_free(turned);
        sunder_shape_free(again);
        close_pair(&p);
    }
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_sums), cmocka_unit_test(test_least),
                                       cmocka_unit_test(test_moves)};
    return cmocka_run_group_tests_name("repaired operands of every kind", tests, NULL, NULL);
}
