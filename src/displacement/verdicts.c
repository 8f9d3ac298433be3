/* Which conflicts that remain have no room, with the proof of each.
 *
 * A conflict has no room if it and all pairs that are not listed cannot be solved together, every other listed pair
 * being held no worse than it stood. Each is asked about by itself (certify.c). A proof is then made irreducible:
 * without one feature after another, what cannot be proved any more needs it, and so does every part of it. */
#include "displacement/certify.h"
#include "displacement/job.h"

#include <math.h>
#include <string.h>

/* Effort, in constraints looked at (some hundred million a second): what a cluster has for its conflicts together, so
 * much for each of its first bodies, and less for each of all. */
#define EFFORT 5000000u
#define FIRST 20
#define EFFORT_EACH 200000u
/* Making a proof irreducible takes no more than this many times what finding it was allowed. */
#define REDUCING 4

/* ---- What listed pairs are held to ---------------------------------------------------------------------------------
 */

typedef struct holding {
    const sunder_i_job *job;
    const uint32_t *listed; /* places in the report's conflicts */
    sunder_i_held *held;
} holding;

/* Disjoint, it may come no nearer than it was; meeting, its depth may not grow. What lies in another may stay there.
 * The doubles nearest to both lengths are taken one step down. */
static sunder_status hold(const sunder_i_job *w, const sunder_conflict *c, double *clearance, sunder_error *err)
{
    const sunder_i_town *town = &w->town;
    const sunder_i_relation *start = sunder_i_relations_find(&w->start, (uint32_t)c->a, (uint32_t)c->b);
    *clearance = -INFINITY;
    if (start && start->contained) return SUNDER_OK;
    *clearance = fmin(town->rules.gap, c->before > 0 ? nextafter(c->before, 0) : 0);
    if (!start || !start->overlap) return SUNDER_OK;
    const double none[2] = {0, 0};
    sunder_separation least;
    bool beyond;
    const sunder_feature *feature = town->layer->feature;
    const sunder_status status = sunder_i_separate(feature[c->a].shape, none, feature[c->b].shape, none, 0, INFINITY,
                                                   &least, &beyond, err);
    if (status) return status;
    *clearance = -nextafter(least.distance, INFINITY);
    sunder_separation_clear(&least);
    return SUNDER_OK;
}

static sunder_status hold_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    const holding *g = context;
    for (size_t k = begin; k < end; k++) {
        const sunder_conflict *c = &g->job->report->conflict[g->listed[k]];
        g->held[k] = (sunder_i_held){(uint32_t)c->a, (uint32_t)c->b, 0};
        const sunder_status status = hold(g->job, c, &g->held[k].clearance, err);
        if (status) return status;
    }
    return SUNDER_OK;
}

/* ---- One conflict --------------------------------------------------------------------------------------------------
 */

typedef struct asking {
    sunder_i_job *job;
    const uint32_t *listed;
    const uint32_t *root;  /* of the clusters that they belong to */
    const uint32_t *count; /* [bodies] by root: how many belong to it */
    const sunder_i_held *held;
    size_t n;
} asking;

/* The features of a proof, ascending: into set, which has room for two a node. */
static size_t features_of(const sunder_proof *proof, uint32_t *set)
{
    size_t n = 0;
    for (size_t k = 0; k < proof->nodes; k++)
        if (proof->node[k].ways) {
            set[n++] = (uint32_t)proof->node[k].a;
            set[n++] = (uint32_t)proof->node[k].b;
        }
    return sunder_i_set_make(set, n);
}

/* Leaves out what the proof can do without, in order of number, while the effort lasts. */
static sunder_status reduce(const sunder_i_question *question, sunder_proof **proof, sunder_error *err)
{
    sunder_i_question q = *question;
    const size_t room = 2 * (*proof)->nodes;
    uint32_t *all = sunder_i_alloc(room, sizeof *all), *set = sunder_i_alloc(room, sizeof *set);
    uint32_t *body = sunder_i_alloc(room, sizeof *body);
    sunder_status status = all && set && body ? SUNDER_OK : sunder_i_no_memory(err);
    const size_t n = status ? 0 : features_of(*proof, all);
    size_t left = n;
    if (n) memcpy(set, all, n * sizeof *set);
    uint64_t budget = REDUCING * question->effort;
    q.reserves = 0;
    for (size_t k = 0; k < n && !status; k++) {
        if (all[k] == q.a || all[k] == q.b || !sunder_i_set_has(set, left, all[k])) continue;
        size_t out = 0;
        for (size_t i = 0; i < left; i++)
            if (set[i] != all[k]) set[out++] = set[i];
        for (size_t i = 0; i < out; i++) body[i] = q.town->body_of[set[i]];
        q.body = body;
        q.bodies = sunder_i_set_make(body, out);
        q.feature = set;
        q.features = out;
        sunder_i_answer answer;
        status = sunder_i_certify(&q, &answer, err);
        if (answer.proof) {
            sunder_i_proof_free(*proof);
            *proof = answer.proof;
            answer.proof = NULL;
            /* Its nodes may be more than the first proof's, its features are among those of the set. */
            left = out;
        } else {
            set[out] = all[k];
            left = sunder_i_set_make(set, out + 1);
        }
        budget = budget > answer.work ? budget - answer.work : 0;
        sunder_i_answer_clear(&answer);
        if (budget == 0) break;
    }
    sunder_i_free(all);
    sunder_i_free(set);
    sunder_i_free(body);
    return status;
}

/* A conflict's share of what its cluster has. */
static uint64_t effort_for(size_t bodies, uint32_t conflicts)
{
    return (EFFORT * (uint64_t)(bodies < FIRST ? bodies : FIRST) + EFFORT_EACH * (uint64_t)bodies) / conflicts;
}

static sunder_status ask(void *context, size_t begin, size_t end, sunder_error *err)
{
    const asking *g = context;
    const sunder_i_town *town = &g->job->town;
    for (size_t k = begin; k < end; k++) {
        sunder_report *report = g->job->report;
        sunder_conflict *c = &report->conflict[g->listed[k]];
        if (c->reason != SUNDER_REASON_UNRESOLVED) continue;
        const uint32_t body[2] = {town->body_of[c->a], town->body_of[c->b]};
        size_t more;
        const uint32_t *cluster = sunder_i_job_members(g->job, g->root[k], &more);
        const sunder_i_question question = {.town = town,
                                            .body = body,
                                            .bodies = 2,
                                            .reserve = cluster,
                                            .reserves = more,
                                            .a = (uint32_t)c->a,
                                            .b = (uint32_t)c->b,
                                            .held = g->held,
                                            .held_n = g->n,
                                            .effort = effort_for(more + 2, g->count[g->root[k]])};
        sunder_i_answer answer;
        sunder_status status = sunder_i_certify(&question, &answer, err);
        sunder_proof **proof = &report->proof[g->listed[k]];
        *proof = answer.proof;
        answer.proof = NULL;
        sunder_i_answer_clear(&answer);
        if (!status && *proof) status = reduce(&question, proof, err);
        if (status) return status;
        if (*proof) c->reason = SUNDER_REASON_NO_ROOM;
    }
    return SUNDER_OK;
}

/* ---- All of them ---------------------------------------------------------------------------------------------------
 */

sunder_status sunder_i_job_prove(sunder_i_job *w, sunder_error *err)
{
    sunder_report *report = w->report;
    const unsigned threads = w->town.rules.threads;
    report->proof = sunder_i_calloc(report->conflicts, sizeof *report->proof);
    uint32_t *listed = sunder_i_alloc(report->conflicts, sizeof *listed);
    uint32_t *root = sunder_i_alloc(report->conflicts, sizeof *root);
    uint32_t *count = sunder_i_calloc(w->town.bodies, sizeof *count);
    sunder_i_held *held = sunder_i_alloc(report->conflicts, sizeof *held);
    sunder_status status = report->proof && listed && root && count && held ? SUNDER_OK : sunder_i_no_memory(err);
    size_t n = 0, open = 0;
    for (size_t k = 0; !status && k < report->conflicts; k++) {
        const sunder_conflict *c = &report->conflict[k];
        if (c->inside_block) continue;
        const uint32_t i = w->town.body_of[c->a], j = w->town.body_of[c->b];
        root[n] = sunder_i_union_find(w->parent, w->town.body[i].fixed ? j : i);
        count[root[n]]++;
        listed[n++] = (uint32_t)k;
        open += c->reason == SUNDER_REASON_UNRESOLVED;
    }
    if (open) {
        holding h = {w, listed, held};
        status = sunder_i_parallel(threads, n, 8, hold_some, &h, err);
        asking g = {w, listed, root, count, held, n};
        if (!status) status = sunder_i_parallel(threads, n, 1, ask, &g, err);
    }
    sunder_i_free(listed);
    sunder_i_free(root);
    sunder_i_free(count);
    sunder_i_free(held);
    return status;
}
