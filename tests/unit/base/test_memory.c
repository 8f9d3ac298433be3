/* number/memory and number/sort: the hooks, growing arrays, arenas, errors; sorting on memory of our own. */
#include "base/memory.h"
#include "base/sort.h"
#include "failing.h"
#include "random.h"
#include "sunder.h"

#include <gmp.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void test_hooks(void **state)
{
    (void)state;
    failing_begin();
    assert_null(sunder_i_alloc(SIZE_MAX / 2, 4)); /* n * size overflows */
    assert_null(sunder_i_calloc(SIZE_MAX, 2));
    void *none = sunder_i_alloc(0, 8);
    assert_non_null(none);
    unsigned char *zeros = sunder_i_calloc(100, 3);
    for (int i = 0; i < 300; i++) assert_int_equal(zeros[i], 0);
    memset(zeros, 7, 300);
    zeros = sunder_i_realloc(zeros, 5000, 1);
    for (int i = 0; i < 300; i++) assert_int_equal(zeros[i], 7);
    failing_at(1, false);
    assert_null(sunder_i_realloc(zeros, 9000, 1));
    assert_int_equal(zeros[299], 7); /* reallocation keeps the content */
    assert_null(sunder_i_realloc(zeros, SIZE_MAX, 16));
    void *fresh = sunder_i_realloc(NULL, 3, 3);
    assert_non_null(fresh);
    assert_int_equal(failing_outstanding(), 3);
    sunder_i_free(none);
    sunder_i_free(zeros);
    sunder_free(fresh);
    sunder_i_free(NULL);
    sunder_free(NULL);
    assert_int_equal(failing_outstanding(), 0);
    failing_end();
}

static void test_reserve(void **state)
{
    (void)state;
    uint32_t *array = NULL;
    size_t capacity = 0;
    failing_begin();
    for (uint32_t i = 0; i < 1000; i++) {
        assert_true(sunder_i_reserve(&array, &capacity, i + 1, sizeof *array));
        assert_true(capacity > i);
        array[i] = i;
    }
    for (uint32_t i = 0; i < 1000; i++) assert_int_equal(array[i], i);
    const size_t before = capacity;
    failing_at(1, true);
    assert_false(sunder_i_reserve(&array, &capacity, capacity + 1, sizeof *array));
    assert_int_equal(capacity, before);
    assert_int_equal(array[999], 999);
    failing_at(0, false);
    assert_false(sunder_i_reserve(&array, &capacity, SIZE_MAX - 1, sizeof *array));
    assert_int_equal(array[999], 999);
    sunder_i_free(array);
    assert_int_equal(failing_outstanding(), 0);
    failing_end();
}

static void test_arena(void **state)
{
    (void)state;
    sunder_i_arena arena;
    failing_begin();
    sunder_i_arena_init(&arena);
    const sunder_i_mark empty = sunder_i_arena_mark(&arena);
    unsigned char *a = sunder_i_arena_alloc(&arena, 5, 1), *b = sunder_i_arena_alloc(&arena, 0, 8);
    assert_non_null(a);
    assert_non_null(b);
    assert_true(a != b);
    memset(a, 1, 5);
    for (size_t n = 1; n < 200000; n = n * 3 + 1) {
        unsigned char *p = sunder_i_arena_alloc(&arena, n, 1);
        assert_non_null(p);
        assert_int_equal((uintptr_t)p % 16, 0);
        memset(p, 2, n);
    }
    for (int i = 0; i < 5; i++) assert_int_equal(a[i], 1);
    const sunder_i_mark mark = sunder_i_arena_mark(&arena);
    const size_t blocks = failing_outstanding();
    for (int i = 0; i < 100; i++) sunder_i_arena_alloc(&arena, 100000, 1);
    sunder_i_arena_release(&arena, mark);
    assert_int_equal(failing_outstanding(), blocks);
    for (int i = 0; i < 5; i++) assert_int_equal(a[i], 1);
    assert_null(sunder_i_arena_alloc(&arena, SIZE_MAX / 2, 8));
    assert_true(arena.failed);
    assert_null(sunder_i_arena_alloc(&arena, 1, 1)); /* an arena that failed once keeps failing */
    sunder_i_arena_release(&arena, empty);
    assert_int_equal(failing_outstanding(), 0);
    sunder_i_arena_free(&arena);
    assert_false(arena.failed);
    failing_at(1, true);
    assert_null(sunder_i_arena_alloc(&arena, 1, 1));
    assert_true(arena.failed);
    failing_at(0, false);
    assert_null(sunder_i_arena_alloc(&arena, 1, 1));
    sunder_i_arena_free(&arena);
    assert_int_equal(failing_outstanding(), 0);
    failing_end();
}

static void test_errors(void **state)
{
    (void)state;
    sunder_error err;
    memset(&err, 0, sizeof err);
    assert_int_equal(sunder_i_fail(&err, SUNDER_EARG, "%s %d", "gap", 5), SUNDER_EARG);
    assert_int_equal(err.status, SUNDER_EARG);
    assert_string_equal(err.message, "gap 5");
    assert_true(err.polygon == SIZE_MAX && err.ring == SIZE_MAX && err.vertex == SIZE_MAX);
    assert_int_equal(sunder_i_fail_at(&err, SUNDER_EINVALID, 1, 2, 3, "x"), SUNDER_EINVALID);
    assert_true(err.polygon == 1 && err.ring == 2 && err.vertex == 3);
    char longer[400];
    memset(longer, 'm', sizeof longer - 1);
    longer[sizeof longer - 1] = '\0';
    sunder_i_fail(&err, SUNDER_ERANGE, "%s", longer);
    assert_int_equal(strlen(err.message), SUNDER_MESSAGE_MAX - 1);
    assert_int_equal(sunder_i_failure_cause(&err), SUNDER_ENOMEM);
    assert_int_equal(err.status, SUNDER_ENOMEM);
    assert_int_equal(sunder_i_failure_cause(NULL), SUNDER_ENOMEM);
    assert_int_equal(sunder_i_fail(NULL, SUNDER_EARG, "x"), SUNDER_EARG);
    assert_int_equal(sunder_i_fail_at(NULL, SUNDER_EARG, 0, 0, 0, "x"), SUNDER_EARG);
}

static void test_words(void **state)
{
    (void)state;
    static const char *const contact[] = {"none", "edge", "vertex", "arc", "degenerate_segment", "degenerate_point"};
    static const char *const status[] = {"unmoved", "moved", "fixed", "blocked", "skipped"};
    static const char *const kind[] = {"overlap",      "too_close", "barrier",  "barrier_drawn",
                                       "barrier_near", "contained", "duplicate"};
    static const char *const reason[] = {"",        "max_shift",  "fixed", "side",      "jump",
                                         "no_room", "same_block", "kept",  "unresolved"};
    for (int i = 0; i < 6; i++) assert_string_equal(sunder_contact_string((sunder_contact)i), contact[i]);
    for (int i = 0; i < 5; i++) assert_string_equal(sunder_feature_status_string((sunder_feature_status)i), status[i]);
    for (int i = 0; i < 6; i++) assert_string_equal(sunder_conflict_kind_string((sunder_conflict_kind)i), kind[i]);
    for (int i = 0; i < 9; i++) assert_string_equal(sunder_reason_string((sunder_reason)i), reason[i]);
    assert_string_equal(sunder_validity_string(SUNDER_VALIDITY_EVEN_ODD), "even-odd");
    assert_string_equal(sunder_containment_string(SUNDER_CONTAINMENT_IGNORE), "ignore");
    assert_string_equal(sunder_phase_string(SUNDER_PHASE_UNION), "union");
    assert_string_equal(sunder_phase_string((sunder_phase)3), "");
    assert_string_equal(sunder_containment_string((sunder_containment)-1), "");
    assert_string_equal(sunder_version(), SUNDER_VERSION);
    assert_string_equal(sunder_gmp_version(), gmp_version);
    for (int i = 0; i <= SUNDER_EFAULT; i++)
        for (int j = 0; j < i; j++)
            assert_string_not_equal(sunder_status_string((sunder_status)i), sunder_status_string((sunder_status)j));
    assert_non_null(sunder_status_string((sunder_status)99));
}

/* ---- Sorting ---- */

static int by_tens(void *context, uint32_t a, uint32_t b)
{
    const uint64_t *key = context;
    return (key[a] / 10 > key[b] / 10) - (key[a] / 10 < key[b] / 10);
}

static int numeric(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static void test_sort(void **state)
{
    (void)state;
    rng g = rng_start(test_seed(), 9);
    for (size_t n = 0; n < 3000; n = n * 2 + (size_t)rng_int(&g, 0, 1) + (n == 0)) {
        uint64_t *key = calloc(n + 1, sizeof *key), *sorted = calloc(n + 1, sizeof *sorted);
        uint32_t *index = calloc(n + 1, sizeof *index);
        sunder_i_valued *valued = calloc(2 * n + 1, sizeof *valued);
        for (size_t i = 0; i < n; i++) {
            key[i] = n % 2 ? rng_next(&g) >> rng_int(&g, 0, 63) : (uint64_t)rng_int(&g, 0, 99);
            sorted[i] = key[i];
            index[i] = (uint32_t)i;
            valued[i] = (sunder_i_valued){(double)key[i], (uint32_t)i, (uint32_t)~i};
        }
        assert_true(sunder_i_sort_valued(valued, n));
        for (size_t i = 0; i < n; i++) {
            assert_true(valued[i].value == (double)key[valued[i].item] && valued[i].mark == ~valued[i].item);
            assert_true(i == 0 || valued[i - 1].value < valued[i].value ||
                        /* the sort is stable */
                        (valued[i - 1].value == valued[i].value && valued[i - 1].item < valued[i].item));
        }
        assert_true(sunder_i_sort_indices(index, n, by_tens, key));
        for (size_t i = 1; i < n; i++) {
            const int c = by_tens(key, index[i - 1], index[i]);
            assert_true(c < 0 || (c == 0 && index[i - 1] < index[i])); /* the sort is stable */
        }
        qsort(sorted, n, sizeof *sorted, numeric);
        assert_true(sunder_i_sort_keys(key, n));
        if (n) assert_memory_equal(key, sorted, n * sizeof *key);
        free(key);
        free(sorted);
        free(index);
        free(valued);
    }
}

static bool sort_run(void *context)
{
    (void)context;
    uint64_t key[300];
    uint32_t index[300];
    for (uint32_t i = 0; i < 300; i++) key[i] = (i * 7919) % 300, index[i] = i;
    return sunder_i_sort_indices(index, 300, by_tens, key) && sunder_i_sort_keys(key, 300);
}

static void test_sort_out_of_memory(void **state)
{
    (void)state;
    assert_true(failing_loop(sort_run, NULL, false));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_hooks),
                                       cmocka_unit_test(test_reserve),
                                       cmocka_unit_test(test_arena),
                                       cmocka_unit_test(test_errors),
                                       cmocka_unit_test(test_words),
                                       cmocka_unit_test(test_sort),
                                       cmocka_unit_test(test_sort_out_of_memory)};
    return cmocka_run_group_tests_name("number/memory, number/sort", tests, NULL, NULL);
}
