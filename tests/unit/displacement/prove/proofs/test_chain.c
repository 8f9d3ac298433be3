/* displacement/prove/proofs/chain: each remaining pair of a long row is proved to have no room, with the fewest links,
 * in a number of steps that grows linearly with the row. Also the common line of several ways out of one obstacle. */
#include "polyset.h"
#include "scene_model.h"

#include "displacement/prove/proofs/chain.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ---- A row ------------------------------------------------------------------------------------------------------- */

/* Squares of side 10 at a spacing of 12, which have to be 3 apart: each pair lacks 1. At four places, a fifth of the
 * row apart, the pair is solved, by moves of 2, 1, 0, 1 and 2; the other pairs are left. */
typedef struct row {
    sunder_feature *feature;
    size_t n;
    scene_model of;
    uint32_t *body;
    sunder_i_requirement *required;
    sunder_i_subproblem cluster;
} row;

enum { SOLVED = 4 };

static bool is_solved(const row *r, size_t pair)
{
    for (size_t k = 1; k <= SOLVED; k++)
        if (pair == k * r->n / (SOLVED + 1)) return true;
    return false;
}

static void set_up(row *r, size_t n, double limit)
{
    sunder_layer_options options;
    double move = -2;
    memset(r, 0, sizeof *r);
    r->n = n;
    r->feature = calloc(n, sizeof *r->feature);
    r->body = calloc(n, sizeof *r->body);
    r->required = calloc(n, sizeof *r->required);
    assert_true(r->feature && r->body && r->required);
    for (size_t k = 0; k < n; k++) {
        char wkt[200];
        snprintf(wkt, sizeof wkt, "POLYGON ((%zu 0, %zu 0, %zu 10, %zu 10))", 12 * k, 12 * k + 10, 12 * k + 10, 12 * k);
        r->feature[k] =
            (sunder_feature){.shape = polyset_shape_of_wkt(wkt), .weight = 1, .max_shift = limit, .block = -1};
        assert_non_null(r->feature[k].shape);
    }
    sunder_layer_options_init(&options);
    options.gap = 3;
    options.no_blocks = true;
    scene_model_related_features(&r->of, r->feature, n, &options);
    sunder_i_model *model = &r->of.model;
    for (size_t k = 0; k < n; k++) {
        const uint32_t b = model->body_of[k];
        assert_int_equal(b, k); /* from left to right */
        r->body[k] = b;
        model->move[2 * (size_t)b] = move;
        if (k + 1 == n) break;
        if (is_solved(r, k))
            move++;
        else
            r->required[r->cluster.required_n++] =
                (sunder_i_requirement){.a = (uint32_t)k, .b = (uint32_t)k + 1, .clearance = 2};
    }
    assert_true(move == 2);
    r->cluster.model = model;
    r->cluster.reserve = r->body;
    r->cluster.reserves = n;
    r->cluster.farthest = limit;
    r->cluster.required = r->required;
    r->cluster.most = 64;
}

static void end(row *r)
{
    scene_model_end(&r->of);
    for (size_t k = 0; k < r->n; k++) sunder_shape_free((sunder_shape *)(uintptr_t)r->feature[k].shape);
    free(r->feature);
    free(r->body);
    free(r->required);
}

/* The links from this pair, or the first pair that is solved, to the last. */
static size_t links_of(const row *r, size_t pair)
{
    const size_t first = r->n / (SOLVED + 1), last = SOLVED * r->n / (SOLVED + 1);
    return (pair > last ? pair : last) - (pair < first ? pair : first);
}

/* Tries to prove all pairs that are left. Returns the most steps that one of them took. */
static uint64_t ask(const row *r, bool has_proof)
{
    sunder_error err;
    sunder_i_chains *chains = sunder_i_chains_new(&r->cluster, false);
    uint64_t most = 0, all = 0;
    assert_non_null(chains);
    for (size_t k = 0; k < r->cluster.required_n; k++) {
        const uint32_t body[2] = {r->required[k].a, r->required[k].b};
        sunder_i_subproblem q = r->cluster;
        sunder_i_decision decision;
        size_t links;
        q.a = body[0];
        q.b = body[1];
        q.body = body;
        q.bodies = 2;
        assert_int_equal(sunder_i_chains_decide(chains, &q, &decision, &links, &err), SUNDER_OK);
        assert_int_equal(decision.verdict, has_proof ? SUNDER_I_INFEASIBLE : SUNDER_I_UNKNOWN);
        assert_int_equal(decision.proof != NULL, has_proof);
        if (has_proof) assert_int_equal(links, links_of(r, q.a));
        all += decision.work;
        if (k && decision.work > most) most = decision.work; /* the first one takes more, since it finds the links */
        sunder_i_decision_clear(&decision);
    }
    assert_true(all > 0);
    sunder_i_chains_free(chains);
    return most;
}

static void test_row(void **state)
{
    (void)state;
    row r;
    set_up(&r, 50, 2);
    const uint64_t few = ask(&r, true);
    end(&r);
    set_up(&r, 500, 2);
    const uint64_t many = ask(&r, true);
    end(&r);
    print_message("%llu steps of 50, %llu of 500\n", (unsigned long long)few, (unsigned long long)many);
    assert_true(many < 12 * few && many < 500 * 200);
}

/* There would be room to solve a fifth pair. */
static void test_room(void **state)
{
    (void)state;
    row r;
    set_up(&r, 200, 2.5);
    assert_true(ask(&r, false) < 200 * 100);
    end(&r);
}

/* ---- One line for several ways out ------------------------------------------------------------------------------- */

static sunder_i_half_plane way_of(double angle, double d)
{
    return (sunder_i_half_plane){.n = {cos(angle), sin(angle)}, .d = d};
}

/* Each place that is within reach and beyond one of the ways is beyond the line; the ends of the ways' arcs touch
 * it. */
static void test_chord(void **state)
{
    (void)state;
    enum { TURNS = 360, RINGS = 8 };
    const double reach = 4;
    sunder_i_branching c = {0};
    assert_true(sunder_i_reserve(&c.scratch, &c.scratch_capacity, 8, sizeof *c.scratch));
    const sunder_i_half_plane ways[] = {way_of(3, 3.5), way_of(3.3, 3), way_of(-2.9, 3.6), way_of(0, 9),
                                        way_of(1.5, 4.5)};
    const size_t n = sizeof ways / sizeof *ways;
    memcpy(c.scratch, ways, sizeof ways);
    assert_int_equal(sunder_i_chain_half_planes(&c, n, reach), n + 1);
    double least = INFINITY;
    for (int k = 0; k < TURNS; k++)
        for (int l = 1; l <= RINGS; l++) {
            const double r = reach * l / RINGS, u[2] = {r * cos(0.0174532925 * k), r * sin(0.0174532925 * k)};
            bool beyond = false;
            for (size_t m = 0; m < n; m++) beyond = beyond || ways[m].n[0] * u[0] + ways[m].n[1] * u[1] >= ways[m].d;
            const double off = c.scratch[0].n[0] * u[0] + c.scratch[0].n[1] * u[1] - c.scratch[0].d;
            if (beyond) assert_true(off > 0);
            if (beyond) least = fmin(least, off);
        }
    assert_true(least < 0.05 * reach);
    for (size_t m = 1; m <= n; m++) assert_false(sunder_i_chain_is_open_behind(&c.scratch[m], &c.scratch[0], reach));
    sunder_i_free(c.scratch);
}

/* One of the ways is enough if it bounds the others: for a wall, and for a corner whose other sides lie behind it. */
static void test_only_way(void **state)
{
    (void)state;
    sunder_i_half_plane wall[] = {way_of(0, 9), way_of(0.4, 3.6), way_of(-0.2, 1)},
                        apart[] = {way_of(0, 3), way_of(3, 3)};
    assert_true(sunder_i_chain_only_half_plane(wall, 3, 4));
    assert_true(wall[0].d == 1);
    assert_false(sunder_i_chain_only_half_plane(apart, 2, 4));
    assert_true(sunder_i_chain_is_open(&apart[0], 3) && !sunder_i_chain_is_open(&apart[0], 2.9));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_row), cmocka_unit_test(test_room),
                                       cmocka_unit_test(test_chord), cmocka_unit_test(test_only_way)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
