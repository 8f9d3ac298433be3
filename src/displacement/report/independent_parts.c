/* Divides the layer into independent parts, and collects what is proved of each. */
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"

#include "base/extremes.h"
#include "base/union_find.h"

#include <math.h>
#include <string.h>

static bool may_move(const sunder_i_model *model, uint32_t body) { return !model->body[body].fixed; }

/* Joins all movable bodies of the group, guests included, in root[]. */
static void join_group(const sunder_i_model *model, const sunder_i_group *g, uint32_t *root)
{
    uint32_t first = SUNDER_I_NOBODY;
    for (size_t m = 0; m < g->n + g->guests.n; m++) {
        const uint32_t b = m < g->n ? g->body[m] : g->guests.item[m - g->n];
        if (!may_move(model, b)) continue;
        if (first == SUNDER_I_NOBODY) first = b;
        sunder_i_union_join(root, first, b);
    }
}

static void join_pairs(const sunder_i_model *model, const sunder_report *report, uint32_t *root)
{
    for (size_t k = 0; k < report->bound_pairs; k++) {
        const sunder_bound_pair *p = &report->bound_pair[k];
        const uint32_t i = model->body_of[p->a], j = model->body_of[p->b];
        if (p->multiplier > 0 && may_move(model, i) && may_move(model, j)) sunder_i_union_join(root, i, j);
    }
}

sunder_status sunder_i_independent_parts_find(sunder_i_independent_parts *parts, const sunder_report *report,
                                              const sunder_i_solver *solver, sunder_error *err)
{
    const sunder_i_model *model = &solver->model;
    *parts = (sunder_i_independent_parts){.root = sunder_i_alloc(model->bodies, sizeof *parts->root),
                                          .by_pairs = sunder_i_calloc(model->bodies, sizeof *parts->by_pairs),
                                          .by_trees = sunder_i_alloc(model->bodies, sizeof *parts->by_trees),
                                          .by_groups = sunder_i_calloc(model->bodies, sizeof *parts->by_groups),
                                          .by_areas = sunder_i_calloc(model->bodies, sizeof *parts->by_areas)};
    if (!parts->root || !parts->by_pairs || !parts->by_trees || !parts->by_groups || !parts->by_areas)
        return sunder_i_failure_cause(err);
    sunder_i_union_init(parts->root, model->bodies);
    join_pairs(model, report, parts->root);
    for (size_t k = 0; k < solver->groups.n; k++)
        if (solver->groups.group[k].bound > 0) join_group(model, &solver->groups.group[k], parts->root);
    for (size_t k = 0; k < solver->groups.n; k++) {
        const sunder_i_group *g = &solver->groups.group[k];
        if (!(g->bound > 0)) continue;
        double *sum = &parts->by_groups[sunder_i_union_find(parts->root, g->number)];
        *sum = *sum > 0 ? nextafter(*sum + g->bound, -INFINITY) : g->bound;
    }
    if (!sunder_i_bound_parts(model, report->bound_pair, report->bound_pairs, parts->root, parts->by_pairs))
        return sunder_i_failure_cause(err);
    memcpy(parts->by_trees, parts->by_pairs, model->bodies * sizeof *parts->by_trees);
    return SUNDER_OK;
}

void sunder_i_independent_parts_free(sunder_i_independent_parts *parts)
{
    sunder_i_free_all(parts->root, parts->by_pairs, parts->by_trees, parts->by_groups, parts->by_areas);
    for (size_t k = 0; k < parts->areas; k++) {
        sunder_i_free_all(parts->area[k].body, parts->area[k].prices.price);
    }
    sunder_i_free(parts->area);
    memset(parts, 0, sizeof *parts);
}

bool sunder_i_independent_part_wants_pair_trees(const sunder_i_independent_parts *parts, uint32_t body)
{
    const uint32_t at = sunder_i_union_find(parts->root, body);
    return parts->by_areas[at] == 0 && parts->by_pairs[at] * (1 - TREES_SHORT) > parts->by_groups[at];
}

bool sunder_i_independent_part_is_by_pairs(const sunder_i_independent_parts *parts, uint32_t body)
{
    const uint32_t at = sunder_i_union_find(parts->root, body);
    return parts->by_areas[at] == 0 && parts->by_trees[at] > parts->by_groups[at];
}

bool sunder_i_independent_part_is_by_groups(const sunder_i_independent_parts *parts, uint32_t body)
{
    const uint32_t at = sunder_i_union_find(parts->root, body);
    return parts->by_areas[at] == 0 && parts->by_groups[at] >= parts->by_trees[at];
}

double sunder_i_independent_part_bound(const sunder_i_independent_parts *parts, uint32_t body)
{
    const double by_area = parts->by_areas[body];
    const double most =
        by_area < 0 ? 0 : sunder_i_max(sunder_i_max(parts->by_trees[body], parts->by_groups[body]), by_area);
    return most > 0 && isfinite(most) ? most : 0;
}
