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

/* Bodies of the pair's tree: the two; or the feature's, and all parts of the barrier that a solution no dearer than the
 * least translation could be kept off by. */
static bool find_bodies(const sunder_i_model *model, const sunder_bound_pair *pair, sunder_i_list *body)
{
    const uint32_t a = model->body_of[pair->a], b = (uint32_t)pair->b;
    body->n = 0;
    if (!sunder_i_list_push(body, a)) return false;
    if (!sunder_i_is_barrier(model, b)) return sunder_i_list_push(body, model->body_of[b]);
    const double home[2] = {0, 0};
    double box[4];
    sunder_i_body_box(&model->body[a], home, 2 * pair->least + sunder_i_owed_above(model, (uint32_t)pair->a, b), box);
    if (!sunder_i_rtree_query(&model->tree, box, body)) return false;
    const uint32_t end = (uint32_t)model->features + model->barriers->part_end[sunder_i_barrier_of(model, b)];
    size_t out = 1;
    for (size_t k = 1; k < body->n; k++)
        if (body->item[k] >= b && body->item[k] < end) body->item[out++] = model->body_of[body->item[k]];
    body->n = 1 + sunder_i_set_make(body->item + 1, out - 1);
    return true;
}

/* The tree of one pair, with its shares of the weights. */
static sunder_status prove(const sunder_i_solver *s, const sunder_bound_pair *pair, const double *load,
                           sunder_i_list *body, sunder_bound_tree *out, sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    const sunder_i_waived waived = {.pair = s->groups.waived, .n = s->groups.waived_n};
    if (!find_bodies(model, pair, body)) return sunder_i_no_memory(err);
    double *weight = sunder_i_alloc(body->n, sizeof *weight), slack = 0;
    if (!weight) return sunder_i_no_memory(err);
    for (size_t k = 0; k < body->n; k++) {
        const sunder_i_body *b = &model->body[body->item[k]];
        weight[k] = b->fixed ? b->weight : b->weight * (pair->multiplier / load[body->item[k]]) * (1 - SHARED);
        if (!b->fixed) slack += 1 / weight[k];
    }
    const sunder_i_task task = {.model = model,
                                .waived = &waived,
                                .body = body->item,
                                .n = body->n,
                                .weight = weight,
                                .goal = pair->least * pair->least / slack * (1 + SHARED),
                                .keep = true};
    sunder_i_tree tree;
    bool ok = sunder_i_tree_init(&tree, &task);
    while (ok && sunder_i_tree_run(&tree, PAIR_STEPS) == SUNDER_I_TREE_FOUND) ok = !tree.failed;
    ok = ok && !tree.failed && sunder_i_tree_record(&tree, out);
    sunder_i_tree_free(&tree);
    sunder_i_free(weight);
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}

static bool counts(const sunder_bound_pair *pair) { return pair->multiplier > 0; }

static sunder_status prove_all(sunder_report *report, const sunder_i_solver *s, sunder_bound_tree *tree, size_t *n,
                               sunder_error *err)
{
    double *load = sunder_i_calloc(s->model.bodies, sizeof *load);
    sunder_i_list body = {0};
    sunder_status status = load ? SUNDER_OK : sunder_i_no_memory(err);
    for (size_t k = 0; !status && k < report->bound_pairs; k++) {
        const sunder_bound_pair *p = &report->bound_pair[k];
        if (!counts(p)) continue;
        load[s->model.body_of[p->a]] += p->multiplier;
        load[s->model.body_of[p->b]] += p->multiplier;
    }
    for (size_t k = 0; !status && k < report->bound_pairs; k++) {
        if (!counts(&report->bound_pair[k])) continue;
        status = prove(s, &report->bound_pair[k], load, &body, &tree[*n], err);
        if (!status && tree[*n].bound > 0)
            ++*n;
        else if (!status)
            sunder_i_bound_tree_free(&tree[*n]);
    }
    sunder_i_free(load);
    sunder_i_free(body.item);
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
