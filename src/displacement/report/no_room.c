/* Determines which remaining conflicts provably have no solution ("no_room"), or belong to a dense group of features
 * for which there is not enough room ("crowded"), and keeps a proof of each.
 *
 * A conflict has no room if it and all pairs that are not listed cannot be solved together while every other listed
 * pair is no worse than at the start. Each conflict is examined by itself (prove/proofs/feasibility.c). A proof is then
 * made irreducible: features are removed one after the other, and a feature is kept, with all of its parts, if nothing
 * can be proved without it; this goes on as long as the effort lasts.
 *
 * In a dense group a pair remains in conflict not because of the pairs that are not listed, but because a few features
 * around it, most of them in listed pairs too, need more room than there is. A conflict without a proof of the first
 * kind is crowded if a chain through it (prove/proofs/chain_fewest.c) proves that the pairs of a few features cannot
 * all be solved, whatever other conflicts remain. A conflict of a body without a limit and a barrier is also crowded if
 * it is proved that the body has no free place among the barriers about it. */
#include "displacement/prove/proofs/feasibility.h"
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- What listed pairs must keep --------------------------------------------------------------------------------- */

typedef struct requiring {
    const sunder_i_solver *solver;
    const sunder_report *report;
    const uint32_t *listed; /* indices in the report's conflicts */
    sunder_i_requirement *required;
} requiring;

static sunder_status find_some_requirements(void *context, size_t begin, size_t end, sunder_error *err)
{
    const requiring *g = context;
    for (size_t k = begin; k < end; k++) {
        const sunder_conflict *c = &g->report->conflict[g->listed[k]];
        const sunder_i_solver *s = g->solver;
        const sunder_status status =
            sunder_i_requirement_find(&s->model, &s->start, (uint32_t)c->a, (uint32_t)c->b, &g->required[k], err);
        if (status) return status;
    }
    return SUNDER_OK;
}

/* ---- Making proofs irreducible ----------------------------------------------------------------------------------- */

/* Writes the features and barriers of the proof to set[] and their number to *n. set[] must have room for them; callers
 * provide room for those of an earlier proof with the same features. Returns false if memory is out. */
static bool take_features(const sunder_i_model *model, const sunder_proof *proof, uint32_t *set, size_t *n)
{
    uint32_t *all = sunder_i_alloc(3 * proof->nodes, sizeof *all);
    if (!all) return false;
    *n = sunder_i_proof_things(model, proof, all);
    memcpy(set, all, *n * sizeof *set);
    sunder_i_free(all);
    return true;
}

/* Removes features that the proof does not need, in order of their numbers, as long as the effort lasts. Each step
 * tries to find a proof without the feature; if it succeeds, the features that the new proof no longer uses are removed
 * as well. *budget is the effort allowed, and is reduced by what was used. */
static sunder_status reduce_proof(const sunder_i_subproblem *subproblem, sunder_i_decide_subproblem decide,
                                  uint64_t *budget, sunder_proof **proof, sunder_error *err)
{
    sunder_i_subproblem q = *subproblem;
    const size_t room = 3 * (*proof)->nodes;
    uint32_t *all = sunder_i_alloc(room, sizeof *all), *set = sunder_i_alloc(room, sizeof *set);
    uint32_t *body = sunder_i_alloc(room, sizeof *body);
    sunder_status status = all && set && body ? SUNDER_OK : sunder_i_failure_cause(err);
    const size_t n = status ? 0 : sunder_i_proof_things(q.model, *proof, all);
    size_t left = n;
    if (n) memcpy(set, all, n * sizeof *set);
    q.reserves = 0;
    for (size_t k = 0; k < n && !status; k++) {
        if (all[k] == q.a || all[k] == q.b || !sunder_i_set_has(set, left, all[k])) continue;
        size_t out = 0;
        for (size_t i = 0; i < left; i++)
            if (set[i] != all[k]) set[out++] = set[i];
        size_t bodies = 0;
        for (size_t i = 0; i < out; i++)
            if (!sunder_i_is_barrier(q.model, set[i])) body[bodies++] = q.model->body_of[set[i]];
        q.body = body;
        q.bodies = sunder_i_set_make(body, bodies);
        q.feature = set;
        q.features = out;
        sunder_i_decision decision;
        status = decide(&q, &decision, err);
        if (decision.proof) {
            q.fine_plane = decision.fine_plane;
            sunder_i_proof_free(*proof);
            *proof = decision.proof;
            decision.proof = NULL;
            if (!take_features(q.model, *proof, set, &left)) status = sunder_i_failure_cause(err);
        } else {
            set[out] = all[k];
            left = sunder_i_set_make(set, out + 1);
        }
        *budget = *budget > decision.work ? *budget - decision.work : 0;
        sunder_i_decision_clear(&decision);
        if (*budget == 0) break;
    }
    sunder_i_free_all(all, set, body);
    return status;
}

/* ---- The conflicts of a cluster ---------------------------------------------------------------------------------- */

/* A conflict, as an index in the report, the root of the cluster that it belongs to, and what is known of it. open: it
 * is to be examined, or examined again with more effort. no_plane: the plane of the pair's relative move was examined
 * and gave no answer. */
typedef struct matter {
    uint32_t root, conflict;
    bool open;
    bool fine;  /* with coarse lines there is a solution, so the next question uses fine ones */
    bool slack; /* with fine lines there is a solution, too; the next question has a translation for each pair of parts
                 * that must keep an overlap no deeper than it was */
    bool still; /* with these translations there is a solution, too; what remains is whether the bodies have a position
                 * in doubles, which is tested after everything else */
    bool no_plane;
} matter;

typedef struct asking {
    const sunder_i_solver *solver;
    sunder_report *report;
    sunder_i_decide_subproblem decide;
    matter *matter;
    const size_t *first; /* [clusters + 1] the index of the first matter of each cluster, and the end */
    const sunder_i_requirement *required;
    size_t required_n;
    bool one_each;  /* one proof for each cluster is enough */
    uint64_t times; /* the factor by which EFFORT and MOST_EFFORT are multiplied: 1 + MORE_EFFORT times the value of
                     * --effort */
} asking;

static double farthest_of(const sunder_i_model *model, const uint32_t *body, size_t n)
{
    double farthest = 0;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *b = &model->body[body[k]];
        if (!b->fixed && isfinite(b->limit)) farthest = sunder_i_max(farthest, b->limit);
    }
    return farthest;
}

/* Sets the next, more exact kind of question for m, and returns whether there is one. The first kind uses slightly
 * coarse lines, which give smaller proofs. If that has a solution, the finest lines are used; if that has one, a slack
 * for pairs that must keep overlaps. Real arithmetic can prove no more than these. Whether one of the two bodies is
 * held between two lines without a position in doubles (`still`) is asked later. */
static bool ask_closer(const sunder_i_subproblem *q, matter *m)
{
    m->still = m->slack || (m->fine && !sunder_i_may_have_slack(q));
    m->slack = m->fine;
    m->fine = true;
    return !m->still;
}

/* If the decision contains a proof, makes it the proof of the conflict and sets the conflict's reason to `reason`.
 * Features that the proof does not need are removed, within *budget. Clears the decision. */
static sunder_status keep_proof(const asking *g, const matter *m, const sunder_i_subproblem *asked,
                                sunder_i_decision *decision, sunder_reason reason, uint64_t *budget, sunder_error *err)
{
    sunder_i_subproblem q = *asked;
    sunder_proof **proof = &g->report->proof[m->conflict];
    *proof = decision->proof;
    q.fine_plane = decision->fine_plane; /* what coarse lines do not prove for all features they do not prove for
                                          * fewer */
    decision->proof = NULL;
    sunder_i_decision_clear(decision);
    if (!*proof) return SUNDER_OK;
    const sunder_status status = *budget ? reduce_proof(&q, g->decide, budget, proof, err) : SUNDER_OK;
    if (status) return status;
    for (size_t k = 0; k < (*proof)->nodes && reason == SUNDER_REASON_NO_ROOM; k++)
        if ((*proof)->node[k].row) g->report->conflict[m->conflict].by_row = true;
    if (g->solver->model.rules.drop_proofs) sunder_i_proof_strip(*proof);
    g->report->conflict[m->conflict].reason = reason;
    return SUNDER_OK;
}

/* Keeps a proof that there is no room. If the proof is reducible, each of the questions that reduce it may take as much
 * effort as the search for the proof, but at least LITTLE_EFFORT. */
static sunder_status keep_no_room(const asking *g, const matter *m, sunder_i_subproblem *q, sunder_i_decision *decision,
                                  bool reducible, sunder_error *err)
{
    const uint64_t effort = q->effort;
    q->effort = effort < LITTLE_EFFORT ? LITTLE_EFFORT : effort;
    uint64_t budget = reducible ? REDUCING * q->effort : 0;
    const sunder_status status = keep_proof(g, m, q, decision, SUNDER_REASON_NO_ROOM, &budget, err);
    q->effort = effort;
    return status;
}

/* Asks whether one conflict has a solution, with more and more exact questions, and keeps a proof that it has none.
 * m->open becomes whether more effort might give an answer. *pool is the effort left for the cluster: the effort of the
 * last question is subtracted if it gave neither a proof nor a solution in real numbers after which only `still` is
 * left to ask. */
static sunder_status ask_conflict(const asking *g, matter *m, sunder_i_subproblem *q, uint64_t *pool, sunder_error *err)
{
    const sunder_conflict *c = &g->report->conflict[m->conflict];
    const uint32_t body[2] = {g->solver->model.body_of[c->a], g->solver->model.body_of[c->b]};
    q->body = body;
    /* a barrier takes part wherever it is near the bodies */
    q->bodies = sunder_i_is_barrier(q->model, (uint32_t)c->b) ? 1 : 2;
    q->a = (uint32_t)c->a;
    q->b = (uint32_t)c->b;
    sunder_i_decision decision = {0};
    sunder_status status = SUNDER_OK;
    do {
        sunder_i_decision_clear(&decision);
        q->coarse = m->fine ? 0 : COARSE;
        q->slack = m->slack && !m->still;
        q->still = m->still;
        q->no_plane = m->no_plane;
        status = g->decide(q, &decision, err);
        m->no_plane = m->no_plane || (!q->no_plane && decision.no_plane);
    } while (!status && decision.verdict == SUNDER_I_FEASIBLE && !m->still && ask_closer(q, m));
    m->open = !decision.proof && decision.verdict == SUNDER_I_UNKNOWN && decision.work > q->effort;
    const bool later = m->still && !q->still; /* there is a solution in real numbers; this question is not asked
                                               * again */
    if (!decision.proof && !later) *pool = *pool > decision.work ? *pool - decision.work : 0;
    q->no_plane = false;
    if (!status) return keep_no_room(g, m, q, &decision, true, err);
    sunder_i_decision_clear(&decision);
    return status;
}

/* Returns whether both bodies of the conflict may move and at least one has no limit. */
static bool has_no_limit(const asking *g, const matter *m)
{
    const sunder_i_model *model = &g->solver->model;
    const sunder_conflict *c = &g->report->conflict[m->conflict];
    const double p = sunder_i_limit_of(&model->body[model->body_of[c->a]]),
                 r = sunder_i_limit_of(&model->body[model->body_of[c->b]]);
    return p > 0 && r > 0 && p + r == INFINITY;
}

/* Keeps the proof that a conflict is crowded. A proof by a single straight chain is already irreducible. Any other is
 * reduced, and dropped if the cluster's *budget is used up before it is irreducible. */
static sunder_status keep_crowded(const asking *g, const matter *m, const sunder_i_subproblem *q,
                                  sunder_i_decision *decision, uint64_t *budget, sunder_error *err)
{
    uint64_t none = 0;
    const bool reducible = decision->proof && !decision->straight;
    if (reducible && *budget == 0) {
        sunder_i_decision_clear(decision);
        return SUNDER_OK;
    }
    const sunder_status status =
        keep_proof(g, m, q, decision, SUNDER_REASON_UNRESOLVED, reducible ? budget : &none, err);
    g->report->conflict[m->conflict].crowded = g->report->proof[m->conflict] != NULL;
    if (status || !reducible || *budget) return status;
    sunder_i_proof_free(g->report->proof[m->conflict]);
    g->report->proof[m->conflict] = NULL;
    g->report->conflict[m->conflict].crowded = false;
    return SUNDER_OK;
}

/* Looks for a chain of features through the pair, each of which pushes the next, up to their limits, that proves that
 * the pair has no room. If its chains have at most REDUCED_LINKS links the proof is made irreducible, as other proofs
 * are; longer ones are kept as they are found. reducing: NULL, or the budget for making proofs irreducible if the chain
 * is to prove that the conflict is crowded (keep_crowded()). */
static sunder_status ask_chain(const asking *g, matter *m, sunder_i_subproblem *q, sunder_i_chains *chains,
                               uint64_t *reducing, sunder_error *err)
{
    const sunder_conflict *c = &g->report->conflict[m->conflict];
    const uint32_t body[2] = {q->model->body_of[c->a], q->model->body_of[c->b]};
    sunder_i_decision decision;
    size_t links;
    q->body = body;
    q->bodies = 2;
    q->a = (uint32_t)c->a;
    q->b = (uint32_t)c->b;
    sunder_status status = sunder_i_chains_decide(chains, q, &decision, &links, err);
    m->open = !decision.proof;
    if (status) {
        sunder_i_decision_clear(&decision);
        return status;
    }
    return reducing ? keep_crowded(g, m, q, &decision, reducing, err)
                    : keep_no_room(g, m, q, &decision, links <= REDUCED_LINKS, err);
}

/* For each unresolved conflict of a cluster, unless both bodies can move and one has no limit: looks for a chain
 * through its pair. reducing: NULL if the chains are to prove that there is no room; otherwise they prove that the
 * conflict is crowded (sunder_layer.h), and *reducing is the budget for making these proofs irreducible. */
static sunder_status ask_chains(const asking *g, matter *first, const matter *last, sunder_i_subproblem *q,
                                uint64_t *reducing, sunder_error *err)
{
    sunder_i_chains *chains = sunder_i_chains_new(q, reducing != NULL);
    sunder_status status = chains ? SUNDER_OK : sunder_i_failure_cause(err);
    for (matter *m = first; m < last && !status; m++)
        if (g->report->conflict[m->conflict].reason == SUNDER_REASON_UNRESOLVED && !has_no_limit(g, m))
            status = ask_chain(g, m, q, chains, reducing, err);
    sunder_i_chains_free(chains);
    return status;
}

/* Returns the features of the two bodies in ascending order, which the caller frees, and sets *n to their number.
 * Returns NULL if memory is out. */
static uint32_t *members_of(const sunder_i_model *model, const uint32_t body[2], size_t *n)
{
    const sunder_i_body *p = &model->body[body[0]], *r = &model->body[body[1]];
    uint32_t *set = sunder_i_alloc((size_t)p->members + r->members, sizeof *set);
    if (!set) return NULL;
    memcpy(set, model->member + p->member, p->members * sizeof *set);
    memcpy(set + p->members, model->member + r->member, r->members * sizeof *set);
    *n = sunder_i_set_make(set, (size_t)p->members + r->members);
    return set;
}

/* Examines a conflict of two bodies that can both move, at least one of them without a limit, as ask_conflict() does.
 * Only the features of these two bodies are considered, whatever else is near. Beyond the distance at which the two
 * certainly do not meet, only shadows forbid a relative move, and the shadow of a forbidden move has no end
 * (pair_reasons.c); so twice that distance takes the place of the missing limit. */
static sunder_status ask_without_limit(const asking *g, matter *m, const sunder_i_subproblem *q, uint64_t *pool,
                                       sunder_error *err)
{
    const sunder_conflict *c = &g->report->conflict[m->conflict];
    const uint32_t body[2] = {q->model->body_of[c->a], q->model->body_of[c->b]};
    sunder_i_subproblem two = *q;
    uint32_t *set = members_of(q->model, body, &two.features);
    if (!set) return sunder_i_failure_cause(err);
    two.feature = set;
    two.reserves = 0;
    two.instead = 2 * sunder_i_farthest_near(q->model, body[0], body[1]);
    const sunder_status status = ask_conflict(g, m, &two, pool, err);
    sunder_i_free(set);
    return status;
}

/* Is the conflict between a body without a limit and a barrier? */
static bool has_barrier_and_no_limit(const asking *g, const matter *m)
{
    const sunder_i_model *model = &g->solver->model;
    const sunder_conflict *c = &g->report->conflict[m->conflict];
    const sunder_i_body *body = &model->body[model->body_of[c->a]];
    return sunder_i_is_barrier(model, (uint32_t)c->b) && sunder_i_limit_of(body) == INFINITY;
}

/* Limits the question to the conflict's body, which has no limit, and all barriers no farther from it than `reach`
 * times its size (barriers_about.c). They are stored in *thing, which the caller frees. False if memory is out. */
static bool put_among_barriers(const asking *g, const matter *m, double reach, sunder_i_subproblem *q,
                               sunder_i_list *thing)
{
    const sunder_i_model *model = q->model;
    const uint32_t body = model->body_of[g->report->conflict[m->conflict].a];
    const sunder_i_body *b = &model->body[body];
    const double size = sunder_i_max(b->box[2] - b->box[0], b->box[3] - b->box[1]) + model->barriers->farthest;
    bool ok = sunder_i_barriers_about(model, body, reach * size, thing, &q->instead);
    for (uint32_t k = 0; k < b->members && ok; k++) ok = sunder_i_list_push(thing, model->member[b->member + k]);
    thing->n = sunder_i_set_make(thing->item, thing->n);
    q->feature = thing->item;
    q->features = thing->n;
    q->reserves = 0;
    return ok;
}

/* Examines a conflict of a body without a limit and a barrier, with the barriers within `reach` and nothing else. The
 * conflict stays open until there is a proof. */
static sunder_status ask_among_barriers(const asking *g, matter *m, const sunder_i_subproblem *q, double reach,
                                        uint64_t *pool, sunder_error *err)
{
    sunder_i_subproblem among = *q;
    sunder_i_list thing = {0};
    sunder_status status = SUNDER_OK;
    const bool ok = put_among_barriers(g, m, reach, &among, &thing);
    if (ok && among.instead > 0) {
        *m = (matter){.root = m->root, .conflict = m->conflict, .open = true};
        status = ask_conflict(g, m, &among, pool, err);
        m->open = g->report->proof[m->conflict] == NULL;
    }
    m->still = false; /* a body without a limit has other places on any line */
    sunder_i_free(thing.item);
    return ok ? status : sunder_i_failure_cause(err);
}

/* For a conflict without a proof, of a body without a limit and a barrier: looks for a proof that the body has no free
 * place among the barriers about it. It can be in such a conflict although that one has a solution: where the solution
 * has more overlaps with other barriers, no more than at the start. */
static sunder_status ask_for_free_place(const asking *g, const matter *m, const sunder_i_subproblem *all,
                                        uint64_t *budget, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    double reach = 1;
    for (uint64_t effort = FIRST_EFFORT; effort <= MOST_EFFORT && *budget && !status && !g->report->proof[m->conflict];
         effort *= GROWTH) {
        const sunder_conflict *c = &g->report->conflict[m->conflict];
        sunder_i_subproblem q = *all;
        sunder_i_list thing = {0};
        sunder_i_decision decision = {0};
        q.body = &g->solver->model.body_of[c->a];
        q.bodies = 1;
        q.a = (uint32_t)c->a;
        q.b = (uint32_t)c->b;
        q.coarse = 0;
        q.effort = effort;
        const bool ok = put_among_barriers(g, m, reach, &q, &thing);
        status = ok ? g->decide(&q, &decision, err) : sunder_i_failure_cause(err);
        if (!status && decision.proof)
            status = keep_crowded(g, m, &q, &decision, budget, err);
        else
            sunder_i_decision_clear(&decision);
        sunder_i_free(thing.item);
        reach *= GROWTH;
    }
    return status;
}

/* For conflicts without a proof: looks for chains that prove them crowded, or for bodies without a limit beside
 * barriers for any such proof. All pairs then have to keep the full distance, whether they are listed or not. */
static sunder_status ask_crowded(const asking *g, matter *first, const matter *last, const sunder_i_subproblem *cluster,
                                 sunder_error *err)
{
    sunder_i_subproblem q = *cluster;
    uint64_t budget = CROWD_REDUCING + CROWD_REDUCING_EACH * (uint64_t)cluster->reserves;
    q.required = NULL;
    q.required_n = 0;
    q.planes = NULL;
    q.precedents = NULL;
    q.coarse = COARSE;
    q.effort = CROWD_EFFORT;
    q.slack = q.still = q.no_plane = q.fine_plane = false;
    sunder_status status = ask_chains(g, first, last, &q, &budget, err);
    for (const matter *m = first; m < last && !status; m++)
        if (g->report->conflict[m->conflict].reason == SUNDER_REASON_UNRESOLVED && !g->report->proof[m->conflict] &&
            has_barrier_and_no_limit(g, m))
            status = ask_for_free_place(g, m, &q, &budget, err);
    return status;
}

/* Examines one open conflict with the effort of q. */
static sunder_status ask_one(const asking *g, matter *m, sunder_i_subproblem *q, double reach, uint64_t *pool,
                             sunder_error *err)
{
    if (has_no_limit(g, m)) return ask_without_limit(g, m, q, pool, err);
    if (has_barrier_and_no_limit(g, m)) return ask_among_barriers(g, m, q, reach, pool, err);
    return ask_conflict(g, m, q, pool, err);
}

/* Is there a proof for one of the conflicts, and is that enough? */
static bool has_enough(const asking *g, const matter *first, const matter *last)
{
    for (const matter *m = first; m < last && g->one_each; m++) {
        const sunder_proof *proof = g->report->proof[m->conflict];
        size_t k = 0;
        while (proof && k < proof->nodes && !proof->node[k].still) k++;
        if (proof && k == proof->nodes) return true;
    }
    return false;
}

/* Examines all open conflicts of a cluster with the effort FIRST_EFFORT, then those still open with GROWTH times as
 * much, and so on. If `patience` conflicts in a row stay open, the search for proofs ends: there is no further effort.
 * `patience` is PROOFS_IN_VAIN_AT_FIRST for the first effort and PROOFS_IN_VAIN for the second, or less if the first
 * effort gave no answer at all; it is halved with each later effort, since each question costs more. */
static sunder_status ask_cluster(const asking *g, matter *first, const matter *last, sunder_i_subproblem *q,
                                 sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    bool in_vain = false;
    unsigned patience = PROOFS_IN_VAIN_AT_FIRST;
    uint64_t pool = EFFORT * g->times + EFFORT_EACH * (uint64_t)(q->reserves + 2);
    double reach = 1;
    for (uint64_t effort = FIRST_EFFORT; effort <= MOST_EFFORT * g->times && pool && !in_vain && !status;
         effort *= GROWTH) {
        unsigned open = 0, asked = 0;
        for (matter *m = first; m < last && pool && !in_vain && !status; m++) {
            if (!m->open) continue;
            if (has_enough(g, first, last)) return SUNDER_OK;
            asked++;
            q->effort = effort < pool ? effort : pool;
            status = ask_one(g, m, q, reach, &pool, err);
            open = m->open ? open + 1 : 0;
            in_vain = open >= patience;
        }
        const bool nothing = open == asked && asked >= ALL_IN_VAIN;
        if (effort == FIRST_EFFORT)
            patience = nothing ? PROOFS_IN_VAIN_OF_CROWD : PROOFS_IN_VAIN;
        else if (patience > 2)
            patience /= 2;
        reach *= GROWTH;
    }
    return status;
}

/* Sets the matters of a cluster to what is known at the beginning. */
static void open_all(const asking *g, matter *first, const matter *last)
{
    for (matter *m = first; m < last; m++)
        *m = (matter){.root = m->root,
                      .conflict = m->conflict,
                      .open = g->report->conflict[m->conflict].reason == SUNDER_REASON_UNRESOLVED};
}

/* Asks about the conflicts of a cluster, if bodies are in rows: these have to keep their order, too. */
static sunder_status ask_in_rows(const asking *g, matter *first, const matter *last, sunder_i_subproblem *q,
                                 sunder_error *err)
{
    if (q->model->row_sides == 0 || has_enough(g, first, last)) return SUNDER_OK;
    q->rows = true;
    open_all(g, first, last);
    const sunder_status status = ask_cluster(g, first, last, q, err);
    q->rows = false;
    return status;
}

/* Asks about the conflicts of a cluster in all ways.
 *
 * Questions about positions in doubles (`still`) are asked after real arithmetic has given all its answers, with an
 * effort of their own: they are large and often unanswered, and must not use up the effort for other conflicts of the
 * cluster. The rule of rows is in a proof only if none was found without; but where one proof is enough, it is asked
 * for first with this rule, since that takes less work. */
static sunder_status ask_in_all_ways(const asking *g, matter *first, const matter *last, sunder_i_subproblem *q,
                                     sunder_error *err)
{
    sunder_status status = ask_chains(g, first, last, q, NULL, err);
    if (!status && g->one_each) status = ask_in_rows(g, first, last, q, err);
    if (g->one_each) open_all(g, first, last);
    if (!status) status = ask_cluster(g, first, last, q, err);
    for (matter *m = first; m < last; m++) m->open = m->still;
    if (!status) status = ask_cluster(g, first, last, q, err);
    if (!status && !g->one_each) status = ask_in_rows(g, first, last, q, err);
    return status || has_enough(g, first, last) ? status : ask_crowded(g, first, last, q, err);
}

static sunder_status ask_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const asking *g = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end; k++) {
        matter *first = g->matter + g->first[k], *last = g->matter + g->first[k + 1];
        sunder_i_planes planes = {0};
        sunder_i_precedents precedents = {0};
        sunder_i_subproblem q = {.model = &g->solver->model,
                                 .required = g->required,
                                 .required_n = g->required_n,
                                 .most = MOST_BODIES,
                                 .planes = &planes,
                                 .precedents = &precedents};
        q.reserve = sunder_i_solver_members(g->solver, first->root, &q.reserves);
        q.farthest = farthest_of(q.model, q.reserve, q.reserves);
        sunder_i_reading reading;
        sunder_i_reads_begin(&reading, q.model, first->root);
        status = ask_in_all_ways(g, first, last, &q, err);
        sunder_i_reads_end(&reading);
        sunder_i_planes_clear(&planes);
        if (status) return status;
    }
    return status;
}

/* ---- All conflicts ----------------------------------------------------------------------------------------------- */

/* Lists the conflicts to examine in list[], grouped by cluster, and sets first[] to the index of the first of each
 * cluster, followed by the end. Returns the number of clusters. */
static size_t group_by_cluster(const sunder_i_solver *s, const sunder_report *report, const uint32_t *listed, size_t n,
                               matter *list, size_t *first)
{
    const sunder_i_model *model = &s->model;
    size_t open = 0, groups = 0;
    for (size_t k = 0; k < n; k++) {
        const sunder_conflict *c = &report->conflict[listed[k]];
        if (c->reason != SUNDER_REASON_UNRESOLVED) continue;
        const uint32_t i = model->body_of[c->a], j = model->body_of[c->b];
        list[open++] = (matter){
            .root = sunder_i_union_find(s->parent, model->body[i].fixed ? j : i), .conflict = listed[k], .open = true};
    }
    if (open) qsort(list, open, sizeof *list, sunder_i_by_id_pair);
    for (size_t k = 0; k < open; k++)
        if (k == 0 || list[k].root != list[k - 1].root) first[groups++] = k;
    first[groups] = open;
    return groups;
}

sunder_status sunder_i_report_proofs(sunder_report *report, const sunder_i_solver *solver,
                                     sunder_i_decide_subproblem decide, bool one_each, sunder_error *err)
{
    const unsigned threads = solver->model.rules.threads;
    const size_t most = report->conflicts;
    uint32_t *listed = sunder_i_alloc(most, sizeof *listed);
    matter *list = sunder_i_alloc(most, sizeof *list);
    size_t *first = sunder_i_alloc(most + 1, sizeof *first);
    sunder_i_requirement *required = sunder_i_alloc(most, sizeof *required);
    sunder_status status = listed && list && first && required ? SUNDER_OK : sunder_i_failure_cause(err);
    size_t n = 0;
    for (size_t k = 0; !status && k < most; k++)
        if (!report->conflict[k].inside_block) listed[n++] = (uint32_t)k;
    const size_t groups = status ? 0 : group_by_cluster(solver, report, listed, n, list, first);
    if (groups) {
        requiring h = {solver, report, listed, required};
        status = sunder_i_parallel(threads, n, SUNDER_I_GRAIN_PAIRS, find_some_requirements, &h, err);
        const uint64_t times = 1 + (uint64_t)(MORE_EFFORT * sunder_i_min(solver->model.rules.effort, MORE_UP_TO));
        asking g = {solver, report, decide, list, first, required, n, one_each, times};
        if (!status) status = sunder_i_parallel(threads, groups, SUNDER_I_GRAIN_WHOLE, ask_clusters, &g, err);
    }
    sunder_i_free_all(listed, list, first, required);
    return status;
}
