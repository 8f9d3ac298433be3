/* Determines why a pair remains in conflict if it has no solution by itself, whatever else is in the layer: neither
 * body may move; their limits are too short; or sides of barriers, or the rule against jumps, forbid every relative
 * move within their limits.
 *
 * Whether a limit is too short is decided exactly by the least translation that separates the pair. Whether every
 * relative move is forbidden is decided by branch and bound (prove/proofs/feasibility.c), which either proves it or
 * gives no answer. Its proof is kept, since it names the features whose shadows block the pair. For limits that are too
 * short the same branch and bound makes a proof, if proofs are wanted. If two features are shut in
 * (solve/clusters/shut_in_pairs.c) it is known beforehand that they have no solution; a proof is still searched for,
 * and if the effort does not suffice there is none. If only the names of the features are wanted, and these can be none
 * but the two themselves, no proof is searched for. */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/prove/proofs/feasibility.h"
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"

#include "base/memory.h"
#include "base/parallel.h"

#include <math.h>
#include <stdlib.h>

static double limit_of(const sunder_i_model *model, size_t f)
{
    const sunder_i_body *body = &model->body[model->body_of[f]];
    return body->fixed ? 0 : body->limit;
}

/* What questions about the same two bodies share. */
typedef struct common {
    bool many; /* several pairs of the two are listed */
    sunder_i_planes planes;
    sunder_i_precedents precedents;
} common;

/* The rules about relative moves that a question takes into account: none, the sides of barriers, these and the rule
 * against jumps, or these and the rule of rows. */
typedef enum path_rules { NO_PATH_RULES, SIDES, SIDES_AND_JUMPS, ALL_AND_ROW } path_rules;

/* Sets *proof to a proof that the pair by itself has no solution under these rules, or to NULL if none is found. The
 * other members of the two blocks move with them. instead: the limit that is assumed for bodies that have none. */
static sunder_status prove_alone(const sunder_i_model *model, const sunder_conflict *c, path_rules rules,
                                 double instead, common *both, sunder_proof **proof, sunder_error *err)
{
    const size_t bodies = c->b < model->features ? 2 : 1;
    const uint32_t feature[2] = {(uint32_t)c->a, (uint32_t)c->b},
                   body[2] = {model->body_of[c->a], model->body_of[c->b]};
    const sunder_i_subproblem alone = {.model = model,
                                       .body = body,
                                       .bodies = bodies,
                                       .a = feature[0],
                                       .b = feature[1],
                                       .feature = feature,
                                       .features = 2,
                                       .every_side = instead == 0 || bodies == 1,
                                       .any_jump = rules < SIDES_AND_JUMPS,
                                       .rows = rules == ALL_AND_ROW,
                                       .row_listed = both->many,
                                       .ignore_paths = rules == NO_PATH_RULES,
                                       .heed_paths = true,
                                       .instead = instead,
                                       .planes = &both->planes,
                                       .precedents = &both->precedents,
                                       .effort = ALONE_EFFORT,
                                       .most = ALONE_MOST};
    sunder_i_decision decision;
    const sunder_status status = sunder_i_decide(&alone, &decision, err);
    *proof = decision.proof;
    decision.proof = NULL;
    sunder_i_decision_clear(&decision);
    return status;
}

/* Finds the reason if a feature of the conflict, or the feature beside a barrier, has no limit. Beyond the distance at
 * which the pair certainly is not in conflict only shadows forbid a relative move, and a shadow has no end: each
 * direction that enters one there stays in it. So a pair without a solution up to slightly more than that distance has
 * none at all. For two features the sides of barriers are ignored, since they restrict the moves of one feature, not
 * the relative move. */
static sunder_status reason_without_limit(const sunder_i_model *model, sunder_conflict *c, common *both,
                                          sunder_proof **proof, sunder_error *err)
{
    const bool barrier = c->b >= model->features;
    if (barrier ? model->sides == 0 : model->rules.jumps) return SUNDER_OK;
    const uint32_t a = model->body_of[c->a];
    const double far = barrier ? sunder_i_far_from_barrier(model, a, (uint32_t)c->b)
                               : 2 * sunder_i_farthest_near(model, a, model->body_of[c->b]);
    const sunder_status status = prove_alone(model, c, barrier ? SIDES : SIDES_AND_JUMPS, far, both, proof, err);
    if (*proof) c->reason = barrier ? SUNDER_REASON_SIDE : SUNDER_REASON_JUMP;
    return status;
}

/* Finds the reason if the limits by themselves leave a solution: the rule against jumps, or sides of barriers. A proof
 * that needs the sides only is preferred. */
static sunder_status reason_of_paths(const sunder_i_model *model, sunder_conflict *c, common *both,
                                     sunder_proof **proof, sunder_error *err)
{
    const bool jump = !model->rules.jumps && c->b < model->features;
    if (!jump && model->sides == 0) return SUNDER_OK;
    sunder_status status = prove_alone(model, c, jump ? SIDES_AND_JUMPS : SIDES, 0, both, proof, err);
    if (status || !*proof) return status;
    c->reason = jump ? SUNDER_REASON_JUMP : SUNDER_REASON_SIDE;
    if (!jump || model->sides == 0) return SUNDER_OK;
    sunder_proof *by_sides = NULL;
    status = prove_alone(model, c, SIDES, 0, both, &by_sides, err);
    if (!by_sides) return status;
    sunder_i_proof_free(*proof);
    *proof = by_sides;
    c->reason = SUNDER_REASON_SIDE;
    return status;
}

/* Finds out whether the rule of rows is the reason, if limits, sides and jumps leave a solution. */
static sunder_status reason_of_row(const sunder_i_model *model, sunder_conflict *c, common *both, sunder_proof **proof,
                                   sunder_error *err)
{
    const sunder_i_body *body = &model->body[model->body_of[c->a]];
    if (c->b >= model->features || body->has->row_sides == 0 ||
        !sunder_i_row_side_of(model, body, model->body_of[c->b]))
        return SUNDER_OK;
    const sunder_status status = prove_alone(model, c, ALL_AND_ROW, 0, both, proof, err);
    if (*proof) c->reason = SUNDER_REASON_ROW;
    return status;
}

/* Returns whether no proof has to be searched for, for two features that are shut in: only the names of the features of
 * a proof are kept, and neither feature has a block, so a proof would name these two alone. */
static bool needs_no_proof(const sunder_i_model *model, const sunder_conflict *c)
{
    return model->rules.drop_proofs && model->body[model->body_of[c->a]].members == 1 &&
           model->body[model->body_of[c->b]].members == 1;
}

/* Sets *proof to an empty proof, which names no feature besides the two of the conflict. */
static sunder_status make_empty_proof(sunder_proof **proof, sunder_error *err)
{
    *proof = sunder_i_calloc(1, sizeof **proof);
    return *proof ? SUNDER_OK : sunder_i_failure_cause(err);
}

static sunder_status find_reason(const sunder_i_model *model, sunder_conflict *c, common *both, sunder_proof **proof,
                                 sunder_error *err)
{
    const double limit[2] = {limit_of(model, c->a), limit_of(model, c->b)}, reach = limit[0] + limit[1];
    const bool shut = c->b < model->features && sunder_i_are_shut_in(model, (uint32_t)c->a, (uint32_t)c->b);
    c->reason = reach == 0 ? SUNDER_REASON_FIXED : shut ? SUNDER_REASON_JUMP : SUNDER_REASON_UNRESOLVED;
    if (reach == 0) return SUNDER_OK;
    if (reach == INFINITY && shut && needs_no_proof(model, c)) return make_empty_proof(proof, err);
    if (reach == INFINITY) return reason_without_limit(model, c, both, proof, err);
    sunder_i_resolution resolution;
    const sunder_status status = sunder_i_resolve_within(model, c->a, c->b, limit, &resolution, err);
    if (status) return status;
    if (!resolution.beyond) {
        const sunder_status paths = reason_of_paths(model, c, both, proof, err);
        return paths || *proof || c->reason != SUNDER_REASON_UNRESOLVED ? paths
                                                                        : reason_of_row(model, c, both, proof, err);
    }
    c->reason = SUNDER_REASON_MAX_SHIFT;
    return model->rules.keep_trees ? prove_alone(model, c, NO_PATH_RULES, 0, both, proof, err) : SUNDER_OK;
}

/* ---- All conflicts ----------------------------------------------------------------------------------------------- */

/* A conflict, as an index in the report, and its two bodies. The bodies of all barriers are replaced by
 * SUNDER_I_NOBODY. */
typedef struct matter {
    sunder_i_id_pair bodies;
    uint32_t conflict;
} matter;

typedef struct asking {
    const sunder_i_model *model;
    sunder_report *report;
    const matter *matter;
    const size_t *first; /* [pairs of bodies + 1] the index of the first matter of each pair, and the end */
} asking;

/* Finds the reasons of all conflicts. Conflicts of the same two bodies follow one another and share `both`. */
static sunder_status find_reasons(void *context, size_t begin, size_t end, sunder_error *err)
{
    const asking *g = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++) {
        common both = {.many = g->first[k + 1] - g->first[k] > 1};
        for (size_t m = g->first[k]; m < g->first[k + 1] && !status; m++) {
            const uint32_t at = g->matter[m].conflict;
            sunder_conflict *c = &g->report->conflict[at];
            sunder_i_reading reading;
            sunder_i_reads_begin(&reading, g->model, sunder_i_reader_of(g->model, c->a, c->b));
            status = find_reason(g->model, c, &both, &g->report->proof[at], err);
            sunder_i_reads_end(&reading);
            if (g->model->rules.drop_proofs) sunder_i_proof_strip(g->report->proof[at]);
        }
        sunder_i_planes_clear(&both.planes);
    }
    return status;
}

static size_t list_matters(const sunder_report *report, const sunder_i_model *model, matter *list, size_t *first)
{
    size_t n = 0, pairs = 0;
    for (size_t k = 0; k < report->conflicts; k++) {
        const sunder_conflict *c = &report->conflict[k];
        if (c->inside_block || c->reason == SUNDER_REASON_KEPT) continue;
        const uint32_t i = model->body_of[c->a], j = c->b < model->features ? model->body_of[c->b] : SUNDER_I_NOBODY;
        list[n++] = (matter){i < j ? (sunder_i_id_pair){i, j} : (sunder_i_id_pair){j, i}, (uint32_t)k};
    }
    if (n) qsort(list, n, sizeof *list, sunder_i_by_id_triple);
    for (size_t k = 0; k < n; k++)
        if (k == 0 || sunder_i_by_id_pair(&list[k - 1].bodies, &list[k].bodies)) first[pairs++] = k;
    first[pairs] = n;
    return pairs;
}

sunder_status sunder_i_report_reasons(sunder_report *report, const sunder_i_model *model, sunder_error *err)
{
    matter *list = sunder_i_alloc(report->conflicts, sizeof *list);
    size_t *first = sunder_i_alloc(report->conflicts + 1, sizeof *first);
    sunder_status status = list && first ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) {
        const asking g = {model, report, list, first};
        const size_t pairs = list_matters(report, model, list, first);
        status = sunder_i_parallel(model->rules.threads, pairs, SUNDER_I_GRAIN_WHOLE, find_reasons, (void *)&g, err);
    }
    sunder_i_free_all(list, first);
    return status;
}
