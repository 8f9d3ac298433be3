/* Finds the anchors of all features, the features that contain them, and the free room around them. A feature whose
 * anchor lies in another feature (as a closed set) may leave that feature. A feature that moves by less than the
 * distance from its anchor to the nearest other feature cannot jump over any.
 *
 * All of this is about the features as they were given, whatever smaller shapes they have now: what may move without a
 * jump may do so, too, when it or another feature becomes smaller.
 *
 * An anchor is an interior point of its feature, rounded to doubles (sunder_shape_anchor()); for a sliver the rounded
 * point may lie beside the feature. The rules on jumps refer to the rounded point, so they are exact in any case. An
 * anchor never lies outside its feature's box, since rounding is monotone. */
#include "displacement/layer/sides.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "separation/separation.h"

#include <math.h>
#include <stdlib.h>

/* The number of runs of the R-tree that one thread takes at a time: together some hundred features. */
#define RUNS_OF_A_BATCH 16

/* Pairs of features, collected by one task: the anchor of the first lies in the second. */
typedef struct held_pairs {
    sunder_i_id_pair *pair;
    size_t n, capacity;
} held_pairs;

typedef struct holder_search {
    const sunder_i_model *model;
    sunder_i_list near, about; /* `near`: leaves of the tree near a run; `about`: those of them near one feature */
    held_pairs *held;
    double *outline; /* the outline of one neighbouring feature, and scratch */
    size_t room;
} holder_search;

/* Returns a lower bound of the distance from point a to the convex hull of feature g, relative to the origin of g's
 * body: the largest distance of a beyond the line of a side of the hull. Returns 0 if the hull contains a, and a
 * negative number if memory is out. */
static double distance_to_outline(holder_search *l, uint32_t g, const double a[2])
{
    const sunder_i_model *model = l->model;
    const size_t room = sunder_i_outline_room(model, g);
    if (!sunder_i_reserve(&l->outline, &l->room, 4 * room + 2, sizeof *l->outline)) return -1;
    const double *origin = model->body[model->body_of[g]].origin, *corner = l->outline;
    const size_t n = sunder_i_outline_of(model, g, l->outline + 2 * room + 2, l->outline);
    const double at[2] = {a[0] - origin[0], a[1] - origin[1]};
    double most = 0;
    for (size_t k = 0; k < n; k++) {
        const double *p = corner + 2 * k, *q = corner + 2 * (k + 1 < n ? k + 1 : 0);
        const double e[2] = {q[0] - p[0], q[1] - p[1]}, over = e[1] * (at[0] - p[0]) - e[0] * (at[1] - p[1]);
        if (over > 0) most = sunder_i_max(most, over / sqrt(e[0] * e[0] + e[1] * e[1]));
    }
    return most;
}

/* If feature g contains the anchor of feature f, appends the pair to l->held. Otherwise lowers *clear to the distance
 * of the anchor from g, if that is less. */
static sunder_status test_neighbour(holder_search *l, uint32_t f, uint32_t g, double *clear, sunder_error *err)
{
    const sunder_i_model *model = l->model;
    held_pairs *held = l->held;
    const double *a = model->anchor_at + 2 * (size_t)f, *box = sunder_i_home_box(model, g);
    bool holds = false;
    if (!sunder_i_box_near_point(box, a[0], a[1], *clear)) return SUNDER_OK;
    if (sunder_i_box_near_point(box, a[0], a[1], 0)) {
        const sunder_status status = sunder_i_holds(sunder_i_given_shape(model, g), a, &holds, err);
        if (status) return status;
    }
    if (!holds) {
        const double distance = distance_to_outline(l, g, a);
        *clear = sunder_i_min(*clear, distance);
        return distance < 0 ? sunder_i_failure_cause(err) : SUNDER_OK;
    }
    if (!sunder_i_reserve(&held->pair, &held->capacity, held->n + 1, sizeof *held->pair))
        return sunder_i_failure_cause(err);
    held->pair[held->n++] = (sunder_i_id_pair){f, g};
    return SUNDER_OK;
}

/* Sets box to the square around the anchor of feature f in which other features are looked for, and returns half its
 * width: half of the longer side of f's own box plus two gaps. */
static double box_about(const sunder_i_model *model, uint32_t f, double box[4])
{
    const double *a = model->anchor_at + 2 * (size_t)f, *own = sunder_i_home_box(model, f);
    const double reach = sunder_i_max(own[2] - own[0], own[3] - own[1]) / 2 + 2 * model->rules.gap;
    for (int c = 0; c < 4; c++) box[c] = a[c & 1] + (c < 2 ? -reach : reach);
    return reach;
}

/* Sets l->about to the leaves of l->near whose boxes meet `box`. l->about must have room for all of them. */
static void keep_near_leaves(holder_search *l, const double box[4])
{
    const double *boxes = l->model->tree.box;
    size_t n = 0;
    for (size_t k = 0; k < l->near.n; k++) {
        const uint32_t leaf = l->near.item[k];
        l->about.item[n] = leaf;
        n += sunder_i_box_meet_any(boxes + 4 * (size_t)leaf, box);
    }
    l->about.n = n;
}

/* Tests which features near feature f contain its anchor. Sets model->clear[f] to a lower bound of the distance from
 * the anchor to all others of other bodies. */
static sunder_status find_holders(holder_search *l, uint32_t f, sunder_error *err)
{
    const sunder_i_model *model = l->model;
    sunder_status status = SUNDER_OK;
    double box[4], clear = box_about(model, f, box);
    keep_near_leaves(l, box);
    for (size_t k = 0; k < l->about.n && !status; k++) {
        const uint32_t g = model->tree.item[l->about.item[k]];
        if (!sunder_i_is_barrier(model, g) && model->body_of[f] != model->body_of[g] && !sunder_i_may_jump(model, f, g))
            status = test_neighbour(l, f, g, &clear, err);
    }
    model->clear[f] = clear;
    return status;
}

static sunder_status find_holders_of_run(holder_search *l, size_t run, sunder_error *err)
{
    const sunder_i_rtree *tree = &l->model->tree;
    sunder_status status = SUNDER_OK;
    size_t first, end;
    double all[4], box[4];
    sunder_i_rtree_run(tree, run, &first, &end);
    sunder_i_box_clear(all);
    for (size_t leaf = first; leaf < end; leaf++) {
        if (sunder_i_is_barrier(l->model, tree->item[leaf])) continue;
        box_about(l->model, tree->item[leaf], box);
        sunder_i_box_join(all, box);
    }
    l->near.n = 0;
    if (!sunder_i_rtree_query_leaves(tree, all, &l->near) ||
        !sunder_i_reserve(&l->about.item, &l->about.capacity, l->near.n + 1, sizeof *l->about.item))
        return sunder_i_failure_cause(err);
    for (size_t leaf = first; leaf < end && !status; leaf++)
        if (!sunder_i_is_barrier(l->model, tree->item[leaf])) status = find_holders(l, tree->item[leaf], err);
    return status;
}

typedef struct holder_search_task {
    const sunder_i_model *model;
    held_pairs *held; /* [batches of runs] */
} holder_search_task;

/* Task of a thread: finds the pairs of the batches of runs `begin` to `end` - 1 of the tree. */
static sunder_status find_holders_of_batches(void *context, size_t begin, size_t end, sunder_error *err)
{
    const holder_search_task *all = context;
    holder_search l = {.model = all->model};
    const size_t runs = sunder_i_rtree_runs(&l.model->tree);
    sunder_status status = SUNDER_OK;
    for (size_t batch = begin; batch < end && !status; batch++) {
        l.held = &all->held[batch];
        for (size_t run = batch * RUNS_OF_A_BATCH; run < (batch + 1) * RUNS_OF_A_BATCH && run < runs && !status; run++)
            status = find_holders_of_run(&l, run, err);
    }
    sunder_i_free_all(l.near.item, l.about.item, l.outline);
    return status;
}

/* Merges the pairs of all batches into model->held and sorts them. Returns false if memory is out. */
static bool merge_held(sunder_i_model *model, const held_pairs *held, size_t batches)
{
    size_t n = 0;
    for (size_t k = 0; k < batches; k++) n += held[k].n;
    model->held = sunder_i_alloc(n, sizeof *model->held);
    if (!model->held) return false;
    for (size_t k = 0; k < batches; k++)
        for (size_t i = 0; i < held[k].n; i++) model->held[model->held_n++] = held[k].pair[i];
    if (n) qsort(model->held, n, sizeof *model->held, sunder_i_by_id_pair);
    return true;
}

static sunder_status find_all_holders(sunder_i_model *model, sunder_error *err)
{
    const size_t batches = (sunder_i_rtree_runs(&model->tree) + RUNS_OF_A_BATCH - 1) / RUNS_OF_A_BATCH;
    holder_search_task all = {model, sunder_i_calloc(batches, sizeof *all.held)};
    if (!all.held) return sunder_i_failure_cause(err);
    sunder_status status =
        sunder_i_parallel(model->rules.threads, batches, SUNDER_I_GRAIN_WHOLE, find_holders_of_batches, &all, err);
    if (!status && !merge_held(model, all.held, batches)) status = sunder_i_failure_cause(err);
    for (size_t k = 0; k < batches; k++) sunder_i_free(all.held[k].pair);
    sunder_i_free(all.held);
    for (size_t f = 0; f < model->features && !status; f++) {
        sunder_i_body *body = &model->body[model->body_of[f]];
        if (model->present[f]) body->clear = sunder_i_min(body->clear, model->clear[f]);
    }
    return status;
}

static sunder_status find_anchors(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_model *model = context;
    (void)err;
    for (size_t f = begin; f < end; f++)
        if (model->present[f]) sunder_shape_anchor(sunder_i_given_shape(model, f), model->anchor_at + 2 * f);
    return SUNDER_OK;
}

/* Notes which features may jump. Returns false if memory is out. */
static bool note_jumpers(sunder_i_model *model)
{
    for (size_t f = 0; f < model->features; f++) {
        if (!sunder_i_demands_on(model, (uint32_t)f)->may_jump) continue;
        if (!model->may_jump) model->may_jump = sunder_i_calloc(model->features, sizeof *model->may_jump);
        if (!model->may_jump) return false;
        model->may_jump[f] = true;
    }
    return true;
}

sunder_status sunder_i_model_anchor(sunder_i_model *model, sunder_error *err)
{
    const size_t n = model->features;
    sunder_status status = sunder_i_model_find_sides(model, err);
    if (status || model->rules.jumps) return status;
    model->anchor_at = sunder_i_calloc(2 * n, sizeof *model->anchor_at);
    model->clear = sunder_i_calloc(n, sizeof *model->clear);
    if (!model->anchor_at || !model->clear || !note_jumpers(model)) return sunder_i_failure_cause(err);
    status = sunder_i_parallel(model->rules.threads, n, SUNDER_I_GRAIN_BOXES, find_anchors, model, err);
    for (size_t b = 0; b < model->bodies && !status; b++)
        if (!sunder_i_keep_anchors(model, &model->body[b])) status = sunder_i_failure_cause(err);
    return status ? status : find_all_holders(model, err);
}

bool sunder_i_may_pass(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    const sunder_i_id_pair pair = {f, g};
    if (!sunder_i_is_barrier(model, g) && sunder_i_may_jump(model, f, g)) return true;
    return model->held_n && bsearch(&pair, model->held, model->held_n, sizeof pair, sunder_i_by_id_pair);
}
