/* Finds what would solve a remaining conflict: a longer limit, a smaller gap, or the removal of one feature. Each
 * question is answered by a small layer around the conflict (question.c).
 *
 * In a dense layer hardly any of these small layers has a solution, and there are thousands of conflicts. The pairs of
 * a cluster are therefore examined in turn until the cluster's budget for failed questions is spent, and a kind of
 * question that mostly fails is asked less and less often. (A gap that the pair already keeps in the result needs no
 * question.) What is reported of a pair thus depends on its cluster only, not on the rest of the layer. */
#include "displacement/layer/reads.h"
#include "displacement/layer/trace.h"
#include "displacement/report/need_gap.h"
#include "displacement/report/tuning.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>

/* ---- A longer limit ---------------------------------------------------------------------------------------------- */

/* Asks whether `what`, a larger limit, has a solution. The small layer that is used for proofs is made with that limit,
 * so that it can answer this question, too. */
static sunder_status try_limit(sunder_i_inquiry *q, const sunder_i_supposition *what, sunder_i_answer *answer,
                               sunder_error *err)
{
    sunder_i_patience *proof = &q->left->proof;
    const bool looks = sunder_i_patience_asks(proof);
    sunder_status status = looks ? sunder_i_inquiry_look_ahead(q, what->limit, err) : SUNDER_OK;
    if (!status && looks && q->foresight->hopeless) {
        *answer = (sunder_i_answer){.foreseen = true, .refuted = what->gap};
        sunder_i_inquiry_note_in_vain(q);
    } else if (!status) {
        status = sunder_i_inquiry_search(q, what, answer, err);
    }
    if (!status && looks && !answer->yes) sunder_i_patience_note(proof, answer->foreseen);
    return status;
}

/* Finds a limit that is sufficient for the conflict (need_shift). The first question allows moves of a->farthest, the
 * greatest length for which all neighbours are in the small layer, or of the limit that solves the whole cluster
 * (cluster_needs.c) if that is known and shorter. If it has a solution, the interval below is halved up to
 * q->questions->halvings times. */
static sunder_status need_shift(sunder_i_inquiry *q, sunder_error *err)
{
    const sunder_i_surroundings *a = q->about;
    sunder_conflict *c = q->conflict;
    sunder_i_supposition what = {
        .limit = sunder_i_min(a->farthest, c->need_shift), .gap = q->questions->options->gap, .gone = SUNDER_I_NOBODY};
    double low = INFINITY;
    sunder_i_answer answer = {.layout = NULL};
    for (size_t k = 0; k < a->moving; k++) low = sunder_i_min(low, a->as[k].max_shift);
    if (!(low < what.limit) || !sunder_i_patience_asks(&q->left->shift)) return SUNDER_OK;
    for (int k = 0; k <= q->questions->halvings; k++) {
        const sunder_status status =
            k ? sunder_i_inquiry_ask(q, &what, true, &answer, err) : try_limit(q, &what, &answer, err);
        if (status) return status;
        if (k == 0) sunder_i_patience_note(&q->left->shift, answer.yes);
        /* The length was rounded once, so the next larger double is an upper bound. */
        if (answer.yes)
            c->need_shift = sunder_i_min(c->need_shift, nextafter(answer.longest, INFINITY));
        else if (k == 0)
            return SUNDER_OK;
        else
            low = what.limit;
        what.limit = low + (c->need_shift - low) / 2;
        if (!(low < what.limit && what.limit < c->need_shift)) return SUNDER_OK;
    }
    return SUNDER_OK;
}

/* ---- Removing one feature ---------------------------------------------------------------------------------------- */

/* Sets need_gone to the first of the features and barriers that block the conflict without which it has a solution. At
 * most q->questions->leaves of them are tried. */
static sunder_status need_gone(sunder_i_inquiry *q, sunder_error *err)
{
    sunder_conflict *c = q->conflict;
    sunder_i_answer answer = {.yes = false};
    if (c->n_blocked_by == 0 || !sunder_i_patience_asks(&q->left->gone)) return SUNDER_OK;
    for (size_t k = 0; k < c->n_blocked_by && k < q->questions->leaves && !answer.yes; k++) {
        const sunder_i_supposition what = {.gap = q->questions->options->gap, .gone = (uint32_t)c->blocked_by[k]};
        const sunder_status status = sunder_i_inquiry_search(q, &what, &answer, err);
        if (status) return status;
        if (answer.yes) c->need_gone = c->blocked_by[k];
    }
    sunder_i_patience_note(&q->left->gone, answer.yes);
    return SUNDER_OK;
}

static size_t members_that_move(const sunder_i_model *model, size_t feature)
{
    const sunder_i_body *body = &model->body[model->body_of[feature]];
    return body->fixed ? 0 : body->members;
}

static sunder_status find_needs(const sunder_i_questions *g, sunder_conflict *c, sunder_i_needs_budget *left,
                                sunder_error *err)
{
    const sunder_i_model *model = &g->solver->model;
    sunder_i_surroundings a = {0};
    if (members_that_move(model, c->a) + members_that_move(model, c->b) > NEED_MOST) return SUNDER_OK;
    sunder_status status = sunder_i_surround(g->solver, c, &a, err);
    a.farthest =
        sunder_i_min(a.farthest, g->options->barrier_reach); /* barriers farther away were not read from the input */
    sunder_i_inquiry inquiry = {g, &a, c, left, NULL};
    if (!status) status = need_shift(&inquiry, err);
    if (!status && inquiry.foresight) sunder_i_foresight_limit(inquiry.foresight, 0);
    if (!status) status = sunder_i_find_need_gap(&inquiry, err);
    if (!status) status = need_gone(&inquiry, err);
    sunder_i_inquiry_end(&inquiry);
    sunder_i_surroundings_clear(&a);
    return status;
}

/* ---- The conflicts of a cluster ---------------------------------------------------------------------------------- */

/* A conflict, as an index in the report, and the root of the cluster that it belongs to. */
typedef struct matter {
    uint32_t root, conflict;
} matter;

typedef struct asking {
    const sunder_i_questions *questions;
    const matter *matter;
    const size_t *first; /* [clusters + 1] the index of the first matter of each cluster, and the end */
    uint64_t most;       /* the number of features that may take part in failed questions about one cluster */
} asking;

/* Returns how many failed questions of a kind are allowed for a cluster: few if need_shift of one of its conflicts is
 * already known from a layout of the whole cluster. The other needs are then found for some of its pairs only, but most
 * of them have neither a feature to remove nor a shorter limit. */
static sunder_i_patience patience_for(const asking *g, size_t cluster)
{
    bool known = false;
    for (size_t m = g->first[cluster]; m < g->first[cluster + 1] && !known; m++)
        known = !isnan(g->questions->report->conflict[g->matter[m].conflict].need_shift);
    return known ? sunder_i_patience_of(CROWD_PATIENCE, 0) : sunder_i_patience_of(NEED_PATIENCE, NEED_REGAINED);
}

static sunder_status ask_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const asking *g = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++) {
        const sunder_i_patience fresh = patience_for(g, k);
        sunder_i_needs_budget left = {g->most, fresh, fresh, fresh,
                                      sunder_i_patience_of(PROOF_PATIENCE, NEED_REGAINED)};
        sunder_i_relaxation_memo memo = {0};
        sunder_i_requirement_memo stood = {0};
        sunder_i_questions questions = *g->questions;
        sunder_i_reading reading;
        questions.memo = &memo;
        questions.stood = &stood;
        sunder_i_reads_begin(&reading, &questions.solver->model, g->matter[g->first[k]].root);
        for (size_t m = g->first[k]; m < g->first[k + 1] && left.left && !status; m++)
            status = find_needs(&questions, &questions.report->conflict[g->matter[m].conflict], &left, err);
        sunder_i_reads_end(&reading);
        sunder_i_free_all(memo.item, stood.item);
    }
    return status;
}

/* Lists the conflicts to examine in list[], grouped by cluster, and sets first[] to the index of the first conflict of
 * each cluster, followed by the end. Returns the number of clusters. */
static size_t group_by_cluster(const sunder_i_solver *s, const sunder_report *report, matter *list, size_t *first)
{
    const sunder_i_model *model = &s->model;
    size_t n = 0, groups = 0;
    for (size_t k = 0; k < report->conflicts; k++) {
        const sunder_conflict *c = &report->conflict[k];
        if (!sunder_i_is_asked_about(c)) continue;
        const uint32_t i = model->body_of[c->a], j = model->body_of[c->b];
        list[n++] = (matter){sunder_i_union_find(s->parent, model->body[i].fixed ? j : i), (uint32_t)k};
    }
    if (n) qsort(list, n, sizeof *list, sunder_i_by_id_pair);
    for (size_t k = 0; k < n; k++)
        if (k == 0 || list[k].root != list[k - 1].root) first[groups++] = k;
    first[groups] = n;
    return groups;
}

static void trace_gaps(const sunder_i_questions *g)
{
    for (size_t k = 0; k < g->report->conflicts; k++) {
        const sunder_conflict *c = &g->report->conflict[k];
        if (isnan(c->need_gap)) continue;
        const bool narrow = c->need_gap_most - c->need_gap <= g->options->gap / NEED_GAP_PARTS;
        sunder_i_trace_pair(&g->solver->model, "need_gap",
                            narrow ? "proved: the largest gap, to a hundredth of the one asked for"
                                   : "a larger gap may have a solution, too",
                            (uint32_t)c->a, (uint32_t)c->b);
    }
}

sunder_status sunder_i_report_needs(sunder_report *report, const sunder_i_solver *solver,
                                    const sunder_layer_options *options, sunder_i_solve_layer solve, sunder_error *err)
{
    const double effort = sunder_i_min(ceil(options->effort), NEED_EFFORT);
    const sunder_i_questions g = {solver, report, options, solve, (int)effort, NEED_GONE * (size_t)effort, NULL, NULL};
    if (!(effort > 0)) return SUNDER_OK;
    matter *list = sunder_i_alloc(report->conflicts, sizeof *list);
    size_t *first = sunder_i_alloc(report->conflicts + 1, sizeof *first);
    sunder_status status = list && first ? sunder_i_keep_gaps_there_are(&g, err) : sunder_i_failure_cause(err);
    if (!status) {
        const size_t groups = group_by_cluster(solver, report, list, first);
        asking h = {&g, list, first, NEED_IN_VAIN * (uint64_t)effort};
        status = sunder_i_parallel(solver->model.rules.threads, groups, SUNDER_I_GRAIN_WHOLE, ask_clusters, &h, err);
    }
    if (!status && sunder_i_is_traced(&solver->model)) trace_gaps(&g);
    sunder_i_free_all(list, first);
    return status;
}
