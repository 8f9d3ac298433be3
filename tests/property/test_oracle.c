/* The oracle compared with itself: with all segments and with the extreme ones only; P + Q and Q + P; and its text with
 * its membership test, point by point. cross/test_cases.c compares it with known cases. */
#include "generate.h"
#include "oracle.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void complain(const char *what, pair_kind kind, uint64_t seed, size_t i, const polyset *p, const polyset *q)
{
    char *a = polyset_wkt(p), *b = polyset_wkt(q);
    print_message("%s: kind %s, SUNDER_SEED=%llu, case %zu\n%s\n%s\n", what, pair_kind_string(kind),
                  (unsigned long long)seed, i, a, b);
    free(a);
    free(b);
}

/* Points on a half-integer or decimal grid across the sum: many fall on edges, vertices and degenerate holes. */
static bool members_agree(const polyset *p, const polyset *q, const char *text, rng *r)
{
    oracle *o = oracle_new(p, q);
    bool agree = true;
    for (int k = 0; k < 12 && agree; k++) {
        const size_t i = (size_t)rng_int(r, 0, (int64_t)p->vertices - 1),
                     j = (size_t)rng_int(r, 0, (int64_t)q->vertices - 1);
        double xy[2];
        for (int d = 0; d < 2; d++)
            xy[d] = p->xy[2 * i + (size_t)d] + q->xy[2 * j + (size_t)d] + (double)rng_int(r, -2, 2) / 2;
        for (int d = 0; d < 2; d++)
            if (!(xy[d] < 1e15 && xy[d] > -1e15)) xy[d] = 0;
        char *x = test_format("%lld/16", (long long)(xy[0] * 16)), *y = test_format("%lld/16", (long long)(xy[1] * 16));
        agree = oracle_covers(o, x, y) == sum_text_covers(text, x, y);
        if (!agree) print_message("point %s %s\n", x, y);
        free(x);
        free(y);
    }
    oracle_free(o);
    return agree;
}

static void test_against_itself(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(25);
    size_t bad = 0, holes = 0, segments = 0, points = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (int kind = 0; kind < PAIR_KINDS; kind++)
        for (size_t i = 0; i < n; i++) {
            rng r = rng_start(seed + (uint64_t)kind * 1000003, i);
            polyset p, q;
            random_pair(&p, &q, &r, (pair_kind)kind);
            char *few = oracle_sum_text(&p, &q, false), *all = oracle_sum_text(&p, &q, true);
            char *turned = oracle_sum_text(&q, &p, false);
            if (strcmp(few, all)) complain("extreme segments are not enough", (pair_kind)kind, seed, i, &p, &q), bad++;
            if (strcmp(few, turned)) complain("P + Q is not Q + P", (pair_kind)kind, seed, i, &p, &q), bad++;
            if (!members_agree(&p, &q, few, &r)) complain("membership", (pair_kind)kind, seed, i, &p, &q), bad++;
            holes += strstr(few, "\"holes\": [[") != NULL;
            segments += !strstr(few, "\"degenerate_segments\": []");
            points += !strstr(few, "\"degenerate_points\": []");
            free(few);
            free(all);
            free(turned);
            polyset_free(&p);
            polyset_free(&q);
        }
    print_message("with holes %zu, degenerate segments %zu, degenerate points %zu\n", holes, segments, points);
    assert_int_equal(bad, 0);
    /* The generators are meant to produce degenerate cases; if they no longer do, comparisons with the library mean
     * little. */
    assert_true(10 * segments >= n && 10 * points >= n && 10 * holes >= n);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_against_itself)};
    return cmocka_run_group_tests_name("oracle", tests, NULL, NULL);
}
