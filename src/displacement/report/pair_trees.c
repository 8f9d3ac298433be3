/* Makes trees for the bound by pairs, for those parts of the layer in which it exceeds the bound of the contact groups.
 * The printed bound is what the trees prove, so that a checker can verify it and the result does not depend on whether
 * a proof is written.
 *
 * The bound by pairs is sum l d - sum (sum l)^2 / (4 w), with multipliers l (bound.c). The weight of a body is divided
 * among its pairs in proportion to their multipliers: w_ij = w l_ij / sum l. By weak duality the least value of w_ij
 * |t_i|^2 + w_ji |t_j|^2 over the admissible relative moves of the pair is at least l d - l^2 / (4 w_ij) - l^2 / (4
 * w_ji), its part of that sum. The trees of one group may be added up if their weights for each body sum to at most its
 * weight. So each pair gets a tree of two bodies, and the trees of a part form one group.
 *
 * Such trees prove slightly less, by a share of about 2^-31. They ignore a pair where one feature may lie inside the
 * other, since such pairs do not have to keep a distance. Jumps and sides of barriers are ignored, as in the least
 * translation of a pair. */
#include "displacement/layer/reads.h"
#include "displacement/prove/optimum/tree.h"
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"
#include "displacement/solve/clusters/cluster_stages.h"

#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>

/* Lists the bodies of a pair's tree: the two bodies; or the body of the feature, and all parts of the barrier that
 * could be in conflict with it in a solution that costs no more than the least translation. Returns false if memory is
 * out. */
static bool find_bodies(const sunder_i_model *model, const sunder_bound_pair *pair, sunder_i_list *body)
{
    const uint32_t a = model->body_of[pair->a], b = (uint32_t)pair->b;
    body->n = 0;
    if (!sunder_i_list_push(body, a)) return false;
    if (!sunder_i_is_barrier(model, b)) return sunder_i_list_push(body, model->body_of[b]);
    const double home[2] = {0, 0};
    double box[4];
    sunder_i_body_box(&model->body[a], home, 2 * pair->least + sunder_i_owed_above(model, (uint32_t)pair->a, b), box);
    sunder_i_reading reading;
    sunder_i_reads_begin(&reading, model, a);
    const bool ok = sunder_i_look_about(model, &model->tree, box, body);
    sunder_i_reads_end(&reading);
    if (!ok) return false;
    const uint32_t end = (uint32_t)model->features + model->barriers->part_end[sunder_i_barrier_of(model, b)];
    size_t out = 1;
    for (size_t k = 1; k < body->n; k++)
        if (body->item[k] >= b && body->item[k] < end) body->item[out++] = model->body_of[body->item[k]];
    body->n = 1 + sunder_i_set_make(body->item + 1, out - 1);
    return true;
}

/* Sets *bound to what the tree of one pair proves with the pair's shares of the weights. If trees are kept, the tree is
 * added to `trees`. */
static sunder_status prove_pair(const sunder_i_solver *s, const sunder_bound_pair *pair, const double *load,
                                sunder_i_list *body, double *bound, sunder_i_bound_trees *trees, sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    const sunder_i_waived waived = {.pair = s->groups.waived, .n = s->groups.waived_n};
    if (!find_bodies(model, pair, body)) return sunder_i_failure_cause(err);
    double *weight = sunder_i_alloc(body->n, sizeof *weight), slack = 0;
    if (!weight) return sunder_i_failure_cause(err);
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
                                .no_paths = true,
                                .keep = model->rules.keep_trees};
    sunder_i_tree tree;
    bool ok = sunder_i_tree_init(&tree, &task);
    while (ok && sunder_i_tree_run(&tree, PAIR_STEPS) == SUNDER_I_TREE_FOUND) ok = !tree.failed;
    ok = ok && !tree.failed;
    *bound = ok ? sunder_i_tree_bound(&tree) : 0;
    if (*bound > 0 && task.keep) ok = sunder_i_tree_keep(&tree, trees);
    sunder_i_tree_free(&tree);
    sunder_i_free(weight);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* Returns the body of pair->a or, if that body is fixed, the body of pair->b. */
static uint32_t mover_of(const sunder_i_model *model, const sunder_bound_pair *pair)
{
    const uint32_t a = model->body_of[pair->a];
    return model->body[a].fixed ? model->body_of[pair->b] : a;
}

/* Lists the pairs whose parts may get their bound from trees of pairs, as (root of the part, index of the pair),
 * sorted. Returns their number. */
static size_t list_pairs(const sunder_report *report, const sunder_i_model *model, sunder_i_independent_parts *parts,
                         sunder_i_id_pair *which)
{
    size_t n = 0;
    for (size_t k = 0; k < report->bound_pairs; k++) {
        const sunder_bound_pair *p = &report->bound_pair[k];
        const uint32_t mover = mover_of(model, p);
        if (!(p->multiplier > 0) || !sunder_i_independent_part_wants_pair_trees(parts, mover)) continue;
        which[n++] = (sunder_i_id_pair){sunder_i_union_find(parts->root, mover), (uint32_t)k};
    }
    qsort(which, n, sizeof *which, sunder_i_by_id_pair);
    return n;
}

static sunder_status prove_all(const sunder_report *report, const sunder_i_solver *s, const sunder_i_id_pair *which,
                               size_t n, double *load, double *by_trees, sunder_i_bound_trees *trees, sunder_error *err)
{
    sunder_i_list body = {0};
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < n; k++) {
        const sunder_bound_pair *p = &report->bound_pair[which[k].b];
        load[s->model.body_of[p->a]] += p->multiplier;
        load[s->model.body_of[p->b]] += p->multiplier;
    }
    for (size_t k = 0; k < n && !status; k++) {
        const size_t before = trees->n;
        double bound;
        status = prove_pair(s, &report->bound_pair[which[k].b], load, &body, &bound, trees, err);
        if (status || !(bound > 0)) continue;
        double *sum = &by_trees[which[k].a];
        *sum = *sum > 0 ? nextafter(*sum + bound, -INFINITY) : bound;
        if (trees->n > before) trees->tree[before].group = which[k].a;
    }
    sunder_i_free(body.item);
    return status;
}

sunder_status sunder_i_report_pair_trees(const sunder_report *report, sunder_i_solver *solver,
                                         sunder_i_independent_parts *parts, sunder_i_bound_trees *trees,
                                         sunder_error *err)
{
    sunder_i_id_pair *which = sunder_i_alloc(report->bound_pairs, sizeof *which);
    double *load = sunder_i_calloc(solver->model.bodies, sizeof *load);
    sunder_status status = which && load ? SUNDER_OK : sunder_i_failure_cause(err);
    const size_t n = status ? 0 : list_pairs(report, &solver->model, parts, which);
    if (!status && n) status = sunder_i_solver_list_waivers(solver, err);
    for (size_t b = 0; b < solver->model.bodies; b++) parts->by_trees[b] = 0;
    if (!status && n) status = prove_all(report, solver, which, n, load, parts->by_trees, trees, err);
    sunder_i_free_all(which, load);
    return status;
}
