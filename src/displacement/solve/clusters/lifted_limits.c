/* Limits of moves: first the layer is solved as if it had none.
 *
 * Bodies that keep their limits in that solution are left as they are: so limits that are not exceeded make no
 * difference, and a limit is never the reason for a worse solution than is known without it. Only bodies that exceed
 * theirs go back to where they started, with their clusters, and are solved again within their limits.
 *
 * Solving pairs that no moves within the limits can separate would be useless: whatever is connected with one at the
 * start is set aside meanwhile. If others run into it, they go back too. So does a cluster that would become part of a
 * crowd, once it costs more than if each of its bodies stood at its limit, which is more than any solution within them
 * costs: it goes back, and pushes nothing from where it could not stay. (A town of terraces, house by house, grew into
 * one cluster of thousands, all on their way out of town.)
 *
 * With barriers limits are kept from the start: in a road network the free place beyond a limit is usually several
 * blocks away, and finding it takes long (measured; and the limit would undo the gain). */
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/union_find.h"

#include <math.h>
#include <string.h>

/* ---- Without limits ---------------------------------------------------------------------------------------------- */

/* Sets aside all bodies that are connected, by conflicts at the start, with a pair that limits keep from being
 * resolved. Relaxations are put into s->waiting until limits are in force again. False if memory is out. */
static bool set_infeasible_aside(sunder_i_solver *s)
{
    sunder_i_model *model = &s->model;
    const uint32_t *root = sunder_i_solver_conflict_roots(s);
    bool *hard = sunder_i_calloc(model->bodies, sizeof *hard);
    const bool ok = root && hard;
    s->waiting = model->relaxations;
    memset(&model->relaxations, 0, sizeof model->relaxations);
    if (ok) {
        for (size_t k = 0; k < s->waiting.n; k++) {
            hard[root[model->body_of[s->waiting.item[k].a]]] = true;
            hard[root[model->body_of[s->waiting.item[k].b]]] = true;
        }
        for (size_t k = 0; k < s->entries; k++)
            hard[root[model->body_of[s->entry[k].a]]] = hard[root[model->body_of[s->entry[k].b]]] = true;
        for (uint32_t b = 0; b < model->bodies; b++)
            if (!model->body[b].fixed && hard[root[b]]) sunder_i_body_event(&s->states, b, SUNDER_I_IS_SET_ASIDE);
    }
    sunder_i_free(hard);
    return ok;
}

sunder_status sunder_i_solver_lift_limits(sunder_i_solver *solver, sunder_error *err)
{
    sunder_i_model *model = &solver->model;
    bool limited = false;
    for (size_t b = 0; b < model->bodies; b++)
        limited = limited || (!model->body[b].fixed && model->body[b].limit < INFINITY);
    solver->had_limits = limited && solver->barriers.parts == 0;
    if (!solver->had_limits) return SUNDER_OK;
    solver->limit = sunder_i_alloc(model->bodies, sizeof *solver->limit);
    solver->went = sunder_i_calloc(2 * model->bodies, sizeof *solver->went);
    if (!solver->limit || !solver->went) return sunder_i_failure_cause(err);
    for (uint32_t b = 0; b < model->bodies; b++) {
        solver->limit[b] = model->body[b].limit;
        if (!model->body[b].fixed) model->body[b].limit = INFINITY;
        sunder_i_body_event(&solver->states, b, SUNDER_I_LIMIT_IS_LIFTED);
    }
    return set_infeasible_aside(solver) ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* ---- What went too far ------------------------------------------------------------------------------------------- */

static void send_home(sunder_i_solver *s, const bool *back)
{
    sunder_i_model *model = &s->model;
    sunder_i_changes_clear(&s->changes);
    for (uint32_t b = 0; b < model->bodies; b++) {
        double start[2];
        if (!back[b]) continue;
        sunder_i_solver_start_of(s, b, start);
        sunder_i_solver_place(s, b, start);
        model->body[b].pinned = false;
        s->widened[b] = 0;
        sunder_i_body_event(&s->states, b, SUNDER_I_GOES_HOME);
        s->carrier[b] = SUNDER_I_NOBODY;
    }
    for (size_t k = 0; k < model->inclusions; k++) {
        sunder_i_inclusion *pair = &model->inclusion[k];
        if (back[model->body_of[pair->a]] || back[model->body_of[pair->b]])
            pair->state = pair->enters ? SUNDER_I_STRICT : SUNDER_I_LENIENT;
    }
}

/* Does the cluster cost more than if each of its bodies were at its limit? */
static bool costs_more_than_limits(const sunder_i_solver *s, const sunder_i_cluster *c)
{
    double cost = 0, most = 0;
    for (size_t k = 0; k < c->n; k++) {
        const uint32_t b = c->body[k];
        const sunder_i_body *body = &s->model.body[b];
        if (body->fixed) continue;
        const double *to = sunder_i_preferred(&s->model, b), far = s->limit[b] + hypot(to[0], to[1]);
        cost += sunder_i_move_cost(&s->model, b, s->model.move + 2 * (size_t)b);
        most += body->weight * far * far;
    }
    return cost > most;
}

/* Joins, in the union-find `root`, the clusters of bodies i and j, which met, unless one of them was set aside or is
 * fixed. */
static void join_if_running(const sunder_i_solver *s, uint32_t i, uint32_t j, uint32_t *root)
{
    if (sunder_i_is_aside(s, i) || sunder_i_is_aside(s, j) || s->model.body[i].fixed || s->model.body[j].fixed) return;
    sunder_i_union_join(root, sunder_i_union_find(s->parent, i), sunder_i_union_find(s->parent, j));
}

/* Finds which clusters would become one by the present conflicts and jumps: root[bodies], a union-find by their
 * roots. */
static void join_running_clusters(const sunder_i_solver *s, uint32_t *root)
{
    const sunder_i_model *model = &s->model;
    sunder_i_union_init(root, model->bodies);
    for (size_t k = 0; k < s->now.n; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        if (!sunder_i_is_conflict_of_bodies(model, r) || sunder_i_relaxations_find(&model->relaxations, r->a, r->b))
            continue;
        join_if_running(s, model->body_of[r->a], model->body_of[r->b], root);
    }
    for (size_t k = 0; k < s->jumps.n; k++)
        join_if_running(s, model->body_of[s->jumps.pair[k].a], model->body_of[s->jumps.pair[k].b], root);
}

/* Sets running[] for the roots of clusters that cost more than their limits allow, and would become part of a crowd of
 * more than MOST_LIFTED bodies. root, size: [bodies] scratch. */
static void find_running_clusters(const sunder_i_solver *s, uint32_t *root, size_t *size, bool *running)
{
    join_running_clusters(s, root);
    for (size_t k = 0; k < s->clusters; k++)
        size[sunder_i_union_find(root, s->member[s->cluster[k].body - s->body].root)] += s->cluster[k].n;
    for (size_t k = 0; k < s->clusters; k++) {
        const uint32_t own = s->member[s->cluster[k].body - s->body].root;
        const size_t together = size[sunder_i_union_find(root, own)];
        running[own] =
            together > s->cluster[k].n && together > MOST_LIFTED && costs_more_than_limits(s, &s->cluster[k]);
    }
}

/* Sets the bodies of the clusters marked in running[] aside, and marks them in back[bodies]. Their present moves are
 * kept in s->went, since the search may start from there later. Returns whether there are any. */
static bool set_running_aside(sunder_i_solver *s, const bool *running, bool *back)
{
    bool any = false;
    for (uint32_t b = 0; b < s->model.bodies; b++) {
        if (s->model.body[b].fixed || !running[sunder_i_union_find(s->parent, b)]) continue;
        any = back[b] = true;
        sunder_i_body_event(&s->states, b, SUNDER_I_IS_SET_ASIDE);
        memcpy(s->went + 2 * (size_t)b, s->model.move + 2 * (size_t)b, 2 * sizeof *s->went);
    }
    return any;
}

sunder_status sunder_i_solver_set_far_aside(sunder_i_solver *solver, sunder_error *err)
{
    const size_t n = solver->model.bodies;
    if (!solver->limit || solver->model.lifted) return SUNDER_OK;
    uint32_t *root = sunder_i_alloc(n, sizeof *root);
    size_t *size = sunder_i_calloc(n, sizeof *size);
    bool *running = sunder_i_calloc(n, sizeof *running), *back = sunder_i_calloc(n, sizeof *back);
    sunder_status status = root && size && running && back ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) {
        find_running_clusters(solver, root, size, running);
        if (set_running_aside(solver, running, back)) {
            send_home(solver, back);
            status = sunder_i_solver_relate(solver, err);
        }
    }
    sunder_i_free_all(root, size, running, back);
    return status;
}

/* ---- Within them ------------------------------------------------------------------------------------------------- */

/* If one of bodies i and j, which met, was set aside: marks the clusters of both by their roots. */
static void mark_meeting(sunder_i_solver *s, uint32_t i, uint32_t j, bool *root)
{
    if (!sunder_i_is_aside(s, i) && !sunder_i_is_aside(s, j)) return;
    root[sunder_i_union_find(s->parent, i)] = root[sunder_i_union_find(s->parent, j)] = true;
}

/* Marks the clusters, by their roots, with a body that exceeds its limit, was set aside, or met a body that was set
 * aside, in a conflict or by a jump. */
static void find_offenders(sunder_i_solver *s, bool *root)
{
    const sunder_i_model *model = &s->model;
    for (uint32_t b = 0; b < model->bodies; b++)
        if (!model->body[b].fixed &&
            (sunder_i_is_aside(s, b) || !sunder_i_is_within_limit(model->move + 2 * (size_t)b, model->body[b].limit)))
            root[sunder_i_union_find(s->parent, b)] = true;
    for (size_t k = 0; k < s->now.n; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        if (sunder_i_is_conflict_of_bodies(model, r)) mark_meeting(s, model->body_of[r->a], model->body_of[r->b], root);
    }
    for (size_t k = 0; k < s->jumps.n; k++)
        mark_meeting(s, model->body_of[s->jumps.pair[k].a], model->body_of[s->jumps.pair[k].b], root);
}

/* Drops the edges, given-up pairs and relaxations of the bodies marked in back[], and adds the relaxations that were
 * waiting. False if memory is out. */
static bool forget_bodies(sunder_i_solver *s, const bool *back)
{
    sunder_i_model *model = &s->model;
    sunder_i_relaxations *relaxations = &model->relaxations;
    size_t out = 0;
    for (size_t e = 0; e < s->edges; e++)
        if (!back[s->edge[e].a] && !back[s->edge[e].b]) s->edge[out++] = s->edge[e];
    s->edges = 0;
    s->edges_listed = SUNDER_I_NONE_LISTED;
    sunder_i_union_init(s->parent, model->bodies);
    for (size_t e = 0; e < out; e++) sunder_i_solver_add_edge(s, s->edge[e].a, s->edge[e].b); /* no memory is needed */
    out = 0;
    for (size_t k = 0; k < model->given_up_n; k++)
        if (!back[model->given_up[k].a] && !back[model->given_up[k].b]) model->given_up[out++] = model->given_up[k];
    model->given_up_n = out;
    out = 0;
    for (size_t k = 0; k < relaxations->n; k++)
        if (!back[model->body_of[relaxations->item[k].a]] && !back[model->body_of[relaxations->item[k].b]])
            relaxations->item[out++] = relaxations->item[k];
    relaxations->n = out;
    for (size_t k = 0; k < s->waiting.n; k++)
        if (!sunder_i_relaxations_add(relaxations, &s->waiting.item[k])) return false;
    sunder_i_relaxations_free(&s->waiting);
    return sunder_i_relaxations_index(relaxations, model);
}

static bool is_limited(const sunder_i_solver *s, uint32_t body) { return s->model.body[body].limit < INFINITY; }

/* Marks the bodies whose given-up pairs may be asked about again: those in clusters with a limited body, since more can
 * be proved within limits, and a pair that had a solution without limits may have none within them. */
static bool doubt_limited_clusters(sunder_i_solver *s)
{
    sunder_i_model *model = &s->model;
    size_t out = 0;
    bool *doubtful = sunder_i_solver_connected_with(s, is_limited);
    if (!doubtful) return false;
    for (uint32_t b = 0; b < model->bodies; b++)
        sunder_i_body_event(&s->states, b, doubtful[b] ? SUNDER_I_IS_DOUBTED : SUNDER_I_IS_CERTAIN);
    for (size_t k = 0; k < s->asked_n; k++)
        if (!doubtful[model->body_of[s->asked[k].a]] && !doubtful[model->body_of[s->asked[k].b]])
            s->asked[out++] = s->asked[k];
    s->asked_n = out;
    sunder_i_free(doubtful);
    return true;
}

sunder_status sunder_i_solver_begin_again(sunder_i_solver *solver, const bool *back, sunder_error *err)
{
    send_home(solver, back);
    const sunder_status status =
        forget_bodies(solver, back) ? sunder_i_solver_relate(solver, err) : sunder_i_failure_cause(err);
    /* Otherwise a body that shared a cluster with a fixed body would still count as tested against it. */
    return status ? status : sunder_i_solver_gather(solver, err);
}

sunder_status sunder_i_solver_restore_limits(sunder_i_solver *solver, sunder_error *err)
{
    sunder_i_model *model = &solver->model;
    bool *root = sunder_i_calloc(model->bodies, sizeof *root), *back = sunder_i_calloc(model->bodies, sizeof *back);
    sunder_status status = root && back ? SUNDER_OK : sunder_i_failure_cause(err);
    model->lifted = solver->went; /* of bodies that were set aside; all others keep their present moves */
    solver->went = NULL;
    for (uint32_t b = 0; b < model->bodies; b++)
        if (!sunder_i_is_aside(solver, b))
            memcpy(model->lifted + 2 * (size_t)b, model->move + 2 * (size_t)b, 2 * sizeof *model->move);
    for (size_t b = 0; b < model->bodies; b++) model->body[b].limit = solver->limit[b];
    if (!status && !doubt_limited_clusters(solver)) status = sunder_i_failure_cause(err);
    if (!status) {
        find_offenders(solver, root);
        for (uint32_t b = 0; b < model->bodies; b++) {
            back[b] = !model->body[b].fixed && root[sunder_i_union_find(solver->parent, b)];
            sunder_i_body_event(&solver->states, b, back[b] ? SUNDER_I_BEGINS_AGAIN_LIMITED : SUNDER_I_IS_LEFT);
            sunder_i_body_event(&solver->states, b, SUNDER_I_LIMIT_IS_RESTORED);
        }
        status = sunder_i_solver_begin_again(solver, back, err);
    }
    sunder_i_free_all(root, back);
    return status;
}
