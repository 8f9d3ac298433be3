/* A question about a conflict: has a small layer a solution in which pairs that are spared are as they were? Most have
 * none, and a search that finds none has tried all it knows: so it is asked first what can be proved, which costs less.
 */
#include "displacement/layer/requirement.h"
#include "displacement/layer/rounding.h"
#include "displacement/prove/proofs/feasibility.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool sunder_i_solver_is_spared(const sunder_i_solver *solver, const sunder_i_spared *spared, uint32_t a, uint32_t b)
{
    const uint32_t p = solver->layer.number[a], q = solver->layer.number[b];
    const sunder_i_id_pair key = {p < q ? p : q, p < q ? q : p};
    return spared->n && bsearch(&key, spared->pair, spared->n, sizeof key, sunder_i_by_id_pair);
}

sunder_status sunder_i_solver_spare(sunder_i_solver *solver, const sunder_i_spared *spared, sunder_error *err)
{
    sunder_i_model *model = &solver->model;
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < solver->start.n && spared->n && !status; k++) {
        const sunder_i_relation *r = &solver->start.pair[k];
        sunder_i_relaxation relaxation;
        if (!sunder_i_is_conflict_of_bodies(model, r) || !sunder_i_solver_is_spared(solver, spared, r->a, r->b))
            continue;
        status = sunder_i_relaxation_of(model, r->a, r->b, &relaxation, err);
        relaxation.infeasible = true;
        if (!status && !sunder_i_relaxations_spread(&model->relaxations, model, &relaxation, model->rules.gap))
            status = sunder_i_failure_cause(err);
    }
    if (!status && !sunder_i_relaxations_index(&model->relaxations, model)) status = sunder_i_failure_cause(err);
    return status;
}

bool sunder_i_solver_is_beyond_limits(const sunder_i_solver *solver, const sunder_i_spared *spared)
{
    const sunder_i_model *model = &solver->model;
    for (size_t k = 0; k < model->relaxations.n; k++) {
        const sunder_i_relaxation *t = &model->relaxations.item[k];
        if (sunder_i_solver_is_spared(solver, spared, t->a, t->b)) continue;
        if (sunder_i_may_move(&model->body[model->body_of[t->a]]) ||
            sunder_i_may_move(&model->body[model->body_of[t->b]]))
            return true;
    }
    return false;
}

/* ---- By proof ---------------------------------------------------------------------------------------------------- */

/* The demand on a spared pair: its relaxation. Without one, or if one lies in the other or in an area and may go
 * deeper, the demand is computed from the start. */
static sunder_status find_requirement(const sunder_i_solver *s, const sunder_i_relation *r, sunder_i_requirement *out,
                                      sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    const sunder_i_relaxation *t = sunder_i_relaxations_find(&model->relaxations, r->a, r->b);
    const bool area = sunder_i_is_barrier(model, r->b) && !sunder_i_thing_shape(model, r->b)->flat;
    if (!t || r->contained || area) return sunder_i_requirement_find(model, &s->start, r->a, r->b, out, err);
    *out = sunder_i_requirement_below(model, t);
    return SUNDER_OK;
}

/* Lists the demands on the spared pairs that are in conflict, sorted. All other pairs have to keep their full
 * distance. */
static sunder_status find_requirements(const sunder_i_solver *s, const sunder_i_spared *list,
                                       sunder_i_requirement *required, size_t *n, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    *n = 0;
    for (size_t k = 0; k < s->start.n && list->n && !status; k++) {
        const sunder_i_relation *r = &s->start.pair[k];
        if (!sunder_i_is_conflict_of_bodies(&s->model, r) || !sunder_i_solver_is_spared(s, list, r->a, r->b)) continue;
        status = find_requirement(s, r, &required[(*n)++], err);
    }
    if (!status && *n) qsort(required, *n, sizeof *required, sunder_i_by_id_pair);
    return status;
}

static bool are_heeded(const sunder_i_subproblem *q, const sunder_i_relation *r)
{
    return sunder_i_set_has(q->feature, q->features, sunder_i_whole_of(q->model, r->a)) &&
           sunder_i_set_has(q->feature, q->features, sunder_i_whole_of(q->model, r->b));
}

/* Asks about each conflict that is not spared by itself: *verdict is infeasible if one provably has no solution,
 * feasible if each has one. Conflicts between the same two bodies are one question, since all of them have to be
 * resolved. *gap: see sunder_i_solver_prove(). */
static sunder_status prove_conflicts(const sunder_i_solver *s, const sunder_i_proving *how, sunder_i_subproblem *q,
                                     sunder_i_verdict *verdict, double *gap, sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    sunder_i_id_pair last = {SUNDER_I_NOBODY, SUNDER_I_NOBODY};
    sunder_status status = SUNDER_OK;
    uint64_t left = EFFORT_BRIEFLY;
    *verdict = SUNDER_I_FEASIBLE;
    for (size_t k = 0; k < s->start.n && left && *verdict != SUNDER_I_INFEASIBLE && !status; k++) {
        const sunder_i_relation *r = &s->start.pair[k];
        const uint32_t body[2] = {model->body_of[r->a], model->body_of[r->b]};
        const bool barrier = sunder_i_is_barrier(model, r->b);
        const sunder_i_id_pair asked = {body[0], barrier ? SUNDER_I_NOBODY : body[1]};
        sunder_i_decision decision;
        if (!sunder_i_is_open_conflict(model, r) || sunder_i_solver_is_spared(s, how->spared, r->a, r->b) ||
            sunder_i_by_id_pair(&asked, &last) == 0 || (q->feature && !are_heeded(q, r)))
            continue;
        last = asked;
        q->effort = how->in_plane ? 0 : left;
        q->body = body;
        q->bodies = barrier ? 1 : 2;
        status = sunder_i_decide(q, &decision, err);
        if (decision.verdict != SUNDER_I_FEASIBLE) *verdict = decision.verdict;
        for (size_t m = 0; m < decision.solution.bodies && how->move; m++)
            memcpy(how->move + 2 * (size_t)decision.solution.body[m], decision.solution.move + 2 * m,
                   2 * sizeof *how->move);
        left -= decision.work < left ? decision.work : left;
        if (!status && decision.proof) status = sunder_i_proof_least_gap(q, decision.proof, gap, err);
        sunder_i_decision_clear(&decision);
    }
    const bool none = last.a == SUNDER_I_NOBODY;
    if ((left == 0 || none) && *verdict == SUNDER_I_FEASIBLE) *verdict = SUNDER_I_UNKNOWN;
    return status;
}

sunder_status sunder_i_solver_prove(const sunder_i_solver *solver, const sunder_i_proving *how,
                                    sunder_i_verdict *verdict, double *gap, sunder_error *err)
{
    sunder_i_requirement *required = sunder_i_alloc(solver->start.n, sizeof *required);
    size_t n = 0;
    sunder_status status =
        required ? find_requirements(solver, how->spared, required, &n, err) : sunder_i_failure_cause(err);
    *verdict = SUNDER_I_UNKNOWN;
    if (!status) {
        sunder_i_subproblem q = {.model = &solver->model,
                                 .less = solver->model.rules.gap - *gap,
                                 .a = SUNDER_I_NOBODY,
                                 .b = SUNDER_I_NOBODY,
                                 .required = required,
                                 .required_n = n,
                                 .feature = how->heeded ? how->heeded->item : NULL,
                                 .features = how->heeded ? how->heeded->n : 0,
                                 .planes = how->planes,
                                 .precedents = how->precedents,
                                 .most = MOST_BODIES};
        status = prove_conflicts(solver, how, &q, verdict, gap, err);
    }
    sunder_i_free(required);
    return status;
}

/* ---- By a layout ------------------------------------------------------------------------------------------------- */

sunder_status sunder_i_solver_place_all(sunder_i_solver *solver, const double *move, bool *well, sunder_error *err)
{
    const sunder_i_model *model = &solver->model;
    sunder_i_list near = {0};
    bool jumps = false;
    *well = true;
    sunder_i_changes_clear(&solver->changes);
    for (uint32_t b = 0; b < model->bodies; b++) {
        double to[2];
        if (!sunder_i_may_move(&model->body[b])) continue;
        sunder_i_round_move(model, b, move + 2 * (size_t)b, to, NULL);
        *well = *well && hypot(to[0], to[1]) <= model->body[b].limit;
        sunder_i_solver_place(solver, b, to);
    }
    sunder_status status = *well ? sunder_i_solver_relate(solver, err) : SUNDER_OK;
    for (uint32_t b = 0; b < model->bodies && *well && !status; b++) {
        if (!sunder_i_may_move(&model->body[b])) continue;
        status = sunder_i_jumps_of_body(&solver->jumps, model, b, &near, &jumps, err);
        *well = !jumps;
    }
    sunder_i_free(near.item);
    return status;
}
