/* The three algorithms for unions on small random operands of every kind of degeneracy: each sum equals the
 * convolution's, byte for byte; some are compared with the oracle's, too, and some computed on big integers.
 * Decomposition, order and seed change from case to case, so that every combination occurs for every kind. */
#include "generate.h"
#include "oracle.h"
#include "roads.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SHOWN 3 /* at most this many disagreements are printed; the rest are counted */

/* The number of algorithms, of three, that disagree. */
static size_t disagreements(pair_kind kind, uint64_t seed, size_t i, bool shown)
{
    rng r = rng_start(seed + (uint64_t)kind * 1000003, i);
    polyset p, q;
    random_pair(&p, &q, &r, kind);
    char *want = i % 8 ? library_sum_text(&p, &q) : oracle_sum_text(&p, &q, false);
    assert_non_null(want);
    size_t bad = 0;
    for (size_t a = 0; a < ROAD_ALGORITHMS; a++) {
        const sunder_sum_options how = road_options(i * ROAD_ALGORITHMS + a, seed + i);
        if (!road_agrees(&p, &q, &how, i % 5 == 0, want, shown)) bad++;
    }
    free(want);
    polyset_free(&p);
    polyset_free(&q);
    return bad;
}

static void test_kind(void **state)
{
    const pair_kind kind = *(const pair_kind *)*state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(kind == PAIR_HUGE ? 36 : 216);
    size_t bad = 0;
    for (size_t i = 0; i < n; i++) bad += disagreements(kind, seed, i, bad < SHOWN);
    print_message("%-14s SUNDER_SEED=%llu: %zu of %zu sums agree\n", pair_kind_string(kind), (unsigned long long)seed,
                  ROAD_ALGORITHMS * n - bad, ROAD_ALGORITHMS * n);
    assert_int_equal(bad, 0);
}

int main(void)
{
    pair_kind kinds[PAIR_KINDS];
    struct CMUnitTest tests[PAIR_KINDS];
    for (int k = 0; k < PAIR_KINDS; k++) {
        kinds[k] = (pair_kind)k;
        tests[k] = (struct CMUnitTest){pair_kind_string(kinds[k]), test_kind, NULL, NULL, &kinds[k]};
    }
    return cmocka_run_group_tests_name("unions like the convolution and the oracle", tests, NULL, NULL);
}
