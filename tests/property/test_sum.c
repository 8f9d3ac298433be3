/* The library's sums compared with the oracle's, byte for byte, on small random operands of every kind of degeneracy;
 * every fourth also with big integers forced. */
#include "generate.h"
#include "oracle.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SHOWN 5 /* at most this many disagreements are printed; the rest are counted */

static void show(pair_kind kind, uint64_t seed, size_t i, const polyset *p, const polyset *q, const char *ours,
                 const char *expected)
{
    char *a = polyset_wkt(p), *b = polyset_wkt(q);
    print_message("kind %s, SUNDER_SEED=%llu, case %zu\n%s\n%s\n  library %s\n  oracle  %s\n", pair_kind_string(kind),
                  (unsigned long long)seed, i, a, b, ours ? ours : "failed", expected);
    free(a);
    free(b);
}

static bool agree(pair_kind kind, uint64_t seed, size_t i, bool shown)
{
    rng r = rng_start(seed + (uint64_t)kind * 1000003, i);
    polyset p, q;
    random_pair(&p, &q, &r, kind);
    char *expected = oracle_sum_text(&p, &q, false);
    if (rng_once_in(&r, 3)) random_dress(&p, &r);
    if (rng_once_in(&r, 3)) random_dress(&q, &r);
    char *ours = library_sum_text(&p, &q);
    bool same = ours && strcmp(ours, expected) == 0;
    if (same && i % 4 == 0) { /* also with big integers */
        free(ours);
        ours = library_sum_text_wide(&p, &q);
        same = ours && strcmp(ours, expected) == 0;
    }
    if (!same && shown) show(kind, seed, i, &p, &q, ours, expected);
    free(ours);
    free(expected);
    polyset_free(&p);
    polyset_free(&q);
    return same;
}

static void test_kind(void **state)
{
    const pair_kind kind = *(const pair_kind *)*state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(kind == PAIR_HUGE ? 80 : 1200);
    size_t bad = 0;
    for (size_t i = 0; i < n; i++)
        if (!agree(kind, seed, i, bad < SHOWN)) bad++;
    print_message("%-14s SUNDER_SEED=%llu: %zu of %zu agree\n", pair_kind_string(kind), (unsigned long long)seed,
                  n - bad, n);
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
    return cmocka_run_group_tests_name("sums like the oracle's", tests, NULL, NULL);
}
