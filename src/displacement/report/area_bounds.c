/* What parts of the layer cost because their bodies share no area, where neither pairs nor contact groups prove nearly
 * what they cost.
 *
 * Of a part those bodies pay of which every two owe each other the gap. Of two that are listed the larger one does;
 * where features may lie in others, and owe them nothing then, nobody does. */
#include "displacement/clusters/stages.h"
#include "displacement/layer/resolution.h"
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"

#include "base/list.h"
#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>

typedef struct payers {
    const sunder_i_solver *s;
    sunder_i_id_pair *member; /* part after part: its root, the body */
    size_t members;
    bool *left_out; /* [bodies] */
    uint32_t *body; /* of one part */
} payers;

static double extent(const sunder_i_model *model, uint32_t body)
{
    const double *box = model->body[body].box;
    return (box[2] - box[0]) * (box[3] - box[1]);
}

/* Of two that are listed one is left out: the smaller, or the later of equals. */
static void leave_out_listed(payers *p)
{
    const sunder_i_model *model = &p->s->model;
    for (size_t k = 0; k < p->s->now.n; k++) {
        const sunder_i_relation *r = &p->s->now.pair[k];
        if (!sunder_i_is_conflict(r) || sunder_i_is_barrier(model, r->b)) continue;
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        if (i == j || p->left_out[i] || p->left_out[j]) continue;
        p->left_out[extent(model, i) < extent(model, j) ? i : j] = true;
    }
}

/* All bodies that move of parts of which anything is proved. */
static void list_members(payers *p, sunder_i_parts *parts)
{
    const sunder_i_model *model = &p->s->model;
    for (uint32_t b = 0; b < model->bodies; b++) {
        const uint32_t root = sunder_i_union_find(parts->root, b);
        if (model->body[b].fixed || !(parts->by_pairs[root] > 0 || parts->by_groups[root] > 0)) continue;
        p->member[p->members++] = (sunder_i_id_pair){root, b};
    }
    qsort(p->member, p->members, sizeof *p->member, sunder_i_by_id_pair);
}

/* Would a better bound of the part change anything that is told of the layer? */
static bool is_worth_it(const sunder_i_model *model, const sunder_i_parts *parts, const sunder_i_id_pair *member,
                        size_t n)
{
    double cost = 0;
    for (size_t k = 0; k < n; k++) {
        const double *t = model->move + 2 * (size_t)member[k].b;
        cost += model->body[member[k].b].weight * (t[0] * t[0] + t[1] * t[1]);
    }
    return sunder_i_part_bound(parts, member[0].a) < AREAS_ASKED * cost;
}

static sunder_status ask_part(payers *p, sunder_i_parts *parts, size_t from, size_t end, sunder_error *err)
{
    sunder_i_model *model = (sunder_i_model *)&p->s->model;
    size_t n = 0;
    for (size_t k = from; k < end; k++)
        if (!p->left_out[p->member[k].b]) p->body[n++] = p->member[k].b;
    sunder_i_area_bound *out = &parts->area[parts->areas];
    *out = (sunder_i_area_bound){.root = p->member[from].a, .n = n};
    sunder_status status = sunder_i_model_unite(model, p->body, n, err);
    if (!status) status = sunder_i_areas_bound(model, p->body, n, &out->prices, &out->bound, err);
    if (status || !(out->bound > sunder_i_part_bound(parts, out->root))) {
        sunder_i_free(out->prices.price);
        return status;
    }
    out->body = sunder_i_alloc(n, sizeof *out->body);
    if (out->body) memcpy(out->body, p->body, n * sizeof *out->body);
    parts->by_areas[out->root] = out->bound;
    parts->areas++;
    return out->body ? SUNDER_OK : sunder_i_no_memory(err);
}

static sunder_status ask_parts(payers *p, sunder_i_parts *parts, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    leave_out_listed(p);
    list_members(p, parts);
    for (size_t from = 0, end; from < p->members && !status; from = end) {
        for (end = from; end < p->members && p->member[end].a == p->member[from].a;) end++;
        if (end - from >= AREAS_FEWEST && is_worth_it(&p->s->model, parts, p->member + from, end - from))
            status = ask_part(p, parts, from, end, err);
    }
    return status;
}

sunder_status sunder_i_report_area_bounds(const sunder_i_solver *s, sunder_i_parts *parts, sunder_error *err)
{
    if (!(s->model.rules.effort > 0) || s->model.rules.contained == SUNDER_CONTAINMENT_IGNORE) return SUNDER_OK;
    const size_t n = s->model.bodies;
    payers p = {.s = s,
                .member = sunder_i_alloc(n, sizeof *p.member),
                .left_out = sunder_i_calloc(n, sizeof *p.left_out),
                .body = sunder_i_alloc(n, sizeof *p.body)};
    parts->area = sunder_i_alloc(n / AREAS_FEWEST + 1, sizeof *parts->area);
    const bool ok = p.member && p.left_out && p.body && parts->area;
    const sunder_status status = ok ? ask_parts(&p, parts, err) : sunder_i_no_memory(err);
    sunder_i_free(p.member);
    sunder_i_free(p.left_out);
    sunder_i_free(p.body);
    return status;
}

/* ---- For a reader ------------------------------------------------------------------------------------------------ */

static bool record(const sunder_i_model *model, sunder_i_area_bound *area, sunder_bound_tree *out)
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

sunder_status sunder_i_report_area_trees(sunder_report *report, const sunder_i_solver *s, sunder_i_parts *parts,
                                         sunder_error *err)
{
    for (size_t k = 0; k < parts->areas; k++) {
        sunder_i_area_bound *area = &parts->area[k];
        sunder_bound_tree *tree = &report->bound_tree[report->bound_trees];
        if (!record(&s->model, area, tree)) return sunder_i_no_memory(err);
        tree->group = s->groups.n + area->root;
        report->bound_trees++;
    }
    return SUNDER_OK;
}
