/* Small members of every family, with other seeds each, at integer coordinates and at coordinates as in maps: the
 * library's sum, with both kinds of numbers, equals the oracle's, byte for byte. */
#include "generated.h"
#include "oracle.h"
#include "random.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SKIPPED 77

static const char *const families[] = {"convex", "comb",  "fork",     "slanted-fork", "covered-fork", "star",
                                       "random", "robot", "fat-grid", "fat-cover",    "tight"};

/* Compares and frees. */
static bool expect(const char *arguments, const char *who, char *got, const char *want)
{
    const bool same = got && strcmp(got, want) == 0;
    if (!same)
        print_message("sunder-families %s: %s says\n  %s\nnot\n  %s\n", arguments, who, got ? got : "nothing", want);
    free(got);
    return same;
}

static bool agree(const char *arguments)
{
    polyset p, q;
    generated_pair(&p, &q, arguments);
    char *want = oracle_sum_text(&p, &q, false);
    bool same = expect(arguments, "the library", library_sum_text(&p, &q), want);
    same = expect(arguments, "the library on big integers", library_sum_text_wide(&p, &q), want) && same;
    free(want);
    polyset_free(&p);
    polyset_free(&q);
    return same;
}

static void test_family(void **state)
{
    const char *family = *(const char *const *)*state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(40);
    size_t bad = 0;
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(seed, i);
        const long long p = rng_int(&r, 8, 26), q = rng_int(&r, 8, 26);
        char *arguments = test_format("%s --size %lld --size-q %lld --seed %llu --coordinates %s%s", family, p, q,
                                      (unsigned long long)(rng_next(&r) >> 32), rng_once_in(&r, 2) ? "map" : "integer",
                                      rng_once_in(&r, 2) ? " --swap" : "");
        if (!agree(arguments)) bad++;
        free(arguments);
    }
    print_message("%-14s SUNDER_SEED=%llu: %zu of %zu agree\n", family, (unsigned long long)seed, n - bad, n);
    assert_int_equal(bad, 0);
}

int main(void)
{
    enum { FAMILIES = sizeof families / sizeof *families };
    struct CMUnitTest tests[FAMILIES];
    if (!generated_available()) return SKIPPED;
    for (size_t i = 0; i < FAMILIES; i++)
        tests[i] = (struct CMUnitTest){families[i], test_family, NULL, NULL, (void *)(uintptr_t)&families[i]};
    return cmocka_run_group_tests_name("families like the oracle's", tests, NULL, NULL);
}
