/* Which pairs stand worse than at the start: the rule for pairs that stay in conflict, exactly, for the features as
 * they will be written. */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/solve/clusters/cluster_stages.h"

#include "separation/separation.h"

/* Are both features of the pair r where they were at the start, up to one exact common move? */
static bool stand_as_they_did(const sunder_i_solver *s, const sunder_i_relation *r)
{
    const sunder_i_placement *p = &s->placement;
    const double *a = p->move + 2 * (size_t)r->a, *b = p->move + 2 * (size_t)r->b;
    return !p->rounded[r->a] && !p->rounded[r->b] && a[0] == b[0] && a[1] == b[1];
}

/* *worse if a feature stands worse beside a barrier than at the start. The barrier counts as a whole: any of its parts
 * may have been in conflict with the feature at the start. */
static sunder_status is_worse_to_barrier(const sunder_i_solver *s, const sunder_i_relation *r, bool *worse,
                                         sunder_error *err)
{
    const sunder_i_relation first = {.a = r->a, .b = sunder_i_whole_of(&s->model, r->b)};
    const size_t at = sunder_i_lower_bound(&first, s->start.pair, s->start.n, sizeof first, sunder_i_by_id_pair);
    *worse =
        at == s->start.n || s->start.pair[at].a != r->a || sunder_i_whole_of(&s->model, s->start.pair[at].b) != first.b;
    if (*worse || stand_as_they_did(s, r)) return SUNDER_OK;
    const sunder_i_translate home = sunder_i_at_home(&s->model, r->a),
                             now = sunder_i_standing(&s->model, &s->placement, r->a);
    return sunder_i_barrier_worsened(&s->model, &home, &now, r->b, worse, err);
}

/* The depth of the pair at the start, as far as it was computed; valid until the next call. NULL if memory is out. */
static sunder_i_depth *depth_of(sunder_i_solver *s, const sunder_i_relation *was)
{
    if (!s->depth_at) s->depth_at = sunder_i_calloc(s->start.n, sizeof *s->depth_at);
    if (!s->depth_at) return NULL;
    uint32_t *at = &s->depth_at[was - s->start.pair];
    if (*at == 0) {
        if (!sunder_i_reserve(&s->depth, &s->depth_capacity, s->depths + 1, sizeof *s->depth)) return NULL;
        s->depth[s->depths++] = (sunder_i_depth){0};
        *at = (uint32_t)s->depths;
    }
    return &s->depth[*at - 1];
}

sunder_status sunder_i_solver_is_worse(sunder_i_solver *solver, const sunder_i_relation *r, bool *worse,
                                       sunder_error *err)
{
    const sunder_i_relation *was = sunder_i_relations_find(&solver->start, r->a, r->b);
    *worse = !was || !sunder_i_is_conflict(was);
    if (sunder_i_is_barrier(&solver->model, r->b)) return is_worse_to_barrier(solver, r, worse, err);
    if (*worse || stand_as_they_did(solver, r) || (was->contained && r->contained)) return SUNDER_OK;
    const sunder_i_translate a = sunder_i_standing(&solver->model, &solver->placement, r->a),
                             b = sunder_i_standing(&solver->model, &solver->placement, r->b);
    const sunder_i_pair before = {sunder_i_thing_shape(&solver->model, r->a),
                                  sunder_i_thing_shape(&solver->model, r->b), NULL, NULL},
                        now = {a.shape, b.shape, a.t, b.t};
    sunder_i_depth *depth = depth_of(solver, was);
    return depth ? sunder_i_pair_worsened_since(&before, depth, &now, worse, err) : sunder_i_failure_cause(err);
}

/* Members of one block may have gaps between them, and may touch: only their overlaps count. */
bool sunder_i_solver_is_always_listed(const sunder_i_solver *solver, const sunder_i_relation *r)
{
    return sunder_i_is_conflict(r) &&
           (solver->model.body_of[r->a] != solver->model.body_of[r->b] || (r->overlap && !r->touch));
}

sunder_status sunder_i_solver_breaks_rule(sunder_i_solver *solver, const sunder_i_relation *r, bool *breaks,
                                          sunder_error *err)
{
    *breaks = false;
    return sunder_i_solver_is_always_listed(solver, r) ? sunder_i_solver_is_worse(solver, r, breaks, err) : SUNDER_OK;
}

sunder_status sunder_i_solver_is_upheld(sunder_i_solver *solver, bool *upheld, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    *upheld = solver->jumps.n == 0;
    for (size_t k = 0; k < solver->now.n && *upheld && !status; k++) {
        bool breaks;
        status = sunder_i_solver_breaks_rule(solver, &solver->now.pair[k], &breaks, err);
        *upheld = !status && !breaks;
    }
    return status;
}
