/* In a crowd for which every question fails the number of questions is limited: which change would resolve a pair
 * (displacement/report/needs), is there a proof that it has no room (displacement/report/no_room), and has a pair by
 * itself a solution (displacement/solve/clusters/one_by_one)? */
#include "polyset.h"
#include "scene_solver.h"

#include "displacement/prove/proofs/feasibility.h"
#include "displacement/report/question.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ---- A crowd ----------------------------------------------------------------------------------------------------- */

/* A dense field of squares, too close to each other, and two far from it. */
typedef struct crowd {
    sunder_feature *feature;
    size_t n;
    sunder_layer_options options;
    scene_model of;
    sunder_i_solver solver;
} crowd;

static void add_square(crowd *c, double x, double y, double limit)
{
    char wkt[200];
    snprintf(wkt, sizeof wkt, "POLYGON ((%g %g, %g %g, %g %g, %g %g))", x, y, x + 10, y, x + 10, y + 10, x, y + 10);
    sunder_shape *shape = polyset_shape_of_wkt(wkt);
    assert_non_null(shape);
    c->feature[c->n++] = (sunder_feature){.shape = shape, .weight = 1, .max_shift = limit, .block = -1};
}

static void set_up(crowd *c, size_t side, double limit)
{
    memset(c, 0, sizeof *c);
    c->feature = calloc(side * side + 2, sizeof *c->feature);
    assert_non_null(c->feature);
    sunder_layer_options_init(&c->options);
    c->options.gap = 2;
    c->options.no_blocks = c->options.allow_jumps = true;
    for (size_t k = 0; k < side * side; k++) add_square(c, 11 * (double)(k % side), 11 * (double)(k / side), limit);
    for (size_t k = 0; k < 2; k++) add_square(c, 11 * (double)k, 2000, limit);
    scene_model_related_features(&c->of, c->feature, c->n, &c->options);
    scene_solver_begin(&c->solver, &c->of);
}

static void end(crowd *c)
{
    scene_solver_end(&c->solver);
    scene_model_end(&c->of);
    for (size_t k = 0; k < c->n; k++) sunder_shape_free((sunder_shape *)(uintptr_t)c->feature[k].shape);
    free(c->feature);
}

/* Copies of constants in report/tuning.h, which documents each of them: numbers of failures allowed, and efforts of
 * questions and proofs about one cluster. */
enum {
    NEED_IN_VAIN = 200000,
    NEED_PATIENCE = 32,
    CROWD_PATIENCE = 4, /* if the change that the crowd as a whole needs is known */
    PROOF_PATIENCE = 8,
    FIRST_EFFORT = 10000,
    PROOFS_IN_VAIN = 32,
    PROOFS_IN_VAIN_OF_CROWD = 8, /* if the first effort decides no question */
    PROOFS_IN_VAIN_AT_FIRST = 1024
};

/* ---- Changes that would resolve a pair --------------------------------------------------------------------------- */

/* Numbers of questions for the field and for the far pair: about limits, about gaps, and for proofs. */
static size_t asked_limit[2], asked_gap[2], asked_proof[2];

/* In place of the solver: every layer fails. */
static sunder_status solve_in_vain(const sunder_layer *layer, const sunder_layer_options *options,
                                   const sunder_i_spared *spared, sunder_i_proof_found *proof, sunder_i_solver *x,
                                   sunder_error *err)
{
    double box[4];
    (void)spared, (void)err;
    x->hopeless = true;
    sunder_shape_box(layer->shape[0], box);
    asked_proof[box[1] > 1000] += *proof == SUNDER_I_PROOF_WANTED || *proof == SUNDER_I_PROOF_LATER;
    if (*proof == SUNDER_I_PROOF_LATER) return SUNDER_OK;
    (options->gap < 2 ? asked_gap : asked_limit)[box[1] > 1000]++;
    if (*proof == SUNDER_I_PROOF_WANTED) *proof = SUNDER_I_PROOF_IN_VAIN;
    return SUNDER_OK;
}

static void list_all(sunder_report *report, const sunder_i_solver *solver)
{
    report->conflict = sunder_i_alloc(solver->start.n, sizeof *report->conflict);
    assert_non_null(report->conflict);
    for (size_t k = 0; k < solver->start.n; k++) {
        const sunder_i_relation *r = &solver->start.pair[k];
        if (!sunder_i_is_conflict_of_bodies(&solver->model, r)) continue;
        report->conflict[report->conflicts++] = (sunder_conflict){.a = r->a,
                                                                  .b = r->b,
                                                                  .distance = 1,
                                                                  .required = 2,
                                                                  .reason = SUNDER_REASON_UNRESOLVED,
                                                                  .need_shift = NAN,
                                                                  .need_gap = NAN,
                                                                  .need_gone = SIZE_MAX};
    }
}

/* Asks about all pairs of a field, and about a pair far from it. shift: the known limit for the whole field. */
static sunder_report *ask_for_needs(crowd *c, double shift)
{
    sunder_report *report = NULL;
    sunder_error err;
    memset(asked_limit, 0, sizeof asked_limit);
    memset(asked_gap, 0, sizeof asked_gap);
    memset(asked_proof, 0, sizeof asked_proof);
    set_up(c, 40, 1);
    assert_int_equal(sunder_i_report_new(&c->solver.model, &report, &err), SUNDER_OK);
    list_all(report, &c->solver);
    for (size_t k = 0; k + 1 < report->conflicts; k++) report->conflict[k].need_shift = shift;
    assert_int_equal(sunder_i_report_needs(report, &c->solver, &c->options, solve_in_vain, &err), SUNDER_OK);
    return report;
}

static void test_needs(void **state)
{
    (void)state;
    crowd c;
    sunder_report *report = ask_for_needs(&c, NAN);
    /* Each question involves between a dozen and 200 features. Gaps are examined for all pairs until the budget is
     * spent; limits for a fixed number of pairs, and after that for one in every power of two. */
    assert_true(asked_gap[0] >= NEED_IN_VAIN / 200 && asked_gap[0] <= NEED_IN_VAIN / 12);
    assert_true(asked_gap[0] < report->conflicts - 1);
    assert_true(asked_limit[0] >= NEED_PATIENCE && asked_limit[0] <= NEED_PATIENCE + 12);
    assert_true(asked_proof[0] >= PROOF_PATIENCE && asked_proof[0] <= PROOF_PATIENCE + 16);
    assert_true(asked_limit[1] >= 1 && asked_gap[1] >= 1 && asked_proof[1] >= 1);
    for (size_t k = 0; k < report->conflicts; k++) assert_true(isnan(report->conflict[k].need_shift));
    sunder_report_free(report);
    end(&c);
}

/* The answer for the whole crowd is cached, and a question of its own is asked for only a few pairs. */
static void test_needs_of_crowd(void **state)
{
    (void)state;
    crowd c;
    sunder_report *report = ask_for_needs(&c, 50);
    assert_true(asked_limit[0] >= CROWD_PATIENCE && asked_limit[0] <= CROWD_PATIENCE + 12);
    assert_true(asked_limit[1] == 1);
    for (size_t k = 0; k + 1 < report->conflicts; k++) assert_true(report->conflict[k].need_shift == 50);
    assert_true(isnan(report->conflict[report->conflicts - 1].need_shift));
    sunder_report_free(report);
    end(&c);
}

/* ---- Proofs ------------------------------------------------------------------------------------------------------ */

/* Numbers of questions at the first effort and at greater ones, for the field and for the far pair. told: the number of
 * the field's questions at the second effort that count as decided; all others fail. */
static size_t asked_first[2], asked_again[2], told;

/* In place of the proof: every effort is too small, except that the first `told` questions count as decided. */
static sunder_status decide_in_vain(const sunder_i_subproblem *q, sunder_i_decision *decision, sunder_error *err)
{
    (void)err;
    const bool apart = q->model->body[q->body[0]].box[1] + q->model->body[q->body[0]].origin[1] > 1000;
    (*(q->effort == FIRST_EFFORT ? &asked_first : &asked_again))[apart]++;
    const bool tells = q->effort > FIRST_EFFORT && !apart && asked_again[0] <= told;
    memset(decision, 0, sizeof *decision);
    decision->verdict = SUNDER_I_UNKNOWN;
    decision->work = tells ? 0 : q->effort + 1;
    return SUNDER_OK;
}

/* Asks about all pairs of a square field; returns the number of pairs. */
static size_t ask_for_proofs(size_t side, size_t tell)
{
    crowd c;
    sunder_report *report = NULL;
    sunder_error err;
    set_up(&c, side, 1);
    assert_int_equal(sunder_i_report_new(&c.solver.model, &report, &err), SUNDER_OK);
    list_all(report, &c.solver);
    report->proof = sunder_i_calloc(report->conflicts, sizeof *report->proof);
    assert_non_null(report->proof);
    memset(asked_first, 0, sizeof asked_first);
    memset(asked_again, 0, sizeof asked_again);
    told = tell;
    assert_int_equal(sunder_i_report_proofs(report, &c.solver, decide_in_vain, false, &err), SUNDER_OK);
    const size_t pairs = report->conflicts - 1;
    assert_int_equal(asked_first[1], 1);
    assert_true(asked_again[1] >= 3);
    sunder_report_free(report);
    end(&c);
    return pairs;
}

/* All are asked once. At the second effort the questions of the field end after PROOFS_IN_VAIN_OF_CROWD failures in
 * succession, after any number of decided ones, while those about the far pair continue to the greatest effort. In a
 * larger field not all pairs are asked about. */
static void test_proofs(void **state)
{
    (void)state;
    for (size_t tell = 0; tell <= 2 * PROOFS_IN_VAIN; tell += PROOFS_IN_VAIN / 2) {
        const size_t pairs = ask_for_proofs(12, tell);
        assert_int_equal(asked_first[0], pairs);
        assert_int_equal(asked_again[0], tell + PROOFS_IN_VAIN_OF_CROWD);
    }
    assert_true(ask_for_proofs(24, 0) > PROOFS_IN_VAIN_AT_FIRST);
    assert_int_equal(asked_first[0], PROOFS_IN_VAIN_AT_FIRST);
    assert_int_equal(asked_again[0], 0);
}

/* In a field with fewer pairs than that, all are asked about at the second effort, and half of them at the third. */
static void test_proofs_of_few(void **state)
{
    (void)state;
    const size_t pairs = ask_for_proofs(3, 0);
    assert_true(pairs > PROOFS_IN_VAIN / 2 && pairs < PROOFS_IN_VAIN);
    assert_int_equal(asked_again[0], pairs + PROOFS_IN_VAIN / 2);
    assert_true(asked_again[1] >= 3);
}

/* ---- Solutions --------------------------------------------------------------------------------------------------- */

/* All pairs are given up at their present places. Each has a solution, which needs half of the field. */
static void test_one_by_one(void **state)
{
    (void)state;
    crowd c;
    sunder_error err;
    bool changed;
    set_up(&c, 20, 0.6);
    sunder_i_model *model = &c.solver.model;
    size_t n = 0;
    c.solver.now.pair = sunder_i_alloc(c.solver.start.n, sizeof *c.solver.now.pair);
    model->given_up = sunder_i_alloc(c.solver.start.n, sizeof *model->given_up);
    assert_true(c.solver.now.pair && model->given_up);
    for (size_t k = 0; k < c.solver.start.n; k++) {
        const sunder_i_relation *r = &c.solver.start.pair[k];
        sunder_i_relaxation t;
        c.solver.now.pair[c.solver.now.n++] = *r;
        if (!sunder_i_is_conflict_of_bodies(model, r)) continue;
        assert_int_equal(sunder_i_relaxation_of(model, r->a, r->b, &t, &err), SUNDER_OK);
        assert_true(sunder_i_relaxations_add(&model->relaxations, &t));
        model->given_up[model->given_up_n++] = (sunder_i_id_pair){model->body_of[r->a], model->body_of[r->b]};
        n++;
    }
    assert_true(sunder_i_relaxations_index(&model->relaxations, model));
    assert_int_equal(sunder_i_solver_ask_one_by_one(&c.solver, &changed, &err), SUNDER_OK);
    uint64_t work = 0;
    for (size_t b = 0; b < model->bodies; b++) work += c.solver.asked_work[b];
    /* The questions about the far pair continue. For pairs of the field a few questions are asked with decreasing
     * efforts, then a number of brief ones for each power of two. Each ends at the next program after its effort, or if
     * too many bodies take part. */
    assert_true(changed);
    assert_true(n > 1000 && work > ALONE_PATIENCE * EFFORT_BRIEFLY_ALONE && work < 40 * EFFORT_BRIEFLY_ALONE);
    c.of.model = *model;
    c.of.placement = c.solver.placement;
    end(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_needs), cmocka_unit_test(test_needs_of_crowd),
                                       cmocka_unit_test(test_proofs), cmocka_unit_test(test_proofs_of_few),
                                       cmocka_unit_test(test_one_by_one)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
