/* The lower bound of the layer: what is proved of its contact groups, of pairs, or by prices of area, summed over the
 * parts.
 *
 * No layout costs less than the sum, over disjoint sets of bodies, of the bound of each set. A group's bound assumes
 * that all pairs of its bodies keep their distance, except those that were listed when it was proved; of those it
 * assumes that they stand no worse than at the start, and remain disjoint if they were. So it counts if no other pair
 * of its bodies is listed now, none of them overlaps that did not, and no movable body of it was counted with another
 * group. */
#include "displacement/layer/resolution.h"
#include "displacement/report/report.h"

#include <math.h>
#include <stdlib.h>

/* The bodies of a group that may move, its guests among them, are its own from here on. False: one was another's. */
static bool claim(const sunder_i_model *model, const sunder_i_group *g, uint32_t *owner)
{
    bool own = true;
    for (size_t k = 0; k < g->n + g->guests.n; k++) {
        const uint32_t b = k < g->n ? g->body[k] : g->guests.item[k - g->n];
        if (model->body[b].fixed || owner[b] == g->number) continue;
        if (owner[b] != SUNDER_I_NOBODY) own = false;
        owner[b] = g->number;
    }
    return own;
}

/* Groups of whose pairs one is listed that was not when they were proved, or overlaps and did not then: their bound is
 * for nothing. listed: [bodies] scratch, by the numbers of groups. */
static void void_bounds(sunder_i_solver *s, const uint32_t *owner, bool *listed)
{
    sunder_i_groups *groups = &s->groups;
    const sunder_i_waived waived = {.pair = groups->waived, .n = groups->waived_n};
    for (size_t k = 0; k < s->now.n; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        if (!sunder_i_is_conflict(r)) continue;
        const sunder_i_waiver *waiver = sunder_i_waiver_of(&s->model, &waived, r->a, r->b);
        if (waiver && (waiver->overlap || !r->overlap)) continue;
        for (int e = 0; e < 2; e++) {
            const uint32_t number = owner[s->model.body_of[e ? r->b : r->a]];
            if (number != SUNDER_I_NOBODY) listed[number] = true;
        }
    }
    for (size_t k = 0; k < groups->n; k++)
        if (listed[groups->group[k].number]) groups->group[k].bound = 0;
}

/* What the group costs as it stands in the end; upwards. */
static double cost_of(const sunder_i_model *model, const sunder_i_group *g)
{
    double cost = 0;
    for (size_t k = 0; k < g->n; k++) {
        const double *t = model->move + 2 * (size_t)g->body[k];
        cost += model->body[g->body[k]].weight * (t[0] * t[0] + t[1] * t[1]);
    }
    return cost * (1 + ((double)g->n + 8) * 0x1p-50);
}

/* Discards what was proved of groups where it does not hold for the result; sums the others' costs, and counts those
 * that are optimal. */
static sunder_status count_groups(sunder_layer_summary *summary, sunder_i_solver *s, sunder_error *err)
{
    uint32_t *owner = sunder_i_alloc(s->model.bodies, sizeof *owner);
    bool *listed = sunder_i_calloc(s->model.bodies, sizeof *listed);
    const bool ok = owner && listed;
    for (size_t b = 0; b < s->model.bodies && ok; b++) owner[b] = SUNDER_I_NOBODY;
    for (size_t k = 0; k < s->groups.n && ok; k++)
        if (!claim(&s->model, &s->groups.group[k], owner)) s->groups.group[k].bound = 0;
    if (ok) void_bounds(s, owner, listed);
    sunder_i_free(owner);
    sunder_i_free(listed);
    for (size_t k = 0; k < s->groups.n && ok; k++) {
        sunder_i_group *g = &s->groups.group[k];
        g->cost = cost_of(&s->model, g);
        summary->clusters_optimal += sunder_i_group_is_optimal(g);
    }
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}

/* The trees that a bound stands on, of groups and of pairs, become the report's. */
static sunder_status take_trees(sunder_report *report, sunder_i_groups *groups, const sunder_i_parts *parts,
                                sunder_i_bound_trees *of_pairs, sunder_error *err)
{
    size_t n = of_pairs->n + parts->areas; /* with room for those of areas */
    for (size_t k = 0; k < groups->n; k++) n += groups->group[k].trees.n;
    report->bound_tree = sunder_i_calloc(n, sizeof *report->bound_tree);
    if (!report->bound_tree) return sunder_i_no_memory(err);
    for (size_t k = 0; k < groups->n; k++) {
        sunder_i_group *g = &groups->group[k];
        if (!(g->bound > 0) || !sunder_i_part_is_by_groups(parts, g->number)) continue;
        for (size_t m = 0; m < g->trees.n; m++) {
            g->trees.tree[m].group = k;
            report->bound_tree[report->bound_trees++] = g->trees.tree[m];
        }
        g->trees.n = 0;
    }
    for (size_t k = 0; k < of_pairs->n; k++) {
        sunder_bound_tree *tree = &of_pairs->tree[k];
        if (!sunder_i_part_is_by_pairs(parts, (uint32_t)tree->group)) continue;
        tree->group += groups->n;
        report->bound_tree[report->bound_trees++] = *tree;
        *tree = (sunder_bound_tree){0};
    }
    return SUNDER_OK;
}

/* What is proved of each part, at its root, with or without trees that are kept for a reader. */
static sunder_status prove_parts(sunder_report *report, sunder_i_solver *s, sunder_i_parts *parts, double *proved,
                                 sunder_error *err)
{
    sunder_i_bound_trees of_pairs = {0};
    sunder_status status = sunder_i_report_pair_trees(report, s, parts, &of_pairs, err);
    if (!status && s->model.rules.keep_trees) {
        status = take_trees(report, &s->groups, parts, &of_pairs, err);
        if (!status) status = sunder_i_report_area_trees(report, s, parts, err);
    }
    for (uint32_t b = 0; b < s->model.bodies; b++) proved[b] = sunder_i_part_bound(parts, b);
    sunder_i_bound_trees_free(&of_pairs);
    return status;
}

/* Sums are exact until they are rounded, once: whatever the order. */
static void add_up(sunder_layer_summary *summary, const double *proved, const double *by_pairs, size_t bodies)
{
    sunder_total all = {0}, pairs = {0};
    for (size_t b = 0; b < bodies; b++) {
        sunder_total_add(&all, proved[b]);
        sunder_total_add(&pairs, by_pairs[b]);
    }
    summary->pair_bound = sunder_total_below(&pairs);
    summary->lower_bound = sunder_total_below(&all);
}

/* For worlds to be told apart; the arrays are the report's from here on. */
static void keep_proved(sunder_report *report, double **proved, sunder_i_parts *parts)
{
    sunder_i_free(report->proved);
    report->proved = *proved;
    report->by_pairs = parts->by_pairs;
    *proved = parts->by_pairs = NULL;
}

sunder_status sunder_i_report_optimality(sunder_report *report, sunder_i_solver *solver, sunder_error *err)
{
    sunder_layer_summary *summary = &report->summary;
    const bool any = solver->groups.n && solver->model.rules.effort > 0;
    summary->clusters = solver->groups.n;
    if (!any && !report->bound_pairs) return SUNDER_OK;
    sunder_i_parts parts = {0};
    double *proved = sunder_i_alloc(solver->model.bodies, sizeof *proved);
    sunder_status status = proved ? SUNDER_OK : sunder_i_no_memory(err);
    if (!status && any) status = count_groups(summary, solver, err);
    if (!status) status = sunder_i_parts_find(&parts, report, solver, err);
    if (!status) status = sunder_i_report_area_bounds(solver, &parts, err);
    if (!status) status = prove_parts(report, solver, &parts, proved, err);
    if (!status) add_up(summary, proved, parts.by_pairs, solver->model.bodies);
    if (!status && solver->model.rules.keep_worlds) keep_proved(report, &proved, &parts);
    sunder_i_free(proved);
    sunder_i_parts_free(&parts);
    return status;
}
