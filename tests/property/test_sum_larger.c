/* Larger sums compared with the oracle, byte for byte. They reach code of the library that small operands do not (cells
 * split many times, long lists of crossings on one segment), and are small enough for the oracle. */
#include "generate.h"
#include "oracle.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static bool agree(family_kind kind, uint64_t seed, size_t i)
{
    rng r = rng_start(seed * 17 + (uint64_t)kind, i);
    polyset p, q;
    random_family(&p, &q, &r, kind, 12, 48);
    char *expected = oracle_sum_text(&p, &q, false), *ours = library_sum_text(&p, &q);
    const bool same = ours && strcmp(ours, expected) == 0;
    if (!same) {
        char *a = polyset_wkt(&p), *b = polyset_wkt(&q);
        print_message("%s, SUNDER_SEED=%llu, case %zu\n%s\n%s\n  library %.3000s\n  oracle  %.3000s\n",
                      family_kind_string(kind), (unsigned long long)seed, i, a, b, ours ? ours : "failed", expected);
        free(a);
        free(b);
    }
    free(ours);
    free(expected);
    polyset_free(&p);
    polyset_free(&q);
    return same;
}

static void test_family(void **state)
{
    const family_kind kind = *(const family_kind *)*state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(25);
    size_t bad = 0;
    for (size_t i = 0; i < n && bad < 2; i++)
        if (!agree(kind, seed, i)) bad++;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    assert_int_equal(bad, 0);
}

int main(void)
{
    family_kind kinds[FAMILY_KINDS];
    struct CMUnitTest tests[FAMILY_KINDS];
    for (int k = 0; k < FAMILY_KINDS; k++) {
        kinds[k] = (family_kind)k;
        tests[k] = (struct CMUnitTest){family_kind_string(kinds[k]), test_family, NULL, NULL, &kinds[k]};
    }
    return cmocka_run_group_tests_name("larger sums like the oracle's", tests, NULL, NULL);
}
