/* Bodies with coarse moves are tried as fixed first.
 *
 * A move of a body is a multiple of the last place of its largest coordinate (../../layer/rounding.c). One corrupt
 * vertex, at 1e20, makes that 16384 m: moving such a body by the shortfall of a neighbour's gap throws it, and
 * everything that it runs into, kilometres away, and the margin for its last place throws the neighbour as far. So a
 * body is *held*, which is fixed for all stages, beside a neighbour in conflict with it that has a much finer last
 * place, if one of these holds:
 *
 *     its last place is coarse beside how far the neighbour may have to move, which is its size and the distance owed
 *     it has far corners (../../layer/far_corners.h), or a coordinate beyond any on the Earth: its moves may be of use,
 *     but its neighbours share its margin
 *
 * If a conflict with a held body remains, or it is not coarse beside any neighbour, it is released, and its cluster is
 * solved once more from the original places. The better of the two layouts is taken (held_or_free.c).
 *
 * Nothing is proved of a layout with held bodies: a contact group that has one keeps no bound, and the layer's bound
 * there is that of pairs, in which all bodies may move. */
#include "displacement/layer/far_corners.h"
#include "displacement/layer/resolution.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/extremes.h"
#include "base/union_find.h"

#include <limits.h>
#include <math.h>

/* The exponent of the last place of the largest of the four coordinates. */
static int last_place(const double box[4])
{
    double largest = 0;
    int exponent;
    for (int c = 0; c < 4; c++) largest = sunder_i_max(largest, fabs(box[c]));
    frexp(largest, &exponent);
    return exponent - 53;
}

/* Does the last place belong to a coordinate beyond any on the Earth? */
static bool is_beyond(int place) { return place > BEYOND_EXPONENT - 53; }

/* ---- Holding ----------------------------------------------------------------------------------------------------- */

/* The length of moves that the body may need: its size plus the gap. */
static double stretch_of(const sunder_i_solver *solver, const double box[4])
{
    return sunder_i_max(box[2] - box[0], box[3] - box[1]) + solver->model.rules.gap;
}

/* A body can be held if it has not moved and is in no cluster. */
static bool is_free_to_hold(const sunder_i_solver *solver, uint32_t b)
{
    const double *t = solver->model.move + 2 * (size_t)b;
    size_t n;
    if (!solver->parent) return true; /* there are no clusters yet */
    sunder_i_solver_members(solver, b, &n);
    return sunder_i_is_in(solver, SUNDER_I_HOLDING, b, SUNDER_I_NOT_HELD) && n == 0 && t[0] == 0 && t[1] == 0 &&
           sunder_i_union_find(solver->parent, b) == b;
}

/* Fixes the body. Unless all its corners are far, corners beyond the nearest coarse coordinate are drawn in for the
 * search, so that doubles can represent products of lengths. */
static void fix_body(sunder_i_solver *solver, sunder_i_body *body, double stretch)
{
    body->held = body->fixed = true;
    if (body->far) return;
    body->reach = sunder_i_min(body->reach, ldexp(stretch, 53) / COARSE_PLACES);
    for (int c = 0; c < 4; c++) body->box[c] = sunder_i_max(-body->reach, sunder_i_min(body->box[c], body->reach));
    if (solver->parent) sunder_i_pieces_forget(&solver->model, 0);
}

static void hold_beside(sunder_i_solver *solver, uint32_t b, uint32_t neighbour)
{
    sunder_i_body *body = &solver->model.body[b];
    const sunder_i_body *other = &solver->model.body[neighbour];
    double box[4], beside[4];
    if ((body->fixed && !body->held) || (other->fixed && !other->held)) return;
    sunder_i_body_home_box(&solver->model, body, box);
    sunder_i_body_home_box(&solver->model, other, beside);
    const int coarser = last_place(box) - last_place(beside);
    const double stretch = stretch_of(solver, beside);
    const bool coarse = coarser >= COARSE_BITS && ldexp(COARSE_PLACES, last_place(box)) > stretch,
               beyond = coarser >= BEYOND_BITS && is_beyond(last_place(box)),
               far = coarser >= COARSE_BITS && body->far;
    if (!body->held && (coarse || beyond || far) && is_free_to_hold(solver, b)) {
        fix_body(solver, body, stretch);
        sunder_i_body_event(&solver->states, b, SUNDER_I_IS_HELD);
    }
    if (body->held && coarse) sunder_i_body_event(&solver->states, b, SUNDER_I_IS_HELD_AS_COARSE);
}

static void hold_coarse_bodies(sunder_i_solver *solver, const sunder_i_relations *relations)
{
    for (size_t k = 0; k < relations->n; k++) {
        const sunder_i_relation *r = &relations->pair[k];
        const uint32_t i = solver->model.body_of[r->a], j = solver->model.body_of[r->b];
        const bool aside = sunder_i_is_aside(solver, i) || sunder_i_is_aside(solver, j);
        if (!sunder_i_is_open_conflict(&solver->model, r) || aside) continue;
        hold_beside(solver, i, j);
        hold_beside(solver, j, i);
    }
}

/* Do the last places of two bodies that are not fixed differ so much that one may be held beside the other? */
static bool may_hold(const sunder_i_model *model)
{
    int finest = INT_MAX, coarsest = INT_MIN;
    for (size_t b = 0; b < model->bodies; b++) {
        double box[4];
        sunder_i_body_home_box(model, &model->body[b], box);
        if (model->body[b].fixed || box[0] > box[2]) continue;
        const int place = last_place(box);
        finest = place < finest ? place : finest;
        coarsest = place > coarsest ? place : coarsest;
    }
    return finest < coarsest && coarsest - finest >= (is_beyond(coarsest) ? BEYOND_BITS : COARSE_BITS);
}

sunder_status sunder_i_solver_begin_holding(sunder_i_solver *solver, sunder_error *err)
{
    if (!may_hold(&solver->model)) return SUNDER_OK;
    if (!sunder_i_body_states_init(&solver->states, solver->model.bodies)) return sunder_i_failure_cause(err);
    solver->may_hold = true;
    for (size_t b = 0; b < solver->model.bodies; b++) sunder_i_find_far_corners(&solver->model, &solver->model.body[b]);
    hold_coarse_bodies(solver, &solver->start);
    return SUNDER_OK;
}

void sunder_i_solver_hold_coarse(sunder_i_solver *solver)
{
    if (solver->may_hold) hold_coarse_bodies(solver, &solver->now);
}

bool sunder_i_solver_any_held(const sunder_i_solver *solver)
{
    for (size_t b = 0; solver->may_hold && b < solver->model.bodies; b++)
        if (solver->model.body[b].held) return true;
    return false;
}

/* ---- Letting go -------------------------------------------------------------------------------------------------- */

static bool was_let_go(const sunder_i_solver *solver, uint32_t b)
{
    return sunder_i_is_in(solver, SUNDER_I_HOLDING, b, SUNDER_I_LET_GO);
}

/* Releases the held bodies that are in conflict, and those whose moves may be of use. Returns whether there are any. */
static bool mark_let_go(sunder_i_solver *solver)
{
    const sunder_i_model *model = &solver->model;
    bool any = false;
    for (uint32_t b = 0; b < model->bodies; b++)
        if (sunder_i_is_in(solver, SUNDER_I_HOLDING, b, SUNDER_I_HELD))
            sunder_i_body_event(&solver->states, b, SUNDER_I_IS_LET_GO);
    for (size_t k = 0; k < solver->now.n; k++) {
        const sunder_i_relation *r = &solver->now.pair[k];
        if (!sunder_i_is_conflict_of_bodies(model, r)) continue;
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        if (model->body[i].held) sunder_i_body_event(&solver->states, i, SUNDER_I_IS_LET_GO);
        if (model->body[j].held) sunder_i_body_event(&solver->states, j, SUNDER_I_IS_LET_GO);
    }
    for (uint32_t b = 0; b < model->bodies; b++) any = any || was_let_go(solver, b);
    return any;
}

/* Sets root[] for the clusters of released bodies and for all clusters with an edge to one. */
static void mark_roots(sunder_i_solver *solver, bool *root)
{
    for (uint32_t b = 0; b < solver->model.bodies; b++)
        if (was_let_go(solver, b)) root[sunder_i_union_find(solver->parent, b)] = true;
    for (size_t k = 0; k < solver->edges; k++) {
        const uint32_t i = solver->edge[k].a, j = solver->edge[k].b;
        if (was_let_go(solver, i) || was_let_go(solver, j))
            root[sunder_i_union_find(solver->parent, i)] = root[sunder_i_union_find(solver->parent, j)] = true;
    }
}

/* Keeps the pairs that were proved infeasible at the start, in solver->waiting, except those with a released body.
 * False if memory is out. */
static bool keep_infeasible(sunder_i_solver *solver)
{
    const sunder_i_model *model = &solver->model;
    bool ok = true;
    for (size_t k = 0; k < model->relaxations.n && ok; k++) {
        const sunder_i_relaxation *t = &model->relaxations.item[k];
        const uint32_t i = model->body_of[t->a], j = model->body_of[t->b];
        if (t->infeasible && (sunder_i_is_wanted(solver, i) || sunder_i_is_wanted(solver, j)) &&
            !was_let_go(solver, i) && !was_let_go(solver, j))
            ok = sunder_i_relaxations_add(&solver->waiting, t);
    }
    return ok;
}

sunder_status sunder_i_solver_let_go(sunder_i_solver *solver, sunder_error *err)
{
    sunder_i_model *model = &solver->model;
    solver->any_let_go = mark_let_go(solver);
    if (!solver->any_let_go) return SUNDER_OK;
    bool *root = sunder_i_calloc(model->bodies, sizeof *root), *back = sunder_i_calloc(model->bodies, sizeof *back);
    sunder_status status = root && back ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) mark_roots(solver, root);
    for (uint32_t b = 0; b < model->bodies && !status; b++) {
        sunder_i_body *body = &model->body[b];
        if (was_let_go(solver, b)) body->held = body->fixed = false;
        back[b] = !body->fixed && root[sunder_i_union_find(solver->parent, b)];
        sunder_i_body_event(&solver->states, b, back[b] ? SUNDER_I_BEGINS_AGAIN_FREED : SUNDER_I_IS_LEFT);
    }
    if (!status && !keep_infeasible(solver)) status = sunder_i_failure_cause(err);
    if (!status) status = sunder_i_solver_begin_again(solver, back, err);
    sunder_i_free_all(root, back);
    return status;
}

void sunder_i_solver_end_holding(sunder_i_solver *solver)
{
    for (size_t k = 0; k < solver->groups.n; k++) {
        sunder_i_group *g = &solver->groups.group[k];
        for (size_t m = 0; m < g->n + g->guests.n; m++)
            if (solver->model.body[m < g->n ? g->body[m] : g->guests.item[m - g->n]].held) g->bound = 0;
    }
    for (size_t b = 0; b < solver->model.bodies; b++)
        if (solver->model.body[b].held) solver->model.body[b].fixed = false;
}
