/* Computes lower bounds by prices of area for those parts of the layer in which pairs and contact groups prove much
 * less than the cost.
 *
 * Bodies that lie around one place form many independent parts, since contact groups consist of bodies that push each
 * other in the final layout. Parts whose bodies were solved together are therefore bounded together, and bodies that
 * belong to no part but were solved with them are added. Parts of which nearly the whole cost is proved are left out.
 * The bound may use only bodies that all have to keep the gap from each other. So of two bodies in a listed conflict
 * only the larger one is used. Nothing is computed if features may lie inside others, because such pairs need not keep
 * a gap; nor if bodies prefer other places than their own, from which prices of area do not count. */
#include "displacement/layer/resolution.h"
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"
#include "displacement/solve/clusters/cluster_stages.h"

#include "base/list.h"
#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>

typedef struct payers {
    sunder_i_solver *s;
    sunder_i_independent_parts *parts;
    double *cost;             /* [bodies] the cost of each part, at the part's root */
    uint32_t *joint;          /* [bodies] union-find that joins parts whose bodies were solved together; a set of it is
                               * a joint part */
    sunder_i_id_pair *member; /* (root of the joint part, body), grouped by joint part */
    size_t members;
    bool *left_out; /* [bodies] the body is in a listed conflict with a larger one */
    uint32_t *body; /* scratch: the bodies of one joint part that are used */
} payers;

static double box_area(const sunder_i_model *model, uint32_t body)
{
    const double *box = model->body[body].box;
    return (box[2] - box[0]) * (box[3] - box[1]);
}

/* For each conflict of two bodies that remains in the result, marks the body with the smaller box in left_out[], unless
 * one of the two is marked already. If the boxes have the same area it is the body of r->b, the feature with the larger
 * number. */
static void leave_out_listed(payers *p)
{
    const sunder_i_model *model = &p->s->model;
    for (size_t k = 0; k < p->s->now.n; k++) {
        const sunder_i_relation *r = &p->s->now.pair[k];
        if (!sunder_i_is_conflict(r) || sunder_i_is_barrier(model, r->b)) continue;
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        if (i == j || p->left_out[i] || p->left_out[j]) continue;
        p->left_out[box_area(model, i) < box_area(model, j) ? i : j] = true;
    }
}

/* Returns whether the part with this root needs no bound by areas, since it has a cost of which at least the share
 * AREAS_ASKED is proved. */
static bool is_settled(const payers *p, uint32_t root)
{
    return p->cost[root] > 0 && sunder_i_independent_part_bound(p->parts, root) >= AREAS_ASKED * p->cost[root];
}

static void find_costs(payers *p)
{
    const sunder_i_model *model = &p->s->model;
    for (uint32_t b = 0; b < model->bodies; b++) {
        if (model->body[b].fixed) continue;
        p->cost[sunder_i_union_find(p->parts->root, b)] +=
            model->body[b].weight * sunder_i_stray_square(model, b, model->move + 2 * (size_t)b);
    }
}

/* Lists the movable bodies of parts that are not settled, grouped by joint part. */
static void list_members(payers *p)
{
    const sunder_i_model *model = &p->s->model;
    sunder_i_union_init(p->joint, model->bodies);
    for (uint32_t b = 0; b < model->bodies; b++) {
        if (model->body[b].fixed) continue;
        sunder_i_union_join(p->joint, b, sunder_i_union_find(p->s->parent, b));
        sunder_i_union_join(p->joint, b, sunder_i_union_find(p->parts->root, b));
    }
    for (uint32_t b = 0; b < model->bodies; b++) {
        if (model->body[b].fixed || is_settled(p, sunder_i_union_find(p->parts->root, b))) continue;
        p->member[p->members++] = (sunder_i_id_pair){sunder_i_union_find(p->joint, b), b};
    }
    qsort(p->member, p->members, sizeof *p->member, sunder_i_by_id_pair);
}

/* Sets *cost to the cost of the parts whose bodies are the n members of a joint part, and *proved to what is proved of
 * these parts so far. */
static void measure_joint(const payers *p, const sunder_i_id_pair *member, size_t n, double *cost, double *proved)
{
    sunder_total costs = {0}, bounds = {0};
    for (size_t k = 0; k < n; k++) {
        sunder_total_add(&costs, p->cost[member[k].b]);
        sunder_total_add(&bounds, sunder_i_independent_part_bound(p->parts, member[k].b));
    }
    *cost = sunder_total_nearest(&costs);
    *proved = sunder_total_nearest(&bounds);
}

/* Makes the bound by areas the bound of the joint part. It is recorded at the root area->root; all other parts of the
 * joint part get none of their own (-1). */
static sunder_status take_bound(payers *p, sunder_i_area_bound *area, const sunder_i_id_pair *member, size_t members,
                                sunder_error *err)
{
    area->body = sunder_i_alloc(area->n, sizeof *area->body);
    if (!area->body) return sunder_i_failure_cause(err);
    memcpy(area->body, p->body, area->n * sizeof *area->body);
    for (size_t k = 0; k < members; k++) p->parts->by_areas[sunder_i_union_find(p->parts->root, member[k].b)] = -1;
    p->parts->by_areas[area->root] = area->bound;
    return SUNDER_OK;
}

static sunder_status bound_joint(payers *p, const sunder_i_id_pair *member, size_t members, sunder_error *err)
{
    sunder_i_model *model = &p->s->model;
    double cost, proved;
    size_t n = 0;
    for (size_t k = 0; k < members; k++)
        if (!p->left_out[member[k].b]) p->body[n++] = member[k].b;
    measure_joint(p, member, members, &cost, &proved);
    if (n < AREAS_FEWEST || !(proved < AREAS_ASKED * cost)) return SUNDER_OK;
    sunder_i_area_bound *out = &p->parts->area[p->parts->areas];
    *out = (sunder_i_area_bound){.root = sunder_i_union_find(p->parts->root, p->body[0]), .n = n};
    sunder_status status = sunder_i_model_unite(model, p->body, n, err);
    if (!status) status = sunder_i_areas_bound(model, p->body, n, &out->prices, &out->bound, err);
    const bool better = !status && out->bound > proved;
    if (better) {
        p->parts->areas++; /* from here on sunder_i_independent_parts_free() frees its arrays */
        return take_bound(p, out, member, members, err);
    }
    sunder_i_free(out->prices.price);
    return status;
}

static sunder_status bound_all_joint(payers *p, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    leave_out_listed(p);
    find_costs(p);
    list_members(p);
    for (size_t from = 0, end; from < p->members && !status; from = end) {
        for (end = from; end < p->members && p->member[end].a == p->member[from].a;) end++;
        if (end - from >= AREAS_FEWEST) status = bound_joint(p, p->member + from, end - from, err);
    }
    return status;
}

sunder_status sunder_i_report_area_bounds(sunder_i_solver *solver, sunder_i_independent_parts *parts, sunder_error *err)
{
    if (!(solver->model.rules.effort > 0) || solver->model.rules.contained == SUNDER_CONTAINMENT_IGNORE ||
        solver->model.preferred)
        return SUNDER_OK;
    const size_t n = solver->model.bodies;
    payers p = {.s = solver,
                .parts = parts,
                .cost = sunder_i_calloc(n, sizeof *p.cost),
                .joint = sunder_i_alloc(n, sizeof *p.joint),
                .member = sunder_i_alloc(n, sizeof *p.member),
                .left_out = sunder_i_calloc(n, sizeof *p.left_out),
                .body = sunder_i_alloc(n, sizeof *p.body)};
    parts->area = sunder_i_alloc(n / AREAS_FEWEST + 1, sizeof *parts->area);
    const bool ok = p.cost && p.joint && p.member && p.left_out && p.body && parts->area;
    const sunder_status status = ok ? bound_all_joint(&p, err) : sunder_i_failure_cause(err);
    sunder_i_free_all(p.cost, p.joint, p.member, p.left_out, p.body);
    return status;
}

/* ---- Bounds by area in the written proof ------------------------------------------------------------------------- */

static bool record_tree(const sunder_i_model *model, sunder_i_area_bound *area, sunder_bound_tree *out)
{
    sunder_bound_body *body = sunder_i_alloc(area->n, sizeof *body);
    if (!body) return false;
    for (size_t k = 0; k < area->n; k++) {
        const sunder_i_body *b = &model->body[area->body[k]];
        body[k] = (sunder_bound_body){.thing = model->member[b->member], .weight = sunder_i_weight_below(model, b)};
    }
    const sunder_i_prices *p = &area->prices;
    *out = (sunder_bound_tree){.bound = area->bound,
                               .body = body,
                               .bodies = area->n,
                               .prices = {.side = p->grid.side,
                                          .unit = p->unit,
                                          .x = p->grid.x,
                                          .y = p->grid.y,
                                          .columns = p->grid.columns,
                                          .rows = p->grid.rows,
                                          .price = p->price}};
    area->prices.price = NULL;
    return true;
}

sunder_status sunder_i_report_area_trees(sunder_report *report, const sunder_i_solver *solver,
                                         sunder_i_independent_parts *parts, sunder_error *err)
{
    for (size_t k = 0; k < parts->areas; k++) {
        sunder_i_area_bound *area = &parts->area[k];
        sunder_bound_tree *tree = &report->bound_tree[report->bound_trees];
        if (!record_tree(&solver->model, area, tree)) return sunder_i_failure_cause(err);
        tree->group = solver->groups.n + area->root;
        report->bound_trees++;
    }
    return SUNDER_OK;
}
