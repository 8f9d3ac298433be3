/* The report: the move and status of each feature, and what remains in conflict. */
#include "displacement/report/report.h"
#include "displacement/prove/proofs/feasibility.h"

#include "base/sized_struct.h"

#include <math.h>

sunder_status sunder_i_report_new(const sunder_i_model *model, sunder_report **out, sunder_error *err)
{
    sunder_report *r = sunder_i_calloc(1, sizeof *r);
    if (!r) return sunder_i_failure_cause(err);
    r->n = model->features;
    r->stripped = model->rules.drop_proofs;
    r->summary.features = model->features;
    r->summary.max_feature = SIZE_MAX;
    *out = r;
    return SUNDER_OK;
}

static void report_blocks(sunder_report *r, const sunder_i_model *model)
{
    for (size_t b = 0; b < model->bodies; b++) {
        const sunder_i_body *body = &model->body[b];
        const int64_t number = body->members > 1 ? (int64_t)model->member[body->member] : -1;
        if (sunder_i_is_barrier(model, model->member[body->member])) break; /* all following bodies are barriers, too */
        for (uint32_t k = 0; k < body->members; k++) r->block[model->member[body->member + k]] = number;
        r->summary.blocks += body->members > 1;
    }
}

sunder_status sunder_i_report_features(sunder_report *report, const sunder_i_model *model, sunder_error *err)
{
    const size_t n = model->features;
    report->move = sunder_i_calloc(2 * n, sizeof *report->move);
    report->status = sunder_i_calloc(n, sizeof *report->status);
    report->block = sunder_i_calloc(n, sizeof *report->block);
    if (!report->move || !report->status || !report->block) return sunder_i_failure_cause(err);
    report_blocks(report, model);
    report->summary.vertices = model->vertices;
    for (size_t f = 0; f < n; f++) {
        const sunder_feature feature = sunder_i_feature(model->layer, f);
        const bool fixed = model->body[model->body_of[f]].fixed;
        const bool hidden = sunder_i_is_present(&feature) && !model->present[f];
        report->status[f] = feature.ignored ? SUNDER_FEATURE_SKIPPED
                            : hidden        ? SUNDER_FEATURE_HIDDEN
                            : fixed         ? SUNDER_FEATURE_FIXED
                                            : SUNDER_FEATURE_UNMOVED;
        if (feature.ignored) report->summary.skipped++;
    }
    return SUNDER_OK;
}

/* Sets the status of movable features that are still in conflict to blocked. */
static void report_blocked(sunder_report *report, const sunder_i_model *model)
{
    for (size_t k = 0; k < report->conflicts; k++) {
        const sunder_conflict *c = &report->conflict[k];
        if (c->inside_block || c->reason == SUNDER_REASON_KEPT) continue;
        const size_t pair[2] = {c->a, c->b};
        for (int e = 0; e < 2; e++)
            if (!model->body[model->body_of[pair[e]]].fixed) report->status[pair[e]] = SUNDER_FEATURE_BLOCKED;
    }
}

/* Counts features by status. A blocked feature with a move other than zero is also counted as moved. */
static void count_statuses(sunder_report *report, const sunder_i_model *model)
{
    sunder_layer_summary *s = &report->summary;
    for (size_t f = 0; f < model->features; f++) {
        const bool moved = report->move[2 * f] != 0 || report->move[2 * f + 1] != 0;
        s->moved += report->status[f] == SUNDER_FEATURE_MOVED;
        s->blocked += report->status[f] == SUNDER_FEATURE_BLOCKED;
        s->blocked_moved += moved && report->status[f] == SUNDER_FEATURE_BLOCKED;
    }
    const size_t moved = s->moved + s->blocked_moved;
    if (moved) s->mean = s->total / (double)moved;
}

void sunder_i_report_moves(sunder_report *report, const sunder_i_model *model)
{
    sunder_layer_summary *s = &report->summary;
    sunder_total total = {0}, cost = {0};
    for (size_t f = 0; f < model->features; f++) {
        const double *t = model->move + 2 * (size_t)model->body_of[f];
        if (report->status[f] == SUNDER_FEATURE_HIDDEN) continue;
        const double square = sunder_i_stray_square(model, model->body_of[f], t);
        sunder_total_add(&cost, sunder_i_feature(model->layer, f).weight * square);
        if (t[0] == 0 && t[1] == 0) continue;
        report->move[2 * f] = t[0];
        report->move[2 * f + 1] = t[1];
        const double length = hypot(t[0], t[1]);
        report->status[f] = SUNDER_FEATURE_MOVED;
        sunder_total_add(&total, length);
        if (length > s->max) {
            s->max = length;
            s->max_feature = f;
        }
        if (model->inexact[f]) s->rounded++;
    }
    s->total = sunder_total_nearest(&total);
    s->cost_moves = sunder_total_nearest(&cost);
    s->cost = s->cost_moves + s->cost_shortfall; /* and that of rows: sunder_i_report_number_rows() */
    report_blocked(report, model);
    count_statuses(report, model);
}

void sunder_i_report_forget_conflicts(sunder_report *report)
{
    for (size_t k = 0; report->proof && k < report->conflicts; k++) sunder_i_proof_free(report->proof[k]);
    sunder_i_free_all(report->conflict, report->proof, report->blocker);
    report->conflict = NULL;
    report->proof = NULL;
    report->blocker = NULL;
    report->conflicts = 0;
}

void sunder_report_free(sunder_report *report)
{
    if (!report) return;
    sunder_i_report_forget_conflicts(report);
    for (size_t k = 0; report->clause && k < report->hiding.clauses; k++)
        sunder_i_proof_free((sunder_proof *)report->clause[k].proof);
    sunder_i_free_all(report->move, report->status, report->block, report->tight, report->bound_pair, report->clause,
                      report->clause_number, report->hiding_class, report->component_class, report->component,
                      (void *)report->hiding_trees.tree, (void *)report->hiding_trees.node,
                      (void *)report->hiding_trees.share, report->clause_level, report->level);
    for (size_t k = 0; k < report->bound_trees; k++) sunder_i_bound_tree_free(&report->bound_tree[k]);
    sunder_row_list_free(&report->row_list);
    sunder_i_free_all(report->bound_tree, report->push, report->row_pair, report->row_reach, report->world,
                      report->world_of, report->stands, report->inside, report->inexact, report->footprint,
                      report->world_bound, report->thin, report->home_pair, report->proved, report->by_pairs,
                      report->lacking, report->paying, report);
}

void sunder_i_count(sunder_conflict_counts *counts, const sunder_conflict *conflict)
{
    if (conflict->inside_block) {
        counts->inside_blocks++;
        return;
    }
    switch (conflict->kind) {
    case SUNDER_CONFLICT_OVERLAP: counts->overlap++; break;
    case SUNDER_CONFLICT_TOO_CLOSE: counts->too_close++; break;
    case SUNDER_CONFLICT_BARRIER: counts->barrier++; break;
    case SUNDER_CONFLICT_BARRIER_DRAWN: counts->barrier_drawn++; break;
    case SUNDER_CONFLICT_BARRIER_NEAR: counts->barrier_near++; break;
    case SUNDER_CONFLICT_CONTAINED: counts->contained++; break;
    case SUNDER_CONFLICT_DUPLICATE: counts->duplicate++; break;
    case SUNDER_CONFLICT_WORSE:
    case SUNDER_CONFLICT_LIMIT:
    case SUNDER_CONFLICT_SIDE:
    case SUNDER_CONFLICT_JUMP:
    case SUNDER_CONFLICT_NOT_A_TRANSLATE:
    case SUNDER_CONFLICT_ROW:
    case SUNDER_CONFLICT_NEEDLESS:
    case SUNDER_CONFLICT_ALTERED:
    case SUNDER_CONFLICT_TOO_SMALL:
    case SUNDER_CONFLICT_TIGHT: break; /* no conflicts of a layer */
    }
}

void sunder_report_summary_sized(const sunder_report *report, sunder_layer_summary *summary, size_t size)
{
    sunder_i_sized_struct_write(summary, size, &report->summary, sizeof report->summary);
}

void sunder_report_move(const sunder_report *report, size_t feature, double *dx, double *dy)
{
    *dx = report->move[2 * feature];
    *dy = report->move[2 * feature + 1];
}

sunder_feature_status sunder_report_status(const sunder_report *report, size_t feature)
{
    return report->status[feature];
}

int64_t sunder_report_block(const sunder_report *report, size_t feature) { return report->block[feature]; }

const sunder_conflict *sunder_report_conflicts(const sunder_report *report, size_t *n)
{
    *n = report->conflicts;
    return report->conflict;
}

const sunder_bound_pair *sunder_report_bound_pairs(const sunder_report *report, size_t *n)
{
    *n = report->bound_pairs;
    return report->bound_pair;
}

const sunder_bound_tree *sunder_report_bound_trees(const sunder_report *report, size_t *n)
{
    *n = report->bound_trees;
    return report->bound_tree;
}

const sunder_push *sunder_report_pushes(const sunder_report *report, size_t *n)
{
    *n = report->pushes;
    return report->push;
}

const sunder_proof *sunder_report_proof(const sunder_report *report, size_t k)
{
    return report->proof && !report->stripped && k < report->conflicts ? report->proof[k] : NULL;
}

void sunder_report_hiding_sized(const sunder_report *report, sunder_hiding_summary *summary, size_t size)
{
    sunder_i_sized_struct_write(summary, size, &report->hiding, sizeof report->hiding);
}

size_t sunder_report_level(const sunder_report *report, size_t feature)
{
    return report->level ? report->level[feature] : 0;
}

const sunder_clause *sunder_report_clauses(const sunder_report *report, size_t *n)
{
    *n = report->hiding.clauses;
    return report->clause;
}

const sunder_hiding_class *sunder_report_hiding_classes(const sunder_report *report, size_t *n)
{
    *n = report->hiding_classes;
    return report->hiding_class;
}

const sunder_hiding_component *sunder_report_hiding_components(const sunder_report *report, size_t *n)
{
    *n = report->hiding.components;
    return report->component;
}

const sunder_hiding_class *sunder_report_component_classes(const sunder_report *report, size_t *n)
{
    *n = report->component_classes;
    return report->component_class;
}

const sunder_hiding_trees *sunder_report_hiding_trees(const sunder_report *report) { return &report->hiding_trees; }
