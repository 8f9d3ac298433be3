/* Computes the lower bound of the layer: the sum over its independent parts of what is proved by contact groups, by
 * pairs, or by prices of area.
 *
 * No layout costs less than the sum, over disjoint sets of bodies, of the lower bound of each set. The bound of a
 * contact group assumes that all pairs of its bodies keep their distance, except those that were listed when it was
 * proved; for those it assumes that they are no worse than at the start, and that they remain disjoint if they were. It
 * is therefore counted only if no other pair of its bodies is listed in the result, if no pair overlaps that did not,
 * and if no movable body of it was counted with another group. */
#include "displacement/layer/resolution.h"
#include "displacement/report/report.h"
#include "displacement/solve/clusters/cluster_stages.h"

/* Makes the group the owner of its movable bodies, guests included. Returns false if another group owned one of
 * them. */
static bool claim_bodies(const sunder_i_model *model, const sunder_i_group *g, uint32_t *owner)
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

/* Sets the bound of a group to 0 if a pair with a movable body of the group is in conflict in the result that was not
 * listed when the bound was proved, or that overlaps and did not overlap then. listed: [bodies] scratch, indexed by the
 * numbers of groups; false before the call. */
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

/* Returns the cost of the springs between bodies of the group; 0 if memory is out. */
static double cost_of_springs(const sunder_i_model *model, const sunder_i_group *g)
{
    double *move = sunder_i_alloc(2 * g->n, sizeof *move), cost = 0;
    for (size_t k = 0; k < g->n && move; k++)
        memcpy(move + 2 * k, model->move + 2 * (size_t)g->body[k], 2 * sizeof *move);
    if (move) cost = sunder_i_springs_within(model, g->body, g->n, move);
    sunder_i_free(move);
    return cost;
}

/* Returns the cost of the group in the result, prices included, rounded upwards. */
static double cost_of(const sunder_i_model *model, const sunder_i_group *g, const sunder_i_paying *paying)
{
    double cost = 0;
    for (size_t k = 0; k < g->n; k++) {
        if (model->body[g->body[k]].fixed) continue;
        cost += model->body[g->body[k]].weight *
                sunder_i_stray_square(model, g->body[k], model->move + 2 * (size_t)g->body[k]);
        if (paying) cost += paying[g->body[k]].pays;
    }
    if (model->row_sides) cost += cost_of_springs(model, g);
    return cost * (1 + ((double)g->n + 8) * 0x1p-50);
}

/* Adds the least prices to the bound of the group's moves. */
static void add_prices(sunder_i_group *g, const sunder_i_paying *paying)
{
    double alone = 0;
    if (!(g->bound > 0)) sunder_i_bound_trees_free(&g->trees); /* they do not hold */
    for (size_t k = 0; k < g->n; k++) alone += paying[g->body[k]].alone;
    if (alone > 0) g->bound = (g->bound + alone) * (1 - ((double)g->n + 8) * 0x1p-50);
}

/* Sets the bound of each group to 0 if it does not hold for the result (claim_bodies(), void_bounds()). Computes the
 * cost of each group, and counts in summary.clusters_optimal the groups that are optimal. */
static sunder_status count_groups(sunder_report *report, sunder_i_solver *s, sunder_error *err)
{
    uint32_t *owner = sunder_i_alloc(s->model.bodies, sizeof *owner);
    bool *listed = sunder_i_calloc(s->model.bodies, sizeof *listed);
    const bool ok = owner && listed, priced = report->paying && (report->eased || sunder_i_has_slack(&s->model));
    sunder_status status = ok ? SUNDER_OK : sunder_i_failure_cause(err);
    if (ok && priced) status = sunder_i_solver_list_waivers(s, err);
    for (size_t b = 0; b < s->model.bodies && ok; b++) owner[b] = SUNDER_I_NOBODY;
    for (size_t k = 0; k < s->groups.n && ok; k++)
        if (!claim_bodies(&s->model, &s->groups.group[k], owner)) s->groups.group[k].bound = 0;
    if (ok) void_bounds(s, owner, listed);
    sunder_i_free_all(owner, listed);
    for (size_t k = 0; k < s->groups.n && ok; k++) {
        sunder_i_group *g = &s->groups.group[k];
        g->cost = cost_of(&s->model, g, report->paying);
        if (report->paying) add_prices(g, report->paying);
    }
    if (!status && priced) status = sunder_i_report_eased_groups(report, s, err);
    for (size_t k = 0; k < s->groups.n && !status; k++)
        report->summary.clusters_optimal += s->model.rules.effort > 0 && sunder_i_group_is_optimal(&s->groups.group[k]);
    return status;
}

/* Moves the trees on which the bound is based, those of groups and those of pairs, to the report, which owns them from
 * then on. */
static sunder_status take_trees(sunder_report *report, sunder_i_groups *groups, const sunder_i_independent_parts *parts,
                                sunder_i_bound_trees *of_pairs, sunder_error *err)
{
    size_t n = of_pairs->n + parts->areas; /* with room for the trees of bounds by area */
    for (size_t k = 0; k < groups->n; k++) n += groups->group[k].trees.n;
    report->bound_tree = sunder_i_calloc(n, sizeof *report->bound_tree);
    if (!report->bound_tree) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < groups->n; k++) {
        sunder_i_group *g = &groups->group[k];
        if (!(g->bound > 0) || !sunder_i_independent_part_is_by_groups(parts, g->number)) continue;
        for (size_t m = 0; m < g->trees.n; m++) {
            g->trees.tree[m].group = k;
            report->bound_tree[report->bound_trees++] = g->trees.tree[m];
        }
        g->trees.n = 0;
    }
    for (size_t k = 0; k < of_pairs->n; k++) {
        sunder_bound_tree *tree = &of_pairs->tree[k];
        if (!sunder_i_independent_part_is_by_pairs(parts, (uint32_t)tree->group)) continue;
        tree->group += groups->n;
        report->bound_tree[report->bound_trees++] = *tree;
        *tree = (sunder_bound_tree){0};
    }
    return SUNDER_OK;
}

/* Sets proved[] to what is proved of each part, at its root, and keeps the trees if they are wanted. */
static sunder_status prove_parts(sunder_report *report, sunder_i_solver *s, sunder_i_independent_parts *parts,
                                 double *proved, sunder_error *err)
{
    sunder_i_bound_trees of_pairs = {0};
    sunder_status status = sunder_i_report_pair_trees(report, s, parts, &of_pairs, err);
    if (!status && s->model.rules.keep_trees) {
        status = take_trees(report, &s->groups, parts, &of_pairs, err);
        if (!status) status = sunder_i_report_area_trees(report, s, parts, err);
    }
    for (uint32_t b = 0; b < s->model.bodies; b++) proved[b] = sunder_i_independent_part_bound(parts, b);
    sunder_i_bound_trees_free(&of_pairs);
    return status;
}

/* Adds up the bounds. The sums are exact until they are rounded once, so they do not depend on the order. */
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

/* Keeps what is proved of each part for sunder_i_report_worlds(). The report owns both arrays from then on. */
static void keep_proved(sunder_report *report, double **proved, sunder_i_independent_parts *parts)
{
    sunder_i_free(report->proved);
    report->proved = *proved;
    report->by_pairs = parts->by_pairs;
    *proved = parts->by_pairs = NULL;
}

sunder_status sunder_i_report_optimality(sunder_report *report, sunder_i_solver *solver, sunder_error *err)
{
    sunder_layer_summary *summary = &report->summary;
    const bool any = solver->groups.n && (solver->model.rules.effort > 0 || report->paying);
    summary->clusters = solver->groups.n;
    if (!any && !report->bound_pairs) return SUNDER_OK;
    sunder_i_independent_parts parts = {0};
    double *proved = sunder_i_alloc(solver->model.bodies, sizeof *proved);
    sunder_status status = proved ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status && any) status = count_groups(report, solver, err);
    if (!status) status = sunder_i_independent_parts_find(&parts, report, solver, err);
    if (!status) status = sunder_i_report_area_bounds(solver, &parts, err);
    if (!status) status = prove_parts(report, solver, &parts, proved, err);
    if (!status) add_up(summary, proved, parts.by_pairs, solver->model.bodies);
    if (!status && solver->model.rules.keep_worlds) keep_proved(report, &proved, &parts);
    sunder_i_free(proved);
    sunder_i_independent_parts_free(&parts);
    return status;
}
