/* Which remaining conflicts have no room, or belong to a crowd that has none; with a proof of each.
 *
 * A conflict has no room if it and all unlisted pairs cannot be solved together while every other listed pair stands no
 * worse than at the start. Each is examined by itself (prove/proofs/feasibility.c). A proof is then made irreducible:
 * features are removed one after the other, and a feature stays if its removal leaves nothing provable, and so do all
 * parts of it; as far as the effort goes.
 *
 * In a crowd a pair remains in conflict not because of the unlisted pairs, but because a few features around it, most
 * of them listed too, need more room than there is. A conflict without the proof above is crowded if a chain through it
 * (prove/proofs/chain_fewest.c) proves that the pairs of a few features cannot all be solved, whatever else remains. */
#include "displacement/prove/proofs/feasibility.h"
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- What listed pairs are held to ------------------------------------------------------------------------------- */

typedef struct requiring {
    const sunder_i_solver *solver;
    const sunder_report *report;
    const uint32_t *listed; /* places in the report's conflicts */
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

/* ---- A proof that needs all it says ------------------------------------------------------------------------------ */

/* The things of a proof into a set that has room for them: they are among those of another proof, whose nodes may be
 * fewer. False if memory is out. */
static bool take_features(const sunder_i_model *model, const sunder_proof *proof, uint32_t *set, size_t *n)
{
    uint32_t *all = sunder_i_alloc(3 * proof->nodes, sizeof *all);
    if (!all) return false;
    *n = sunder_i_proof_things(model, proof, all);
    memcpy(set, all, *n * sizeof *set);
    sunder_i_free(all);
    return true;
}

/* Removes features that the proof can do without, in order of number, while the effort lasts: the current one, and
 * those that a proof without it no longer uses. *budget: the effort allowed, reduced by what was spent. */
static sunder_status reduce(const sunder_i_subproblem *subproblem, sunder_i_decide_subproblem decide, uint64_t *budget,
                            sunder_proof **proof, sunder_error *err)
{
    sunder_i_subproblem q = *subproblem;
    const size_t room = 3 * (*proof)->nodes;
    uint32_t *all = sunder_i_alloc(room, sizeof *all), *set = sunder_i_alloc(room, sizeof *set);
    uint32_t *body = sunder_i_alloc(room, sizeof *body);
    sunder_status status = all && set && body ? SUNDER_OK : sunder_i_no_memory(err);
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
            if (!take_features(q.model, *proof, set, &left)) status = sunder_i_no_memory(err);
        } else {
            set[out] = all[k];
            left = sunder_i_set_make(set, out + 1);
        }
        *budget = *budget > decision.work ? *budget - decision.work : 0;
        sunder_i_decision_clear(&decision);
        if (*budget == 0) break;
    }
    sunder_i_free(all);
    sunder_i_free(set);
    sunder_i_free(body);
    return status;
}

/* ---- The conflicts of a cluster ---------------------------------------------------------------------------------- */

/* A conflict of the report, and the cluster that it belongs to. */
typedef struct matter {
    uint32_t root, conflict;
    bool open;
    bool fine;  /* by coarse lines there is a solution */
    bool slack; /* and by fine ones, with a translation for each two parts that are held to an overlap */
    bool still; /* also with slack; but has it a place that doubles can represent? Tested after everything else */
    bool no_plane;
} matter;

typedef struct asking {
    const sunder_i_solver *solver;
    sunder_report *report;
    sunder_i_decide_subproblem decide;
    matter *matter;
    const size_t *first; /* [clusters + 1] matters, cluster after cluster */
    const sunder_i_requirement *required;
    size_t required_n;
    uint64_t times; /* multiple of the effort of --effort 1 */
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

/* Sets the next way to ask; false if there is none. It asks first with slightly coarse lines, which make smaller
 * proofs; if that has a solution, with the finest lines; if that has one, with a slack for pairs that are held to
 * overlaps. Real arithmetic tells no more. Whether one of the two is held between two lines, without a place that
 * doubles can represent, is asked later. */
static bool ask_closer(const sunder_i_subproblem *q, matter *m)
{
    m->still = m->slack || (m->fine && !sunder_i_may_have_slack(q));
    m->slack = m->fine;
    m->fine = true;
    return !m->still;
}

/* The conflict has the decision's proof from now on, if there is one, which is of that reason; what it can do
 * without is left out, while a budget lasts. Clears the decision. */
static sunder_status keep_proof(const asking *g, const matter *m, const sunder_i_subproblem *asked,
                                sunder_i_decision *decision, sunder_reason reason, uint64_t *budget, sunder_error *err)
{
    sunder_i_subproblem q = *asked;
    sunder_proof **proof = &g->report->proof[m->conflict];
    *proof = decision->proof;
    q.fine_plane = decision->fine_plane; /* what coarse lines do not prove of all they do not prove of fewer */
    decision->proof = NULL;
    sunder_i_decision_clear(decision);
    if (!*proof) return SUNDER_OK;
    const sunder_status status = *budget ? reduce(&q, g->decide, budget, proof, err) : SUNDER_OK;
    if (status) return status;
    if (g->solver->model.rules.drop_proofs) sunder_i_proof_strip(*proof);
    g->report->conflict[m->conflict].reason = reason;
    return SUNDER_OK;
}

/* The same of one without room: as much is allowed for each of the questions that reduce it as for the proof, or a
 * little. */
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

/* Asks about one conflict: is there a proof? It is open as long as more effort might tell. */
static sunder_status ask(const asking *g, matter *m, sunder_i_subproblem *q, uint64_t *pool, sunder_error *err)
{
    const sunder_conflict *c = &g->report->conflict[m->conflict];
    const uint32_t body[2] = {g->solver->model.body_of[c->a], g->solver->model.body_of[c->b]};
    q->body = body;
    q->bodies = sunder_i_is_barrier(q->model, (uint32_t)c->b) ? 1 : 2; /* it is met where it is near */
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
    const bool later = m->still && !q->still; /* it has a solution of reals, and is not asked for one again */
    if (!decision.proof && !later) *pool = *pool > decision.work ? *pool - decision.work : 0;
    q->no_plane = false;
    if (!status) return keep_no_room(g, m, q, &decision, true, err);
    sunder_i_decision_clear(&decision);
    return status;
}

/* Are they two that move, and one of them without a limit? */
static bool has_no_limit(const asking *g, const matter *m)
{
    const sunder_i_model *model = &g->solver->model;
    const sunder_conflict *c = &g->report->conflict[m->conflict];
    const double p = sunder_i_limit_of(&model->body[model->body_of[c->a]]),
                 r = sunder_i_limit_of(&model->body[model->body_of[c->b]]);
    return p > 0 && r > 0 && p + r == INFINITY;
}

/* Keeps the proof of a conflict in a crowd. A proof by one straight chain is already irreducible. Any other is
 * reduced, or dropped when the cluster's `budget` is used up. */
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

/* Does the pair push others to their limits, one after the other? A chain of more than a few links is irreducible from
 * the start, as far as such chains tell. crowd: NULL, or the budget of pairs that belong to a crowd. */
static sunder_status ask_chain(const asking *g, matter *m, sunder_i_subproblem *q, sunder_i_chains *chains,
                               uint64_t *crowd, sunder_error *err)
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
    return crowd ? keep_crowded(g, m, q, &decision, crowd, err)
                 : keep_no_room(g, m, q, &decision, links <= REDUCED_LINKS, err);
}

/* crowd: NULL, or what may be taken by reducing, of those that are of a crowd. */
static sunder_status ask_chains(const asking *g, matter *first, const matter *last, sunder_i_subproblem *q,
                                uint64_t *crowd, sunder_error *err)
{
    sunder_i_chains *chains = sunder_i_chains_new(q, crowd != NULL);
    sunder_status status = chains ? SUNDER_OK : sunder_i_no_memory(err);
    for (matter *m = first; m < last && !status; m++)
        if (g->report->conflict[m->conflict].reason == SUNDER_REASON_UNRESOLVED && !has_no_limit(g, m))
            status = ask_chain(g, m, q, chains, crowd, err);
    sunder_i_chains_free(chains);
    return status;
}

/* If nothing else was proved: does it belong to a crowd, a few features that all owe each other the full distance,
 * listed or not? */
static sunder_status ask_crowd(const asking *g, matter *first, const matter *last, const sunder_i_subproblem *cluster,
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
    return ask_chains(g, first, last, &q, &budget, err);
}

/* Those of the two bodies, ascending; *n of them. NULL if memory is out. */
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

/* The same for two features where one has no limit: for the two alone, whatever else is near. Beyond the distance at
 * which they are certainly apart only shadows forbid a relative move, and what is shaded there was shaded before
 * (pair_reasons.c). */
static sunder_status ask_without_limit(const asking *g, matter *m, const sunder_i_subproblem *q, uint64_t *pool,
                                       sunder_error *err)
{
    const sunder_conflict *c = &g->report->conflict[m->conflict];
    const uint32_t body[2] = {q->model->body_of[c->a], q->model->body_of[c->b]};
    sunder_i_subproblem two = *q;
    uint32_t *set = members_of(q->model, body, &two.features);
    if (!set) return sunder_i_no_memory(err);
    two.feature = set;
    two.reserves = 0;
    two.instead = 2 * sunder_i_farthest_near(q->model, body[0], body[1]);
    const sunder_status status = ask(g, m, &two, pool, err);
    sunder_i_free(set);
    return status;
}

/* All open conflicts of a cluster at one level of effort, before any at the next level. If `patience` questions in a
 * row get no answer, the cluster is too entangled for a proof, and the level is the last. The number falls with each
 * level, since each costs more, and for a crowd where the first level answers nothing. */
static sunder_status ask_cluster(const asking *g, matter *first, const matter *last, sunder_i_subproblem *q,
                                 sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    bool in_vain = false;
    unsigned patience = PROOFS_IN_VAIN_AT_FIRST;
    uint64_t pool = EFFORT * g->times + EFFORT_EACH * (uint64_t)(q->reserves + 2);
    for (uint64_t effort = FIRST_EFFORT; effort <= MOST_EFFORT * g->times && pool && !in_vain && !status;
         effort *= GROWTH) {
        unsigned open = 0, asked = 0;
        for (matter *m = first; m < last && pool && !in_vain && !status; m++) {
            if (!m->open) continue;
            asked++;
            q->effort = effort < pool ? effort : pool;
            status = has_no_limit(g, m) ? ask_without_limit(g, m, q, &pool, err) : ask(g, m, q, &pool, err);
            open = m->open ? open + 1 : 0;
            in_vain = open >= patience;
        }
        const bool nothing = open == asked && asked >= ALL_IN_VAIN;
        if (effort == FIRST_EFFORT)
            patience = nothing ? PROOFS_IN_VAIN_OF_CROWD : PROOFS_IN_VAIN;
        else if (patience > 2)
            patience /= 2;
    }
    return status;
}

/* Bodies that stay in place because of their lattice are examined once real arithmetic has told everything, with an
 * effort of their own: such questions are large and often unanswered, and must not use up the effort of later ones in
 * the cluster. */
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
        status = ask_chains(g, first, last, &q, NULL, err);
        if (!status) status = ask_cluster(g, first, last, &q, err);
        for (matter *m = first; m < last; m++) m->open = m->still;
        if (!status) status = ask_cluster(g, first, last, &q, err);
        if (!status) status = ask_crowd(g, first, last, &q, err);
        sunder_i_reads_end(&reading);
        sunder_i_planes_clear(&planes);
        if (status) return status;
    }
    return status;
}

/* ---- All of them ------------------------------------------------------------------------------------------------- */

/* The conflicts to be asked about, by clusters; first: where each begins, and the end. Returns how many clusters. */
static size_t group(const sunder_i_solver *s, const sunder_report *report, const uint32_t *listed, size_t n,
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
                                     sunder_i_decide_subproblem decide, sunder_error *err)
{
    const unsigned threads = solver->model.rules.threads;
    const size_t most = report->conflicts;
    uint32_t *listed = sunder_i_alloc(most, sizeof *listed);
    matter *list = sunder_i_alloc(most, sizeof *list);
    size_t *first = sunder_i_alloc(most + 1, sizeof *first);
    sunder_i_requirement *required = sunder_i_alloc(most, sizeof *required);
    sunder_status status = listed && list && first && required ? SUNDER_OK : sunder_i_no_memory(err);
    size_t n = 0;
    for (size_t k = 0; !status && k < most; k++)
        if (!report->conflict[k].inside_block) listed[n++] = (uint32_t)k;
    const size_t groups = status ? 0 : group(solver, report, listed, n, list, first);
    if (groups) {
        requiring h = {solver, report, listed, required};
        status = sunder_i_parallel(threads, n, SUNDER_I_GRAIN_PAIRS, find_some_requirements, &h, err);
        const uint64_t times = 1 + (uint64_t)(MORE_EFFORT * sunder_i_min(solver->model.rules.effort, MORE_UP_TO));
        asking g = {solver, report, decide, list, first, required, n, times};
        if (!status) status = sunder_i_parallel(threads, groups, SUNDER_I_GRAIN_WHOLE, ask_clusters, &g, err);
    }
    sunder_i_free(listed);
    sunder_i_free(list);
    sunder_i_free(first);
    sunder_i_free(required);
    return status;
}
