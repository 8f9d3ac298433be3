/* Is there no solution, or was none found? Pairs that were given up are looked at again, component by component of the
 * layer's conflicts (prove/proofs/feasibility.c). Either it is proved that limits and fixed features leave no room for
 * all of them, or there is a solution to continue from, or the question stays open. report/no_room.c writes what is
 * known of the pairs that remain. */
#include "displacement/layer/rounding.h"
#include "displacement/prove/proofs/feasibility.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/parallel.h"
#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>

/* A component of the conflicts at the start: its pairs of bodies, and its bodies, ascending. */
typedef struct component {
    uint32_t root;
    const sunder_i_id_pair *pair;
    size_t pairs;
    const uint32_t *body;
    size_t bodies;
} component;

/* All components of the conflicts at the start. A fixed body connects none. */
typedef struct components {
    const uint32_t *root_of; /* [bodies] the root of each body's component; lent */
    component *component;
    size_t n;
    sunder_i_id_pair *pair;
    uint32_t *body;
} components;

typedef struct rooted {
    uint32_t root;
    sunder_i_id_pair pair;
} rooted;

static size_t list_pairs(const sunder_i_solver *s, const uint32_t *root_of, rooted *list)
{
    const sunder_i_model *model = &s->model;
    size_t n = 0;
    for (size_t k = 0; k < s->start.n; k++) {
        const sunder_i_relation *r = &s->start.pair[k];
        if (!sunder_i_is_conflict_of_bodies(model, r)) continue;
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        if (model->body[i].fixed && model->body[j].fixed) continue;
        list[n++] = (rooted){root_of[model->body[i].fixed ? j : i],
                             i < j ? (sunder_i_id_pair){i, j} : (sunder_i_id_pair){j, i}};
    }
    if (n) qsort(list, n, sizeof *list, sunder_i_by_id_triple);
    size_t out = 0;
    for (size_t k = 0; k < n; k++)
        if (k == 0 || sunder_i_by_id_triple(&list[out - 1], &list[k])) list[out++] = list[k];
    return out;
}

static void free_components(components *c) { sunder_i_free_all(c->component, c->pair, c->body); }

static sunder_status find_components(sunder_i_solver *s, components *out, sunder_error *err)
{
    const size_t most = s->start.n;
    *out = (components){.root_of = sunder_i_solver_conflict_roots(s),
                        .component = sunder_i_alloc(most, sizeof *out->component),
                        .pair = sunder_i_alloc(most, sizeof *out->pair),
                        .body = sunder_i_alloc(2 * most, sizeof *out->body)};
    rooted *list = sunder_i_alloc(most, sizeof *list);
    if (!out->root_of || !out->component || !out->pair || !out->body || !list) {
        sunder_i_free(list);
        return sunder_i_failure_cause(err);
    }
    const size_t n = list_pairs(s, out->root_of, list);
    for (size_t first = 0, end; first < n; first = end) {
        uint32_t *body = out->body + 2 * first;
        for (end = first; end < n && list[end].root == list[first].root; end++) {
            out->pair[end] = list[end].pair;
            memcpy(body + 2 * (end - first), &list[end].pair, 2 * sizeof *body);
        }
        const size_t bodies = sunder_i_set_make(body, 2 * (end - first));
        out->component[out->n++] = (component){list[first].root, out->pair + first, end - first, body, bodies};
    }
    sunder_i_free(list);
    return SUNDER_OK;
}

/* ---- Looking again ----------------------------------------------------------------------------------------------- */

/* The question about a component: its bodies and those of the cluster that it is in now, ascending. Several components
 * of one cluster can have the same question, which is asked once, for the first of them. */
typedef struct question {
    sunder_i_list body; /* empty: the component is not asked about */
    size_t first;       /* the component whose question, and decision, this is */
} question;

typedef struct asking {
    const sunder_i_solver *solver;
    const component *component;
    const question *question; /* [components] */
    const sunder_i_requirement *required;
    size_t required_n;
    sunder_i_decision *decision; /* [components] of those that are first */
} asking;

/* Lists the bodies of the component and of the cluster that its root is in now, ascending. Returns false if memory is
 * out. */
static bool gather_bodies(const sunder_i_solver *s, const component *c, sunder_i_list *body)
{
    size_t more;
    const uint32_t *member = sunder_i_solver_members(s, sunder_i_union_find(s->parent, c->root), &more);
    bool ok = true;
    for (size_t k = 0; k < c->bodies && ok; k++) ok = sunder_i_list_push(body, c->body[k]);
    for (size_t k = 0; k < more && ok; k++) ok = sunder_i_list_push(body, member[k]);
    body->n = sunder_i_set_make(body->item, body->n);
    return ok;
}

static bool are_alike(const sunder_i_list *a, const sunder_i_list *b)
{
    return a->n == b->n && memcmp(a->item, b->item, a->n * sizeof *a->item) == 0;
}

/* Makes the questions about the components that are asked about. Returns false if memory is out. */
static bool make_questions(const sunder_i_solver *s, const components *all, const bool *asked, question *out)
{
    /* The last component of each cluster, plus one, that has a question of its own. */
    size_t *last = sunder_i_calloc(s->model.bodies, sizeof *last);
    bool ok = last != NULL;
    for (size_t k = 0; k < all->n && ok; k++) {
        out[k].first = k;
        if (!asked[k]) continue;
        ok = gather_bodies(s, &all->component[k], &out[k].body);
        size_t *of_cluster = &last[sunder_i_union_find(s->parent, all->component[k].root)];
        if (ok && *of_cluster && are_alike(&out[*of_cluster - 1].body, &out[k].body))
            out[k].first = *of_cluster - 1;
        else
            *of_cluster = k + 1;
    }
    sunder_i_free(last);
    return ok;
}

static void free_questions(question *list, size_t n)
{
    for (size_t k = 0; k < n && list; k++) sunder_i_free(list[k].body.item);
    sunder_i_free(list);
}

static sunder_status decide_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    const asking *g = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++) {
        const sunder_i_list *body = &g->question[k].body;
        if (!body->n || g->question[k].first != k) continue;
        const sunder_i_subproblem subproblem = {.model = &g->solver->model,
                                                .body = body->item,
                                                .bodies = body->n,
                                                .a = SUNDER_I_NOBODY,
                                                .b = SUNDER_I_NOBODY,
                                                .required = g->required,
                                                .required_n = g->required_n,
                                                /* the plane finds proofs only, and a solution is looked for */
                                                .no_plane = true,
                                                .effort = EFFORT * (uint64_t)body->n,
                                                .most = MOST_BODIES};
        sunder_i_reading reading;
        sunder_i_reads_begin(&reading, subproblem.model, g->component[k].root);
        status = sunder_i_decide(&subproblem, &g->decision[k], err);
        sunder_i_reads_end(&reading);
    }
    return status;
}

static void mark_component(const components *all, const sunder_i_model *model, uint32_t body, bool *by_root_of)
{
    if (!model->body[body].fixed) by_root_of[all->root_of[body]] = true;
}

/* Lists the requirements of the pairs that were proved infeasible, in the order of relaxations. Returns their
 * number. */
static size_t list_requirements(const sunder_i_model *model, sunder_i_requirement *required)
{
    size_t n = 0;
    for (size_t k = 0; k < model->relaxations.n; k++) {
        const sunder_i_relaxation *t = &model->relaxations.item[k];
        if (t->infeasible) required[n++] = sunder_i_requirement_of(model, t);
    }
    return n;
}

static bool was_asked(const sunder_i_solver *s, uint32_t root)
{
    return sunder_i_is_in(s, SUNDER_I_QUESTION, root, SUNDER_I_DOUBTFUL_ASKED) ||
           sunder_i_is_in(s, SUNDER_I_QUESTION, root, SUNDER_I_CERTAIN_ASKED);
}

/* Sets asked[] for the components with a given-up pair and a doubtful body that have not been asked about without
 * finding a solution. */
static sunder_status mark_asked(const sunder_i_solver *s, const components *all, bool *asked, sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    bool *root = sunder_i_calloc(model->bodies, sizeof *root);
    bool *doubtful = sunder_i_solver_connected_with(s, sunder_i_is_doubtful);
    if (!root || !doubtful) {
        sunder_i_free_all(root, doubtful);
        return sunder_i_failure_cause(err);
    }
    for (size_t k = 0; k < model->given_up_n; k++) {
        mark_component(all, model, model->given_up[k].a, root);
        mark_component(all, model, model->given_up[k].b, root);
    }
    for (size_t k = 0; k < all->n; k++)
        asked[k] =
            root[all->component[k].root] && doubtful[all->component[k].root] && !was_asked(s, all->component[k].root);
    sunder_i_free_all(doubtful, root);
    return SUNDER_OK;
}

/* Drops the given-up pairs and relaxations of the bodies of the solution, except infeasible ones. False if memory is
 * out. */
static bool take_back(sunder_i_model *model, const sunder_i_solution *solution)
{
    size_t out = 0;
    for (size_t k = 0; k < model->given_up_n; k++)
        if (!sunder_i_set_has(solution->body, solution->bodies, model->given_up[k].a) &&
            !sunder_i_set_has(solution->body, solution->bodies, model->given_up[k].b))
            model->given_up[out++] = model->given_up[k];
    model->given_up_n = out;
    out = 0;
    for (size_t k = 0; k < model->relaxations.n; k++) {
        const sunder_i_relaxation *t = &model->relaxations.item[k];
        if (t->infeasible || (!sunder_i_set_has(solution->body, solution->bodies, model->body_of[t->a]) &&
                              !sunder_i_set_has(solution->body, solution->bodies, model->body_of[t->b])))
            model->relaxations.item[out++] = *t;
    }
    model->relaxations.n = out;
    return sunder_i_relaxations_index(&model->relaxations, model);
}

/* Moves the bodies to the solution, and drops what was given up for them. The bodies that it moved become one cluster
 * with the component's root, in which the search continues. False if memory is out. */
static bool take_solution(sunder_i_solver *s, const component *c, const sunder_i_solution *solution)
{
    bool ok = take_back(&s->model, solution);
    for (size_t k = 0; k < solution->bodies; k++) {
        const uint32_t b = solution->body[k];
        double move[2];
        if (s->model.body[b].fixed) continue;
        sunder_i_body_event(&s->states, b, SUNDER_I_IS_WANTED);
        sunder_i_round_move(&s->model, b, solution->move + 2 * k, move, NULL);
        sunder_i_solver_place(s, b, move);
        if ((move[0] != 0 || move[1] != 0) && b != c->root) ok = ok && sunder_i_solver_add_edge(s, c->root, b);
    }
    return ok;
}

/* Traces the verdict. The line names all bodies that took part, since the component alone may well have a solution. */
static sunder_status trace_verdict(const sunder_i_solver *s, const question *q, sunder_i_verdict verdict,
                                   sunder_error *err)
{
    if (!sunder_i_is_traced(&s->model)) return SUNDER_OK;
    const char *outcome = verdict == SUNDER_I_FEASIBLE     ? "a solution of all pairs was found"
                          : verdict == SUNDER_I_INFEASIBLE ? "proved: no solution of all pairs"
                                                           : "undecided within the budget";
    const sunder_i_trace_step step = {NULL, "branch and bound", outcome, NAN, NAN};
    return sunder_i_trace_emit(&s->model, "cluster", &step, q->body.item, q->body.n, err);
}

sunder_status sunder_i_solver_reconsider(sunder_i_solver *solver, bool *changed, sunder_error *err)
{
    *changed = false;
    if (solver->model.given_up_n == 0) return SUNDER_OK;
    components all;
    sunder_status status = find_components(solver, &all, err);
    if (!status) status = sunder_i_solver_gather(solver, err);
    bool *asked = sunder_i_calloc(all.n, sizeof *asked);
    sunder_i_decision *decision = sunder_i_calloc(all.n, sizeof *decision);
    sunder_i_requirement *required = sunder_i_alloc(solver->model.relaxations.n, sizeof *required);
    question *question_of = sunder_i_calloc(all.n, sizeof *question_of);
    if (!status && (!asked || !decision || !required || !question_of)) status = sunder_i_failure_cause(err);
    if (!status) status = mark_asked(solver, &all, asked, err);
    if (!status && !make_questions(solver, &all, asked, question_of)) status = sunder_i_failure_cause(err);
    if (!status) {
        asking g = {solver,  all.component, question_of, required, list_requirements(&solver->model, required),
                    decision};
        status = sunder_i_parallel(solver->model.rules.threads, all.n, SUNDER_I_GRAIN_WHOLE, decide_some, &g, err);
    }
    if (!status) sunder_i_changes_clear(&solver->changes);
    for (size_t k = 0; k < all.n && !status; k++) {
        const question *q = &question_of[k];
        const sunder_i_decision *told = &decision[q->first];
        if (asked[k] && q->first == k) status = trace_verdict(solver, q, told->verdict, err);
        if (told->verdict != SUNDER_I_FEASIBLE) {
            if (asked[k]) sunder_i_body_event(&solver->states, all.component[k].root, SUNDER_I_IS_ASKED_IN_VAIN);
            continue;
        }
        *changed = true;
        if (!take_solution(solver, &all.component[k], &told->solution)) status = sunder_i_failure_cause(err);
    }
    for (size_t k = 0; k < all.n && decision; k++) sunder_i_decision_clear(&decision[k]);
    free_questions(question_of, all.n);
    sunder_i_free_all(asked, decision, required);
    free_components(&all);
    return !status && *changed ? sunder_i_solver_relate(solver, err) : status;
}
