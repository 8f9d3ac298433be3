/* Moves on their way between the layer and its clusters: where a cluster starts from, and what becomes of what it
 * found. Every move of a body goes through sunder_i_solver_place(), which notes what has to be related anew. */
#include "displacement/clusters/solver.h"
#include "displacement/layer/rounding.h"

#include <string.h>

double *sunder_i_solver_load_moves(const sunder_i_solver *s, const sunder_i_cluster *c)
{
    double *move = s->move + 2 * (size_t)(c->body - s->body);
    for (size_t k = 0; k < c->n; k++) {
        const uint32_t b = c->body[k], from = s->carrier[b] == SUNDER_I_NOBODY ? b : s->carrier[b];
        memcpy(move + 2 * k, s->model.move + 2 * (size_t)from, 2 * sizeof *move);
    }
    return move;
}

void sunder_i_solver_place(sunder_i_solver *s, uint32_t b, const double *to)
{
    sunder_i_model *model = &s->model;
    const sunder_i_body *body = &model->body[b];
    double *move = model->move + 2 * (size_t)b;
    if (body->fixed || memcmp(move, to, 2 * sizeof *move) == 0) return;
    memcpy(move, to, 2 * sizeof *move);
    if (model->went) sunder_i_box_include(model->went + 4 * (size_t)b, to);
    s->cheapest[b] = false;
    const bool exact = sunder_i_is_exact_move(model, b, move);
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        sunder_i_changes_add(&s->changes, f);
        model->inexact[f] = !exact;
    }
}

void sunder_i_solver_commit(sunder_i_solver *s)
{
    sunder_i_changes_clear(&s->changes);
    for (size_t k = 0; k < s->members; k++) sunder_i_solver_place(s, s->body[k], s->move + 2 * k);
}

sunder_status sunder_i_solver_relate(sunder_i_solver *s, sunder_error *err)
{
    if (!sunder_i_changes_sort(&s->changes)) return sunder_i_no_memory(err);
    sunder_status status = sunder_i_placement_move(&s->model, &s->placement, &s->changes, err);
    if (status) return status;
    status = sunder_i_jumps_update(&s->jumps, &s->model, &s->changes, err);
    return status ? status : sunder_i_placement_relate_again(&s->model, &s->placement, &s->changes, &s->now, err);
}
