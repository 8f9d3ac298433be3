/* A layout with held bodies, kept beside the one that is found where these may move: the better of the two is taken,
 * cluster by cluster.
 *
 * A cluster here is a component of bodies connected by edges or conflicts in either layout. Its better layout is the
 * one with fewer pairs in conflict; if both have as many, the cheaper one; if both cost the same, the one with held
 * bodies. The layout without held bodies is not taken, whatever it resolves, if it throws a body that was never held:
 * moves it farther by many times its size, as the margin of a coarse neighbour does. Nor is it taken if it bends a body
 * that was held: moves its near corners, while the far ones are rounded back. So what stands beside a corrupt vertex
 * costs no more than beside the same feature fixed, unless that leaves more conflicts; and it is never thrown. */
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/extremes.h"
#include "base/union_find.h"

#include <math.h>
#include <string.h>

void sunder_i_held_layout_free(sunder_i_held_layout *layout)
{
    sunder_i_free_all(layout->move, layout->held, layout->widened, layout->improved, layout->edge, layout->conflict,
                      layout->given_up, layout->state);
    sunder_i_relaxations_free(&layout->relaxations);
    memset(layout, 0, sizeof *layout);
}

/* ---- Kept -------------------------------------------------------------------------------------------------------- */

/* Returns a copy of n items; NULL if memory is out. */
static void *copy_items(const void *from, size_t n, size_t size)
{
    void *to = sunder_i_alloc(n, size);
    if (to && n) memcpy(to, from, n * size);
    return to;
}

/* Lists the two bodies of each pair of features in conflict. NULL if memory is out. */
static sunder_i_id_pair *list_conflicts(const sunder_i_solver *solver, size_t *n)
{
    sunder_i_id_pair *list = sunder_i_alloc(solver->now.n, sizeof *list);
    *n = 0;
    for (size_t k = 0; k < solver->now.n && list; k++) {
        const sunder_i_relation *r = &solver->now.pair[k];
        if (sunder_i_is_conflict_of_bodies(&solver->model, r))
            list[(*n)++] = (sunder_i_id_pair){solver->model.body_of[r->a], solver->model.body_of[r->b]};
    }
    return list;
}

static bool keep_states(const sunder_i_model *model, sunder_i_held_layout *layout)
{
    layout->state = sunder_i_alloc(model->inclusions, sizeof *layout->state);
    for (size_t k = 0; k < model->inclusions && layout->state; k++) layout->state[k] = model->inclusion[k].state;
    return layout->state != NULL;
}

sunder_status sunder_i_solver_keep_held(sunder_i_solver *solver, sunder_error *err)
{
    const sunder_i_model *model = &solver->model;
    sunder_i_held_layout *layout = solver->held_layout;
    const size_t n = model->bodies;
    layout->move = copy_items(model->move, 2 * n, sizeof *layout->move);
    layout->held = sunder_i_alloc(n, sizeof *layout->held);
    layout->widened = copy_items(solver->widened, n, sizeof *layout->widened);
    layout->improved = sunder_i_alloc(n, sizeof *layout->improved);
    layout->edge = copy_items(solver->edge, solver->edges, sizeof *layout->edge);
    layout->edges = solver->edges;
    layout->conflict = list_conflicts(solver, &layout->conflicts);
    layout->given_up = copy_items(model->given_up, model->given_up_n, sizeof *layout->given_up);
    layout->given_up_n = model->given_up_n;
    bool ok = layout->move && layout->held && layout->widened && layout->improved && layout->edge && layout->conflict &&
              layout->given_up && keep_states(model, layout);
    for (uint32_t b = 0; b < n && ok; b++) {
        layout->held[b] = model->body[b].held;
        layout->improved[b] = sunder_i_is_improved(solver, b);
    }
    for (size_t k = 0; k < model->relaxations.n && ok; k++)
        ok = sunder_i_relaxations_add(&layout->relaxations, &model->relaxations.item[k]);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* ---- Compared ---------------------------------------------------------------------------------------------------- */

typedef struct tally {
    size_t held_conflicts, free_conflicts;
    double held_cost, free_cost;
    bool was_held; /* one of its bodies was held, and is free now */
    bool breaks;   /* a body that was not held is thrown now, or a body that was held is bent */
} tally;

typedef struct comparing {
    const sunder_i_solver *solver;
    const sunder_i_held_layout *held;
    uint32_t *root; /* [bodies] union-find */
    tally *of;      /* [bodies] by roots */
} comparing;

static void join_pairs(const comparing *c, const sunder_i_id_pair *pair, size_t n)
{
    const sunder_i_body *body = c->solver->model.body;
    for (size_t k = 0; k < n; k++)
        if (!body[pair[k].a].fixed && !body[pair[k].b].fixed) sunder_i_union_join(c->root, pair[k].a, pair[k].b);
}

static tally *tally_of(const comparing *c, const sunder_i_id_pair *pair)
{
    return &c->of[sunder_i_union_find(c->root, c->solver->model.body[pair->a].fixed ? pair->b : pair->a)];
}

static bool is_thrown(const comparing *c, uint32_t b)
{
    const sunder_i_model *model = &c->solver->model;
    const sunder_i_body *body = &model->body[b];
    const double *now = model->move + 2 * (size_t)b, *then = c->held->move + 2 * (size_t)b,
                 size = sunder_i_max(body->box[2] - body->box[0], body->box[3] - body->box[1]);
    return !c->held->held[b] && hypot(now[0], now[1]) > hypot(then[0], then[1]) + THROWN * (size + model->rules.gap);
}

static bool is_bent(const comparing *c, uint32_t b)
{
    const sunder_i_model *model = &c->solver->model;
    const sunder_i_body *body = &model->body[b];
    for (uint32_t m = 0; m < body->members && c->held->held[b]; m++)
        if (model->inexact[model->member[body->member + m]]) return true;
    return false;
}

static void compare_layouts(const comparing *c, const sunder_i_id_pair *now, size_t n)
{
    const sunder_i_model *model = &c->solver->model;
    join_pairs(c, c->solver->edge, c->solver->edges);
    join_pairs(c, c->held->edge, c->held->edges);
    join_pairs(c, now, n);
    join_pairs(c, c->held->conflict, c->held->conflicts);
    for (size_t k = 0; k < n; k++) tally_of(c, &now[k])->free_conflicts++;
    for (size_t k = 0; k < c->held->conflicts; k++) tally_of(c, &c->held->conflict[k])->held_conflicts++;
    for (uint32_t b = 0; b < model->bodies; b++) {
        const sunder_i_body *body = &model->body[b];
        tally *of = &c->of[sunder_i_union_find(c->root, b)];
        if (body->fixed) continue;
        of->held_cost += sunder_i_move_cost(model, b, c->held->move + 2 * (size_t)b);
        of->free_cost += sunder_i_move_cost(model, b, model->move + 2 * (size_t)b);
        of->was_held = of->was_held || c->held->held[b];
        of->breaks = of->breaks || is_thrown(c, b) || is_bent(c, b);
    }
}

static bool is_held_better(const tally *t)
{
    if (!t->was_held) return false;
    if (t->breaks) return true;
    if (t->held_conflicts != t->free_conflicts) return t->held_conflicts < t->free_conflicts;
    return !(t->free_cost < t->held_cost);
}

/* Finds the clusters whose result was better while some bodies were held. back[b] is set for each of their bodies
 * that can move; *any tells whether there is one. */
static bool find_better_held(const sunder_i_solver *solver, const sunder_i_held_layout *layout, bool *back, bool *any)
{
    const size_t bodies = solver->model.bodies;
    size_t n;
    comparing c = {solver, layout, sunder_i_alloc(bodies, sizeof *c.root), sunder_i_calloc(bodies, sizeof *c.of)};
    sunder_i_id_pair *now = list_conflicts(solver, &n);
    const bool ok = c.root && c.of && now;
    *any = false;
    if (ok) {
        sunder_i_union_init(c.root, bodies);
        compare_layouts(&c, now, n);
        for (uint32_t b = 0; b < bodies; b++) {
            back[b] = !solver->model.body[b].fixed && is_held_better(&c.of[sunder_i_union_find(c.root, b)]);
            *any = *any || back[b];
        }
    }
    sunder_i_free_all(now, c.root, c.of);
    return ok;
}

/* ---- Taken back -------------------------------------------------------------------------------------------------- */

static void put_back_moves(sunder_i_solver *solver, const sunder_i_held_layout *layout, const bool *back)
{
    sunder_i_model *model = &solver->model;
    sunder_i_changes_clear(&solver->changes);
    for (uint32_t b = 0; b < model->bodies; b++) {
        if (!back[b]) continue;
        sunder_i_solver_place(solver, b, layout->move + 2 * (size_t)b);
        if (layout->held[b]) {
            sunder_i_body_event(&solver->states, b, SUNDER_I_IS_HELD_AGAIN);
            model->body[b].held = model->body[b].fixed = true;
        }
        solver->widened[b] = layout->widened[b];
        if (layout->improved[b]) sunder_i_body_event(&solver->states, b, SUNDER_I_IS_IMPROVED);
    }
    for (size_t k = 0; k < model->inclusions; k++)
        if (back[model->body_of[model->inclusion[k].a]] || back[model->body_of[model->inclusion[k].b]])
            model->inclusion[k].state = layout->state[k];
}

/* Puts back edges, relaxations and given-up pairs. False if memory is out. */
static bool put_back_pairs(sunder_i_solver *solver, const sunder_i_held_layout *layout, const bool *back)
{
    sunder_i_model *model = &solver->model;
    bool ok = true;
    for (size_t k = 0; k < layout->edges && ok; k++)
        if (back[layout->edge[k].a] || back[layout->edge[k].b])
            ok = sunder_i_solver_add_edge(solver, layout->edge[k].a, layout->edge[k].b);
    for (size_t k = 0; k < layout->relaxations.n && ok; k++) {
        const sunder_i_relaxation *t = &layout->relaxations.item[k];
        if (back[model->body_of[t->a]] || back[model->body_of[t->b]])
            ok = sunder_i_relaxations_add(&model->relaxations, t);
    }
    sunder_i_id_pair *list = sunder_i_realloc(model->given_up, model->given_up_n + layout->given_up_n, sizeof *list);
    if (!list) return false;
    model->given_up = list;
    for (size_t k = 0; k < layout->given_up_n; k++)
        if (back[layout->given_up[k].a] || back[layout->given_up[k].b]) list[model->given_up_n++] = layout->given_up[k];
    sunder_i_sort_given_up(model);
    return ok && sunder_i_relaxations_index(&model->relaxations, model);
}

sunder_status sunder_i_solver_take_better(sunder_i_solver *solver, sunder_error *err)
{
    const sunder_i_held_layout *layout = solver->held_layout;
    bool *back = sunder_i_calloc(solver->model.bodies, sizeof *back), any = false;
    sunder_status status =
        back && find_better_held(solver, layout, back, &any) ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status && any) {
        status = sunder_i_solver_begin_again(solver, back, err);
        if (!status) put_back_moves(solver, layout, back);
        if (!status && !put_back_pairs(solver, layout, back)) status = sunder_i_failure_cause(err);
        if (!status) status = sunder_i_solver_relate(solver, err);
        if (!status) status = sunder_i_solver_gather(solver, err);
    }
    sunder_i_free(back);
    return status;
}
