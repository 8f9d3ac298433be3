/* The cheapest features to hide, beside a search through all subsets. */
#include "displacement/hide/cover.h"

#include "base/random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 12, CLASSES = 4 };

static size_t below(uint64_t *stream, uint64_t n) { return (size_t)(sunder_i_draw(stream) % n); }

static void add(sunder_i_clauses *clauses, const uint32_t *member, size_t n, bool proved)
{
    bool added;
    assert_true(sunder_i_clauses_add(clauses, member, n, 0, proved, &added));
}

/* Is choice p better than q? Both are sets of bits. */
static bool is_better(uint32_t p, uint32_t q, const sunder_hiding_cost *cost, size_t n)
{
    int64_t sum[2][CLASSES] = {{0}};
    for (size_t f = 0; f < n; f++) {
        if (p >> f & 1) sum[0][cost[f].hierarchy] += cost[f].weight;
        if (q >> f & 1) sum[1][cost[f].hierarchy] += cost[f].weight;
    }
    for (size_t k = 0; k < CLASSES; k++)
        if (sum[0][k] != sum[1][k]) return sum[0][k] < sum[1][k];
    for (size_t f = 0; f < n; f++)
        if ((p >> f & 1) != (q >> f & 1)) return p >> f & 1;
    return false;
}

static uint32_t best_of_all(const sunder_i_clauses *clauses, bool proved_only, const sunder_hiding_cost *cost, size_t n)
{
    uint32_t best = UINT32_MAX;
    for (uint32_t p = 0; p < UINT32_C(1) << n; p++) {
        bool covers = true;
        for (size_t k = 0; k < clauses->n && covers; k++) {
            const sunder_i_clause *c = &clauses->clause[k];
            bool hit = c->n == 0 || (proved_only && !c->proved);
            for (size_t m = 0; m < c->n; m++) hit = hit || (p >> clauses->item[c->first + m] & 1);
            covers = hit;
        }
        if (covers && (best == UINT32_MAX || is_better(p, best, cost, n))) best = p;
    }
    return best;
}

static uint32_t found_by(const sunder_i_clauses *clauses, bool proved_only, const sunder_hiding_cost *cost, size_t n,
                         sunder_i_cover_result *result)
{
    sunder_error err;
    assert_int_equal(sunder_i_cover_find(clauses, proved_only, cost, n, 100000, result, &err), SUNDER_OK);
    assert_int_equal(result->exact, result->components);
    uint32_t p = 0;
    for (size_t f = 0; f < n; f++) p |= (uint32_t)result->hidden[f] << f;
    return p;
}

static void check_random(void **state)
{
    (void)state;
    uint64_t stream = 1;
    for (int round = 0; round < 3000; round++) {
        sunder_i_clauses clauses = {0};
        sunder_hiding_cost cost[MOST];
        bool hidden[MOST], sure[MOST];
        sunder_i_cover_result result = {.hidden = hidden, .sure = sure};
        const size_t n = 1 + below(&stream, MOST);
        const uint32_t classes = 1 + (uint32_t)below(&stream, CLASSES - 1);
        const uint64_t weights = round % 3 ? 1 + below(&stream, 5) : 1;
        for (size_t f = 0; f < n; f++)
            cost[f] = (sunder_hiding_cost){1 + (uint32_t)below(&stream, classes), 1 + (int64_t)below(&stream, weights)};
        for (size_t k = below(&stream, 2 * MOST); k-- > 0;) {
            uint32_t member[4];
            const size_t drawn = 1 + below(&stream, 4);
            for (size_t m = 0; m < drawn; m++) member[m] = (uint32_t)below(&stream, n);
            add(&clauses, member, sunder_i_set_make(member, drawn), below(&stream, 3) > 0);
        }
        for (int proved = 0; proved < 2; proved++)
            assert_int_equal(found_by(&clauses, proved, cost, n, &result), best_of_all(&clauses, proved, cost, n));
        sunder_i_clauses_free(&clauses);
    }
}

/* All of n features exclude each other: all but the last are hidden. */
static void check_clique(void **state)
{
    (void)state;
    enum { N = 60 };
    sunder_i_clauses clauses = {0};
    sunder_hiding_cost cost[N];
    bool hidden[N];
    sunder_i_cover_result result = {.hidden = hidden};
    sunder_error err;
    for (uint32_t f = 0; f < N; f++) {
        cost[f] = (sunder_hiding_cost){1, 1000};
        for (uint32_t g = f + 1; g < N; g++) add(&clauses, (uint32_t[]){f, g}, 2, true);
    }
    assert_int_equal(sunder_i_cover_find(&clauses, true, cost, N, 1000, &result, &err), SUNDER_OK);
    assert_int_equal(result.components, 1);
    assert_int_equal(result.exact, 1);
    for (uint32_t f = 0; f < N; f++) assert_int_equal(hidden[f], f + 1 < N);
    sunder_i_clauses_free(&clauses);
}

static void check_clauses(void **state)
{
    (void)state;
    sunder_i_clauses clauses = {0};
    const uint32_t pair[] = {3, 7}, more[] = {3, 7, 9};
    bool added;
    assert_true(sunder_i_clauses_add(&clauses, pair, 2, 0, false, &added) && added);
    assert_true(sunder_i_clauses_add(&clauses, more, 3, 0, true, &added) && added);
    assert_true(sunder_i_clauses_add(&clauses, pair, 2, 0, false, &added) && !added);
    assert_true(sunder_i_clauses_add(&clauses, pair, 2, 0, true, &added) && added);
    assert_true(sunder_i_clauses_add(&clauses, pair, 2, 0, false, &added) && !added);
    assert_int_equal(clauses.n, 2);
    assert_true(clauses.clause[0].proved);
    sunder_i_clauses_free(&clauses);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_random), cmocka_unit_test(check_clique),
                                       cmocka_unit_test(check_clauses)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
