/* Other starts for easing. A descent (../search/ease_cluster.c) keeps the sides of its start, and passes no dearer
 * layout on its way. So the tree of a small cluster, in which pairs that are left in conflict have prices, looks for
 * cheaper layouts on any sides, and the cluster is eased once more from each that it finds. */
#include "displacement/prove/optimum/tree.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/extremes.h"
#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>

/* ---- Pairs with prices ------------------------------------------------------------------------------------------- */

void sunder_i_eased_starts_free(sunder_i_eased_starts *starts)
{
    sunder_i_free_all(starts->pair, starts->group_of, starts->waived);
}

/* Lists the pairs of bodies that are in conflict; a barrier has the body of its first part. */
static bool list_pairs(const sunder_i_solver *s, sunder_i_eased_starts *out)
{
    const sunder_i_model *model = &s->model;
    size_t kept = 0;
    out->pair = sunder_i_alloc(s->now.n, sizeof *out->pair);
    for (size_t k = 0; k < s->now.n && out->pair; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        const uint32_t i = model->body_of[r->a], j = model->body_of[sunder_i_whole_of(model, r->b)];
        if (!sunder_i_is_conflict_of_bodies(model, r)) continue;
        const bool swap = !sunder_i_may_move(&model->body[i]) || (sunder_i_may_move(&model->body[j]) && j < i);
        out->pair[out->pairs++] = swap ? (sunder_i_id_pair){j, i} : (sunder_i_id_pair){i, j};
    }
    if (out->pairs) qsort(out->pair, out->pairs, sizeof *out->pair, sunder_i_by_id_pair);
    for (size_t k = 0; k < out->pairs; k++)
        if (k == 0 || sunder_i_by_id_pair(&out->pair[k - 1], &out->pair[k])) out->pair[kept++] = out->pair[k];
    out->pairs = kept;
    return out->pair != NULL;
}

sunder_status sunder_i_eased_starts_init(sunder_i_solver *solver, sunder_i_eased_starts *starts, sunder_error *err)
{
    *starts = (sunder_i_eased_starts){.group_of = sunder_i_alloc(solver->model.bodies, sizeof *starts->group_of)};
    if (!starts->group_of || !list_pairs(solver, starts)) return sunder_i_failure_cause(err);
    for (uint32_t b = 0; b < solver->model.bodies; b++)
        starts->group_of[b] =
            sunder_i_may_move(&solver->model.body[b]) ? sunder_i_union_find(solver->parent, b) : SUNDER_I_NOBODY;
    return sunder_i_solver_find_waivers(solver, &starts->waived, &starts->waived_n, err);
}

/* ---- The tree of a cluster --------------------------------------------------------------------------------------- */

typedef struct starting {
    const sunder_i_model *model;
    sunder_i_cluster *cluster;
    double *move, *start; /* [2 n] the cheapest moves so far; scratch */
    double cost;          /* of these */
    int tried;            /* layouts that the cluster was eased from */
    bool better;
    sunder_status status;
    sunder_error *err;
} starting;

/* Eases the cluster from a layout that the tree found. If that is cheaper, the tree looks for a still cheaper one. It
 * ends after MOST_STARTS layouts. */
static bool try_start(sunder_i_tree *tree, void *context)
{
    starting *x = context;
    const sunder_i_cluster *c = x->cluster;
    bool done;
    memcpy(x->start, x->move, 2 * c->n * sizeof *x->start);
    for (size_t k = 0; k < tree->task.n; k++) {
        const uint32_t body = tree->body[k];
        const uint32_t *own = bsearch(&body, c->body, c->n, sizeof body, sunder_i_by_number);
        if (own && sunder_i_may_move(&x->model->body[body]))
            memcpy(x->start + 2 * (own - c->body), tree->program.t + 2 * k, 2 * sizeof *x->start);
    }
    x->status = sunder_i_cluster_ease_from(x->model, c, x->start, x->move, &x->cost, &done, x->err);
    x->better = x->better || done;
    sunder_i_tree_lower_goal(tree, ++x->tried < MOST_STARTS ? x->cost * (1 - START_NEAR) : 0);
    return !x->status;
}

static uint32_t place_in(const sunder_i_list *list, uint32_t body)
{
    return (uint32_t)sunder_i_lower_bound(&body, list->item, list->n, sizeof body, sunder_i_by_number);
}

/* About how deep something may lie in the body. */
static double depth_of(const sunder_i_body *body)
{
    return sunder_i_min(body->box[2] - body->box[0], body->box[3] - body->box[1]);
}

/* Sets the bodies and the prices of the cluster's tree. False if memory is out. */
static bool gather_task(const sunder_i_model *model, const sunder_i_cluster *c, const sunder_i_eased_starts *starts,
                        sunder_i_list *body, sunder_i_task_price **price, size_t *prices)
{
    const sunder_i_id_pair *pair = starts->pair, *end = pair + starts->pairs;
    sunder_i_id_pair *own = sunder_i_alloc(starts->pairs, sizeof *own);
    bool ok = own != NULL;
    *prices = 0;
    for (size_t k = 0; k < c->n && ok; k++) ok = sunder_i_list_push(body, c->body[k]);
    for (; pair < end && ok; pair++) {
        if (!sunder_i_set_has(c->body, c->n, pair->a) || !sunder_i_may_move(&model->body[pair->a])) continue;
        if (sunder_i_may_move(&model->body[pair->b]) && !sunder_i_set_has(c->body, c->n, pair->b)) continue;
        own[(*prices)++] = *pair;
        ok = sunder_i_tree_list_parts(model, pair->a, pair->b, body);
    }
    body->n = sunder_i_set_make(body->item, body->n);
    *price = ok ? sunder_i_alloc(*prices, sizeof **price) : NULL;
    for (size_t k = 0; k < *prices && *price; k++) {
        const uint32_t p = place_in(body, own[k].a), q = place_in(body, own[k].b);
        (*price)[k] = (sunder_i_task_price){p < q ? p : q, p < q ? q : p,
                                            sunder_i_price_of(model, &model->body[own[k].a], &model->body[own[k].b]),
                                            INFINITY, depth_of(&model->body[own[k].a])};
    }
    sunder_i_free(own);
    return *price != NULL;
}

/* Runs the tree. False if memory is out. */
static bool run_tree(const sunder_i_solver *s, const sunder_i_eased_starts *starts, starting *x, size_t movers)
{
    const sunder_i_waived waived = {.pair = starts->waived, .n = starts->waived_n};
    sunder_i_list body = {0};
    sunder_i_task task = {.model = &s->model,
                          .waived = &waived,
                          .group_of = starts->group_of,
                          .goal = x->cost * (1 - START_NEAR),
                          .all_springs = true};
    sunder_i_task_price *price = NULL;
    bool ok = gather_task(&s->model, x->cluster, starts, &body, &price, &task.prices);
    for (size_t k = 0; k < x->cluster->n; k++)
        if (sunder_i_may_move(&s->model.body[x->cluster->body[k]])) task.group = starts->group_of[x->cluster->body[k]];
    task.price = price;
    task.body = body.item;
    task.n = body.n;
    const double steps = STARTED_STEPS * s->model.rules.effort * (double)movers;
    const sunder_i_priced_run run = {(uint64_t)sunder_i_min(steps, 0x1p62), try_start, NULL, x};
    if (ok && task.prices && steps > 0) ok = sunder_i_tree_run_priced(&task, &run);
    sunder_i_free_all(body.item, price);
    return ok;
}

sunder_status sunder_i_eased_starts_try(const sunder_i_solver *solver, sunder_i_cluster *cluster, double *move,
                                        void *context, sunder_error *err)
{
    starting x = {.model = &solver->model, .cluster = cluster, .move = move, .err = err};
    size_t movers = 0;
    for (size_t k = 0; k < cluster->n; k++) movers += sunder_i_may_move(&solver->model.body[cluster->body[k]]);
    if (movers == 0 || movers > MOST_STARTED) return SUNDER_OK;
    x.start = sunder_i_alloc(2 * cluster->n, sizeof *x.start);
    if (!x.start) return sunder_i_failure_cause(err);
    sunder_status status = sunder_i_cluster_ease(&solver->model, cluster, move, &x.cost, &x.better, err);
    if (!status && x.cost > 0 && !run_tree(solver, context, &x, movers) && !x.status)
        status = sunder_i_failure_cause(err);
    sunder_i_free(x.start);
    if (!status) status = x.status;
    if (!status && x.better) cluster->outcome = SUNDER_I_WORKED_ON;
    return status;
}
