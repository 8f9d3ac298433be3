/* Bodies with coarse moves are tried as fixed first.
 *
 * A move of a body is a multiple of the last place of its largest coordinate (../../layer/rounding.c). One corrupt
 * vertex, at 1e20, makes that 16384 m: moving such a body by the shortfall of a neighbour's gap throws it, and
 * everything that it runs into, kilometres away, and the margin for its last place throws the neighbour as far. So a
 * body is *held* if its last place is coarse beside a neighbour that it is in conflict with: beside how far the
 * neighbour may have to move, which is its size and the distance owed, and beside the neighbour's own last place. A
 * held body is fixed for all stages. If a conflict with one remains, it is released, and its cluster is solved once
 * more from the original places.
 *
 * Nothing is proved of a layout with held bodies: a contact group that has one keeps no bound, and the layer's bound
 * there is that of pairs, in which all bodies may move. */
#include "displacement/layer/resolution.h"
#include "displacement/solve/clusters/stages.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/extremes.h"
#include "base/union_find.h"

#include <math.h>

/* Exponent of the last place of the body's largest coordinate. */
static int last_place(const sunder_i_body *b)
{
    double largest = 0;
    int exponent;
    for (int c = 0; c < 4; c++) largest = sunder_i_max(largest, fabs(b->box[c] + b->origin[c & 1]));
    frexp(largest, &exponent);
    return exponent - 53;
}

static bool is_coarse_beside(const sunder_i_model *model, const sunder_i_body *b, const sunder_i_body *other)
{
    const int place = last_place(b);
    if (place < last_place(other) + COARSE_BITS) return false;
    const double size = sunder_i_max(other->box[2] - other->box[0], other->box[3] - other->box[1]);
    return ldexp(COARSE_PLACES, place) > size + model->rules.gap;
}

/* Has it stood still so far, and is it in no cluster? Then it can be held. */
static bool is_free_to_hold(const sunder_i_solver *s, uint32_t b)
{
    const double *t = s->model.move + 2 * (size_t)b;
    size_t n;
    sunder_i_solver_members(s, b, &n);
    return !s->let_go[b] && n == 0 && t[0] == 0 && t[1] == 0 && sunder_i_union_find(s->parent, b) == b;
}

/* Corners that are farther away than the nearest coarse coordinate are drawn in for the search: seen from the
 * neighbours their edges change by less than rounding, and products of such lengths are doubles. */
static void hold(sunder_i_solver *s, uint32_t b, const sunder_i_body *other)
{
    sunder_i_body *body = &s->model.body[b];
    const double size = sunder_i_max(other->box[2] - other->box[0], other->box[3] - other->box[1]);
    body->held = body->fixed = true;
    body->reach = sunder_i_min(body->reach, ldexp(size + s->model.rules.gap, 53) / COARSE_PLACES);
    for (int c = 0; c < 4; c++) body->box[c] = sunder_i_max(-body->reach, sunder_i_min(body->box[c], body->reach));
    sunder_i_pieces_forget(&s->model, 0);
}

void sunder_i_solver_hold(sunder_i_solver *solver, uint32_t i, uint32_t j)
{
    sunder_i_body *body = solver->model.body;
    if (!solver->let_go || body[i].fixed || body[j].fixed) return;
    for (int e = 0; e < 2; e++) {
        const uint32_t b = e ? j : i;
        if (is_coarse_beside(&solver->model, &body[b], &body[e ? i : j]) && is_free_to_hold(solver, b))
            hold(solver, b, &body[e ? i : j]);
    }
}

sunder_status sunder_i_solver_let_go(sunder_i_solver *solver, bool *any, sunder_error *err)
{
    sunder_i_model *model = &solver->model;
    bool *root = sunder_i_calloc(model->bodies, sizeof *root);
    *any = false;
    if (!root) return sunder_i_no_memory(err);
    for (size_t k = 0; k < solver->now.n; k++) {
        const sunder_i_relation *r = &solver->now.pair[k];
        const uint32_t pair[2] = {model->body_of[r->a], model->body_of[r->b]};
        if (!sunder_i_is_conflict_of_bodies(model, r)) continue;
        for (int e = 0; e < 2; e++) {
            sunder_i_body *body = &model->body[pair[e]];
            if (!body->held && !solver->let_go[pair[e]]) continue;
            *any = *any || body->held;
            if (body->held) body->held = body->fixed = false;
            solver->let_go[pair[e]] = root[sunder_i_union_find(solver->parent, pair[0])] =
                root[sunder_i_union_find(solver->parent, pair[1])] = true;
        }
    }
    sunder_status status = SUNDER_OK;
    if (*any) {
        for (uint32_t b = 0; b < model->bodies; b++) {
            solver->wanted[b] = !model->body[b].fixed && root[sunder_i_union_find(solver->parent, b)];
            solver->reconsidered[b] = solver->reconsidered[b] && !solver->wanted[b];
        }
        status = sunder_i_solver_begin_again(solver, solver->wanted, err);
    }
    sunder_i_free(root);
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
