/* A feature that lies in two features that have to part, and may overlap both, is kept in one of them;
 * layer/inclusion.c chooses in which. */
#include "displacement/layer/resolution.h"
#include "displacement/solve/clusters/cluster_stages.h"

/* Is one of the pair's bodies movable, and in a cluster for which better sides were looked for? Then the bodies keep
 * their positions and holders. */
static bool is_settled(const sunder_i_solver *s, const uint32_t pair[2])
{
    return sunder_i_solver_any_of(s, pair, 2, sunder_i_is_improved);
}

sunder_status sunder_i_solver_choose_holders(sunder_i_solver *solver, sunder_error *err)
{
    if (solver->model.inclusions == 0) return SUNDER_OK;
    bool *conflict = sunder_i_calloc(solver->start.n, sizeof *conflict);
    if (!conflict) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < solver->start.n; k++) {
        const uint32_t pair[2] = {solver->model.body_of[solver->start.pair[k].a],
                                  solver->model.body_of[solver->start.pair[k].b]};
        conflict[k] = sunder_i_solver_any_of(solver, pair, 2, sunder_i_is_wanted) && !is_settled(solver, pair) &&
                      sunder_i_is_open_conflict(&solver->model, &solver->start.pair[k]);
    }
    const sunder_status status = sunder_i_inclusions_choose(&solver->model, &solver->start, conflict, err);
    sunder_i_free(conflict);
    return status;
}
