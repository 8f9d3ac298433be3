/* base/sized_struct: callers that were compiled with an older or a newer header, and sizes that are impossible.
 *
 * The struct of a caller fills a heap block of exactly its size, so that sanitizers and valgrind detect reads and
 * writes beyond its end. */
#include "base/sized_struct.h"
#include "sunder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef enum entry { SUM, UNION, MORPHOLOGY, DILATION, ROUTE, SEPARATE, CHECK, CHECK_MOVES, ENTRIES } entry;

typedef struct scene {
    sunder_shape *p, *q;
    sunder_layer *layer;
    sunder_obstacle obstacle;
} scene;

static void scene_init(scene *s)
{
    sunder_feature feature[2] = {{.weight = 1, .max_shift = INFINITY, .block = -1},
                                 {.weight = 1, .max_shift = INFINITY, .block = -1}};
    assert_int_equal(sunder_shape_rectangle(4, 3, &s->p, NULL), SUNDER_OK);
    assert_int_equal(sunder_shape_rectangle(1, 1, &s->q, NULL), SUNDER_OK);
    feature[0].shape = s->p;
    feature[1].shape = s->q;
    assert_int_equal(sunder_layer_new(feature, 2, &s->layer, NULL), SUNDER_OK);
    s->obstacle = (sunder_obstacle){.shape = s->p};
}

static void scene_free(scene *s)
{
    sunder_layer_free(s->layer);
    sunder_shape_free(s->p);
    sunder_shape_free(s->q);
}

static size_t size_of(entry e)
{
    return e < ROUTE    ? sizeof(sunder_sum_options)
           : e == ROUTE ? sizeof(sunder_route_options)
                        : sizeof(sunder_layer_options);
}

static void init(entry e, void *options, size_t size)
{
    if (e < ROUTE)
        sunder_sum_options_init_sized(options, size);
    else if (e == ROUTE)
        sunder_route_options_init_sized(options, size);
    else
        sunder_layer_options_init_sized(options, size);
}

static sunder_status call(const scene *s, entry e, const void *options, sunder_error *err)
{
    sunder_sum *sum = NULL;
    sunder_route *route = NULL;
    sunder_report *report = NULL;
    const sunder_place from = {.xy = {-9, 0}}, to = {.xy = {9, 0}};
    sunder_status status = SUNDER_OK;
    switch (e) {
    case SUM: status = sunder_minkowski_sum(s->p, s->q, options, &sum, err); break;
    case UNION: status = sunder_shape_union(s->p, options, &sum, err); break;
    case MORPHOLOGY: status = sunder_morphology(s->p, s->q, SUNDER_OPERATION_OPEN, options, &sum, err); break;
    case DILATION: status = sunder_morphology(s->p, s->q, SUNDER_OPERATION_DILATE, options, &sum, err); break;
    case ROUTE: status = sunder_route_find(&s->obstacle, 1, s->q, &from, &to, options, &route, err); break;
    case SEPARATE: status = sunder_layer_separate(s->layer, options, &report, err); break;
    case CHECK: status = sunder_layer_check(s->layer, options, &report, err); break;
    case CHECK_MOVES: status = sunder_layer_check_moves(s->layer, s->layer, options, &report, err); break;
    case ENTRIES: break;
    }
    assert_int_equal(status == SUNDER_OK, sum || route || report);
    sunder_sum_free(sum);
    sunder_route_free(route);
    sunder_report_free(report);
    return status;
}

/* Allocates a struct of `size` bytes whose member `size` is `said`. */
static void *options_new(entry e, size_t size, size_t said)
{
    unsigned char *options = malloc(size);
    assert_non_null(options);
    memset(options, 0xa5, size);
    init(e, options, size);
    memcpy(options, &said, sizeof said);
    return options;
}

static void test_smaller_struct_of_an_older_caller(void **state)
{
    scene s;
    scene_init(&s);
    for (entry e = SUM; e < ENTRIES; e++)
        for (size_t size = sizeof(size_t); size <= size_of(e); size += sizeof(size_t)) {
            void *options = options_new(e, size, size);
            assert_int_equal(call(&s, e, options, NULL), SUNDER_OK);
            free(options);
        }
    scene_free(&s);
}

/* An older caller that only has the member gap. The gap is used; the tolerance, which its struct does not have, is a
 * tenth of the gap by default, so that two features 0.1 apart are one block. */
static void test_what_an_older_caller_sets_counts(void **state)
{
    struct {
        size_t size;
        double gap;
    } old = {sizeof old, 2};
    const sunder_layer_options *options = (const sunder_layer_options *)(const void *)&old;
    scene s;
    sunder_shape *beside;
    sunder_layer *layer;
    sunder_report *report;
    sunder_layer_summary summary;
    bool exact;
    scene_init(&s);
    assert_int_equal(sunder_shape_translate(s.q, 2.6, 0, &beside, &exact, NULL), SUNDER_OK);
    const sunder_feature feature[2] = {{.shape = s.p, .weight = 1, .max_shift = INFINITY, .block = -1},
                                       {.shape = beside, .weight = 1, .max_shift = INFINITY, .block = -1}};
    assert_int_equal(sunder_layer_new(feature, 2, &layer, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_check(layer, options, &report, NULL), SUNDER_OK);
    sunder_report_summary(report, &summary);
    assert_int_equal(summary.blocks, 1);
    assert_int_equal(summary.before.inside_blocks, 1);
    sunder_report_free(report);
    old.gap = -1;
    assert_int_equal(sunder_layer_check(layer, options, &report, NULL), SUNDER_EARG);
    sunder_layer_free(layer);
    sunder_shape_free(beside);
    scene_free(&s);
}

static void test_larger_struct_of_a_newer_caller(void **state)
{
    scene s;
    sunder_error err;
    scene_init(&s);
    for (entry e = SUM; e < ENTRIES; e++)
        for (size_t size = size_of(e) + sizeof(size_t); size <= SUNDER_OPTIONS_MAX; size += 7 * sizeof(size_t)) {
            unsigned char *options = options_new(e, size, size);
            assert_int_equal(call(&s, e, options, NULL), SUNDER_OK);
            /* the first byte and the last byte */
            for (size_t k = size_of(e); k < size; k += size - 1 - k ? size - 1 - k : 1) {
                options[k] = 1;
                assert_int_equal(call(&s, e, options, &err), SUNDER_EARG);
                assert_non_null(strstr(err.message, "does not know"));
                options[k] = 0;
            }
            free(options);
        }
    scene_free(&s);
}

static void test_sizes_that_no_struct_has(void **state)
{
    const size_t wrong[] = {0,
                            1,
                            4,
                            7,
                            9,
                            20,
                            sizeof(sunder_layer_options) + 1,
                            SUNDER_OPTIONS_MAX + 8,
                            SIZE_MAX - 7,
                            (size_t)(uintptr_t)&wrong};
    scene s;
    scene_init(&s);
    for (entry e = SUM; e < ENTRIES; e++)
        for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
            char number[32];
            sunder_error err = {0};
            void *options = options_new(e, size_of(e), wrong[k]);
            assert_int_equal(call(&s, e, options, &err), SUNDER_EARG);
            snprintf(number, sizeof number, "size %zu,", wrong[k]);
            assert_non_null(strstr(err.message, number));
            assert_non_null(strstr(err.message, "_init"));
            assert_int_equal(call(&s, e, options, NULL), SUNDER_EARG);
            free(options);
        }
    scene_free(&s);
}

/* The defaults are written up to the end of the caller's struct, and no farther. */
static void test_init_keeps_to_the_size(void **state)
{
    for (entry e = SUM; e < ENTRIES; e++) {
        unsigned char *whole = options_new(e, size_of(e), size_of(e));
        for (size_t size = 0; size <= size_of(e) + 64; size += sizeof(size_t)) {
            unsigned char *options = malloc(size + 1);
            assert_non_null(options);
            memset(options, 0xa5, size + 1);
            init(e, options, size);
            assert_int_equal(options[size], 0xa5);
            for (size_t k = sizeof size; k < size; k++) assert_int_equal(options[k], k < size_of(e) ? whole[k] : 0);
            assert_true(size == 0 || memcmp(options, &size, sizeof size) == 0);
            free(options);
        }
        free(whole);
    }
}

static void test_summary_keeps_to_the_size(void **state)
{
    scene s;
    sunder_report *report;
    sunder_layer_summary whole;
    scene_init(&s);
    assert_int_equal(sunder_layer_separate(s.layer, NULL, &report, NULL), SUNDER_OK);
    sunder_report_summary(report, &whole);
    assert_int_equal(whole.features, 2);
    for (size_t size = 0; size <= sizeof whole + 40; size++) {
        unsigned char *summary = malloc(size + 1);
        assert_non_null(summary);
        memset(summary, 0xa5, size + 1);
        sunder_report_summary_sized(report, (sunder_layer_summary *)(void *)summary, size);
        assert_int_equal(summary[size], 0xa5);
        assert_memory_equal(summary, &whole, size < sizeof whole ? size : sizeof whole);
        for (size_t k = sizeof whole; k < size; k++) assert_int_equal(summary[k], 0);
        free(summary);
    }
    sunder_report_free(report);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_smaller_struct_of_an_older_caller),
                                       cmocka_unit_test(test_what_an_older_caller_sets_counts),
                                       cmocka_unit_test(test_larger_struct_of_a_newer_caller),
                                       cmocka_unit_test(test_sizes_that_no_struct_has),
                                       cmocka_unit_test(test_init_keeps_to_the_size),
                                       cmocka_unit_test(test_summary_keeps_to_the_size)};
    return cmocka_run_group_tests_name("structs that carry their size", tests, NULL, NULL);
}
