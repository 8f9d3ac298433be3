/* The cheapest levels of features, beside a search through all choices. */
#include "displacement/hide/cover.h"

#include "base/random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 7, CLASSES = 4, LEVELS = 2 };

static size_t below(uint64_t *stream, uint64_t n) { return (size_t)(sunder_i_draw(stream) % n); }

static void add(sunder_i_clauses *clauses, const uint32_t *member, const uint32_t *level, size_t n, bool proved)
{
    static const uint32_t none[MOST];
    bool added;
    assert_true(sunder_i_clauses_add(clauses, member, level ? level : none, n, 0, proved, &added));
}

/* The cost of a choice: what is hidden of each class, and what is smaller. */
static void cost_of(const sunder_layer *layer, const uint32_t *choice, int64_t cost[CLASSES + 1])
{
    memset(cost, 0, (CLASSES + 1) * sizeof *cost);
    for (size_t f = 0; f < layer->n; f++) {
        size_t n;
        const sunder_level *smaller = sunder_i_levels_of(layer, f, &n);
        if (choice[f] > n)
            cost[layer->hiding[f].hierarchy] += layer->hiding[f].weight;
        else if (choice[f])
            cost[CLASSES] += smaller[choice[f] - 1].cost;
    }
}

static bool is_better(const sunder_layer *layer, const uint32_t *p, const uint32_t *q)
{
    int64_t a[CLASSES + 1], b[CLASSES + 1];
    cost_of(layer, p, a);
    cost_of(layer, q, b);
    for (size_t k = 0; k <= CLASSES; k++)
        if (a[k] != b[k]) return a[k] < b[k];
    for (size_t f = 0; f < layer->n; f++)
        if (p[f] != q[f]) return p[f] > q[f];
    return false;
}

static bool covers(const sunder_i_clauses *clauses, bool proved_only, const uint32_t *choice)
{
    for (size_t k = 0; k < clauses->n; k++) {
        const sunder_i_clause *c = &clauses->clause[k];
        bool met = c->n == 0 || (proved_only && !c->proved);
        for (size_t m = 0; m < c->n; m++)
            met = met || choice[clauses->item[c->first + m]] > clauses->level[c->first + m];
        if (!met) return false;
    }
    return true;
}

/* Sets choice to the next one in order; returns false after the last one. */
static bool next_choice(const sunder_layer *layer, uint32_t *choice)
{
    for (size_t f = 0; f < layer->n; f++) {
        if (choice[f] < sunder_i_last_level(layer, f)) {
            choice[f]++;
            return true;
        }
        choice[f] = 0;
    }
    return false;
}

static void best_of_all(const sunder_i_clauses *clauses, bool proved_only, const sunder_layer *layer, uint32_t *best)
{
    uint32_t choice[MOST] = {0};
    bool found = false;
    do {
        if (!covers(clauses, proved_only, choice) || (found && !is_better(layer, choice, best))) continue;
        memcpy(best, choice, sizeof choice);
        found = true;
    } while (next_choice(layer, choice));
    assert_true(found);
}

/* A layer of up to MOST features with costs alone, and clauses that can be satisfied. */
typedef struct world {
    sunder_layer layer;
    sunder_hiding_cost hiding[MOST];
    sunder_level level[MOST * LEVELS];
    size_t level_end[MOST];
    sunder_i_clauses clauses;
} world;

static void draw_world(world *w, uint64_t *stream)
{
    memset(w, 0, sizeof *w);
    const uint32_t classes = 1 + (uint32_t)below(stream, CLASSES - 1);
    const uint64_t weights = below(stream, 3) ? 1 + below(stream, 5) : 1, levels = below(stream, LEVELS + 1);
    w->layer = (sunder_layer){.n = 1 + below(stream, MOST), .hiding = w->hiding};
    if (levels) {
        w->layer.level = w->level;
        w->layer.level_end = w->level_end;
    }
    for (size_t f = 0, end = 0; f < w->layer.n; f++) {
        w->hiding[f] = (sunder_hiding_cost){(uint32_t)below(stream, classes + (levels > 0)) + !levels,
                                            1 + (int64_t)below(stream, weights)};
        const size_t first = end;
        end += below(stream, levels + 1);
        for (size_t k = first; k < end; k++)
            w->level[k].cost = (k > first ? w->level[k - 1].cost : 0) + 1 + (int64_t)below(stream, 4);
        w->level_end[f] = end;
    }
    for (size_t k = below(stream, 2 * MOST); k-- > 0;) {
        uint32_t member[4], level[4];
        const size_t drawn = 1 + below(stream, 4);
        for (size_t m = 0; m < drawn; m++) member[m] = (uint32_t)below(stream, w->layer.n);
        const size_t n = sunder_i_set_make(member, drawn);
        size_t kept = 0;
        for (size_t m = 0; m < n; m++) {
            const uint32_t last = sunder_i_last_level(&w->layer, member[m]);
            if (last == 0) continue;
            level[kept] = (uint32_t)below(stream, last);
            member[kept++] = member[m];
        }
        if (kept) add(&w->clauses, member, level, kept, below(stream, 3) > 0);
    }
}

static void check_random(void **state)
{
    (void)state;
    uint64_t stream = 1;
    for (int round = 0; round < 3000; round++) {
        world w;
        uint32_t level[MOST], best[MOST] = {0};
        bool sure[MOST];
        sunder_i_cover_result result = {.level = level, .sure = sure};
        sunder_error err;
        draw_world(&w, &stream);
        for (int proved = 0; proved < 2; proved++) {
            const sunder_i_cover_demand demand = proved ? SUNDER_I_COVER_PROVED : SUNDER_I_COVER_ALL;
            assert_int_equal(sunder_i_cover_find(&w.clauses, demand, &w.layer, 100000, &result, &err), SUNDER_OK);
            assert_int_equal(result.exact, result.components);
            best_of_all(&w.clauses, proved, &w.layer, best);
            assert_memory_equal(level, best, w.layer.n * sizeof *level);
        }
        sunder_i_clauses_free(&w.clauses);
    }
}

/* With what the best choice hides, its other levels cost no more than any that satisfy the rest of the clauses. */
static void check_shrinking(void **state)
{
    (void)state;
    uint64_t stream = 2;
    for (int round = 0; round < 1000; round++) {
        world w;
        uint32_t level[MOST], best[MOST] = {0};
        int64_t cost[2][CLASSES + 1];
        sunder_i_cover_result result = {.level = level};
        sunder_error err;
        draw_world(&w, &stream);
        best_of_all(&w.clauses, true, &w.layer, best);
        memcpy(level, best, sizeof level);
        assert_int_equal(sunder_i_cover_find(&w.clauses, SUNDER_I_COVER_SHRINKING, &w.layer, 100000, &result, &err),
                         SUNDER_OK);
        for (size_t f = 0; f < w.layer.n; f++) assert_false(sunder_i_is_hidden_at(&w.layer, f, level[f]));
        cost_of(&w.layer, level, cost[0]);
        cost_of(&w.layer, best, cost[1]);
        assert_int_equal(cost[0][CLASSES], cost[1][CLASSES]);
        sunder_i_clauses_free(&w.clauses);
    }
}

/* All of n features exclude each other: all but the last are hidden. */
static void check_clique(void **state)
{
    (void)state;
    enum { N = 60 };
    sunder_i_clauses clauses = {0};
    sunder_hiding_cost cost[N];
    const sunder_layer layer = {.n = N, .hiding = cost};
    uint32_t level[N];
    sunder_i_cover_result result = {.level = level};
    sunder_error err;
    for (uint32_t f = 0; f < N; f++) {
        cost[f] = (sunder_hiding_cost){1, 1000};
        for (uint32_t g = f + 1; g < N; g++) add(&clauses, (uint32_t[]){f, g}, NULL, 2, true);
    }
    assert_int_equal(sunder_i_cover_find(&clauses, SUNDER_I_COVER_PROVED, &layer, 1000, &result, &err), SUNDER_OK);
    assert_int_equal(result.components, 1);
    assert_int_equal(result.exact, 1);
    for (uint32_t f = 0; f < N; f++) assert_int_equal(level[f], f + 1 < N);
    sunder_i_clauses_free(&clauses);
}

static void check_clauses(void **state)
{
    (void)state;
    sunder_i_clauses clauses = {0};
    const uint32_t pair[] = {3, 7}, more[] = {3, 7, 9}, none[3] = {0}, other[] = {0, 1};
    bool added;
    assert_true(sunder_i_clauses_add(&clauses, pair, none, 2, 0, false, &added) && added);
    assert_true(sunder_i_clauses_add(&clauses, more, none, 3, 0, true, &added) && added);
    assert_true(sunder_i_clauses_add(&clauses, pair, none, 2, 0, false, &added) && !added);
    assert_true(sunder_i_clauses_add(&clauses, pair, none, 2, 0, true, &added) && added);
    assert_true(sunder_i_clauses_add(&clauses, pair, none, 2, 0, false, &added) && !added);
    assert_true(sunder_i_clauses_add(&clauses, pair, other, 2, 0, false, &added) && added);
    assert_int_equal(clauses.n, 3);
    assert_true(clauses.clause[0].proved);
    sunder_i_clauses_free(&clauses);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_random), cmocka_unit_test(check_shrinking),
                                       cmocka_unit_test(check_clique), cmocka_unit_test(check_clauses)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
