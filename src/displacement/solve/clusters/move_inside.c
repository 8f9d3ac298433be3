/* Pairs that limits cannot separate, where one may go inside the other: it is sent there, and from then on kept there
 * like a feature that lay in it at the start (inclusion.c). If that fails it is released, and the pair becomes one like
 * any other. */
#include "displacement/layer/rounding.h"
#include "displacement/solve/clusters/cluster_stages.h"

#include <math.h>

/* Moves the inner body as far as its limit allows, and the holder towards it for the rest. */
static void send_inside(sunder_i_solver *s, const sunder_i_entry *e)
{
    const sunder_i_model *model = &s->model;
    const uint32_t inner = model->body_of[e->a_inside ? e->a : e->b],
                   holder = model->body_of[e->a_inside ? e->b : e->a];
    const double sign = e->a_inside ? -1 : 1, length = hypot(e->place[0], e->place[1]);
    const double own = sunder_i_limit_of(&model->body[inner]), share = length > own ? own / length : 1;
    for (int k = 0; k < 2; k++) {
        const uint32_t b = k ? holder : inner;
        const double *move = model->move + 2 * (size_t)b, factor = k ? -(1 - share) : share;
        if (model->body[b].fixed || factor == 0 || move[0] != 0 || move[1] != 0) continue;
        double to[2];
        for (int c = 0; c < 2; c++) to[c] = sign * factor * e->place[c];
        sunder_i_round_move(model, b, to, to, NULL);
        sunder_i_solver_place(s, b, to);
    }
}

sunder_status sunder_i_solver_move_inside(sunder_i_solver *solver, sunder_error *err)
{
    if (solver->entries == 0) return SUNDER_OK;
    sunder_i_changes_clear(&solver->changes);
    for (size_t k = 0; k < solver->entries; k++) {
        const uint32_t i = solver->model.body_of[solver->entry[k].a], j = solver->model.body_of[solver->entry[k].b];
        send_inside(solver, &solver->entry[k]);
        if (!sunder_i_solver_add_edge(solver, i, j)) return sunder_i_failure_cause(err);
    }
    return sunder_i_solver_relate(solver, err);
}
