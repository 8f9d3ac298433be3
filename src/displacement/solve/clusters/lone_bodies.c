/* Places for lone bodies: bodies without a limit that are in conflict with barriers and nothing else.
 *
 * The result for such a body is one move. Branch and bound (prove/proofs/feasibility.c) decides whether one of its
 * conflicts has a solution that keeps its other conflicts no worse than at the start and makes no new one. This is the
 * question that the report asks about each conflict that remains. So if there is a solution the body goes there, after
 * an exact check (trial.c), and its remaining conflicts are asked about anew. At the end no conflict of the body has a
 * solution, and the report finds the proofs of that (report/no_room.c, report/pair_reasons.c). There is an exception:
 * the body stays where it is if it would overlap more barriers at the solution, since fewer overlaps go before fewer
 * conflicts.
 *
 * First it is asked whether there is no solution at all, which is so for most conflicts. A solution that is found is
 * rarely free in doubles, since it touches what is in its way. So the next questions demand a margin: from all
 * barriers; and if no such place is free, only from those that the body is not in conflict with, since on a straight
 * road there is no margin to be had from a conflict on either side.
 *
 * A lone body that is in no conflict stands at the nearest place that is free with a margin. If a place is nearer that
 * is free without a margin, and an exact check allows it, the body goes there. An example is a corridor exactly as wide
 * as the body. */
#include "displacement/layer/rounding.h"
#include "displacement/prove/proofs/feasibility.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/trial.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

/* A lone body, and its present conflicts; a barrier counts as a whole. */
typedef struct lone_body {
    sunder_i_solver *solver;
    uint32_t body;
    sunder_i_requirement *required; /* [n] the bounds that the conflicts are held to; sorted */
    bool *overlaps;                 /* [n] does the body overlap the barrier? */
    size_t n;
} lone_body;

/* Marks in lone[bodies] the lone bodies with a conflict. False if memory is out. */
static bool mark_lone_bodies(const sunder_i_solver *s, bool *lone)
{
    const sunder_i_model *model = &s->model;
    bool *others = sunder_i_calloc(model->bodies, sizeof *others);
    if (!others) return false;
    for (size_t k = 0; k < s->now.n; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        if (!sunder_i_is_conflict_of_bodies(model, r)) continue;
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        lone[i] = sunder_i_may_move(&model->body[i]) && sunder_i_limit_of(&model->body[i]) == INFINITY;
        if (!sunder_i_is_barrier(model, r->b)) others[i] = others[j] = true;
    }
    for (size_t b = 0; b < model->bodies; b++) lone[b] = lone[b] && !others[b];
    sunder_i_free(others);
    return true;
}

/* Adds the conflicts of feature f to the list. */
static sunder_status list_conflicts_of(lone_body *l, uint32_t f, sunder_error *err)
{
    sunder_i_solver *s = l->solver;
    const sunder_i_relation key = {.a = f};
    sunder_status status = SUNDER_OK;
    for (size_t k = sunder_i_lower_bound(&key, s->now.pair, s->now.n, sizeof key, sunder_i_by_id_pair);
         k < s->now.n && s->now.pair[k].a == f && !status; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        const uint32_t whole = sunder_i_whole_of(&s->model, r->b);
        if (!sunder_i_is_conflict_of_bodies(&s->model, r)) continue;
        const sunder_i_requirement *last = l->n ? &l->required[l->n - 1] : NULL;
        if (!last || last->a != f || last->b != whole) {
            l->overlaps[l->n] = false;
            status = sunder_i_requirement_find(&s->model, &s->start, f, whole, &l->required[l->n++], err);
        }
        l->overlaps[l->n - 1] |= r->overlap;
    }
    return status;
}

static sunder_status list_conflicts(lone_body *l, sunder_error *err)
{
    const sunder_i_model *model = &l->solver->model;
    const sunder_i_body *body = &model->body[l->body];
    sunder_status status = SUNDER_OK;
    l->n = 0;
    for (uint32_t m = 0; m < body->members && !status; m++)
        status = list_conflicts_of(l, model->member[body->member + m], err);
    return status;
}

static size_t count_overlaps(const lone_body *l)
{
    size_t n = 0;
    for (size_t k = 0; k < l->n; k++) n += l->overlaps[k];
    return n;
}

/* Moves the body to u, rounded, and lists its conflicts there. *better if the exact check lets it stay there, with
 * fewer overlaps, or as many and fewer conflicts. Otherwise the body goes back, and the list with it. */
static sunder_status try_place(lone_body *l, const double u[2], bool *better, sunder_error *err)
{
    sunder_i_solver *s = l->solver;
    sunder_i_trial there = {.solver = s, .along = 3, .from_start = true}, back = there;
    const size_t conflicts = l->n, overlaps = count_overlaps(l);
    double to[2], stood[2];
    *better = false;
    memcpy(stood, s->model.move + 2 * (size_t)l->body, sizeof stood);
    sunder_i_round_move(&s->model, l->body, u, to, NULL);
    sunder_status status = sunder_i_trial_take(&there, l->body) ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) status = sunder_i_trial_place(&there, to, err);
    if (!status && there.well) status = list_conflicts(l, err);
    const size_t now = count_overlaps(l);
    *better = !status && there.well && (now < overlaps || (now == overlaps && l->n < conflicts));
    if (!status && there.well && !*better) {
        status = sunder_i_trial_take(&back, l->body) ? SUNDER_OK : sunder_i_failure_cause(err);
        if (!status) status = sunder_i_trial_place(&back, stood, err);
        if (!status) status = list_conflicts(l, err);
    }
    sunder_i_trial_free(&there);
    sunder_i_trial_free(&back);
    return status;
}

static sunder_status decide(const lone_body *l, const sunder_i_subproblem *q, sunder_i_decision *decision,
                            sunder_error *err)
{
    sunder_i_reading reading;
    sunder_i_reads_begin(&reading, q->model, l->body);
    const sunder_status status = sunder_i_decide(q, decision, err);
    sunder_i_reads_end(&reading);
    return status;
}

/* Asks about one conflict among the things of q. *verdict: what is known of a solution without a margin. */
static sunder_status ask_with_margins(lone_body *l, sunder_i_subproblem *q, sunder_i_verdict *verdict, bool *solved,
                                      sunder_error *err)
{
    const double margin = MARGINS * sunder_i_solver_margin(l->solver, &l->body, 1);
    double touching[2] = {0, 0};
    *solved = false;
    for (int k = 0; k < 3; k++) {
        sunder_i_decision decision;
        q->margin = k > 0 ? margin : 0;
        q->held_margin = k == 1 ? margin : 0;
        sunder_status status = decide(l, q, &decision, err);
        if (k == 0) *verdict = decision.verdict;
        if (!status && k == 0 && *verdict == SUNDER_I_FEASIBLE)
            memcpy(touching, decision.solution.move, sizeof touching);
        if (!status && k > 0 && decision.verdict == SUNDER_I_FEASIBLE)
            status = try_place(l, decision.solution.move, solved, err);
        sunder_i_decision_clear(&decision);
        if (status || *solved || *verdict == SUNDER_I_INFEASIBLE) return status;
    }
    return *verdict == SUNDER_I_FEASIBLE ? try_place(l, touching, solved, err) : SUNDER_OK;
}

/* Asks about one conflict; *solved if the body was moved to a better place. Only barriers near the body take part at
 * first, then more. */
static sunder_status ask(lone_body *l, size_t at, bool *solved, sunder_error *err)
{
    const sunder_i_model *model = &l->solver->model;
    const sunder_i_body *b = &model->body[l->body];
    const double size = sunder_i_max(b->box[2] - b->box[0], b->box[3] - b->box[1]) + model->barriers->farthest;
    sunder_i_verdict verdict = SUNDER_I_UNKNOWN;
    sunder_i_list thing = {0};
    sunder_status status = SUNDER_OK;
    size_t before = 0;
    double reach = size;
    *solved = false;
    for (int k = 0; k < LONE_REACHES && !status && !*solved && verdict != SUNDER_I_INFEASIBLE; k++) {
        sunder_i_subproblem q = {.model = model,
                                 .body = &l->body,
                                 .bodies = 1,
                                 .a = l->required[at].a,
                                 .b = l->required[at].b,
                                 .required = l->required,
                                 .required_n = l->n,
                                 .slack = true,
                                 .no_plane = true,
                                 .effort = LONE_EFFORT,
                                 .most = MOST_BODIES};
        sunder_i_reading reading;
        sunder_i_reads_begin(&reading, model, l->body);
        bool ok = sunder_i_barriers_about(model, l->body, reach, &thing, &q.instead);
        sunder_i_reads_end(&reading);
        for (uint32_t m = 0; m < b->members && ok; m++) ok = sunder_i_list_push(&thing, model->member[b->member + m]);
        thing.n = sunder_i_set_make(thing.item, thing.n);
        q.feature = thing.item;
        q.features = thing.n;
        if (!ok) status = sunder_i_failure_cause(err);
        if (!status && thing.n > before) status = ask_with_margins(l, &q, &verdict, solved, err);
        before = thing.n;
        reach *= LONE_GROWTH;
    }
    sunder_i_free(thing.item);
    return status;
}

/* Asks about the conflicts of one body, overlaps first, until none has a solution. */
static sunder_status place_body(lone_body *l, sunder_error *err)
{
    bool solved = true;
    sunder_status status = list_conflicts(l, err);
    while (solved && !status) {
        solved = false;
        for (int overlap = 1; overlap >= 0; overlap--)
            for (size_t k = 0; k < l->n && !solved && !status; k++)
                if (l->overlaps[k] == overlap) status = ask(l, k, &solved, err);
    }
    return status;
}

/* Has the body moved, without a limit and beside barriers, while all other bodies of its cluster are fixed? */
static bool has_moved_alone(const sunder_i_solver *s, uint32_t b)
{
    const sunder_i_model *model = &s->model;
    const double *at = model->move + 2 * (size_t)b;
    const sunder_i_cluster *c = sunder_i_solver_cluster_of(s, b);
    size_t movable = 0;
    if (!c || !sunder_i_may_move(&model->body[b]) || sunder_i_limit_of(&model->body[b]) < INFINITY) return false;
    for (size_t k = 0; k < c->n; k++) movable += sunder_i_may_move(&model->body[c->body[k]]);
    return movable == 1 && sunder_i_is_astray(model, b, at);
}

/* Moves a body in no conflict to the first place that is free without a margin, if that is nearer by a share of NEARER
 * or more. */
static sunder_status move_nearer(sunder_i_solver *s, uint32_t body, sunder_error *err)
{
    const double *at = s->model.move + 2 * (size_t)body;
    double place[NEARER_PLACES][2], to[2];
    size_t n;
    sunder_i_reading reading;
    sunder_i_reads_begin(&reading, &s->model, body);
    const double far = sunder_i_stray(&s->model, body, at);
    const bool ok = sunder_i_cluster_free_places(&s->model, body, far * (1 - NEARER), NEARER_PLACES, place, &n);
    sunder_i_reads_end(&reading);
    sunder_status status = ok ? SUNDER_OK : sunder_i_failure_cause(err);
    for (size_t k = 0; k < n && !status; k++) {
        sunder_i_trial there = {.solver = s, .along = 3};
        sunder_i_round_move(&s->model, body, place[k], to, NULL);
        status = sunder_i_trial_take(&there, body) ? SUNDER_OK : sunder_i_failure_cause(err);
        if (!status) status = sunder_i_trial_place(&there, to, err);
        if (there.well) n = 0;
        sunder_i_trial_free(&there);
    }
    return status;
}

sunder_status sunder_i_solver_place_lone_bodies(sunder_i_solver *solver, sunder_error *err)
{
    const size_t bodies = solver->model.bodies, most = solver->start.n; /* no conflict is new */
    if (!solver->barriers.parts || most == 0) return SUNDER_OK;
    bool *lone = sunder_i_calloc(bodies, sizeof *lone);
    lone_body l = {.solver = solver,
                   .required = sunder_i_alloc(most, sizeof *l.required),
                   .overlaps = sunder_i_alloc(most, sizeof *l.overlaps)};
    sunder_status status = SUNDER_OK;
    if (!lone || !l.required || !l.overlaps || !mark_lone_bodies(solver, lone)) status = sunder_i_failure_cause(err);
    for (l.body = 0; l.body < bodies && !status; l.body++)
        if (lone[l.body])
            status = place_body(&l, err);
        else if (has_moved_alone(solver, l.body))
            status = move_nearer(solver, l.body, err);
    sunder_i_free_all(lone, l.required, l.overlaps);
    return status;
}
