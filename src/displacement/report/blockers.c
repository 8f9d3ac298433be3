/* Determines which features and barriers block a remaining conflict. If there is a proof that the conflict has no
 * solution, they are the features and barriers that the proof uses; otherwise those that the two features of the
 * conflict rest against at their present positions. */
#include "displacement/layer/reads.h"
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"

#include "separation/separation.h"

#include "base/extremes.h"

#include <math.h>

/* Appends to `blockers` the features and barriers of other bodies that are not farther from feature f than they have to
 * be, plus a small tolerance. Features and barriers of the conflict's own bodies are left out, and features that may
 * lie inside f. */
static sunder_status find_around(const sunder_i_solver *s, const sunder_conflict *c, uint32_t f, sunder_i_list *near,
                                 sunder_i_list *blockers, sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    const sunder_i_placement *placement = &s->placement;
    const double *own = sunder_i_rtree_box(&placement->tree, f), size = hypot(own[2] - own[0], own[3] - own[1]);
    const double reach = model->rules.gap + sunder_i_max(model->rules.gap, size) * RESTING;
    double box[4];
    sunder_i_box_grow(own, reach, box);
    near->n = 0;
    sunder_i_reading reading;
    sunder_i_reads_begin(&reading, model, sunder_i_reader_of(model, c->a, c->b));
    const bool ok = sunder_i_look_about(model, &placement->tree, box, near);
    sunder_i_reads_end(&reading);
    if (!ok) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < near->n; k++) {
        const uint32_t g = near->item[k], other = model->body_of[g];
        if (other == model->body_of[c->a] || sunder_i_whole_of(model, g) == c->b || other == model->body_of[c->b] ||
            sunder_i_is_included(model, f, g))
            continue;
        const sunder_i_translate p = sunder_i_standing(model, placement, g), q = sunder_i_standing(model, placement, f);
        const double off = reach + (sunder_i_owed_above(model, f, g) - model->rules.gap);
        bool apart;
        const sunder_status status = sunder_i_apart(p.shape, p.t, q.shape, q.t, sunder_i_max(off, 0), &apart, err);
        if (status) return status;
        if (!apart && !sunder_i_list_push(blockers, sunder_i_whole_of(model, g))) return sunder_i_failure_cause(err);
    }
    return SUNDER_OK;
}

static sunder_status find_blockers(const sunder_i_solver *s, const sunder_conflict *c, sunder_i_list *near,
                                   sunder_i_list *blockers, sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    const size_t pair[2] = {c->a, c->b};
    for (int e = 0; e < 2 && !sunder_i_is_barrier(model, (uint32_t)pair[e]); e++) {
        const sunder_i_body *body = &model->body[model->body_of[pair[e]]];
        for (uint32_t m = 0; m < body->members; m++) {
            const uint32_t f = model->member[body->member + m];
            if (!model->present[f]) continue;
            const sunder_status status = find_around(s, c, f, near, blockers, err);
            if (status) return status;
        }
    }
    return SUNDER_OK;
}

static bool take_from_proof(const sunder_i_model *model, const sunder_conflict *c, const sunder_proof *proof,
                            sunder_i_list *blockers)
{
    for (size_t k = 0; k < proof->nodes; k++) {
        const sunder_proof_node *node = &proof->node[k];
        const size_t thing_of[3] = {node->a, node->b, node->chord ? node->c : node->b};
        for (int e = 0; e < 3 && node->ways; e++) {
            const uint32_t thing = sunder_i_whole_of(model, (uint32_t)thing_of[e]);
            if (thing != c->a && thing != c->b && !sunder_i_list_push(blockers, thing)) return false;
        }
    }
    return true;
}

sunder_status sunder_i_report_blockers(sunder_report *report, const sunder_i_solver *solver, sunder_error *err)
{
    sunder_i_list blockers = {0}, near = {0};
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < report->conflicts && !status; k++) {
        sunder_conflict *c = &report->conflict[k];
        const size_t first = blockers.n;
        if (c->inside_block || c->reason == SUNDER_REASON_KEPT) continue;
        /* here limits are the only cause */
        if (c->reason == SUNDER_REASON_FIXED || c->reason == SUNDER_REASON_MAX_SHIFT) continue;
        if (!report->proof[k])
            status = find_blockers(solver, c, &near, &blockers, err);
        else if (!take_from_proof(&solver->model, c, report->proof[k], &blockers))
            status = sunder_i_failure_cause(err);
        if (blockers.n == first) continue; /* no blockers; blockers.item may still be NULL */
        c->n_blocked_by = sunder_i_set_make(&blockers.item[first], blockers.n - first);
        blockers.n = first + c->n_blocked_by;
    }
    if (!status) {
        report->blocker = sunder_i_alloc(blockers.n, sizeof *report->blocker);
        if (!report->blocker) status = sunder_i_failure_cause(err);
    }
    if (!status) {
        size_t next = 0;
        for (size_t i = 0; i < blockers.n; i++) report->blocker[i] = blockers.item[i];
        for (size_t k = 0; k < report->conflicts; k++) {
            report->conflict[k].blocked_by = report->blocker + next;
            next += report->conflict[k].n_blocked_by;
        }
    }
    sunder_i_free_all(blockers.item, near.item);
    return status;
}
