/* The state of the work on one layer. Bodies in conflict make edges, edges make clusters.
 *
 * An edge is a pair of bodies that came into conflict, or into each other's way, at some time. Clusters are the
 * components of the edges over bodies that are not fixed; a fixed body is a member of every cluster that has an edge to
 * it, and joins none. */
#include "displacement/solve/clusters/stages.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/extremes.h"
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
        sunder_i_free(s->cluster[k].restored);
        sunder_i_free(s->cluster[k].guest);
    }
    s->clusters = 0;
}

void sunder_i_solver_free(sunder_i_solver *s)
{
    sunder_i_jumps_free(&s->jumps);
    sunder_i_placement_free(&s->model, &s->placement);
    sunder_i_model_free(&s->model);
    sunder_i_free(s->start.pair);
    sunder_i_free(s->depth);
    sunder_i_free(s->depth_at);
    sunder_i_free(s->now.pair);
    sunder_i_free(s->entry);
    sunder_i_free(s->edge);
    sunder_i_free(s->conflict_root);
    sunder_i_free(s->parent);
    sunder_i_free(s->dirty);
    sunder_i_free(s->widened);
    sunder_i_changes_free(&s->changes);
    sunder_i_free(s->reconsidered);
    sunder_i_free(s->alone);
    sunder_i_free(s->alone_work);
    sunder_i_free(s->wanted);
    sunder_i_free(s->doubtful);
    sunder_i_free(s->gave_up);
    sunder_i_free(s->crowd);
    sunder_i_free(s->measured);
    sunder_i_free(s->improved);
    sunder_i_free(s->cheapest);
    sunder_i_free(s->limit);
    sunder_i_free(s->aside);
    sunder_i_free(s->let_go);
    sunder_i_free(s->went);
    sunder_i_relaxations_free(&s->waiting);
    sunder_i_free(s->carrier);
    sunder_i_free(s->member);
    sunder_i_free(s->body);
    sunder_i_free(s->move);
    free_clusters(s);
    sunder_i_free(s->cluster);
    sunder_i_groups_free(&s->groups);
    sunder_i_ordered_clear(&s->layer);
    sunder_i_barriers_free(&s->barriers);
    memset(s, 0, sizeof *s);
}

sunder_status sunder_i_solver_init(sunder_i_solver *s, sunder_error *err)
{
    const size_t n = s->model.bodies;
    s->parent = sunder_i_alloc(n, sizeof *s->parent);
    s->dirty = sunder_i_calloc(n, sizeof *s->dirty);
    s->widened = sunder_i_calloc(n, sizeof *s->widened);
    s->reconsidered = sunder_i_calloc(n, sizeof *s->reconsidered);
    s->improved = sunder_i_calloc(n, sizeof *s->improved);
    s->cheapest = sunder_i_calloc(n, sizeof *s->cheapest);
    s->carrier = sunder_i_alloc(n, sizeof *s->carrier);
    s->wanted = sunder_i_alloc(n, sizeof *s->wanted);
    s->doubtful = sunder_i_alloc(n, sizeof *s->doubtful);
    s->gave_up = sunder_i_calloc(n, sizeof *s->gave_up);
    s->crowd = sunder_i_calloc(n, sizeof *s->crowd);
    if (!s->wanted || !s->doubtful || !s->gave_up || !s->crowd) return sunder_i_no_memory(err);
    if (!s->improved || !s->cheapest || !s->parent || !s->dirty || !s->widened || !s->reconsidered || !s->carrier ||
        !sunder_i_changes_init(&s->changes, s->model.things))
        return sunder_i_no_memory(err);
    sunder_i_union_init(s->parent, n);
    for (size_t b = 0; b < n; b++) {
        s->carrier[b] = SUNDER_I_NOBODY;
        s->wanted[b] = s->doubtful[b] = true;
    }
    return SUNDER_OK;
}

/* ---- Conflicts and edges ----------------------------------------------------------------------------------------- */

const uint32_t *sunder_i_solver_conflict_roots(sunder_i_solver *s)
{
    const sunder_i_model *model = &s->model;
    if (s->conflict_root) return s->conflict_root;
    uint32_t *root = s->conflict_root = sunder_i_alloc(model->bodies, sizeof *root);
    if (!root) return NULL;
    sunder_i_union_init(root, model->bodies);
    for (size_t k = 0; k < s->start.n; k++) {
        const sunder_i_relation *r = &s->start.pair[k];
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        if (!sunder_i_is_conflict_of_bodies(model, r) || model->body[i].fixed || model->body[j].fixed) continue;
        sunder_i_union_join(root, i, j);
    }
    for (size_t b = 0; b < model->bodies; b++) root[b] = sunder_i_union_find(root, (uint32_t)b);
    return root;
}

/* ---- Clusters ---------------------------------------------------------------------------------------------------- */

bool sunder_i_solver_add_edge(sunder_i_solver *s, uint32_t i, uint32_t j)
{
    if (!sunder_i_reserve(&s->edge, &s->edge_capacity, s->edges + 1, sizeof *s->edge)) return false;
    s->edge[s->edges++] = (sunder_i_id_pair){i, j};
    const bool fi = s->model.body[i].fixed, fj = s->model.body[j].fixed;
    if (!fi) s->dirty[i] = true;
    if (!fj) s->dirty[j] = true;
    if (!fi && !fj) sunder_i_union_join(s->parent, i, j);
    return true;
}

bool sunder_i_solver_has_member(const sunder_i_solver *s, uint32_t root, uint32_t body)
{
    const sunder_i_cluster_member wanted = {root, body};
    return s->members && bsearch(&wanted, s->member, s->members, sizeof wanted, sunder_i_by_id_pair);
}

/* The first member of the cluster of that root, or of a later one. */
static size_t first_member(const sunder_i_solver *s, uint32_t root)
{
    const sunder_i_cluster_member first = {root, 0};
    return sunder_i_lower_bound(&first, s->member, s->members, sizeof first, sunder_i_by_id_pair);
}

const uint32_t *sunder_i_solver_members(const sunder_i_solver *s, uint32_t root, size_t *n)
{
    const size_t first = first_member(s, root);
    *n = first_member(s, root + 1) - first;
    return *n ? s->body + first : NULL;
}

sunder_i_cluster *sunder_i_solver_cluster_with(const sunder_i_solver *s, uint32_t root)
{
    size_t n, low = 0, high = s->clusters;
    const uint32_t *member = sunder_i_solver_members(s, root, &n);
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (s->cluster[middle].body < member)
            low = middle + 1;
        else
            high = middle;
    }
    return n && low < s->clusters && s->cluster[low].body == member ? &s->cluster[low] : NULL;
}

sunder_i_cluster *sunder_i_solver_cluster_of(const sunder_i_solver *s, uint32_t body)
{
    return sunder_i_solver_cluster_with(s, sunder_i_union_find(s->parent, body));
}

/* What is asked beyond the gap so that rounding the moves, and the search's own rounding, cannot eat into it: a
 * power of two, two to four units in the last place of the largest coordinate; four times as much for each failed
 * check. So where a shift keeps coordinates in their binades the search, which reckons from the bodies' own origins,
 * does the same. */
double sunder_i_solver_margin(const sunder_i_solver *s, const uint32_t *b, size_t n)
{
    double largest = 0;
    unsigned widened = 0;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *body = &s->model.body[b[k]];
        if (body->pieces == 0 || body->held) continue;
        for (int c = 0; c < 4; c++) {
            const double far = fabs(body->origin[c & 1]) + fabs(body->box[c]);
            if (far > largest) largest = far;
        }
        if (s->widened[b[k]] > widened) widened = s->widened[b[k]];
    }
    int exponent;
    frexp(largest + sunder_i_max(s->model.rules.gap, s->barriers.farthest), &exponent);
    return ldexp(1, exponent - 51 + 2 * (int)widened);
}

bool sunder_i_solver_any_of(const sunder_i_solver *s, const uint32_t *body, size_t n, const bool *flag)
{
    for (size_t k = 0; k < n; k++)
        if (flag[body[k]] && !s->model.body[body[k]].fixed) return true;
    return false;
}

bool *sunder_i_solver_who_hang_with(const sunder_i_solver *s, const bool *flag)
{
    const sunder_i_body *body = s->model.body;
    bool *root = sunder_i_calloc(s->model.bodies, sizeof *root), *out = sunder_i_calloc(s->model.bodies, sizeof *out);
    for (uint32_t b = 0; b < s->model.bodies && root && out; b++)
        if (flag[b] && !body[b].fixed) root[sunder_i_union_find(s->parent, b)] = true;
    for (uint32_t b = 0; b < s->model.bodies && root && out; b++)
        out[b] = !body[b].fixed && root[sunder_i_union_find(s->parent, b)];
    if (!root) sunder_i_free(out);
    const bool ok = root != NULL;
    sunder_i_free(root);
    return ok ? out : NULL;
}

#ifndef NDEBUG
/* Clusters are disjoint but for fixed bodies, and their members ascend. */
static const char *check(const sunder_i_solver *s)
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

void sunder_i_solver_forget_clusters(sunder_i_solver *s)
{
    free_clusters(s);
    sunder_i_free(s->cluster);
    sunder_i_free(s->move);
    s->cluster = NULL;
    s->move = NULL;
}

/* Room for what comes of so many edges. What is there is lost where it is too small. */
static bool make_room(sunder_i_solver *s)
{
    if (s->room >= s->edges && s->cluster) return true;
    sunder_i_free(s->member);
    sunder_i_free(s->body);
    sunder_i_free(s->move);
    sunder_i_free(s->cluster);
    s->room = s->edges + s->edges / SPARE_ROOM;
    s->member = sunder_i_alloc(2 * s->room, sizeof *s->member);
    s->body = sunder_i_alloc(2 * s->room, sizeof *s->body);
    s->move = sunder_i_alloc(4 * s->room, sizeof *s->move);
    s->cluster = sunder_i_alloc(s->room, sizeof *s->cluster);
    s->listed = SUNDER_I_NONE_LISTED;
    const bool ok = s->member && s->body && s->move && s->cluster;
    if (!ok) s->room = 0; /* some of it is not there */
    return ok;
}

/* The ends of all edges, each by the root of its cluster, and once; unless they are listed, and no edge has come since.
 * False if memory is out. */
static bool list_members(sunder_i_solver *s)
{
    if (s->listed == s->edges) return true;
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
    s->listed = ok ? s->edges : SUNDER_I_NONE_LISTED;
    sunder_i_free(key);
    return ok;
}

/* Many that may go anywhere, and are more than when they began: what a large crowd ran into changes little of where it
 * is best put, unless it is as many as itself. */
static bool is_new_crowd(const sunder_i_solver *s, const sunder_i_cluster *c)
{
    if (!(s->model.rules.effort > 0) || c->limited || c->brief || c->n < CROWD) return false;
    const size_t most = c->n <= LARGE_GROWN_CROWD ? c->n - 1 : c->n / 2;
    for (size_t k = 0; k < c->n; k++)
        if (s->crowd[c->body[k]] > most) return false;
    return true;
}

/* Clusters from the edges, afresh. */
sunder_status sunder_i_solver_gather(sunder_i_solver *s, sunder_error *err)
{
    free_clusters(s);
    if (!make_room(s) || !list_members(s)) {
        s->members = 0;
        return sunder_i_no_memory(err);
    }
    for (size_t first = 0, end; first < s->members; first = end) {
        sunder_i_cluster *c = &s->cluster[s->clusters++];
        *c = (sunder_i_cluster){.touching = true};
        for (end = first; end < s->members && s->member[end].root == s->member[first].root; end++) {
            const sunder_i_body *body = &s->model.body[s->member[end].body];
            c->touching = c->touching && s->widened[s->member[end].body] == 0;
            c->limited =
                c->limited || body->fixed || body->pinned || body->limit < INFINITY || sunder_i_forbids_ways(&s->model);
        }
        c->brief = s->brief;
        c->body = s->body + first;
        c->n = end - first;
        c->margin = sunder_i_solver_margin(s, c->body, c->n);
        c->crowd = is_new_crowd(s, c);
    }
    SUNDER_I_CHECK(check(s), s->members);
    return SUNDER_OK;
}

sunder_status sunder_i_solver_for_clusters(const sunder_i_solver *s, sunder_i_work work, void *context,
                                           sunder_error *err)
{
    size_t *size = sunder_i_alloc(s->clusters, sizeof *size);
    if (!size) return sunder_i_no_memory(err);
    for (size_t k = 0; k < s->clusters; k++) size[k] = s->cluster[k].n;
    const sunder_status status =
        sunder_i_parallel_largest_first(s->model.rules.threads, size, s->clusters, work, context, err);
    sunder_i_free(size);
    return status;
}

sunder_status sunder_i_solver_unite_blocks(sunder_i_solver *s, sunder_error *err)
{
    bool *seen = sunder_i_calloc(s->model.bodies, sizeof *seen);
    uint32_t *body = sunder_i_alloc(s->members, sizeof *body);
    sunder_status status = seen && body ? SUNDER_OK : sunder_i_no_memory(err);
    size_t n = 0;
    for (size_t k = 0; !status && k < s->members; k++) {
        if (!seen[s->body[k]] && sunder_i_cluster_may_want_shape(&s->model, s->body[k])) body[n++] = s->body[k];
        seen[s->body[k]] = true;
    }
    if (!status) status = sunder_i_model_unite(&s->model, body, n, err);
    sunder_i_free(seen);
    sunder_i_free(body);
    return status;
}
