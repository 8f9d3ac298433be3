/* Moves between the layer and its clusters: where a cluster starts from, and what becomes of its result. Every move of
 * a body goes through sunder_i_solver_place(), which records what has to be related anew. */
#include "displacement/layer/rounding.h"
#include "displacement/solve/clusters/solver.h"

#include "base/parallel.h"

#include <string.h>

double *sunder_i_solver_load_moves(const sunder_i_solver *solver, const sunder_i_cluster *cluster)
{
    double *move = solver->move + 2 * (size_t)(cluster->body - solver->body);
    for (size_t k = 0; k < cluster->n; k++) {
        const uint32_t b = cluster->body[k], from = solver->carrier[b] == SUNDER_I_NOBODY ? b : solver->carrier[b];
        memcpy(move + 2 * k, solver->model.move + 2 * (size_t)from, 2 * sizeof *move);
    }
    return move;
}

static bool goes_elsewhere(const sunder_i_solver *s, uint32_t b, const double *to)
{
    return !s->model.body[b].fixed && memcmp(s->model.move + 2 * (size_t)b, to, 2 * sizeof *to) != 0;
}

/* Moves body b to `to`; exact: its coordinates need no rounding there. */
static void place_body(sunder_i_solver *s, uint32_t b, const double *to, bool exact)
{
    sunder_i_model *model = &s->model;
    const sunder_i_body *body = &model->body[b];
    memcpy(model->move + 2 * (size_t)b, to, 2 * sizeof *to);
    if (model->went) sunder_i_box_include(model->went + 4 * (size_t)b, to);
    sunder_i_body_event(&s->states, b, SUNDER_I_MOVES);
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        sunder_i_changes_add(&s->changes, f);
        model->inexact[f] = !exact;
    }
}

void sunder_i_solver_place(sunder_i_solver *solver, uint32_t b, const double *move)
{
    if (goes_elsewhere(solver, b, move)) place_body(solver, b, move, sunder_i_is_exact_move(&solver->model, b, move));
}

void sunder_i_solver_start_of(const sunder_i_solver *solver, uint32_t b, double start[2])
{
    sunder_i_round_move(&solver->model, b, sunder_i_preferred(&solver->model, b), start, NULL);
}

sunder_status sunder_i_solver_start_preferred(sunder_i_solver *solver, sunder_error *err)
{
    sunder_i_changes_clear(&solver->changes);
    for (uint32_t b = 0; b < solver->model.bodies; b++) {
        double start[2];
        sunder_i_solver_start_of(solver, b, start);
        sunder_i_solver_place(solver, b, start);
    }
    return sunder_i_solver_relate(solver, err);
}

typedef struct committing {
    const sunder_i_solver *solver;
    bool *exact; /* [members] does the new move need no rounding? for clusters that were worked on */
} committing;

static sunder_status find_some_exact(void *context, size_t begin, size_t end, sunder_error *err)
{
    (void)err;
    const committing *c = context;
    const sunder_i_solver *s = c->solver;
    for (size_t i = begin; i < end; i++) {
        const sunder_i_cluster *cluster = &s->cluster[i];
        const size_t first = (size_t)(cluster->body - s->body), after = first + cluster->n;
        for (size_t k = first; cluster->outcome != SUNDER_I_UNTOUCHED && k < after; k++)
            c->exact[k] = goes_elsewhere(s, s->body[k], s->move + 2 * k) &&
                          sunder_i_is_exact_move(&s->model, s->body[k], s->move + 2 * k);
    }
    return SUNDER_OK;
}

static void take_moves(sunder_i_solver *s, const sunder_i_cluster *c, const bool *exact)
{
    const size_t first = (size_t)(c->body - s->body);
    for (size_t k = first; k < first + c->n; k++)
        if (goes_elsewhere(s, s->body[k], s->move + 2 * k)) place_body(s, s->body[k], s->move + 2 * k, exact[k]);
}

sunder_status sunder_i_solver_commit(sunder_i_solver *solver, sunder_error *err)
{
    committing c = {solver, sunder_i_alloc(solver->members, sizeof *c.exact)};
    sunder_status status = c.exact ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status)
        status = sunder_i_parallel(solver->model.rules.threads, solver->clusters, SUNDER_I_GRAIN_LOOKS, find_some_exact,
                                   &c, err);
    sunder_i_changes_clear(&solver->changes);
    for (size_t i = 0; i < solver->clusters && !status; i++)
        if (solver->cluster[i].outcome != SUNDER_I_UNTOUCHED) take_moves(solver, &solver->cluster[i], c.exact);
    sunder_i_free(c.exact);
    return status;
}

sunder_status sunder_i_solver_relate(sunder_i_solver *solver, sunder_error *err)
{
    return sunder_i_solver_relate_near(solver, NULL, err);
}

sunder_status sunder_i_solver_relate_near(sunder_i_solver *solver, const sunder_i_list *things, sunder_error *err)
{
    if (!sunder_i_changes_sort(&solver->changes)) return sunder_i_failure_cause(err);
    sunder_status status = sunder_i_placement_move(&solver->model, &solver->placement, &solver->changes, err);
    if (status) return status;
    status = sunder_i_jumps_update(&solver->jumps, &solver->model, &solver->changes, err);
    if (status) return status;
    return sunder_i_placement_relate_again(&solver->model, &solver->placement, &solver->changes, things, &solver->now,
                                           err);
}
