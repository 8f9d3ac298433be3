/* The state of the work on one layer. Bodies in conflict make edges, edges make clusters.
 *
 * An edge is a pair of bodies that came into conflict, or into each other's way, at some time. Clusters are the
 * components of the edges over bodies that are not fixed; a fixed body is a member of every cluster that has an edge to
 * it, and joins none. */
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/invariant.h"
#include "base/sort.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void free_clusters(sunder_i_solver *s)
{
    for (size_t k = 0; k < s->clusters; k++) {
        sunder_i_relaxations_free(&s->cluster[k].relaxations);
        sunder_i_free_all(s->cluster[k].restored, s->cluster[k].guest);
        sunder_i_trace_log_free(&s->cluster[k].log);
    }
    s->clusters = 0;
}

void sunder_i_solver_free(sunder_i_solver *solver)
{
    sunder_i_jumps_free(&solver->jumps);
    sunder_i_rows_free(&solver->rows);
    sunder_i_placement_free(&solver->model, &solver->placement);
    sunder_i_model_free(&solver->model);
    sunder_i_free_all(solver->start.pair, solver->depth, solver->depth_at, solver->now.pair, solver->entry,
                      solver->edge, solver->conflict_root, solver->parent);
    sunder_i_body_states_free(&solver->states);
    sunder_i_free(solver->widened);
    sunder_i_changes_free(&solver->changes);
    sunder_i_free_all(solver->asked, solver->asked_work, solver->crowd_size, solver->measured, solver->limit,
                      solver->went);
    sunder_i_relaxations_free(&solver->waiting);
    sunder_i_free_all(solver->carrier, solver->member, solver->body, solver->move);
    free_clusters(solver);
    sunder_i_free(solver->cluster);
    sunder_i_groups_free(&solver->groups);
    sunder_i_ordered_clear(&solver->layer);
    sunder_i_barriers_free(&solver->barriers);
    memset(solver, 0, sizeof *solver);
}

sunder_status sunder_i_solver_init(sunder_i_solver *solver, sunder_error *err)
{
    const size_t n = solver->model.bodies;
    solver->parent = sunder_i_alloc(n, sizeof *solver->parent);
    solver->widened = sunder_i_calloc(n, sizeof *solver->widened);
    solver->carrier = sunder_i_alloc(n, sizeof *solver->carrier);
    solver->crowd_size = sunder_i_calloc(n, sizeof *solver->crowd_size);
    if (!solver->parent || !solver->widened || !solver->carrier || !solver->crowd_size ||
        !sunder_i_body_states_init(&solver->states, n) ||
        !sunder_i_changes_init(&solver->changes, solver->model.things))
        return sunder_i_failure_cause(err);
    sunder_i_union_init(solver->parent, n);
    for (size_t b = 0; b < n; b++) solver->carrier[b] = SUNDER_I_NOBODY;
    return SUNDER_OK;
}

/* ---- Conflicts and edges ----------------------------------------------------------------------------------------- */

const uint32_t *sunder_i_solver_conflict_roots(sunder_i_solver *solver)
{
    const sunder_i_model *model = &solver->model;
    if (solver->conflict_root) return solver->conflict_root;
    uint32_t *root = solver->conflict_root = sunder_i_alloc(model->bodies, sizeof *root);
    if (!root) return NULL;
    sunder_i_union_init(root, model->bodies);
    for (size_t k = 0; k < solver->start.n; k++) {
        const sunder_i_relation *r = &solver->start.pair[k];
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        if (!sunder_i_is_conflict_of_bodies(model, r) || model->body[i].fixed || model->body[j].fixed) continue;
        sunder_i_union_join(root, i, j);
    }
    for (size_t b = 0; b < model->bodies; b++) root[b] = sunder_i_union_find(root, (uint32_t)b);
    return root;
}

/* ---- Clusters ---------------------------------------------------------------------------------------------------- */

bool sunder_i_solver_add_edge(sunder_i_solver *solver, uint32_t i, uint32_t j)
{
    if (!sunder_i_reserve(&solver->edge, &solver->edge_capacity, solver->edges + 1, sizeof *solver->edge)) return false;
    solver->edge[solver->edges++] = (sunder_i_id_pair){i, j};
    if (!solver->model.body[i].fixed && !solver->model.body[j].fixed) sunder_i_union_join(solver->parent, i, j);
    return true;
}

bool sunder_i_solver_has_member(const sunder_i_solver *solver, uint32_t root, uint32_t body)
{
    const sunder_i_cluster_member wanted = {root, body};
    return solver->members && bsearch(&wanted, solver->member, solver->members, sizeof wanted, sunder_i_by_id_pair);
}

/* The index in member[] of the first member of the cluster with this root, or, if there is none, of the next
 * cluster. */
static size_t first_member(const sunder_i_solver *s, uint32_t root)
{
    const sunder_i_cluster_member first = {root, 0};
    return sunder_i_lower_bound(&first, s->member, s->members, sizeof first, sunder_i_by_id_pair);
}

const uint32_t *sunder_i_solver_members(const sunder_i_solver *solver, uint32_t root, size_t *n)
{
    const size_t first = first_member(solver, root);
    *n = first_member(solver, root + 1) - first;
    return *n ? solver->body + first : NULL;
}

sunder_i_cluster *sunder_i_solver_cluster_at_root(const sunder_i_solver *solver, uint32_t root)
{
    size_t n, low = 0, high = solver->clusters;
    const uint32_t *member = sunder_i_solver_members(solver, root, &n);
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (solver->cluster[middle].body < member)
            low = middle + 1;
        else
            high = middle;
    }
    return n && low < solver->clusters && solver->cluster[low].body == member ? &solver->cluster[low] : NULL;
}

sunder_i_cluster *sunder_i_solver_cluster_of(const sunder_i_solver *solver, uint32_t body)
{
    return sunder_i_solver_cluster_at_root(solver, sunder_i_union_find(solver->parent, body));
}

bool sunder_i_solver_any_of(const sunder_i_solver *solver, const uint32_t *body, size_t n, sunder_i_body_test test)
{
    for (size_t k = 0; k < n; k++)
        if (test(solver, body[k]) && !solver->model.body[body[k]].fixed) return true;
    return false;
}

bool *sunder_i_solver_connected_with(const sunder_i_solver *solver, sunder_i_body_test test)
{
    const sunder_i_body *body = solver->model.body;
    bool *root = sunder_i_calloc(solver->model.bodies, sizeof *root),
         *out = sunder_i_calloc(solver->model.bodies, sizeof *out);
    for (uint32_t b = 0; b < solver->model.bodies && root && out; b++)
        if (test(solver, b) && !body[b].fixed) root[sunder_i_union_find(solver->parent, b)] = true;
    for (uint32_t b = 0; b < solver->model.bodies && root && out; b++)
        out[b] = !body[b].fixed && root[sunder_i_union_find(solver->parent, b)];
    if (!root) sunder_i_free(out);
    const bool ok = root != NULL;
    sunder_i_free(root);
    return ok ? out : NULL;
}

#ifndef NDEBUG
/* The checker: clusters share no body but fixed ones, and the members of each ascend. */
static const char *check_clusters(const sunder_i_solver *s)
{
    size_t members = 0;
    for (size_t k = 0; k < s->clusters; members += s->cluster[k++].n) {
        const sunder_i_cluster *c = &s->cluster[k];
        if (c->body != s->body + members || !(c->margin > 0)) return "a cluster without members of its own";
        for (size_t m = 0; m < c->n; m++) {
            const uint32_t b = c->body[m], root = s->member[members + m].root;
            if (m && c->body[m - 1] >= b) return "members do not ascend";
            if (!s->model.body[b].fixed && sunder_i_union_find(s->parent, b) != root) return "a member of two clusters";
        }
    }
    return members == s->members ? NULL : "a member without a cluster";
}
#endif

void sunder_i_solver_forget_clusters(sunder_i_solver *solver)
{
    free_clusters(solver);
    sunder_i_free_all(solver->cluster, solver->move);
    solver->cluster = NULL;
    solver->move = NULL;
}

/* Makes room for the clusters of the present edges. Old contents are lost if there was too little. False if memory is
 * out. */
static bool reserve_clusters(sunder_i_solver *s)
{
    if (s->edge_room >= s->edges && s->cluster) return true;
    sunder_i_free_all(s->member, s->body, s->move, s->cluster);
    s->edge_room = s->edges + s->edges / SPARE_ROOM;
    s->member = sunder_i_alloc(2 * s->edge_room, sizeof *s->member);
    s->body = sunder_i_alloc(2 * s->edge_room, sizeof *s->body);
    s->move = sunder_i_alloc(4 * s->edge_room, sizeof *s->move);
    s->cluster = sunder_i_alloc(s->edge_room, sizeof *s->cluster);
    s->edges_listed = SUNDER_I_NONE_LISTED;
    const bool ok = s->member && s->body && s->move && s->cluster;
    if (!ok) s->edge_room = 0; /* some arrays are missing */
    return ok;
}

/* Lists the ends of all edges in member[], sorted by the root of their cluster, each once. Does nothing if no edge was
 * added since the last time. False if memory is out. */
static bool list_members(sunder_i_solver *s)
{
    if (s->edges_listed == s->edges) return true;
    uint64_t *key = sunder_i_alloc(2 * s->edges, sizeof *key);
    size_t n = 0;
    s->members = 0;
    for (size_t e = 0; e < s->edges && key; e++) {
        const uint32_t i = s->edge[e].a, j = s->edge[e].b;
        const uint64_t root = sunder_i_union_find(s->parent, s->model.body[i].fixed ? j : i);
        key[n++] = root << 32 | i;
        key[n++] = root << 32 | j;
    }
    const bool ok = key && sunder_i_sort_keys(key, n);
    for (size_t k = 0; k < n && ok; k++) {
        if (k && key[k - 1] == key[k]) continue;
        s->member[s->members] = (sunder_i_cluster_member){(uint32_t)(key[k] >> 32), (uint32_t)key[k]};
        s->body[s->members++] = (uint32_t)key[k];
    }
    s->edges_listed = ok ? s->edges : SUNDER_I_NONE_LISTED;
    sunder_i_free(key);
    return ok;
}

/* Does the cluster start from prices of area? It does if it is large, has no limits, and has grown since it last
 * started so, provided that bodies prefer to stay. What a large crowd ran into hardly changes the best positions, so it
 * has to have doubled. */
static bool is_new_crowd(const sunder_i_solver *s, const sunder_i_cluster *c)
{
    if (!(s->model.rules.effort > 0) || c->limited || c->brief || c->n < CROWD || s->model.preferred) return false;
    const size_t most = c->n <= LARGE_GROWN_CROWD ? c->n - 1 : c->n / 2;
    for (size_t k = 0; k < c->n; k++)
        if (s->crowd_size[c->body[k]] > most) return false;
    return true;
}

sunder_status sunder_i_solver_gather(sunder_i_solver *solver, sunder_error *err)
{
    free_clusters(solver);
    if (!reserve_clusters(solver) || !list_members(solver)) {
        solver->members = 0;
        return sunder_i_failure_cause(err);
    }
    for (size_t first = 0, end; first < solver->members; first = end) {
        sunder_i_cluster *c = &solver->cluster[solver->clusters++];
        *c = (sunder_i_cluster){.touching = true};
        for (end = first; end < solver->members && solver->member[end].root == solver->member[first].root; end++) {
            const sunder_i_body *body = &solver->model.body[solver->member[end].body];
            c->touching = c->touching && solver->widened[solver->member[end].body] == 0;
            c->limited = c->limited || body->fixed || body->pinned || body->limit < INFINITY ||
                         sunder_i_forbids_paths(&solver->model);
        }
        c->brief = solver->brief;
        c->body = solver->body + first;
        c->n = end - first;
        c->margin = sunder_i_solver_margin(solver, c->body, c->n);
        c->starts_from_areas = is_new_crowd(solver, c);
    }
    SUNDER_I_CHECK(check_clusters(solver), solver->members);
    return SUNDER_OK;
}

typedef struct working {
    const sunder_i_solver *solver;
    sunder_i_cluster_test test;
    sunder_i_cluster_work work;
    void *context;
} working;

static sunder_status work_on_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const working *w = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++) {
        sunder_i_cluster *c = &w->solver->cluster[k];
        if (w->test && !w->test(w->solver, c)) continue;
        double *move = sunder_i_solver_load_moves(w->solver, c);
        sunder_i_reading reading;
        sunder_i_reads_begin(&reading, &w->solver->model, sunder_i_reader_for(w->solver, c));
        status = w->work(w->solver, c, move, w->context, err);
        sunder_i_reads_end(&reading);
    }
    return status;
}

sunder_status sunder_i_solver_for_clusters(const sunder_i_solver *solver, sunder_i_cluster_test test,
                                           sunder_i_cluster_work work, void *context, sunder_error *err)
{
    working w = {solver, test, work, context};
    size_t *size = sunder_i_alloc(solver->clusters, sizeof *size);
    if (!size) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < solver->clusters; k++) size[k] = solver->cluster[k].n;
    const sunder_status status =
        sunder_i_parallel_largest_first(solver->model.rules.threads, size, solver->clusters, work_on_clusters, &w, err);
    sunder_i_free(size);
    return status;
}

sunder_status sunder_i_solver_trace_clusters(sunder_i_solver *solver, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < solver->clusters && sunder_i_is_traced(&solver->model) && !status; k++) {
        sunder_i_cluster *c = &solver->cluster[k];
        status = sunder_i_trace_log_emit(&solver->model, "cluster", &c->log, c->body, c->n, err);
    }
    return status;
}

sunder_status sunder_i_solver_unite_blocks(sunder_i_solver *solver, sunder_error *err)
{
    bool *seen = sunder_i_calloc(solver->model.bodies, sizeof *seen);
    uint32_t *body = sunder_i_alloc(solver->members, sizeof *body);
    sunder_status status = seen && body ? SUNDER_OK : sunder_i_failure_cause(err);
    size_t n = 0;
    for (size_t k = 0; !status && k < solver->members; k++) {
        if (!seen[solver->body[k]] && sunder_i_cluster_may_want_shape(&solver->model, solver->body[k]))
            body[n++] = solver->body[k];
        seen[solver->body[k]] = true;
    }
    if (!status) status = sunder_i_model_unite(&solver->model, body, n, err);
    sunder_i_free_all(seen, body);
    return status;
}
