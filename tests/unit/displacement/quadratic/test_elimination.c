/* Elimination orders: each ranks all nodes, and gives the same neighbours as eliminating one node after the other in
 * that order, with sets. For points that are connected with near ones, nested dissection takes less work than minimum
 * degree; a graph without a small separator is declined. */
#include "displacement/quadratic/elimination.h"
#include "random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 120 };

typedef struct drawn {
    size_t n, pairs;
    double place[2 * MOST];
    sunder_i_id_pair pair[MOST * MOST];
    bool joined[MOST][MOST];
} drawn;

static void join(drawn *g, uint32_t a, uint32_t b)
{
    if (a == b) return;
    g->pair[g->pairs++] = (sunder_i_id_pair){a, b};
    g->joined[a][b] = g->joined[b][a] = true;
}

/* Draws points, some of them at one place or on one line, joined if they are near; sometimes one more, far away. */
static void draw(rng *r, drawn *g)
{
    memset(g, 0, sizeof *g);
    g->n = (size_t)rng_int(r, 1, MOST);
    const int64_t side = rng_int(r, 0, 30);
    const double near = (double)rng_int(r, 1, 5);
    for (size_t k = 0; k < 2 * g->n; k++) g->place[k] = (double)rng_int(r, 0, k % 2 && rng_once_in(r, 3) ? 0 : side);
    for (uint32_t a = 0; a < g->n; a++)
        for (uint32_t b = a + 1; b < g->n; b++) {
            const double x = g->place[2 * a] - g->place[2 * b], y = g->place[2 * a + 1] - g->place[2 * b + 1];
            if (x * x + y * y <= near * near || rng_once_in(r, 400)) join(g, a, b);
        }
}

static void check_columns(drawn *g, const sunder_i_elimination *e, size_t trial)
{
    uint32_t by_rank[MOST];
    bool ranked[MOST] = {false};
    for (uint32_t v = 0; v < g->n; v++) {
        assert_true(e->rank[v] < g->n && !ranked[e->rank[v]]);
        ranked[e->rank[v]] = true;
        by_rank[e->rank[v]] = v;
    }
    for (size_t turn = 0; turn < g->n; turn++) {
        const uint32_t v = by_rank[turn];
        size_t left = 0;
        for (uint32_t a = 0; a < g->n; a++) {
            if (e->rank[a] <= turn || !g->joined[v][a]) continue;
            left++;
            for (uint32_t b = 0; b < g->n; b++)
                if (b != a && e->rank[b] > turn && g->joined[v][b]) g->joined[a][b] = true;
        }
        if (e->near[v].n != left) fail_msg("trial %zu: %zu neighbours of %u and not %zu", trial, e->near[v].n, v, left);
        for (size_t k = 0; k < e->near[v].n; k++)
            assert_true(g->joined[v][e->near[v].item[k]] && e->rank[e->near[v].item[k]] > turn);
    }
}

static void check_drawn(void **state)
{
    (void)state;
    static drawn g;
    size_t dissected = 0, left = 0;
    for (size_t trial = 0; trial < test_count(400); trial++) {
        rng r = rng_start(test_seed(), trial);
        draw(&r, &g);
        uint32_t rank[MOST];
        sunder_i_elimination e;
        bool done = false;
        assert_true(sunder_i_elimination_init(&e, g.n, g.pair, g.pairs, rank));
        if (trial % 4) assert_true(sunder_i_dissect(&e, g.place, &done));
        *(done ? &dissected : &left) += 1;
        if (!done) assert_true(sunder_i_minimum_degree(&e));
        check_columns(&g, &e, trial);
        sunder_i_elimination_free(&e);
    }
    printf("%zu dissected, %zu not\n", dissected, left);
    assert_true(dissected > 0 && left > 0);
}

/* The number of products of entries that the factorisation takes. */
static size_t count_work(size_t n, const sunder_i_id_pair *pair, size_t pairs, const double *place, bool *done)
{
    uint32_t *rank = malloc(n * sizeof *rank);
    sunder_i_elimination e;
    size_t work = 0;
    assert_true(sunder_i_elimination_init(&e, n, pair, pairs, rank));
    *done = false;
    if (place) assert_true(sunder_i_dissect(&e, place, done));
    if (!place) assert_true(sunder_i_minimum_degree(&e));
    for (size_t v = 0; v < n; v++) work += e.near[v].n * (e.near[v].n + 1) / 2;
    sunder_i_elimination_free(&e);
    free(rank);
    return work;
}

static void check_grid(void **state)
{
    (void)state;
    enum { SIDE = 70, N = SIDE * SIDE };
    static sunder_i_id_pair pair[4 * N];
    static double place[2 * N];
    size_t pairs = 0;
    for (int k = 0; k < N; k++) {
        place[2 * k] = k % SIDE;
        place[2 * k + 1] = k / SIDE;
        for (int e = 0; e < 4; e++) {
            const int dx[] = {1, 0, 1, -1}, dy[] = {0, 1, 1, 1}, x = k % SIDE + dx[e], y = k / SIDE + dy[e];
            if (x >= 0 && x < SIDE && y < SIDE)
                pair[pairs++] = (sunder_i_id_pair){(uint32_t)k, (uint32_t)(y * SIDE + x)};
        }
    }
    bool done;
    const size_t least = count_work(N, pair, pairs, NULL, &done), dissected = count_work(N, pair, pairs, place, &done);
    assert_true(done && dissected < least);
}

static void check_star(void **state)
{
    (void)state;
    enum { N = 1000 };
    static sunder_i_id_pair pair[N];
    static double place[2 * N];
    for (int k = 0; k < N; k++) {
        place[2 * k] = k;
        if (k != N / 2) pair[k] = (sunder_i_id_pair){N / 2, (uint32_t)k};
    }
    pair[N / 2] = pair[0];
    bool done;
    const size_t work = count_work(N, pair, N, NULL, &done);
    assert_true(work == N - 1);
    count_work(N, pair, N, place, &done);
    assert_true(done); /* one node separates all others: it comes last */
    for (int k = 0; k < N; k++) pair[k] = (sunder_i_id_pair){(uint32_t)k, (uint32_t)((k + N / 2) % N)};
    count_work(N, pair, N, place, &done);
    assert_false(done); /* each node is connected with one of the other half: no small separator */
}

int main(void)
{
    printf("seed %llu\n", (unsigned long long)test_seed());
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_drawn), cmocka_unit_test(check_grid),
                                       cmocka_unit_test(check_star)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
