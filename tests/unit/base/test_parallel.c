/* Work on several threads: each item is processed once, on at most the given number of threads, also if an item starts
 * parallel work itself. The largest items begin first, and the first failure is reported. */
#include "base/parallel.h"

#include "sunder.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

enum { ITEMS = 40, INNER = 64 };

typedef struct tally {
    atomic_int done[ITEMS], inner[ITEMS];
    atomic_int running, most; /* threads at work now; the most at any time */
    unsigned threads;
    size_t order[ITEMS]; /* items in the order in which they began */
    atomic_size_t begun;
} tally;

static void wait_a_little(void)
{
    const struct timespec some = {0, 200000};
    nanosleep(&some, NULL);
}

static void enter(tally *t)
{
    const int now = atomic_fetch_add(&t->running, 1) + 1;
    int most = atomic_load(&t->most);
    while (now > most && !atomic_compare_exchange_weak(&t->most, &most, now)) continue;
}

static sunder_status count_inner(void *context, size_t begin, size_t end, sunder_error *err)
{
    (void)err;
    tally *t = context;
    enter(t);
    wait_a_little();
    atomic_fetch_add(&t->inner[0], (int)(end - begin));
    atomic_fetch_sub(&t->running, 1);
    return SUNDER_OK;
}

/* The first item takes as long as all others together, and asks for more threads. */
static sunder_status count(void *context, size_t begin, size_t end, sunder_error *err)
{
    tally *t = context;
    for (size_t k = begin; k < end; k++) {
        t->order[atomic_fetch_add(&t->begun, 1)] = k;
        atomic_fetch_add(&t->done[k], 1);
        if (k == 0) {
            assert_int_equal(sunder_i_parallel(t->threads, INNER, 2, count_inner, t, err), SUNDER_OK);
            continue;
        }
        enter(t);
        wait_a_little();
        atomic_fetch_sub(&t->running, 1);
    }
    return SUNDER_OK;
}

static void demand_all(const tally *t, unsigned threads)
{
    for (size_t k = 0; k < ITEMS; k++) assert_int_equal(t->done[k], 1);
    assert_int_equal(t->inner[0], INNER);
    assert_true(t->most <= (int)threads);
}

static void test_all_is_done_within_threads(void **state)
{
    (void)state;
    static tally t;
    size_t size[ITEMS];
    sunder_error err;
    for (size_t k = 0; k < ITEMS; k++) size[k] = ITEMS - k;
    for (unsigned threads = 1; threads <= 5; threads++)
        for (int sized = 0; sized < 2; sized++) {
            memset(&t, 0, sizeof t);
            t.threads = threads;
            const sunder_status status = sized ? sunder_i_parallel_largest_first(threads, size, ITEMS, count, &t, &err)
                                               : sunder_i_parallel(threads, ITEMS, 3, count, &t, &err);
            assert_int_equal(status, SUNDER_OK);
            demand_all(&t, threads);
        }
}

/* With a single item the other threads are idle. */
static void test_idle_threads_help(void **state)
{
    (void)state;
    static tally t;
    sunder_error err;
    int most = 0;
    for (int round = 0; round < 20 && most < 2; round++) {
        memset(&t, 0, sizeof t);
        t.threads = 4;
        assert_int_equal(sunder_i_parallel(4, 1, 1, count, &t, &err), SUNDER_OK);
        most = t.most;
        assert_true(most <= 4);
    }
    assert_true(most >= 2);
}

static void test_largest_begin_first(void **state)
{
    (void)state;
    static tally t;
    size_t size[ITEMS];
    sunder_error err;
    for (size_t k = 0; k < ITEMS; k++) size[k] = k == 7 ? SIZE_MAX : k % 5;
    memset(&t, 0, sizeof t);
    assert_int_equal(sunder_i_parallel_largest_first(1, size, ITEMS, count, &t, &err), SUNDER_OK);
    for (size_t k = 0; k < ITEMS; k++) assert_int_equal(t.order[k], k); /* one thread processes them in order */
    memset(&t, 0, sizeof t);
    t.threads = 2;
    assert_int_equal(sunder_i_parallel_largest_first(2, size, ITEMS, count, &t, &err), SUNDER_OK);
    /* Two threads: an item may begin a little before one that was handed out before it. */
    assert_true(t.order[0] == 7 || t.order[1] == 7);
    for (size_t k = 3; k < ITEMS; k++) assert_true(size[t.order[k]] <= size[t.order[k - 2]] || t.order[k - 2] == 7);
}

static sunder_status fail_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    (void)end;
    const size_t *first = context;
    if (begin < *first) return SUNDER_OK;
    err->status = SUNDER_EINVALID;
    snprintf(err->message, sizeof err->message, "item %zu", begin);
    return SUNDER_EINVALID;
}

static void test_failure_is_told(void **state)
{
    (void)state;
    size_t first = 5, size[ITEMS] = {0};
    sunder_error err;
    for (unsigned threads = 1; threads <= 4; threads++) {
        memset(&err, 0, sizeof err);
        assert_int_equal(sunder_i_parallel(threads, ITEMS, 1, fail_some, &first, &err), SUNDER_EINVALID);
        assert_string_equal(err.message, "item 5");
        assert_int_equal(sunder_i_parallel_largest_first(threads, size, ITEMS, fail_some, &first, &err),
                         SUNDER_EINVALID);
        assert_int_equal(sunder_i_parallel_largest_first(threads, size, 0, fail_some, &first, &err), SUNDER_OK);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_is_done_within_threads), cmocka_unit_test(test_idle_threads_help),
        cmocka_unit_test(test_largest_begin_first), cmocka_unit_test(test_failure_is_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
