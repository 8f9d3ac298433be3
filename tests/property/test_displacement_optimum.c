/* The optimum of small layers, by a branch and bound of its own (support/optimum.c), beside what the library says: its
 * cost is no less than the optimum, its lower bound no more.
 *
 * A layer is a few features of convex parts, on a coarse grid, so that they touch, share edges, lie in each other and
 * in each other's holes; with and without a gap, weights, limits, fixed ones and blocks. Where pairs stay in conflict
 * the optimum is that of all others, and what is said to have no solution has none. */
#include "optimum.h"
#include "random.h"
#include "run_layer.h"

#include "sunder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 5, PARTS = 4, CORNERS = 16 };

/* The optimum is found to this, relative to itself; what is said of it may be off by as much, and by what a place of
 * optimum.c may miss. */
static const double CLOSE = 1e-8;

typedef struct part {
    double xy[8];
    size_t corners;
} part;

typedef struct house {
    part part[PARTS];
    size_t parts;
    double xy[2 * CORNERS]; /* the outline */
    size_t ring_end[2], rings;
    double weight, limit;
    int64_t block;
    bool fixed;
} house;

typedef struct hamlet {
    house house[MOST];
    size_t n;
    double gap;
} hamlet;

/* ---- Layers */

static void add_box(house *h, double x, double y, double w, double d)
{
    const double xy[8] = {x, y, x + w, y, x + w, y + d, x, y + d};
    part *p = &h->part[h->parts++];
    memcpy(p->xy, xy, sizeof xy);
    p->corners = 4;
}

static void set_outline(house *h, const double *xy, size_t outer, size_t inner)
{
    memcpy(h->xy, xy, 2 * (outer + inner) * sizeof *xy);
    h->ring_end[0] = outer;
    h->ring_end[1] = outer + inner;
    h->rings = inner ? 2 : 1;
}

/* In units of the grid: a box, a triangle, a slanted quadrangle, an L, a U, a frame round a yard. */
static void build(rng *r, house *h, double x, double y, double unit)
{
    const double w = unit * (double)rng_int(r, 3, 8), d = unit * (double)rng_int(r, 3, 8), a = unit, b = unit;
    *h = (house){.weight = 1, .limit = INFINITY, .block = -1};
    const double lean = unit * (double)rng_int(r, 0, 2);
    const double triangle[] = {x, y, x + w, y + lean, x + lean, y + d};
    const double slanted[] = {x, y, x + w, y + lean, x + w + lean, y + lean + d, x + lean, y + d};
    const double box[] = {x, y, x + w, y, x + w, y + d, x, y + d};
    const double l[] = {x, y, x + w, y, x + w, y + b, x + a, y + b, x + a, y + d, x, y + d};
    const double u[] = {x,         y,     x + w, y,     x + w, y + d, x + w - a, y + d,
                        x + w - a, y + b, x + a, y + b, x + a, y + d, x,         y + d};
    const double frame[] = {x,     y,     x + w, y,         x + w,     y + d,     x,         y + d,
                            x + a, y + b, x + a, y + d - b, x + w - a, y + d - b, x + w - a, y + b};
    switch (rng_int(r, 0, 6)) {
    case 0:
        set_outline(h, triangle, 3, 0);
        h->part[h->parts].corners = 3;
        memcpy(h->part[h->parts++].xy, triangle, sizeof triangle);
        break;
    case 1:
        set_outline(h, slanted, 4, 0);
        h->part[h->parts].corners = 4;
        memcpy(h->part[h->parts++].xy, slanted, sizeof slanted);
        break;
    case 2:
        set_outline(h, l, 6, 0);
        add_box(h, x, y, w, b);
        add_box(h, x, y + b, a, d - b);
        break;
    case 3:
        set_outline(h, u, 8, 0);
        add_box(h, x, y, w, b);
        add_box(h, x, y + b, a, d - b);
        add_box(h, x + w - a, y + b, a, d - b);
        break;
    case 4:
        set_outline(h, frame, 4, 4);
        add_box(h, x, y, w, b);
        add_box(h, x, y + d - b, w, b);
        add_box(h, x, y + b, a, d - 2 * b);
        add_box(h, x + w - a, y + b, a, d - 2 * b);
        break;
    default: set_outline(h, box, 4, 0); add_box(h, x, y, w, d);
    }
}

static void found(rng *r, hamlet *t, size_t n)
{
    const double unit = rng_once_in(r, 2) ? 1 : 0.125 * (double)rng_int(r, 1, 12);
    const double x = rng_once_in(r, 3) ? 400000 : 0, y = x * 13;
    const bool weights = rng_once_in(r, 3), limits = rng_once_in(r, 3), fixed = rng_once_in(r, 4);
    t->n = n;
    t->gap = rng_once_in(r, 2) ? 0 : unit * 0.25 * (double)rng_int(r, 1, 8);
    for (size_t k = 0; k < n; k++) {
        house *h = &t->house[k];
        build(r, h, x + unit * (double)rng_int(r, 0, 9), y + unit * (double)rng_int(r, 0, 9), unit);
        if (weights) h->weight = (double)rng_int(r, 1, 32) / 8;
        if (limits && rng_once_in(r, 2)) h->limit = unit * (double)rng_int(r, 0, 24) / 4;
        h->fixed = fixed && rng_once_in(r, 3);
    }
    if (n > 2 && rng_once_in(r, 4)) t->house[0].block = t->house[n - 1].block = 7;
}

static sunder_report *separate(const hamlet *t)
{
    sunder_shape *shape[MOST];
    sunder_feature feature[MOST];
    sunder_error err;
    sunder_layer_options options;
    sunder_layer_options_init(&options);
    options.gap = t->gap;
    options.touch_tolerance = 0;
    options.no_blocks = true;
    options.contained = SUNDER_CONTAINMENT_SEPARATE;
    options.allow_jumps = true;
    for (size_t k = 0; k < t->n; k++) {
        const house *h = &t->house[k];
        if (sunder_shape_from_rings(h->xy, h->ring_end, &h->rings, 1, SUNDER_VALIDITY_STRICT, &shape[k], &err))
            fail_msg("%s", err.message);
        feature[k] = (sunder_feature){
            .shape = shape[k], .weight = h->weight, .max_shift = h->limit, .block = h->block, .fixed = h->fixed};
    }
    sunder_report *report = run_separate(feature, t->n, &options);
    for (size_t k = 0; k < t->n; k++) sunder_shape_free(shape[k]);
    return report;
}

/* ---- The same as a problem of optimum.h */

static bool is_listed(const sunder_conflict *c, size_t n, size_t a, size_t b)
{
    for (size_t k = 0; k < n; k++)
        if (c[k].a == a && c[k].b == b) return true;
    return false;
}

/* body_of: features of one block are one body. */
static void set_bodies(const hamlet *t, optimum_problem *m, size_t body_of[MOST])
{
    for (size_t k = 0; k < t->n; k++) {
        const house *h = &t->house[k];
        body_of[k] = m->bodies;
        for (size_t j = 0; j < k; j++)
            if (h->block >= 0 && t->house[j].block == h->block) body_of[k] = body_of[j];
        if (body_of[k] == m->bodies) m->body[m->bodies++] = (optimum_body){0, INFINITY};
        optimum_body *body = &m->body[body_of[k]];
        body->weight += h->weight;
        body->limit = h->fixed ? 0 : fmin(body->limit, h->limit);
    }
}

static void add_pair(const hamlet *t, optimum_problem *m, const size_t body_of[MOST], size_t a, size_t b)
{
    for (size_t i = 0; i < t->house[a].parts; i++)
        for (size_t j = 0; j < t->house[b].parts; j++) {
            const part *p = &t->house[a].part[i], *q = &t->house[b].part[j];
            optimum_keep_apart(m, body_of[a], body_of[b], p->xy, p->corners, q->xy, q->corners, t->gap);
        }
}

/* All pairs of features but those listed; and the one pair besides, if there is one. */
static void pose(const hamlet *t, const sunder_conflict *c, size_t listed, const sunder_conflict *besides,
                 optimum_problem *m)
{
    size_t body_of[MOST];
    *m = (optimum_problem){.bodies = 0};
    set_bodies(t, m, body_of);
    for (size_t b = 1; b < t->n; b++)
        for (size_t a = 0; a < b; a++)
            if (body_of[a] != body_of[b] &&
                (!is_listed(c, listed, a, b) || (besides && besides->a == a && besides->b == b)))
                add_pair(t, m, body_of, a, b);
}

/* The pair alone. */
static void pose_pair(const hamlet *t, const sunder_conflict *c, optimum_problem *m)
{
    size_t body_of[MOST];
    *m = (optimum_problem){.bodies = 0};
    set_bodies(t, m, body_of);
    add_pair(t, m, body_of, c->a, c->b);
}

/* ---- What is asked */

typedef struct tally {
    size_t layers, open, optimal, dearer, infeasible, unresolved, resolvable;
    double worst;
} tally;

/* What is said to have no solution has none: none within the limits, whatever that costs. */
static void check_verdict(const hamlet *t, const sunder_conflict *c, size_t n, const sunder_conflict *own, size_t trial,
                          tally *sum)
{
    optimum_problem m;
    const bool proved = own->reason == SUNDER_REASON_MAX_SHIFT || own->reason == SUNDER_REASON_NO_ROOM;
    if (!proved && own->reason != SUNDER_REASON_UNRESOLVED) return;
    if (own->reason == SUNDER_REASON_MAX_SHIFT)
        pose_pair(t, own, &m);
    else
        pose(t, c, n, own, &m);
    double most = 1;
    for (size_t k = 0; k < m.bodies; k++)
        most += m.body[k].weight * (isinf(m.body[k].limit) ? 1e6 : m.body[k].limit * m.body[k].limit);
    const optimum_answer answer = optimum_find(&m, most, 0.5, 20000);
    const bool solvable = answer.high < INFINITY;
    sum->infeasible += proved;
    sum->unresolved += !proved;
    sum->resolvable += !proved && solvable;
    /* A proof may stand on other listed pairs, which are held to what they had; the problem leaves them out. */
    if (proved && solvable && (own->reason == SUNDER_REASON_MAX_SHIFT || n == 1))
        fail_msg("seed %llu, case %zu: %zu and %zu are said to have no solution, but have one of cost %.17g",
                 (unsigned long long)test_seed(), trial, own->a, own->b, answer.high);
    optimum_free(&m);
}

static void judge(const hamlet *t, size_t trial, tally *sum)
{
    sunder_report *report = separate(t);
    sunder_layer_summary summary;
    optimum_problem m;
    size_t n;
    sunder_report_summary(report, &summary);
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    pose(t, c, n, NULL, &m);
    const double cost = summary.cost, bound = summary.lower_bound;
    /* A little dearer than the library's place is allowed, so that a cost that is too low is seen. */
    const optimum_answer answer = optimum_find(&m, cost * 1.001 + 1e-6, CLOSE / 4, 40000);
    const double slack = CLOSE * cost + 1e-8;
    sum->layers++;
    sum->open += answer.open;
    if (cost < answer.low - slack)
        fail_msg("seed %llu, case %zu: the cost %.17g is below the optimum, which is at least %.17g",
                 (unsigned long long)test_seed(), trial, cost, answer.low);
    if (bound > fmin(answer.high, cost) + slack)
        fail_msg("seed %llu, case %zu: the bound %.17g is above the optimum, which is at most %.17g",
                 (unsigned long long)test_seed(), trial, bound, fmin(answer.high, cost));
    if (!answer.open && !(answer.high < INFINITY))
        fail_msg("seed %llu, case %zu: no place costs as little as %.17g", (unsigned long long)test_seed(), trial,
                 cost);
    const double over = cost - fmin(answer.low, cost);
    sum->optimal += over <= 1e-6 * cost + 1e-7;
    sum->dearer += answer.high < cost - 1e-6 * cost - 1e-7;
    if (cost > 0) sum->worst = fmax(sum->worst, over / cost);
    for (size_t k = 0; k < n; k++) check_verdict(t, c, n, &c[k], trial, sum);
    optimum_free(&m);
    sunder_report_free(report);
}

static void ask(size_t count, size_t fewest, size_t most, uint64_t stream)
{
    tally sum = {.layers = 0};
    for (size_t i = 0; i < test_count(count); i++) {
        rng r = rng_start(test_seed() + stream, i);
        hamlet t = {.n = 0};
        found(&r, &t, (size_t)rng_int(&r, (int64_t)fewest, (int64_t)most));
        judge(&t, i, &sum);
    }
    printf(
        "%zu layers, %zu not settled; %zu at the optimum, %zu dearer, at worst by %.3g; %zu verdicts; %zu unresolved, "
        "%zu of them not in need\n",
        sum.layers, sum.open, sum.optimal, sum.dearer, sum.worst, sum.infeasible, sum.unresolved, sum.resolvable);
    assert_true(10 * sum.open <= sum.layers);
}

static void test_up_to_three(void **state)
{
    (void)state;
    ask(100, 2, 3, 0);
}

static void test_four_and_five(void **state)
{
    (void)state;
    ask(10, 4, 5, 1);
}

/* ---- The oracle itself */

static double known(const double *p, size_t np, const double *q, size_t nq, double gap, double limit_p)
{
    optimum_problem m = {.bodies = 2, .body = {{1, limit_p}, {1, INFINITY}}};
    optimum_keep_apart(&m, 0, 1, p, np, q, nq, gap);
    const optimum_answer answer = optimum_find(&m, 1e6, 1e-9, 10000);
    optimum_free(&m);
    assert_false(answer.open);
    assert_true(answer.high - answer.low <= 2e-9 * answer.high + 1e-9);
    return answer.high;
}

static void test_oracle(void **state)
{
    (void)state;
    const double box[] = {0, 0, 4, 0, 4, 4, 0, 4}, beside[] = {3, 1, 7, 1, 7, 5, 3, 5},
                 off[] = {7, 8, 9, 8, 9, 9, 7, 9};
    const double wall[] = {2, -9, 2, 9}, post[] = {1, 2};
    assert_true(fabs(known(box, 4, beside, 4, 0, INFINITY) - 0.5) < 1e-7); /* 1/2 each */
    assert_true(fabs(known(box, 4, beside, 4, 2, INFINITY) - 4.5) < 1e-7); /* 3/2 each */
    assert_true(fabs(known(box, 4, beside, 4, 2, 0) - 9) < 1e-7);          /* 3 by one */
    assert_true(fabs(known(box, 4, beside, 4, 2, 1) - 5) < 1e-7);          /* 1 and 2 */
    assert_true(fabs(known(box, 4, off, 4, 7, INFINITY) - 2) < 1e-7);      /* corners 5 apart: 1 each */
    assert_true(fabs(known(box, 4, wall, 2, 0, INFINITY) - 2) < 1e-7);     /* 1 each */
    assert_true(fabs(known(box, 4, post, 1, 2, INFINITY) - 4.5) < 1e-7);   /* 3/2 each */
}

/* Three discs in a row, as points round which boxes have to stay; a wall with a door that is wide enough, and not. */
static void test_oracle_in_company(void **state)
{
    (void)state;
    const double box[] = {0, 0, 2, 0, 2, 2, 0, 2}, left[] = {-9, 1, -0.5, 1, -0.5, 9, -9, 9},
                 right[] = {2, 1, 9, 1, 9, 9, 2, 9};
    const double top[] = {-9, 9, 9, 9, 9, 10, -9, 10};
    optimum_problem m = {.bodies = 2, .body = {{1, INFINITY}, {1, 0}}};
    optimum_keep_apart(&m, 0, 1, box, 4, left, 4, 0);
    optimum_keep_apart(&m, 0, 1, box, 4, right, 4, 0);
    optimum_keep_apart(&m, 0, 1, box, 4, top, 4, 0);
    optimum_answer answer = optimum_find(&m, 1e6, 1e-9, 10000);
    assert_true(answer.high == 0 && !answer.open); /* the door is 2.5 wide */
    const double near[] = {1, 1, 9, 1, 9, 9, 1, 9};
    optimum_keep_apart(&m, 0, 1, box, 4, near, 4, 0);
    answer = optimum_find(&m, 1e6, 1e-9, 10000);
    assert_true(fabs(answer.high - 1) < 1e-7 && answer.low > 1 - 1e-7); /* 1.5 wide: out, by 1 */
    optimum_free(&m);
}

/* From (0, 0) behind a wall from (2, -1) to (2, 1): what has to go right by 4 goes round an end's shadow. */
static void test_oracle_of_shadows(void **state)
{
    (void)state;
    const double wall[] = {2, -1, 2, 1}, anchor[] = {0, 0}, ground[] = {-8, -8, 4, -8, 4, 8, -8, 8}, grain[] = {0, 0};
    optimum_problem m = {.bodies = 2, .body = {{1, 0}, {1, INFINITY}}};
    optimum_keep_apart(&m, 0, 1, ground, 4, grain, 1, 0);
    optimum_answer answer = optimum_find(&m, 1e6, 1e-9, 10000);
    assert_true(fabs(answer.high - 16) < 1e-6);
    optimum_keep_off(&m, 0, 1, wall, 2, anchor);
    answer = optimum_find(&m, 1e6, 1e-9, 10000);
    assert_true(fabs(answer.high - 20) < 1e-6 && fabs(answer.low - 20) < 1e-6); /* (4, 2) */
    optimum_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_oracle),
        cmocka_unit_test(test_oracle_in_company),
        cmocka_unit_test(test_oracle_of_shadows),
        cmocka_unit_test(test_up_to_three),
        cmocka_unit_test(test_four_and_five),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
