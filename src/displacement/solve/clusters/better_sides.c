/* Better sides, for the clusters that were solved since the last search: neighbours in the way join first, then each
 * cluster is improved by itself. Conflicts that this causes are left to the next round of settle.c. */
#include "displacement/solve/clusters/cluster_stages.h"

/* Are better sides to be looked for in the cluster? They are not if it is not wanted, or they were looked for, or its
 * layout is known to be the cheapest. If each of several clusters that merged was the cheapest, so is their union. */
static bool is_to_improve(const sunder_i_solver *s, const sunder_i_cluster *c)
{
    bool improved = true, cheapest = true;
    if (!sunder_i_solver_any_of(s, c->body, c->n, sunder_i_is_wanted)) return false;
    for (size_t k = 0; k < c->n; k++) {
        if (s->model.body[c->body[k]].fixed) continue;
        improved = improved && sunder_i_is_improved(s, c->body[k]);
        cheapest = cheapest && sunder_i_is_cheapest(s, c->body[k]);
    }
    return !improved && !cheapest;
}

bool sunder_i_solver_is_to_improve(sunder_i_solver *solver)
{
    bool *wanted = sunder_i_solver_connected_with(solver, sunder_i_is_wanted), any = false;
    for (size_t e = 0; e < solver->edges && wanted; e++)
        for (int k = 0; k < 2; k++) {
            const uint32_t b = k ? solver->edge[e].b : solver->edge[e].a;
            any = any || (wanted[b] && !sunder_i_is_improved(solver, b));
        }
    solver->failed = solver->failed || !wanted;
    sunder_i_free(wanted);
    return any;
}

static sunder_status note_improved(const sunder_i_solver *s, sunder_i_cluster *c, double before, const double *move,
                                   sunder_error *err)
{
    const double after = sunder_i_trace_cost(&s->model, c->body, c->n, move);
    const sunder_i_trace_step step = {NULL, "better sides", "cheaper", before, after};
    if (!(after < before)) return SUNDER_OK;
    return sunder_i_trace_note(&c->log, &step) ? SUNDER_OK : sunder_i_failure_cause(err);
}

static sunder_status improve_cluster(const sunder_i_solver *s, sunder_i_cluster *c, double *move, void *context,
                                     sunder_error *err)
{
    const double before = sunder_i_is_traced(&s->model) ? sunder_i_trace_cost(&s->model, c->body, c->n, move) : 0;
    (void)context;
    c->outcome = SUNDER_I_WORKED_ON;
    const sunder_status status = sunder_i_cluster_improve(&s->model, c, move, err);
    return status || !sunder_i_is_traced(&s->model) ? status : note_improved(s, c, before, move, err);
}

static sunder_status find_blocking_neighbours(const sunder_i_solver *s, sunder_i_cluster *c, double *move,
                                              void *context, sunder_error *err)
{
    (void)context;
    return sunder_i_cluster_find_blocking(&s->model, c, move) ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* Joins the neighbours that block bodies of a cluster to that cluster. */
static sunder_status join_guests(sunder_i_solver *s, sunder_error *err)
{
    bool any = false;
    sunder_status status = sunder_i_solver_for_clusters(s, is_to_improve, find_blocking_neighbours, NULL, err);
    for (size_t k = 0; k < s->clusters && !status; k++)
        for (size_t g = 0; g < s->cluster[k].guests && !status; g++) {
            const sunder_i_id_pair *pair = &s->cluster[k].guest[g];
            any = true;
            if (!sunder_i_solver_add_edge(s, pair->a, pair->b)) status = sunder_i_failure_cause(err);
        }
    return status || !any ? status : sunder_i_solver_gather(s, err);
}

sunder_status sunder_i_solver_improve(sunder_i_solver *solver, sunder_error *err)
{
    sunder_status status = sunder_i_solver_gather(solver, err);
    if (!status) status = join_guests(solver, err);
    if (!status) status = sunder_i_solver_unite_blocks(solver, err);
    if (!status) status = sunder_i_solver_for_clusters(solver, is_to_improve, improve_cluster, NULL, err);
    if (!status) status = sunder_i_solver_trace_clusters(solver, err);
    if (status) return status;
    sunder_i_pieces_forget(&solver->model, SUNDER_I_PIECES_HELD);
    status = sunder_i_solver_commit(solver, err);
    for (size_t k = 0; k < solver->clusters && !status; k++) {
        const sunder_i_cluster *c = &solver->cluster[k];
        if (!sunder_i_solver_any_of(solver, c->body, c->n, sunder_i_is_wanted)) continue;
        for (size_t m = 0; m < c->n; m++) sunder_i_body_event(&solver->states, c->body[m], SUNDER_I_IS_IMPROVED);
    }
    return status ? status : sunder_i_solver_relate(solver, err);
}
