/* outline/pairs.h: pairs that were added, without those that were removed, are returned line by line in ascending
 * order, whether they were added in rows of one line, in rows of one part, or singly. */
#include "failing.h"
#include "outline/pairs.h"
#include "random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { LINES = 23, PARTS = 17 };

typedef struct tally {
    unsigned n[LINES][PARTS];
    size_t all;
} tally;

static void add(sunder_i_pairs *pairs, tally *t, uint32_t line, uint32_t part)
{
    assert_true(sunder_i_pairs_add(pairs, line, part));
    t->n[line][part]++;
    t->all++;
    assert_int_equal(pairs->count, t->all);
}

/* Adds a row of random length, along lines or along parts. */
static void add_some(sunder_i_pairs *pairs, tally *t, rng *r)
{
    const int kind = (int)rng_int(r, 0, 2), n = kind == 2 ? 1 : (int)rng_int(r, 1, 9);
    uint32_t line = (uint32_t)rng_int(r, 0, LINES - 1), part = (uint32_t)rng_int(r, 0, PARTS - 1);
    for (int i = 0; i < n; i++) {
        add(pairs, t, line, part);
        if (kind == 0) line = (line + (uint32_t)rng_int(r, 0, 2)) % LINES;
        if (kind == 1) part = (part + (uint32_t)rng_int(r, 0, 2)) % PARTS;
    }
}

static void demand_equal(const sunder_i_pairs *pairs, const tally *t, const bool *wanted)
{
    sunder_i_line_parts by_line;
    assert_true(sunder_i_pairs_by_line(pairs, wanted, LINES, PARTS, &by_line));
    size_t at = 0;
    for (uint32_t line = 0; line < LINES; line++) {
        for (uint32_t part = 0; part < PARTS && wanted[line]; part++)
            for (unsigned k = 0; k < t->n[line][part]; k++) {
                assert_true(at < by_line.end[line]);
                assert_int_equal(by_line.part[at++], part);
            }
        assert_int_equal(at, by_line.end[line]);
    }
    sunder_i_line_parts_free(&by_line);
}

static void test_random(void **state)
{
    (void)state;
    const size_t n = test_count(2000);
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(test_seed(), i);
        sunder_i_pairs pairs = {0};
        tally t = {0};
        bool wanted[LINES];
        for (int k = 0; k < LINES; k++) wanted[k] = rng_once_in(&r, 2);
        for (int64_t k = rng_int(&r, 0, 40); k > 0; k--) add_some(&pairs, &t, &r);
        if (i % 2) {
            const tally kept = t;
            const sunder_i_pairs_mark mark = sunder_i_pairs_mark_here(&pairs);
            for (int64_t k = rng_int(&r, 0, 20); k > 0; k--) add_some(&pairs, &t, &r);
            if (i % 4 == 1) {
                sunder_i_pairs_take_back(&pairs, mark);
                t = kept;
            }
            for (int64_t k = rng_int(&r, 0, 20); k > 0; k--) add_some(&pairs, &t, &r);
        }
        demand_equal(&pairs, &t, wanted);
        sunder_i_pairs_free(&pairs);
    }
}

static void test_none(void **state)
{
    (void)state;
    const sunder_i_pairs pairs = {0};
    const tally t = {0};
    const bool wanted[LINES] = {false, true};
    demand_equal(&pairs, &t, wanted);
}

/* A row takes one word for each pair and one for the common number; a single pair takes two. */
static void test_room(void **state)
{
    (void)state;
    sunder_i_pairs pairs = {0};
    for (uint32_t i = 0; i < 100; i++) assert_true(sunder_i_pairs_add(&pairs, 7, i));
    assert_int_equal(pairs.n, 101);
    for (uint32_t i = 0; i < 100; i++) assert_true(sunder_i_pairs_add(&pairs, i, 200));
    assert_int_equal(pairs.n, 202);
    for (uint32_t i = 0; i < 100; i++) assert_true(sunder_i_pairs_add(&pairs, 100 + i, 300 + i));
    assert_int_equal(pairs.n, 402);
    sunder_i_pairs_free(&pairs);
}

static bool attempt(void *context)
{
    (void)context;
    sunder_i_pairs pairs = {0};
    sunder_i_line_parts by_line = {0};
    bool wanted[LINES], ok = true;
    size_t added = 0;
    memset(wanted, true, sizeof wanted);
    for (uint32_t i = 0; ok && i < 3000; i++) {
        ok = sunder_i_pairs_add(&pairs, i % LINES, i % PARTS);
        added += ok;
    }
    assert_int_equal(pairs.count, added);
    ok = ok && sunder_i_pairs_by_line(&pairs, wanted, LINES, PARTS, &by_line);
    if (ok) assert_int_equal(by_line.end[LINES - 1], added);
    sunder_i_line_parts_free(&by_line);
    sunder_i_pairs_free(&pairs);
    return ok;
}

static void test_memory(void **state)
{
    (void)state;
    failing_begin();
    assert_true(failing_loop(attempt, NULL, false));
    failing_end();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_random), cmocka_unit_test(test_none),
                                       cmocka_unit_test(test_room), cmocka_unit_test(test_memory)};
    return cmocka_run_group_tests_name("pairs of a line and a part", tests, NULL, NULL);
}
