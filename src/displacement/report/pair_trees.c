/* Trees for the bound of pairs, where that is more than contact groups prove, so that a reader has something to check.
 *
 * The bound of pairs is sum l d - sum (sum l)^2 / (4 w), by multipliers l (bound.c). A body shares its weight out
 * among its pairs as their multipliers are: w_ij = w l_ij / sum l. Then the least of w_ij |t_i|^2 + w_ji |t_j|^2 over
 * what the pair by itself may do is no less than its part of that sum, l d - l^2 / (4 w_ij) - l^2 / (4 w_ji), by weak
 * duality; and trees of one group add up whose weights of a body are no more than its own. So there is a tree of two
 * bodies for each pair, and all are of one group.
 *
 * What such trees prove is less by what counts as free in them, a share of some 2^-31: that is the bound then. Where
 * they prove much less (a pair that may get one inside the other is nothing to them) all stays as it was. */
#include "displacement/clusters/stages.h"
#include "displacement/optimum/tree.h"
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"

#include <math.h>

static double sum_of(const sunder_bound_tree *tree, size_t n)
{
    double sum = 0;
    for (size_t k = 0; k < n; k++) sum = nextafter(sum + tree[k].bound, -INFINITY);
    return sum;
}

/* The tree of one pair, with its shares of the weights. */
static sunder_status prove(const sunder_i_solver *s, const sunder_bound_pair *pair, const double *load,
                           sunder_bound_tree *out, sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    const sunder_i_waived waived = {s->groups.waived, s->groups.waived_n};
    const uint32_t body[2] = {model->body_of[pair->a], model->body_of[pair->b]};
    double weight[2], slack = 0;
    for (int e = 0; e < 2; e++) {
        weight[e] = model->body[body[e]].weight * (pair->multiplier / load[body[e]]) * (1 - SHARED);
        if (!model->body[body[e]].fixed) slack += 1 / weight[e];
    }
    const sunder_i_task task = {.model = model,
                                .waived = &waived,
                                .body = body,
                                .n = 2,
                                .weight = weight,
                                .goal = pair->least * pair->least / slack * (1 + SHARED),
                                .keep = true};
    sunder_i_tree tree;
    bool ok = sunder_i_tree_init(&tree, &task);
    while (ok && sunder_i_tree_run(&tree, PAIR_STEPS) == SUNDER_I_TREE_FOUND) ok = !tree.failed;
    ok = ok && !tree.failed && sunder_i_tree_record(&tree, out);
    sunder_i_tree_free(&tree);
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}

static bool counts(const sunder_bound_pair *pair) { return pair->multiplier > 0; }

static sunder_status prove_all(sunder_report *report, const sunder_i_solver *s, sunder_bound_tree *tree, size_t *n,
                               sunder_error *err)
{
    double *load = sunder_i_calloc(s->model.bodies, sizeof *load);
    sunder_status status = load ? SUNDER_OK : sunder_i_no_memory(err);
    for (size_t k = 0; !status && k < report->bound_pairs; k++) {
        const sunder_bound_pair *p = &report->bound_pair[k];
        if (!counts(p)) continue;
        load[s->model.body_of[p->a]] += p->multiplier;
        load[s->model.body_of[p->b]] += p->multiplier;
    }
    for (size_t k = 0; !status && k < report->bound_pairs; k++) {
        if (!counts(&report->bound_pair[k])) continue;
        status = prove(s, &report->bound_pair[k], load, &tree[*n], err);
        if (!status && tree[*n].bound > 0)
            ++*n;
        else if (!status)
            sunder_i_bound_tree_free(&tree[*n]);
    }
    sunder_i_free(load);
    return status;
}

sunder_status sunder_i_report_pair_trees(sunder_report *report, sunder_i_solver *s, sunder_error *err)
{
    sunder_layer_summary *summary = &report->summary;
    /* Trees of blocks prove less than the sum of their bounds: but then the groups prove more than the pairs. */
    if (!s->model.rules.keep_trees || summary->lower_bound > summary->pair_bound ||
        sum_of(report->bound_tree, report->bound_trees) == summary->lower_bound)
        return SUNDER_OK;
    sunder_bound_tree *tree = sunder_i_calloc(report->bound_pairs, sizeof *tree);
    size_t n = 0;
    sunder_status status = tree ? sunder_i_solver_waive(s, err) : sunder_i_no_memory(err);
    if (!status) status = prove_all(report, s, tree, &n, err);
    const double sum = sum_of(tree, n);
    if (!status && sum >= summary->lower_bound * (1 - NEARLY_AS_MUCH)) {
        for (size_t k = 0; k < report->bound_trees; k++) sunder_i_bound_tree_free(&report->bound_tree[k]);
        sunder_i_free(report->bound_tree);
        report->bound_tree = tree;
        report->bound_trees = n;
        summary->lower_bound = fmin(summary->lower_bound, sum);
        return SUNDER_OK;
    }
    for (size_t k = 0; k < n; k++) sunder_i_bound_tree_free(&tree[k]);
    sunder_i_free(tree);
    return status;
}
