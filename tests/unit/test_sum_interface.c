/* sunder_minkowski_sum() beside its answers: empty operands, the same operand twice, stopping, memory that runs out at
 * every allocation, numbers beyond the range of doubles. */
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
    polyset set;
    assert_true(polyset_read_wkt(&set, wkt, NULL));
    sunder_shape *shape = polyset_shape(&set);
    assert_non_null(shape);
    polyset_free(&set);
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
        assert_int_equal(sunder_minkowski_sum(k == 1 ? square : empty, k == 0 ? square : empty, NULL, &sum, NULL), SUNDER_OK);
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
    sunder_shape *p = shape_of("POLYGON((0 0,4 0,4 1,1 1,1 3,4 3,4 4,0 4,0 0))"), *q = shape_of("POLYGON((0 0,4 0,4 1,1 1,1 3,4 3,4 4,0 4,0 0))");
    sunder_sum *once = NULL, *twice = NULL;
    assert_int_equal(sunder_minkowski_sum(p, p, NULL, &once, NULL), SUNDER_OK);
    assert_int_equal(sunder_minkowski_sum(p, q, NULL, &twice, NULL), SUNDER_OK);
    char *a = sum_text(once), *b = sum_text(twice);
    assert_string_equal(a, b);
    sunder_operations n;
    double decompose = -1, subsums = -1, unite = -1;
    sunder_sum_operations(once, &n);
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
    sunder_sum_options options = {watching, &w};
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
    sunder_status status = sunder_shape_from_rings(s->xy, s->ring_end, s->poly_end, s->polygons, SUNDER_STRICT, &p, &err);
    if (!status) status = sunder_shape_from_rings(t->xy, t->ring_end, t->poly_end, t->polygons, SUNDER_STRICT, &q, &err);
    if (!status) status = sunder_minkowski_sum(p, q, NULL, &sum, &err);
    if (!status) status = sunder_sum_area_text(sum, &area, &err);
    if (!status) status = sunder_sum_vertex_text(sum, 0, &x, &y, &err);
    if (status && (status != SUNDER_ENOMEM || err.status != SUNDER_ENOMEM)) print_message("status %d\n", (int)status);
    /* Outputs of a failed call are untouched, so everything here is either made or NULL. */
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
            print_message("kind %s, SUNDER_SEED=%llu\n%s\n%s\n", pair_kind_string(kinds[k]), (unsigned long long)seed, p, q);
            free(p);
            free(q);
            fail();
        }
        polyset_free(&c.p);
        polyset_free(&c.q);
    }
}

/* The exact sum is beyond all doubles: the texts are right, the doubles infinite. */
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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_empty), cmocka_unit_test(test_same_operand),
                                       cmocka_unit_test(test_progress), cmocka_unit_test(test_out_of_memory),
                                       cmocka_unit_test(test_beyond_doubles)};
    return cmocka_run_group_tests_name("the interface of sums", tests, NULL, NULL);
}
