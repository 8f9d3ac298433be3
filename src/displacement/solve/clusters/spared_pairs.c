/* A question about a conflict: has a small layer a solution while the pairs that are spared stay as they are? Most such
 * layers have none, and a search that finds none has tried everything. So proofs are tried first, which cost less. */
#include "displacement/layer/requirement.h"
#include "displacement/layer/rounding.h"
#include "displacement/prove/proofs/feasibility.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The entry of `spared` for features a and b of this layer; NULL: the pair is not spared. */
static const sunder_i_id_pair *spared_pair(const sunder_i_solver *s, const sunder_i_spared *spared, uint32_t a,
                                           uint32_t b)
{
    const uint32_t p = s->layer.number[a], q = s->layer.number[b];
    const sunder_i_id_pair key = {p < q ? p : q, p < q ? q : p};
    return spared->n ? bsearch(&key, spared->pair, spared->n, sizeof key, sunder_i_by_id_pair) : NULL;
}

bool sunder_i_solver_is_spared(const sunder_i_solver *solver, const sunder_i_spared *spared, uint32_t a, uint32_t b)
{
    return spared_pair(solver, spared, a, b) != NULL;
}

/* Sets *relaxation, whose a and b are set, to the relaxation of that feature and barrier: from spared->memo if it is
 * there under the names `named`; otherwise it is computed, and stored there. */
static sunder_status relax_beside_barrier(const sunder_i_model *model, const sunder_i_spared *spared,
                                          const sunder_i_id_pair *named, sunder_i_relaxation *relaxation,
                                          sunder_error *err)
{
    sunder_i_relaxation_memo *memo = spared->memo;
    const uint32_t a = relaxation->a, b = relaxation->b;
    const size_t at = sunder_i_lower_bound(named, memo->item, memo->n, sizeof *memo->item, sunder_i_by_id_pair);
    if (at < memo->n && sunder_i_by_id_pair(named, &memo->item[at]) == 0) {
        *relaxation = memo->item[at];
        relaxation->a = a;
        relaxation->b = b;
        return SUNDER_OK;
    }
    const sunder_status status = sunder_i_relaxation_of(model, a, b, relaxation, err);
    if (status) return status;
    if (!sunder_i_reserve(&memo->item, &memo->capacity, memo->n + 1, sizeof *memo->item))
        return sunder_i_failure_cause(err);
    memmove(memo->item + at + 1, memo->item + at, (memo->n++ - at) * sizeof *memo->item);
    memo->item[at] = *relaxation;
    memo->item[at].a = named->a;
    memo->item[at].b = named->b;
    return SUNDER_OK;
}

static sunder_status relax(const sunder_i_solver *s, const sunder_i_spared *spared, const sunder_i_relation *r,
                           sunder_i_relaxation *relaxation, sunder_error *err)
{
    const uint32_t *number = s->layer.number;
    *relaxation = (sunder_i_relaxation){.a = r->a, .b = r->b};
    if (spared->memo && sunder_i_is_barrier(&s->model, r->b) && spared->name[number[r->a]] != SUNDER_I_NOBODY) {
        const sunder_i_id_pair named = {spared->name[number[r->a]], spared->name[number[r->b]]};
        return relax_beside_barrier(&s->model, spared, &named, relaxation, err);
    }
    return sunder_i_relaxation_of(&s->model, r->a, r->b, relaxation, err);
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
        status = relax(solver, spared, r, &relaxation, err);
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

/* Returns an array of the features of this layer, indexed by the numbers that they have in the layer of the caller
 * (layer.number), which the pairs of sunder_i_spared use. NULL if memory is out. */
static uint32_t *features_by_number(const sunder_i_solver *s)
{
    uint32_t *feature = sunder_i_alloc(s->model.things, sizeof *feature);
    for (uint32_t k = 0; k < s->model.things && feature; k++) feature[s->layer.number[k]] = k;
    return feature;
}

/* Appends a requirement for each pair of `list` that has a clearance in list->held, whether the pair is in conflict in
 * this layer or not. *n is the number of requirements. */
static sunder_status list_held(const sunder_i_solver *s, const sunder_i_spared *list, sunder_i_requirement *required,
                               size_t *n, sunder_error *err)
{
    uint32_t *feature = features_by_number(s);
    if (!feature) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < list->n; k++) {
        if (isnan(list->held[k])) continue;
        const uint32_t f = feature[list->pair[k].a], g = feature[list->pair[k].b];
        required[(*n)++] = (sunder_i_requirement){f < g ? f : g, f < g ? g : f, list->held[k], {0, 0}};
    }
    sunder_i_free(feature);
    return SUNDER_OK;
}

static bool is_held_otherwise(const sunder_i_solver *s, const sunder_i_spared *list, const sunder_i_relation *r)
{
    const sunder_i_id_pair *pair = spared_pair(s, list, r->a, r->b);
    return !pair || (list->held && !isnan(list->held[pair - list->pair]));
}

/* Lists the demands on the spared pairs, sorted: those that are in conflict, and those for which `list` has a
 * clearance. All other pairs have to keep their full distance. */
static sunder_status find_requirements(const sunder_i_solver *s, const sunder_i_spared *list,
                                       sunder_i_requirement *required, size_t *n, sunder_error *err)
{
    *n = 0;
    sunder_status status = list->held && list->n ? list_held(s, list, required, n, err) : SUNDER_OK;
    for (size_t k = 0; k < s->start.n && list->n && !status; k++) {
        const sunder_i_relation *r = &s->start.pair[k];
        if (!sunder_i_is_conflict_of_bodies(&s->model, r) || is_held_otherwise(s, list, r)) continue;
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

/* Raises the requirements of pairs that do not move alike in the layout how->near by the margin. A pair that does may
 * stay exactly as it is, which needs no room for rounding. */
static void add_margins(const sunder_i_model *model, const sunder_i_proving *how, sunder_i_requirement *required,
                        size_t n)
{
    for (size_t k = 0; k < n && how->held_margin > 0; k++) {
        const double *p = how->near + 2 * (size_t)model->body_of[required[k].a],
                     *q = how->near + 2 * (size_t)model->body_of[required[k].b];
        if (p[0] != q[0] || p[1] != q[1]) required[k].clearance += how->held_margin;
    }
}

/* Is r a conflict that is to be solved? A spared one is not. A pair of how->relaxed is, although the model has relaxed
 * it. */
static bool is_to_be_solved(const sunder_i_solver *s, const sunder_i_proving *how, const sunder_i_relation *r)
{
    if (sunder_i_solver_is_spared(s, how->spared, r->a, r->b)) return false;
    if (how->relaxed && sunder_i_solver_is_spared(s, how->relaxed, r->a, r->b))
        return sunder_i_is_conflict_of_bodies(&s->model, r);
    return sunder_i_is_open_conflict(&s->model, r);
}

/* The questions about the conflicts of a small layer: the verdict so far, and the remaining effort. */
typedef struct questioning {
    const sunder_i_solver *solver;
    const sunder_i_proving *how;
    sunder_i_subproblem subproblem;
    sunder_i_verdict verdict;
    uint64_t left;
    double *gap;         /* of a proof */
    sunder_i_list asked; /* bodies that have a solution, each question by itself */
    size_t questions;
} questioning;

/* Asks about `bodies` bodies. The moves of a solution are taken over. */
static sunder_status ask_about(questioning *g, const uint32_t *body, size_t bodies, sunder_i_verdict *verdict,
                               sunder_error *err)
{
    sunder_i_subproblem *q = &g->subproblem;
    sunder_i_decision decision;
    q->effort = g->how->in_plane ? 0 : g->left;
    q->body = body;
    q->bodies = bodies;
    sunder_status status = sunder_i_decide(q, &decision, err);
    *verdict = decision.verdict;
    for (size_t m = 0; m < decision.solution.bodies && g->how->move; m++)
        memcpy(g->how->move + 2 * (size_t)decision.solution.body[m], decision.solution.move + 2 * m,
               2 * sizeof *g->how->move);
    g->left -= decision.work < g->left ? decision.work : g->left;
    if (!status && decision.proof) status = sunder_i_proof_least_gap(q, decision.proof, g->gap, err);
    sunder_i_decision_clear(&decision);
    return status;
}

/* Asks about each two bodies with conflicts to be solved, by themselves, until the effort ends: conflicts of the same
 * two bodies are one question. g->verdict: infeasible if one has provably no solution; feasible if there were questions
 * and each has a solution; otherwise unknown. */
static sunder_status prove_each(questioning *g, sunder_error *err)
{
    const sunder_i_solver *s = g->solver;
    const sunder_i_model *model = &s->model;
    sunder_i_id_pair last = {SUNDER_I_NOBODY, SUNDER_I_NOBODY};
    sunder_status status = SUNDER_OK;
    g->verdict = SUNDER_I_FEASIBLE;
    for (size_t k = 0; k < s->start.n && g->left && g->verdict != SUNDER_I_INFEASIBLE && !status; k++) {
        const sunder_i_relation *r = &s->start.pair[k];
        const uint32_t body[2] = {model->body_of[r->a], model->body_of[r->b]};
        const bool barrier = sunder_i_is_barrier(model, r->b);
        const sunder_i_id_pair asked = {body[0], barrier ? SUNDER_I_NOBODY : body[1]};
        sunder_i_verdict verdict;
        if (!is_to_be_solved(s, g->how, r) || sunder_i_by_id_pair(&asked, &last) == 0 ||
            (g->subproblem.feature && !are_heeded(&g->subproblem, r)))
            continue;
        last = asked;
        g->questions++;
        status = ask_about(g, body, barrier ? 1 : 2, &verdict, err);
        if (verdict != SUNDER_I_FEASIBLE) g->verdict = verdict;
        for (size_t b = 0; b < (barrier ? 1u : 2u) && !status; b++)
            if (!sunder_i_list_push(&g->asked, body[b])) status = sunder_i_failure_cause(err);
    }
    if ((g->left == 0 || g->questions == 0) && g->verdict == SUNDER_I_FEASIBLE) g->verdict = SUNDER_I_UNKNOWN;
    return status;
}

/* Asks whether the conflicts, each of which has a solution by itself, have none together; if that is proved, g->verdict
 * is infeasible. Otherwise the former verdict stands. */
static sunder_status prove_together(questioning *g, sunder_error *err)
{
    sunder_i_verdict verdict;
    g->asked.n = sunder_i_set_make(g->asked.item, g->asked.n);
    const sunder_status status = ask_about(g, g->asked.item, g->asked.n, &verdict, err);
    if (verdict == SUNDER_I_INFEASIBLE || g->how->seeks) g->verdict = verdict;
    return status;
}

sunder_status sunder_i_solver_prove(const sunder_i_solver *solver, const sunder_i_proving *how,
                                    sunder_i_verdict *verdict, double *gap, sunder_error *err)
{
    sunder_i_requirement *required = sunder_i_alloc(solver->start.n + how->spared->n, sizeof *required);
    size_t n = 0;
    sunder_status status =
        required ? find_requirements(solver, how->spared, required, &n, err) : sunder_i_failure_cause(err);
    if (!status) add_margins(&solver->model, how, required, n);
    questioning g = {.solver = solver,
                     .how = how,
                     .subproblem = {.model = &solver->model,
                                    .less = solver->model.rules.gap - *gap,
                                    .a = SUNDER_I_NOBODY,
                                    .b = SUNDER_I_NOBODY,
                                    .required = required,
                                    .required_n = n,
                                    .feature = how->heeded ? how->heeded->item : NULL,
                                    .features = how->heeded ? how->heeded->n : 0,
                                    .planes = how->planes,
                                    .precedents = how->precedents,
                                    .rows = true,
                                    .near = how->near,
                                    .most = MOST_BODIES},
                     .left = how->effort ? how->effort : EFFORT_BRIEFLY,
                     .gap = gap};
    g.subproblem.slack = how->seeks && sunder_i_may_have_slack(&g.subproblem);
    if (!status) status = prove_each(&g, err);
    const bool together = how->move && !how->in_plane && g.questions > 1;
    if (!status && together && g.verdict == SUNDER_I_FEASIBLE) status = prove_together(&g, err);
    *verdict = status ? SUNDER_I_UNKNOWN : g.verdict;
    sunder_i_free_all(g.asked.item, required);
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
