/* Finds which bodies influenced each other. Two did if they were ever solved together, if they were in conflict or in
 * contact, if a proof names both, or if a place was examined for one where the other ever was. The places examined are
 * recorded as boxes (layer/reads.h). A block is always read as a whole, whichever member was met, because its other end
 * may be fixed.
 *
 * If features may be hidden or become smaller, a layer is laid out several times. Each layout is determined by the
 * levels of features, and the levels by the conflicts of the layouts before; so influences of all layouts count. A
 * feature that may get another level counts as one that moves, even if it is fixed: it may not be there. */
#include "displacement/report/influence.h"

#include "displacement/layer/resolution.h"

#include "base/union_find.h"

#include <string.h>

/* The relative tolerance by which contact may exceed the required distance. */
#define HAIR 0x1p-16

static bool begin(sunder_i_influence *g, const sunder_i_model *model)
{
    const size_t n = model->bodies;
    if (g->root) return true;
    *g = (sunder_i_influence){.bodies = n,
                              .root = sunder_i_alloc(n, sizeof *g->root),
                              .active = sunder_i_calloc(n, sizeof *g->active),
                              .fixed = sunder_i_alloc(n, sizeof *g->fixed),
                              .lowers = sunder_i_calloc(n, sizeof *g->lowers),
                              .read = sunder_i_alloc(n, sizeof *g->read),
                              .seen = sunder_i_alloc(n, sizeof *g->seen),
                              .wrote = sunder_i_alloc(n, sizeof *g->wrote)};
    if (!g->root || !g->active || !g->fixed || !g->lowers || !g->read || !g->seen || !g->wrote) return false;
    sunder_i_union_init(g->root, n);
    for (size_t b = 0; b < n; b++) {
        g->fixed[b] = model->body[b].fixed;
        sunder_i_box_clear(g->read[b]);
        sunder_i_box_clear(g->seen[b]);
        sunder_i_box_clear(g->wrote[b]);
    }
    return true;
}

void sunder_i_influence_free(sunder_i_influence *influence)
{
    sunder_i_free_all(influence->root, influence->active, influence->fixed, influence->lowers, influence->read,
                      influence->seen, influence->wrote);
    memset(influence, 0, sizeof *influence);
}

/* ---- Who met ----------------------------------------------------------------------------------------------------- */

/* Computes the box of the places where the body stood, from its original to every later position. */
static void box_of(const sunder_i_model *model, uint32_t body, double box[4])
{
    const double *went = model->went + 4 * (size_t)body;
    sunder_i_body_home_box(model, &model->body[body], box);
    for (int c = 0; c < 4; c++) box[c] += went[c];
}

/* Records that bodies i and j influenced each other. A body that stands does not join two sets; but two such bodies in
 * conflict with each other belong to a world, too. */
static void meet_bodies(sunder_i_influence *g, const sunder_i_model *model, uint32_t i, uint32_t j)
{
    if (sunder_i_influence_stands(g, i) && !sunder_i_influence_stands(g, j)) {
        meet_bodies(g, model, j, i);
        return;
    }
    g->active[i] = true;
    if (sunder_i_is_barrier_body(model, &model->body[j])) return;
    if (sunder_i_influence_stands(g, j) && !sunder_i_influence_stands(g, i)) {
        /* Whether the block is fixed may depend on a member at its other end, so all of it is marked as seen. */
        double box[4];
        box_of(model, j, box);
        sunder_i_box_join(g->seen[i], box);
        return;
    }
    g->active[j] = true;
    sunder_i_union_join(g->root, i, j);
}

void sunder_i_influence_meet(sunder_i_influence *influence, const sunder_i_model *model, uint32_t a, uint32_t b)
{
    if (!sunder_i_is_barrier(model, a)) meet_bodies(influence, model, model->body_of[a], model->body_of[b]);
}

static void meet_conflicts(sunder_i_influence *g, const sunder_i_model *model, const sunder_i_relations *relations)
{
    for (size_t k = 0; k < relations->n; k++) {
        const sunder_i_relation *r = &relations->pair[k];
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        if (i != j && (sunder_i_is_conflict(r) || r->kept)) meet_bodies(g, model, i, j);
    }
}

static void meet_home_pairs(sunder_i_influence *g, const sunder_i_model *model, const sunder_report *report)
{
    for (size_t k = 0; k < report->home_pairs; k++) {
        const sunder_i_home_pair *p = &report->home_pair[k];
        const uint32_t i = model->body_of[p->a], j = model->body_of[p->b];
        if (p->fact == SUNDER_I_HOME_MET) meet_bodies(g, model, i, j);
    }
}

/* A pair of bodies that may not move is tight without ever having been solved. */
static void meet_tight(sunder_i_influence *g, const sunder_i_model *model, const sunder_report *report)
{
    for (size_t k = 0; k < report->conflicts; k++) {
        const sunder_conflict *c = &report->conflict[k];
        if (c->kind == SUNDER_CONFLICT_TIGHT) meet_bodies(g, model, model->body_of[c->a], model->body_of[c->b]);
    }
}

static void meet_groups(sunder_i_influence *g, const sunder_i_model *model, const sunder_i_groups *groups)
{
    for (size_t k = 0; k < groups->n; k++) {
        const sunder_i_group *group = &groups->group[k];
        for (size_t m = 0; m < group->n + group->guests.n; m++) {
            const uint32_t b = m < group->n ? group->body[m] : group->guests.item[m - group->n];
            if (!model->body[b].fixed) meet_bodies(g, model, group->number, b);
        }
    }
    for (size_t k = 0; k < groups->joins; k++) meet_bodies(g, model, groups->joined[k].a, groups->joined[k].b);
}

/* ---- Where bodies looked, and where they stood ------------------------------------------------------------------- */

/* Adds to what the body read: its neighbours in rows as they stand, and the place that decides which ones they are. */
static void look_along_rows(sunder_i_influence *g, const sunder_i_solver *solver, uint32_t b)
{
    const sunder_i_model *model = &solver->model;
    const sunder_i_extras *has = model->body[b].has;
    if (solver->rows.reach) sunder_i_box_join(g->seen[b], solver->rows.reach[b]);
    for (uint32_t k = has->row_side; k < has->row_side + has->row_sides && !model->body[b].fixed; k++) {
        double box[4];
        box_of(model, model->row_side[k].other, box);
        sunder_i_box_join(g->read[b], box);
    }
}

double sunder_i_contact_reach(const sunder_i_rules *rules)
{
    return (rules->full_gap + rules->tolerance + rules->thin) * (1 + HAIR);
}

static void look_about(sunder_i_influence *g, const sunder_i_solver *solver, uint32_t b)
{
    const sunder_i_model *model = &solver->model;
    const double reach = sunder_i_contact_reach(&model->rules);
    double box[4], about[4];
    box_of(model, b, box);
    sunder_i_box_grow(box, reach, about);
    if (!sunder_i_influence_stands(g, b)) sunder_i_box_join(g->wrote[b], box);
    sunder_i_box_join(g->read[b], about);
    sunder_i_box_join(g->read[b], model->read[b].place);
    sunder_i_box_join(g->seen[b], model->read[b].seen);
    look_along_rows(g, solver, b);
}

sunder_status sunder_i_influence_add(sunder_i_influence *influence, const sunder_i_solver *solver,
                                     const sunder_report *report, sunder_error *err)
{
    const sunder_i_model *model = &solver->model;
    if (!begin(influence, model)) return sunder_i_failure_cause(err);
    for (size_t e = 0; e < solver->edges; e++) meet_bodies(influence, model, solver->edge[e].a, solver->edge[e].b);
    meet_home_pairs(influence, model, report);
    meet_conflicts(influence, model, &solver->start);
    meet_conflicts(influence, model, &solver->now);
    meet_tight(influence, model, report);
    meet_groups(influence, model, &solver->groups);
    for (uint32_t b = 0; b < model->bodies; b++) look_about(influence, solver, b);
    return SUNDER_OK;
}

/* ---- Features that may have other levels ------------------------------------------------------------------------- */

void sunder_i_influence_lower(sunder_i_influence *influence, const sunder_i_model *model, uint32_t feature)
{
    const uint32_t b = model->body_of[feature];
    const sunder_i_body *body = &model->body[b];
    if (influence->lowers[b]) return;
    influence->active[b] = influence->lowers[b] = true;
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        const sunder_feature given = sunder_i_feature(model->layer, f);
        double box[4];
        if (!sunder_i_is_present(&given)) continue;
        sunder_shape_box(sunder_i_given_shape(model, f), box);
        sunder_i_box_join(influence->wrote[b], box);
    }
}

void sunder_i_influence_place(sunder_i_influence *influence, const sunder_i_model *model, uint32_t feature,
                              const double place[4], const double read[4])
{
    const uint32_t b = model->body_of[feature];
    sunder_i_box_join(influence->wrote[b], place);
    sunder_i_box_join(influence->read[b], read);
}

/* ---- Sets -------------------------------------------------------------------------------------------------------- */

static bool is_root(const sunder_i_influence *g, uint32_t b) { return g->active[b] && g->root[b] == b; }

/* Joins two sets in world[] if one read where the other stood. */
static sunder_status meet_readers(const sunder_i_influence *g, uint32_t *world, sunder_error *err)
{
    bool *there = sunder_i_calloc(g->bodies, sizeof *there);
    sunder_i_rtree tree = {0};
    sunder_i_list hits = {0};
    sunder_status status = there ? SUNDER_OK : sunder_i_failure_cause(err);
    for (uint32_t b = 0; b < g->bodies && !status; b++) there[b] = is_root(g, b) && g->wrote[b][0] <= g->wrote[b][2];
    if (!status) status = sunder_i_rtree_build(g->wrote[0], there, g->bodies, &tree, err);
    for (uint32_t b = 0; b < g->bodies && !status; b++) {
        if (!there[b]) continue;
        hits.n = 0;
        if (!sunder_i_rtree_query(&tree, g->read[b], &hits)) status = sunder_i_failure_cause(err);
        for (size_t k = 0; k < hits.n && !status; k++) sunder_i_union_join(world, b, hits.item[k]);
    }
    sunder_i_rtree_free(&tree);
    sunder_i_free_all(hits.item, there);
    return status;
}

sunder_status sunder_i_influence_gather(sunder_i_influence *influence, uint32_t *world, sunder_error *err)
{
    sunder_i_influence *g = influence;
    for (uint32_t b = 0; b < g->bodies; b++) {
        const uint32_t at = sunder_i_union_find(g->root, b);
        world[b] = at;
        if (!g->active[b] || at == b) continue;
        sunder_i_box_join(g->read[at], g->read[b]);
        sunder_i_box_join(g->seen[at], g->seen[b]);
        sunder_i_box_join(g->wrote[at], g->wrote[b]);
    }
    return meet_readers(g, world, err);
}
