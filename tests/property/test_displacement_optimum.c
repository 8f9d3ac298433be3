/* The optimum of small layers, computed by an independent branch and bound (support/optimum.c) and compared with the
 * library's result. If no conflict remains, the cost is the optimum; the lower bound is never greater.
 *
 * A layer is a few features of convex parts (support/hamlet.c). If pairs remain in conflict, the optimum is that of all
 * other pairs, with these no nearer than at the start, and a conflict that is reported without a solution has none. */
#include "hamlet.h"
#include "optimum.h"
#include "random.h"

#include "sunder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* Relative accuracy of the optimum. The library's results may differ by as much, and by the tolerance of places in
 * optimum.c. */
static const double CLOSE = 1e-8;
/* The distance from the optimum up to which a cost counts as optimal, relative and absolute, as the interface documents
 * it. */
static const double OPTIMAL = 1e-6, OPTIMAL_TOO = 1e-7;
/* A place of optimum.c may exceed limits by 1e-9; limits are reduced by this share if a place has to be certainly
 * allowed. If one coordinate uses up a whole limit, such a place may be wrong by a ten-thousandth in the other
 * coordinate, and cost less by as much. */
static const double WITHIN = 1e-8;
/* The distance that a move keeps from shadows. These are closed sets, and if there is no clearance no move beside one
 * is free. */
static const double BESIDE = 1e-7;

typedef struct tally {
    size_t layers, open, solved, optimal, dearer, claimed, proved, unresolved, resolvable;
    double worst;
} tally;

#define FAIL(i, ...)                                                                                                   \
    do {                                                                                                               \
        printf("seed %llu, case %zu: ", (unsigned long long)test_seed(), (size_t)i);                                   \
        fail_msg(__VA_ARGS__);                                                                                         \
    } while (0)

/* ---- Questions */

/* The problem that has no solution according to a verdict. */
static bool pose_verdict(const hamlet *t, const sunder_conflict *c, size_t n, const sunder_conflict *own,
                         optimum_problem *m)
{
    const bool alone = own->reason != SUNDER_REASON_NO_ROOM && own->reason != SUNDER_REASON_UNRESOLVED;
    switch (own->reason) {
    case SUNDER_REASON_FIXED:
    case SUNDER_REASON_MAX_SHIFT: hamlet_pose_pair(t, own, HAMLET_APART, m); break;
    case SUNDER_REASON_SIDE: hamlet_pose_pair(t, own, HAMLET_APART | HAMLET_KEEP_SIDES, m); break;
    case SUNDER_REASON_JUMP: hamlet_pose_pair(t, own, HAMLET_ALL, m); break;
    default: hamlet_pose(t, c, n, own, m);
    }
    return alone;
}

/* A conflict that is reported to have no solution has none within the limits, at any cost. */
static void check_verdict(const hamlet *t, const sunder_conflict *c, size_t n, const sunder_conflict *own, size_t i,
                          tally *sum)
{
    optimum_problem m;
    if (own->inside_block) return;
    const bool alone = pose_verdict(t, c, n, own, &m), proved = own->reason != SUNDER_REASON_UNRESOLVED;
    double most = 1;
    for (size_t k = 0; k < m.bodies; k++) {
        const double off = hypot(m.preferred[2 * k], m.preferred[2 * k + 1]), far = fmin(1e3, m.body[k].limit) + off;
        most += m.body[k].weight * far * far;
    }
    const optimum_answer answer = optimum_find(&m, most, 0.5, 20000);
    const bool solvable = answer.high < INFINITY;
    sum->proved += proved;
    sum->unresolved += !proved;
    sum->resolvable += !proved && solvable;
    /* A proof may use other listed pairs that overlapped, which may not get deeper into each other; the problem leaves
     * them out. */
    if (proved && solvable && (alone || n == 1))
        FAIL(i, "%zu and %zu (%s) are said to have no solution, but have one of cost %.17g", own->a, own->b,
             sunder_reason_string(own->reason), answer.high);
    optimum_free(&m);
}

/* Does a certainly allowed place cost less than `than`? Such a place exceeds no limit even slightly, and touches no
 * shadow, which would be a jump although it costs no more than a place beside it. found: the cost of a place for which
 * these may be violated slightly. */
static bool costs_less(const optimum_problem *m, double found, double than)
{
    if (found >= than) return false;
    optimum_problem within = *m;
    for (size_t k = 0; k < m->pieces; k++)
        if (m->piece[k].shadow) m->piece[k].radius = BESIDE;
    for (size_t k = 0; k < m->bodies; k++) within.body[k].limit *= 1 - WITHIN;
    const double best = optimum_find(&within, than + 1e-6, CLOSE / 4, 40000).high;
    for (size_t k = 0; k < m->pieces; k++)
        if (m->piece[k].shadow) m->piece[k].radius = 0;
    return best < than;
}

static void judge(const hamlet *t, size_t i, tally *sum)
{
    sunder_report *report = hamlet_separate(t, 1);
    sunder_layer_summary summary;
    optimum_problem m;
    size_t n, listed = 0;
    sunder_report_summary(report, &summary);
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    for (size_t k = 0; k < n; k++) listed += !c[k].inside_block;
    hamlet_pose(t, c, n, NULL, &m);
    const double cost = summary.cost, bound = summary.lower_bound, slack = CLOSE * cost + 1e-8;
    /* Places slightly more expensive than the library's are examined, too, so that a cost that is too low is
     * detected. */
    const optimum_answer answer = optimum_find(&m, cost * 1.001 + 1e-6, CLOSE / 4, 40000);
    if (cost < answer.low - slack) FAIL(i, "cost %.17g; the optimum is at least %.17g", cost, answer.low);
    if (bound > cost + slack || costs_less(&m, answer.high, bound - slack))
        FAIL(i, "bound %.17g; the optimum is at most %.17g", bound, fmin(answer.high, cost));
    if (!answer.open && !(answer.high < INFINITY)) FAIL(i, "no place costs as little as %.17g", cost);
    const double most = OPTIMAL * cost + OPTIMAL_TOO * (double)summary.clusters; /* the tolerance of reported optima */
    if (summary.clusters_optimal == summary.clusters && costs_less(&m, answer.high, cost - most - slack))
        FAIL(i, "all %zu groups are said to be at their optimum, cost %.17g; it is at most %.17g", summary.clusters,
             cost, answer.high);
    sum->claimed += summary.clusters_optimal == summary.clusters;
    sum->layers++;
    sum->open += answer.open;
    if (!listed) {
        const double over = cost - fmin(answer.low, cost);
        sum->solved++;
        sum->optimal += over <= OPTIMAL * cost + OPTIMAL_TOO;
        if (costs_less(&m, answer.high, cost - OPTIMAL * cost - OPTIMAL_TOO)) {
            sum->dearer++;
            printf("seed %llu, case %zu: cost %.9g, but the optimum is %.9g\n", (unsigned long long)test_seed(), i,
                   cost, answer.high);
        }
        if (cost > 0 && !answer.open) sum->worst = fmax(sum->worst, over / cost);
    }
    for (size_t k = 0; k < n; k++) check_verdict(t, c, n, &c[k], i, sum);
    optimum_free(&m);
    sunder_report_free(report);
}

static void ask(size_t count, size_t fewest, size_t most, int kinds, uint64_t stream)
{
    tally sum = {.layers = 0};
    for (size_t i = 0; i < test_count(count); i++) {
        rng r = rng_start(test_seed() + stream, i);
        hamlet t;
        hamlet_found(&r, &t, (size_t)rng_int(&r, (int64_t)fewest, (int64_t)most), kinds);
        judge(&t, i, &sum);
    }
    printf("%zu layers, %zu undecided, %zu reported as optimal; %zu solved, %zu of them at the optimum, "
           "%zu of greater cost, by %.3g at most; %zu verdicts; %zu unresolved, %zu of them with a solution\n",
           sum.layers, sum.open, sum.claimed, sum.solved, sum.optimal, sum.dearer, sum.worst, sum.proved,
           sum.unresolved, sum.resolvable);
    assert_true(10 * sum.open <= sum.layers);
    assert_int_equal(sum.dearer, 0);
}

static void test_up_to_three(void **state)
{
    (void)state;
    ask(100, 2, 3, HAMLET_PLAIN, 0);
}

static void test_four_and_five(void **state)
{
    (void)state;
    ask(10, 4, 5, HAMLET_PLAIN, 1);
}

static void test_barriers(void **state)
{
    (void)state;
    ask(60, 1, 3, HAMLET_BARRIERS_TOO, 2);
}

static void test_jumps(void **state)
{
    (void)state;
    ask(60, 2, 3, HAMLET_NO_JUMPS, 3);
}

static void test_some_jump(void **state)
{
    (void)state;
    ask(60, 2, 4, HAMLET_NO_JUMPS | HAMLET_SYMBOLS, 10);
}

static void test_sides(void **state)
{
    (void)state;
    ask(60, 1, 3, HAMLET_SIDES, 4);
}

static void test_all_rules(void **state)
{
    (void)state;
    ask(60, 1, 4, HAMLET_SIDES | HAMLET_BARRIERS_TOO | HAMLET_NO_JUMPS, 5);
}

/* ---- Preferred places */

static void test_preferred(void **state)
{
    (void)state;
    ask(60, 1, 3, HAMLET_PREFERRED, 6);
}

static void test_preferred_with_rules(void **state)
{
    (void)state;
    ask(60, 1, 4, HAMLET_PREFERRED | HAMLET_SIDES | HAMLET_BARRIERS_TOO | HAMLET_NO_JUMPS, 7);
}

/* ---- Gaps by classes */

static void test_classes(void **state)
{
    (void)state;
    ask(60, 2, 4, HAMLET_CLASSED | HAMLET_BARRIERS_TOO, 8);
}

static void test_classes_with_rules(void **state)
{
    (void)state;
    ask(60, 1, 4, HAMLET_CLASSED | HAMLET_PREFERRED | HAMLET_SIDES | HAMLET_BARRIERS_TOO | HAMLET_NO_JUMPS, 9);
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
    assert_true(fabs(known(box, 4, beside, 4, 0, INFINITY) - 0.5) < 1e-7); /* each moves 1/2 */
    assert_true(fabs(known(box, 4, beside, 4, 2, INFINITY) - 4.5) < 1e-7); /* each moves 3/2 */
    assert_true(fabs(known(box, 4, beside, 4, 2, 0) - 9) < 1e-7);          /* one moves 3 */
    assert_true(fabs(known(box, 4, beside, 4, 2, 1) - 5) < 1e-7);          /* the moves are 1 and 2 */
    assert_true(fabs(known(box, 4, off, 4, 7, INFINITY) - 2) < 1e-7);      /* corners 5 apart: each moves 1 */
    assert_true(fabs(known(box, 4, wall, 2, 0, INFINITY) - 2) < 1e-7);     /* each moves 1 */
    assert_true(fabs(known(box, 4, post, 1, 2, INFINITY) - 4.5) < 1e-7);   /* each moves 3/2 */
}

/* Three discs in a row, as points around which boxes have to stay; a wall with a door that is wide enough, or too
 * narrow. */
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
    /* the door is 1.5 wide, so the box moves out by 1 */
    assert_true(fabs(answer.high - 1) < 1e-7 && answer.low > 1 - 1e-7);
    optimum_free(&m);
}

/* From (0, 0) behind a wall from (2, -1) to (2, 1): a body that has to move right by 4 goes around the shadow of an
 * end. */
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
    assert_true(fabs(answer.high - 20) < 1e-6 && fabs(answer.low - 20) < 1e-6); /* the move is (4, 2) */
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
        cmocka_unit_test(test_barriers),
        cmocka_unit_test(test_jumps),
        cmocka_unit_test(test_some_jump),
        cmocka_unit_test(test_sides),
        cmocka_unit_test(test_all_rules),
        cmocka_unit_test(test_preferred),
        cmocka_unit_test(test_preferred_with_rules),
        cmocka_unit_test(test_classes),
        cmocka_unit_test(test_classes_with_rules),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
