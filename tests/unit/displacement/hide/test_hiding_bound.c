/* The bound of what has to be hidden, beside a search through all subsets. */
#include "displacement/hide/hiding_bound.h"

#include "base/list.h"
#include "base/random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 10, CLASSES = 4 };

static size_t below(uint64_t *stream, uint64_t n) { return (size_t)(sunder_i_draw(stream) % n); }

static void add_costs(const sunder_hiding_cost *cost, size_t n, uint32_t choice, int64_t sum[CLASSES])
{
    memset(sum, 0, CLASSES * sizeof *sum);
    for (size_t f = 0; f < n; f++)
        if (choice >> f & 1) sum[cost[f].hierarchy] += cost[f].weight;
}

static int compare(const int64_t *p, const int64_t *q)
{
    for (size_t k = 0; k < CLASSES; k++)
        if (p[k] != q[k]) return p[k] < q[k] ? -1 : 1;
    return 0;
}

/* Returns a best choice for the proved clauses, as a set of bits. */
static uint32_t best_choice(const sunder_i_clauses *clauses, const sunder_hiding_cost *cost, size_t n)
{
    uint32_t best = UINT32_MAX;
    int64_t least[CLASSES] = {0}, sum[CLASSES];
    for (uint32_t choice = 0; choice < UINT32_C(1) << n; choice++) {
        bool covers = true;
        for (size_t k = 0; k < clauses->n && covers; k++) {
            const sunder_i_clause *c = &clauses->clause[k];
            bool hit = !c->proved;
            for (size_t m = 0; m < c->n; m++) hit = hit || (choice >> clauses->item[c->first + m] & 1);
            covers = hit;
        }
        add_costs(cost, n, choice, sum);
        if (!covers || (best != UINT32_MAX && compare(sum, least) >= 0)) continue;
        best = choice;
        memcpy(least, sum, sizeof least);
    }
    return best;
}

static void draw_clauses(uint64_t *stream, size_t n, sunder_i_clauses *clauses)
{
    for (size_t k = below(stream, 2 * MOST); k-- > 0;) {
        uint32_t member[4];
        bool added;
        const size_t drawn = 1 + below(stream, 4);
        for (size_t m = 0; m < drawn; m++) member[m] = (uint32_t)below(stream, n);
        assert_true(sunder_i_clauses_add(clauses, member, (const uint32_t[4]){0}, sunder_i_set_make(member, drawn), 0,
                                         below(stream, 4) > 0, &added));
    }
}

/* Computes the bound with this effort, and compares it with the cost of a best choice. Returns the order of the two. */
static int compare_bound(const sunder_i_clauses *clauses, const sunder_hiding_cost *cost, size_t n, uint32_t choice,
                         size_t effort)
{
    const sunder_layer layer = {.n = n, .hiding = (sunder_hiding_cost *)cost};
    uint32_t best[MOST];
    sunder_error err;
    sunder_i_hiding_bound bound = {0};
    int64_t proved[CLASSES] = {0}, least[CLASSES];
    for (size_t f = 0; f < n; f++) best[f] = choice >> f & 1;
    assert_int_equal(sunder_i_hiding_bound_find(clauses, &layer, best, effort, &bound, &err), SUNDER_OK);
    for (size_t t = 0; t < bound.trees; t++)
        for (size_t k = bound.tree[t].bound; k < bound.tree[t].bound + bound.tree[t].bounds; k++) {
            assert_true(bound.share[k].weight >= 0);
            proved[bound.share[k].hierarchy] += bound.share[k].weight;
        }
    add_costs(cost, n, choice, least);
    sunder_i_free_all(bound.tree, bound.node, bound.share);
    return compare(proved, least);
}

static void reaches_the_best_choice(void **state)
{
    (void)state;
    uint64_t stream = 7;
    for (int round = 0; round < 3000; round++) {
        sunder_i_clauses clauses = {0};
        sunder_hiding_cost cost[MOST];
        const size_t n = 1 + below(&stream, MOST);
        const uint32_t classes = 1 + (uint32_t)below(&stream, CLASSES - 1);
        const uint64_t weights = round % 3 ? 1 + below(&stream, 5) : 1;
        for (size_t f = 0; f < n; f++)
            cost[f] = (sunder_hiding_cost){1 + (uint32_t)below(&stream, classes), 1 + (int64_t)below(&stream, weights)};
        draw_clauses(&stream, n, &clauses);
        const uint32_t choice = best_choice(&clauses, cost, n);
        assert_int_equal(compare_bound(&clauses, cost, n, choice, 10000), 0);
        assert_true(compare_bound(&clauses, cost, n, choice, 0) <= 0);
        /* a choice that is not the best one is no bound */
        assert_true(compare_bound(&clauses, cost, n, (UINT32_C(1) << n) - 1, 10000) <= 0);
        sunder_i_clauses_free(&clauses);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(reaches_the_best_choice)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
