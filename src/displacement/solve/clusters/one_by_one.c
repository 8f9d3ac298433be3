/* Has a single given-up pair a solution, if the others stay given up?
 *
 * A cluster gives up pairs until the search finds a solution for the rest, and reconsider.c asks whether all of them
 * have one. This stage asks a question in between: can one pair be resolved together with all pairs that are not in
 * conflict now, while the other present conflicts stand no worse (prove/proofs/feasibility.c)? It is the question that
 * the report asks (report/no_room.c), so a pair with a solution is not reported as unresolved. The search continues
 * from a solution, one in each cluster at a time. If it succeeds the pair is no longer given up; otherwise all bodies
 * return. A solution without spare room, which the margins of the search exclude, is aligned to the last bit
 * (prove/optimum/tight_place.c) and checked exactly, like all moves. No pair is asked about twice; and in a crowd where
 * questions get no answer fewer and fewer are asked. */
#include "displacement/layer/resolution.h"
#include "displacement/prove/optimum/optimum.h"
#include "displacement/prove/proofs/feasibility.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "base/patience.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A question: a relaxation, and the root of its cluster. */
typedef struct question {
    uint32_t root, relaxation;
} question;

typedef struct asking {
    const sunder_i_solver *solver;
    const question *question;
    const size_t *first;                  /* [clusters + 1] index of the first question of each cluster */
    const sunder_i_requirement *required; /* [required_n] the demands on the present conflicts */
    size_t required_n;
    bool *asked;    /* [questions] was it asked? */
    uint64_t *work; /* [bodies] effort of questions without a solution; the effort of a cluster is the sum over its
                     * bodies */
    sunder_i_decision *decision; /* [clusters] the verdict on its last question that was asked */
} asking;

static bool is_conflict_now(const sunder_i_solver *s, const sunder_i_relaxation *t)
{
    const sunder_i_relation *r = sunder_i_relations_find(&s->now, t->a, t->b);
    return r && sunder_i_is_conflict(r);
}

/* Lists the requirements of the relaxations that are conflicts now, ascending. Barriers count as a whole; each pair
 * is listed once. */
static size_t list_requirements(const sunder_i_solver *s, sunder_i_requirement *required)
{
    const sunder_i_model *model = &s->model;
    size_t n = 0;
    for (size_t k = 0; k < model->relaxations.n; k++) {
        const sunder_i_relaxation *t = &model->relaxations.item[k];
        const uint32_t b = sunder_i_whole_of(model, t->b);
        if (!is_conflict_now(s, t) || (n && required[n - 1].a == t->a && required[n - 1].b == b)) continue;
        required[n++] = sunder_i_requirement_of(model, t);
    }
    return n;
}

/* Was the question asked in an earlier call? */
static bool was_asked(const sunder_i_solver *s, const sunder_i_relaxation *t)
{
    const sunder_i_id_pair key = {t->a, sunder_i_whole_of(&s->model, t->b)};
    return s->asked_n && bsearch(&key, s->asked, s->asked_n, sizeof key, sunder_i_by_id_pair);
}

/* Lists the questions of wanted clusters, sorted by clusters. wanted: [bodies] is the body in a wanted cluster? */
static void list_questions(const sunder_i_solver *s, const bool *wanted, question *list, size_t *first,
                           size_t *clusters)
{
    const sunder_i_model *model = &s->model;
    size_t n = 0;
    const sunder_i_relaxation *last = NULL;
    for (size_t k = 0; k < model->relaxations.n; k++) {
        const sunder_i_relaxation *t = &model->relaxations.item[k];
        const uint32_t i = model->body_of[t->a], j = model->body_of[t->b];
        if (t->infeasible || (model->body[i].fixed && model->body[j].fixed) || !is_conflict_now(s, t)) continue;
        if (last && last->a == t->a && sunder_i_whole_of(model, last->b) == sunder_i_whole_of(model, t->b)) continue;
        const uint32_t of = model->body[i].fixed ? j : i, root = sunder_i_union_find(s->parent, of);
        /* A pair that was relaxed before anything moved, and met no other body, is in no cluster. */
        if (!wanted[of] || was_asked(s, t) || !sunder_i_solver_has_member(s, root, of)) continue;
        last = t;
        list[n++] = (question){root, (uint32_t)k};
    }
    if (n) qsort(list, n, sizeof *list, sunder_i_by_id_pair);
    *clusters = 0;
    for (size_t k = 0; k < n; k++)
        if (k == 0 || list[k].root != list[k - 1].root) first[(*clusters)++] = k;
    first[*clusters] = n;
}

/* Returns the longest move to allow for bodies that have no limit: the greater of the summed sizes and gaps of those
 * of the n bodies that are no barriers, with which each can pass all others, and of how far body `first` has to move
 * to be past any barrier among them. */
static double far_for(const sunder_i_model *model, uint32_t first, const uint32_t *body, size_t n)
{
    double far = 0, beyond = 0;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *b = &model->body[body[k]];
        if (sunder_i_is_barrier_body(model, b))
            beyond = sunder_i_max(beyond, sunder_i_far_from_barrier(model, first, model->member[b->member]));
        else
            far += b->box[2] - b->box[0] + b->box[3] - b->box[1] + model->rules.gap;
    }
    return sunder_i_max(far, beyond);
}

/* Asks for a solution with a margin for rounding. If there is provably none, asks again without the margin, since a
 * place may just fit. If there is a solution, and there may be one with spare room, asks for that. Adds the effort of
 * all questions to *work. */
static sunder_status ask_question(sunder_i_subproblem *p, sunder_i_decision *decision, uint64_t *work,
                                  sunder_error *err)
{
    bool tight = false;
    sunder_status status = sunder_i_decide(p, decision, err);
    *work += decision->work;
    if (!status && decision->verdict == SUNDER_I_INFEASIBLE && p->margin > 0 &&
        !sunder_i_may_be_tight(p->model, p->body, p->bodies, &tight))
        status = sunder_i_failure_cause(err);
    if (!status && tight) {
        sunder_i_decision_clear(decision);
        p->margin = 0;
        status = sunder_i_decide(p, decision, err);
        *work += decision->work;
    }
    if (!status && decision->verdict == SUNDER_I_FEASIBLE && sunder_i_may_have_slack(p)) {
        sunder_i_decision_clear(decision);
        p->slack = true;
        status = sunder_i_decide(p, decision, err);
        *work += decision->work;
    }
    return status;
}

/* Do both bodies have no limit? */
static bool has_no_limit(const sunder_i_model *model, const sunder_i_relaxation *t)
{
    return sunder_i_limit_of(&model->body[model->body_of[t->a]]) == INFINITY &&
           sunder_i_limit_of(&model->body[model->body_of[t->b]]) == INFINITY;
}

/* The effort for the question about relaxation t, after `in_vain` questions in a row that used up theirs. In a crowd
 * connected by chains of dozens of bodies almost all questions end like that, and the few others end early. So after
 * the first failures (ALONE_IN_VAIN) the effort is halved from one question to the next. A question about two bodies
 * without limits gets the least effort in any case. */
static uint64_t effort_for(const sunder_i_model *model, const sunder_i_relaxation *t, unsigned in_vain)
{
    if (has_no_limit(model, t)) return EFFORT_BRIEFLY_ALONE;
    uint64_t effort =
        EFFORT_ALONE * (1 + (uint64_t)(MORE_EFFORT_ALONE * sunder_i_min(model->rules.effort, MORE_ALONE_UP_TO)));
    for (unsigned k = ALONE_IN_VAIN; k <= in_vain && effort > EFFORT_BRIEFLY_ALONE; k++) effort /= 2;
    return effort > EFFORT_BRIEFLY_ALONE ? effort : EFFORT_BRIEFLY_ALONE;
}

/* The effort that questions without a solution may still use up in the cluster of these n members. */
static uint64_t left_to_ask(const asking *g, const uint32_t *member, size_t n)
{
    const uint64_t pool = POOL_ALONE + POOL_ALONE_EACH * (uint64_t)n;
    uint64_t taken = 0;
    for (size_t k = 0; k < n; k++)
        if (!g->solver->model.body[member[k]].fixed) taken += g->work[member[k]];
    return taken < pool ? pool - taken : 0;
}

/* Asks the questions of each cluster, until one has a solution. */
static sunder_status ask_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const asking *g = context;
    const sunder_i_model *model = &g->solver->model;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end; k++) {
        sunder_i_decision *decision = &g->decision[k];
        size_t members;
        const uint32_t *member = sunder_i_solver_members(g->solver, g->question[g->first[k]].root, &members);
        uint64_t left = left_to_ask(g, member, members);
        /* Questions in a row that used up their effort. In a crowd most would, so it starts as if some had. */
        unsigned in_vain = g->first[k + 1] - g->first[k] > MANY_ALONE ? MANY_IN_VAIN : 0;
        sunder_i_patience patience = sunder_i_patience_of(ALONE_PATIENCE, ALONE_REGAINED);
        for (size_t q = g->first[k]; q < g->first[k + 1] && left && !status; q++) {
            if (!sunder_i_patience_asks(&patience)) continue;
            const sunder_i_relaxation *t = &model->relaxations.item[g->question[q].relaxation];
            const uint32_t body[2] = {model->body_of[t->a], model->body_of[t->b]};
            sunder_i_subproblem p = {.model = model,
                                     .body = body,
                                     .bodies = sunder_i_is_barrier(model, t->b) ? 1 : 2,
                                     .a = t->a,
                                     .b = sunder_i_whole_of(model, t->b),
                                     .required = g->required,
                                     .required_n = g->required_n,
                                     .margin = MARGINS *
                                               sunder_i_solver_cluster_at_root(g->solver, g->question[q].root)->margin,
                                     .no_plane = true, /* the plane finds proofs only, and a solution is looked for */
                                     .effort = effort_for(model, t, in_vain),
                                     .most = MOST_BODIES};
            p.reserve = member;
            p.reserves = members;
            p.instead = far_for(model, body[0], p.reserve, p.reserves);
            for (size_t m = 0; m < p.reserves; m++)
                if (isfinite(sunder_i_limit_of(&model->body[p.reserve[m]])))
                    p.farthest = sunder_i_max(p.farthest, sunder_i_limit_of(&model->body[p.reserve[m]]));
            uint64_t work = 0;
            sunder_i_reading reading;
            sunder_i_reads_begin(&reading, model, g->question[q].root);
            status = ask_question(&p, decision, &work, err);
            sunder_i_reads_end(&reading);
            g->asked[q] = true;
            const sunder_i_verdict verdict = decision->verdict;
            if (status || verdict == SUNDER_I_FEASIBLE) break;
            sunder_i_decision_clear(decision);
            in_vain = verdict == SUNDER_I_UNKNOWN ? in_vain + 1 : 0;
            sunder_i_patience_note(&patience, verdict != SUNDER_I_UNKNOWN);
            g->work[model->body[body[0]].fixed ? body[1] : body[0]] += work;
            left -= work < left ? work : left;
        }
        if (status) return status;
    }
    return SUNDER_OK;
}

/* ---- Going on from a solution ------------------------------------------------------------------------------------ */

/* A solution from which the search of one cluster continues, and the relaxations that it ends. */
typedef struct proposal {
    uint32_t root, which; /* root of the cluster; index of the relaxation that was asked about */
    const sunder_i_solution *solution;
    sunder_i_restored *restored;
    size_t n;
} proposal;

static bool is_held(const asking *g, const sunder_i_relaxation *t, const sunder_i_relaxation *asked)
{
    const sunder_i_model *model = &g->solver->model;
    const sunder_i_requirement key = {.a = t->a, .b = sunder_i_whole_of(model, t->b)};
    if (key.a == asked->a && key.b == sunder_i_whole_of(model, asked->b)) return false;
    return bsearch(&key, g->required, g->required_n, sizeof key, sunder_i_by_id_pair) != NULL;
}

static bool make_proposal(const asking *g, uint32_t which, const sunder_i_solution *solution, proposal *out)
{
    const sunder_i_model *model = &g->solver->model;
    const sunder_i_relaxations *all = &model->relaxations;
    *out = (proposal){.which = which, .solution = solution, .restored = sunder_i_alloc(all->n, sizeof *out->restored)};
    for (size_t k = 0; k < all->n && out->restored; k++) {
        const sunder_i_relaxation *t = &all->item[k];
        const bool met = sunder_i_set_has(solution->body, solution->bodies, model->body_of[t->a]) ||
                         sunder_i_set_has(solution->body, solution->bodies, model->body_of[t->b]);
        if (met && !t->infeasible && !is_held(g, t, &all->item[which]))
            out->restored[out->n++] = sunder_i_restored_of(model, t);
    }
    if (out->n) qsort(out->restored, out->n, sizeof *out->restored, sunder_i_by_restored);
    return out->restored != NULL;
}

/* Merges the clusters of the solution's bodies into one and marks it as taken. If one of these clusters is taken by
 * an earlier solution, merges nothing and sets *fits to false, else to true. taken: [bodies], indexed by the root of
 * a cluster. Returns false if memory is out. */
static bool join_solution(sunder_i_solver *s, const sunder_i_solution *solution, bool *taken, bool *fits)
{
    *fits = true;
    for (size_t k = 0; k < solution->bodies && *fits; k++)
        *fits = !taken[sunder_i_union_find(s->parent, solution->body[k])];
    for (size_t k = 1; k < solution->bodies && *fits; k++)
        if (!sunder_i_solver_add_edge(s, solution->body[0], solution->body[k])) return false;
    if (*fits) taken[sunder_i_union_find(s->parent, solution->body[0])] = true;
    return true;
}

/* Lists the first proposal of each cluster. A question whose solution does not fit beside another proposal is asked
 * again later. */
static bool list_proposals(sunder_i_solver *s, const asking *g, size_t clusters, proposal *list, size_t *n)
{
    bool *taken = sunder_i_calloc(s->model.bodies, sizeof *taken), ok = taken != NULL, fits;
    for (size_t k = 0; k < clusters && ok; k++) {
        const sunder_i_decision *decision = &g->decision[k];
        if (decision->verdict != SUNDER_I_FEASIBLE) continue;
        size_t last = g->first[k]; /* index of the last question of the cluster that was asked */
        while (last + 1 < g->first[k + 1] && g->asked[last + 1]) last++;
        ok = join_solution(s, &decision->solution, taken, &fits);
        g->asked[last] = fits;
        if (ok && fits) ok = make_proposal(g, g->question[last].relaxation, &decision->solution, &list[(*n)++]);
    }
    for (size_t k = 0; k < *n; k++) list[k].root = sunder_i_union_find(s->parent, list[k].solution->body[0]);
    sunder_i_free(taken);
    return ok;
}

typedef struct resuming {
    const sunder_i_solver *solver;
    const asking *asked;
    const proposal *proposal;
    size_t n;
} resuming;

/* Returns the demands on all present conflicts but that of relaxation `which`, in the form that proofs use; *n is their
 * number. NULL if memory is out. */
static sunder_i_waiver *waive_others(const resuming *g, uint32_t which, size_t *n)
{
    const sunder_i_model *model = &g->solver->model;
    const sunder_i_relaxation *t = &model->relaxations.item[which];
    const uint32_t b = sunder_i_whole_of(model, t->b);
    sunder_i_waiver *out = sunder_i_alloc(g->asked->required_n, sizeof *out);
    *n = 0;
    for (size_t k = 0; k < g->asked->required_n && out; k++) {
        const sunder_i_requirement *r = &g->asked->required[k];
        if (r->a != t->a || r->b != b) out[(*n)++] = (sunder_i_waiver){r->a, r->b, r->clearance, r->clearance < 0};
    }
    return out;
}

/* If the search finds no solution with a margin: aligns the bodies exactly (prove/optimum/tight_place.c). */
static sunder_status align_exactly(const resuming *g, const proposal *x, sunder_i_cluster *c, double *move, bool *done,
                                   sunder_error *err)
{
    sunder_i_waived waived = {0};
    sunder_i_waiver *others = waive_others(g, x->which, &waived.n);
    waived.pair = others;
    bool ok = others != NULL &&
              sunder_i_tight_place(&g->solver->model, &waived, c->body, c->n, MARGINS * c->margin, move, done);
    sunder_i_free(others);
    if (ok && *done && x->n) {
        c->restored = sunder_i_alloc(x->n, sizeof *c->restored);
        ok = c->restored != NULL;
        if (ok) memcpy(c->restored, x->restored, x->n * sizeof *c->restored);
        c->restored_n = ok ? x->n : 0;
    }
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

static void place_solution(const sunder_i_cluster *c, const sunder_i_solution *solution, double *move)
{
    for (size_t k = 0, at = 0; k < solution->bodies; k++) {
        while (c->body[at] < solution->body[k]) at++;
        memcpy(move + 2 * at, solution->move + 2 * k, 2 * sizeof *move);
    }
}

static sunder_status resume_proposal(const resuming *g, const proposal *x, sunder_i_cluster *c, double *move,
                                     sunder_error *err)
{
    const size_t size = 2 * c->n * sizeof *move;
    double *stood = sunder_i_alloc(2 * c->n, sizeof *stood);
    bool done = false;
    if (!stood) return sunder_i_failure_cause(err);
    memcpy(stood, move, size);
    place_solution(c, x->solution, move);
    sunder_status status = sunder_i_cluster_resume(&g->solver->model, c, x->restored, x->n, move, &done, err);
    if (!status && !done) {
        memcpy(move, stood, size);
        place_solution(c, x->solution, move);
        status = align_exactly(g, x, c, move, &done, err);
    }
    if (!done) memcpy(move, stood, size);
    sunder_i_free(stood);
    return status;
}

static sunder_status resume_cluster(const sunder_i_solver *s, sunder_i_cluster *c, double *move, void *context,
                                    sunder_error *err)
{
    const resuming *g = context;
    const uint32_t root = sunder_i_reader_for(s, c);
    sunder_status status = SUNDER_OK;
    c->outcome = SUNDER_I_WORKED_ON;
    for (size_t p = 0; p < g->n && !status; p++)
        if (g->proposal[p].root == root) status = resume_proposal(g, &g->proposal[p], c, move, err);
    return status;
}

/* Notes which questions were asked, so that none is asked twice: if the search could not continue from a solution, it
 * could not the next time. False if memory is out. */
static bool note_asked(sunder_i_solver *s, const asking *g, size_t questions)
{
    if (!sunder_i_reserve(&s->asked, &s->asked_capacity, s->asked_n + questions, sizeof *s->asked)) return false;
    for (size_t q = 0; q < questions; q++) {
        const sunder_i_relaxation *t = &s->model.relaxations.item[g->question[q].relaxation];
        if (g->asked[q]) s->asked[s->asked_n++] = (sunder_i_id_pair){t->a, sunder_i_whole_of(&s->model, t->b)};
    }
    if (s->asked_n) qsort(s->asked, s->asked_n, sizeof *s->asked, sunder_i_by_id_pair);
    return true;
}

/* Traces the questions, cluster by cluster. Only the last one of each has a verdict other than unknown. */
static void trace_questions(const sunder_i_solver *s, const asking *g, size_t clusters)
{
    for (size_t k = 0; k < clusters && sunder_i_is_traced(&s->model); k++)
        for (size_t q = g->first[k]; q < g->first[k + 1] && g->asked[q]; q++) {
            const sunder_i_relaxation *t = &s->model.relaxations.item[g->question[q].relaxation];
            const bool last = q + 1 == g->first[k + 1] || !g->asked[q + 1];
            const sunder_i_verdict verdict = last ? g->decision[k].verdict : SUNDER_I_UNKNOWN;
            const char *outcome = verdict == SUNDER_I_FEASIBLE     ? "a solution was found"
                                  : verdict == SUNDER_I_INFEASIBLE ? "proved: no solution"
                                                                   : "no solution found";
            sunder_i_trace_pair(&s->model, "branch and bound", outcome, t->a, t->b);
        }
}

static sunder_status resume_from_solutions(sunder_i_solver *s, const asking *asked, size_t clusters, bool *changed,
                                           sunder_error *err)
{
    resuming g = {.solver = s, .asked = asked};
    proposal *list = sunder_i_calloc(clusters, sizeof *list);
    sunder_status status = SUNDER_OK;
    if (!list || !list_proposals(s, asked, clusters, list, &g.n) || !note_asked(s, asked, asked->first[clusters]))
        status = sunder_i_failure_cause(err);
    g.proposal = list;
    *changed = g.n > 0;
    if (!status && g.n) {
        status = sunder_i_solver_gather(s, err);
        if (!status) status = sunder_i_solver_unite_blocks(s, err);
        if (!status) status = sunder_i_solver_for_clusters(s, NULL, resume_cluster, &g, err);
        if (!status) status = sunder_i_solver_commit(s, err);
        if (!status) status = sunder_i_solver_take_relaxations(s, err);
        if (!status) status = sunder_i_solver_relate(s, err);
    }
    for (size_t k = 0; k < g.n; k++) sunder_i_free(list[k].restored);
    sunder_i_free(list);
    return status;
}

sunder_status sunder_i_solver_ask_one_by_one(sunder_i_solver *solver, bool *changed, sunder_error *err)
{
    const size_t n = solver->model.relaxations.n;
    *changed = false;
    if (solver->model.given_up_n == 0) return SUNDER_OK;
    sunder_status status = sunder_i_solver_gather(solver, err);
    question *list = sunder_i_alloc(n, sizeof *list);
    size_t *first = sunder_i_alloc(n + 1, sizeof *first), clusters = 0;
    sunder_i_requirement *required = sunder_i_alloc(n, sizeof *required);
    bool *asked = sunder_i_calloc(n, sizeof *asked),
         *wanted = sunder_i_solver_connected_with(solver, sunder_i_is_wanted);
    sunder_i_decision *decision = sunder_i_calloc(n, sizeof *decision);
    if (!solver->asked_work) solver->asked_work = sunder_i_calloc(solver->model.bodies, sizeof *solver->asked_work);
    if (!status && (!list || !first || !required || !asked || !wanted || !decision || !solver->asked_work))
        status = sunder_i_failure_cause(err);
    if (!status) {
        list_questions(solver, wanted, list, first, &clusters);
        asking g = {solver,  list, first, required, list_requirements(solver, required), asked, solver->asked_work,
                    decision};
        status = sunder_i_parallel(solver->model.rules.threads, clusters, SUNDER_I_GRAIN_WHOLE, ask_clusters, &g, err);
        if (!status) trace_questions(solver, &g, clusters);
        if (!status) status = resume_from_solutions(solver, &g, clusters, changed, err);
    }
    for (size_t k = 0; k < clusters && decision; k++) sunder_i_decision_clear(&decision[k]);
    sunder_i_free_all(list, first, required, asked, wanted, decision);
    return status;
}
