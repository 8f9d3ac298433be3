/* The loop: clusters are solved, their moves checked exactly, and what is found makes work for the next round. */
#include "displacement/clusters/settle.h"
#include "displacement/clusters/stages.h"
#include "displacement/clusters/tuning.h"
#include "displacement/layer/resolution.h"
#include "displacement/layer/rounding.h"

#include "base/parallel.h"
#include "base/union_find.h"

#include <string.h>

static bool is_dirty(const sunder_i_solver *s, const sunder_i_cluster *c)
{
    for (size_t k = 0; k < c->n; k++)
        if (s->dirty[c->body[k]]) return true;
    return false;
}

double *sunder_i_solver_load_moves(const sunder_i_solver *s, const sunder_i_cluster *c)
{
    double *move = s->move + 2 * (size_t)(c->body - s->body);
    for (size_t k = 0; k < c->n; k++) {
        const uint32_t b = c->body[k], from = s->carrier[b] == SUNDER_I_NOBODY ? b : s->carrier[b];
        memcpy(move + 2 * k, s->model.move + 2 * (size_t)from, 2 * sizeof *move);
    }
    return move;
}

static sunder_status solve_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_solver *s = context;
    for (size_t k = begin; k < end; k++) {
        sunder_i_cluster *c = &s->cluster[k];
        double *move = sunder_i_solver_load_moves(s, c);
        if (!is_dirty(s, c)) continue;
        const sunder_status status = sunder_i_cluster_solve(&s->model, c, move, err);
        if (status) return status;
    }
    return SUNDER_OK;
}

static bool is_improved(const sunder_i_solver *s, const sunder_i_cluster *c)
{
    for (size_t k = 0; k < c->n; k++)
        if (!s->improved[c->body[k]] && !s->model.body[c->body[k]].fixed) return false;
    return true;
}

bool sunder_i_solver_is_improved(const sunder_i_solver *s)
{
    for (size_t e = 0; e < s->edges; e++)
        for (int k = 0; k < 2; k++) {
            const uint32_t b = k ? s->edge[e].b : s->edge[e].a;
            if (!s->improved[b] && !s->model.body[b].fixed) return false;
        }
    return true;
}

/* What was solved again is to be improved again. */
static void note_solved(sunder_i_solver *s)
{
    for (size_t k = 0; k < s->clusters; k++) {
        const sunder_i_cluster *c = &s->cluster[k];
        if (!is_dirty(s, c)) continue;
        for (size_t m = 0; m < c->n; m++) s->improved[c->body[m]] = false;
    }
}

static sunder_status improve_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_solver *s = context;
    for (size_t k = begin; k < end; k++) {
        const sunder_i_cluster *c = &s->cluster[k];
        double *move = sunder_i_solver_load_moves(s, c);
        if (is_improved(s, c)) continue;
        const sunder_status status = sunder_i_cluster_improve(&s->model, c, move, err);
        if (status) return status;
    }
    return SUNDER_OK;
}

void sunder_i_solver_place(sunder_i_solver *s, uint32_t b, const double *to)
{
    sunder_i_model *model = &s->model;
    const sunder_i_body *body = &model->body[b];
    double *move = model->move + 2 * (size_t)b, exact_move[2];
    if (body->fixed || memcmp(move, to, 2 * sizeof *move) == 0) return;
    memcpy(move, to, 2 * sizeof *move);
    const bool exact = sunder_i_round_move(model, b, move, exact_move, NULL);
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        s->changed[f] = true;
        model->inexact[f] = !exact;
    }
}

void sunder_i_solver_commit(sunder_i_solver *s)
{
    memset(s->changed, 0, s->model.features * sizeof *s->changed);
    for (size_t k = 0; k < s->members; k++) sunder_i_solver_place(s, s->body[k], s->move + 2 * k);
}

/* Exact relations of what changed. */
sunder_status sunder_i_solver_relate(sunder_i_solver *s, sunder_error *err)
{
    sunder_status status = sunder_i_placement_move(&s->model, &s->placement, s->changed, err);
    if (status) return status;
    sunder_i_relations now;
    status = sunder_i_placement_relate(&s->model, &s->placement, s->changed, &s->now, &now, err);
    if (status) return status;
    sunder_i_free(s->now.pair);
    s->now = now;
    return SUNDER_OK;
}

/* What has not moved yet and is cut by the edge of its holder, which has: it starts from where the holder would carry
 * it, so that the cluster begins from a position without conflicts. */
static void carry(sunder_i_solver *s, uint32_t f, uint32_t g)
{
    const sunder_i_model *model = &s->model;
    sunder_i_inclusion_state state;
    for (int e = 0; e < 2; e++) {
        const uint32_t holder = model->body_of[e ? g : f], inner = model->body_of[e ? f : g];
        const double *t = model->move + 2 * (size_t)holder, *own = model->move + 2 * (size_t)inner;
        if (sunder_i_keeps_inside(model, e ? g : f, e ? f : g, &state) && own[0] == 0 && own[1] == 0 &&
            sunder_i_may_move(&model->body[inner]) && sunder_i_is_within_limit(t, model->body[inner].limit))
            s->carrier[inner] = holder;
    }
}

/* Are the two in one cluster? A fixed body is in those that were last gathered with it: edges added since then are not
 * known, and may be added again. */
static bool are_together(const sunder_i_solver *s, uint32_t i, uint32_t j)
{
    const bool fixed = s->model.body[i].fixed || s->model.body[j].fixed;
    if (!fixed) return sunder_i_union_find(s->parent, i) == sunder_i_union_find(s->parent, j);
    const uint32_t still = s->model.body[i].fixed ? i : j, other = still == i ? j : i;
    return sunder_i_solver_has_member(s, sunder_i_union_find(s->parent, other), still);
}

/* A relaxation between bodies of different clusters is not in the way of either, unless it was broken. */
static sunder_status heed_relaxation(sunder_i_solver *s, const sunder_i_relation *r, bool *any, sunder_error *err)
{
    const uint32_t i = s->model.body_of[r->a], j = s->model.body_of[r->b];
    bool worse;
    if (are_together(s, i, j)) return SUNDER_OK;
    const sunder_status status = sunder_i_solver_is_worse(s, r, &worse, err);
    if (status || !worse) return status;
    *any = true;
    return sunder_i_solver_add_edge(s, i, j) ? SUNDER_OK : sunder_i_no_memory(err);
}

/* Conflicts as the features stand make bodies dirty: by a new edge between clusters, or a wider margin within one.
 * Returns whether there is anything to do. */
static sunder_status find_work(sunder_i_solver *s, bool *any, sunder_error *err)
{
    sunder_i_model *model = &s->model;
    memset(s->dirty, 0, model->bodies * sizeof *s->dirty);
    *any = false;
    for (size_t k = 0; k < s->now.n; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        const bool fi = model->body[i].fixed;
        if (s->aside && (s->aside[i] || s->aside[j])) continue;
        if (!sunder_i_is_conflict(r) || i == j) continue;
        if (!sunder_i_may_move(&model->body[i]) && !sunder_i_may_move(&model->body[j])) continue;
        if (sunder_i_relaxations_find(&model->relaxations, r->a, r->b)) {
            const sunder_status status = heed_relaxation(s, r, any, err);
            if (status) return status;
            continue;
        }
        if (!are_together(s, i, j)) {
            if (!sunder_i_solver_add_edge(s, i, j)) return sunder_i_no_memory(err);
            carry(s, r->a, r->b);
            *any = true;
            continue;
        }
        const uint32_t b = fi ? j : i;
        /* What lay in another, and was not kept inside. */
        sunder_i_inclusion *inclusion = sunder_i_inclusion_find(model, r->a, r->b);
        if (inclusion && inclusion->state != SUNDER_I_LAPSED) {
            inclusion->state++;
            s->dirty[b] = *any = true;
            continue;
        }
        if (s->widened[b] >= MOST_MARGINS) continue;
        if (s->dirty[b] && s->widened[b]) continue; /* once a round */
        s->widened[b]++;
        s->dirty[b] = *any = true;
    }
    return SUNDER_OK;
}

sunder_status sunder_i_solver_unite_blocks(sunder_i_solver *s, sunder_error *err)
{
    bool *seen = sunder_i_calloc(s->model.bodies, sizeof *seen);
    uint32_t *body = sunder_i_alloc(s->members, sizeof *body);
    sunder_status status = seen && body ? SUNDER_OK : sunder_i_no_memory(err);
    size_t n = 0;
    for (size_t k = 0; !status && k < s->members; k++) {
        if (!seen[s->body[k]]) body[n++] = s->body[k];
        seen[s->body[k]] = true;
    }
    if (!status) status = sunder_i_model_unite(&s->model, body, n, err);
    sunder_i_free(seen);
    sunder_i_free(body);
    return status;
}

sunder_status sunder_i_solver_settle(sunder_i_solver *s, double from, double to, sunder_error *err)
{
    bool any;
    sunder_status status = find_work(s, &any, err);
    for (size_t round = 0; !status && any; round++) {
        if (!sunder_i_progress(&s->model.rules, from + (to - from) * (1 - 1 / (1 + 0.25 * (double)round))))
            return sunder_i_cancelled(err);
        status = sunder_i_solver_gather(s, err);
        if (!status) status = sunder_i_solver_unite_blocks(s, err);
        if (!status) status = sunder_i_parallel(s->model.rules.threads, s->clusters, 1, solve_clusters, s, err);
        if (status) return status;
        sunder_i_solver_commit(s);
        note_solved(s);
        for (size_t k = 0; k < s->members; k++) s->carrier[s->body[k]] = SUNDER_I_NOBODY;
        status = sunder_i_solver_take_over(s, err);
        if (!status) status = sunder_i_solver_relate(s, err);
        if (!status) status = find_work(s, &any, err);
    }
    return status;
}

static sunder_status invite_to_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_solver *s = context;
    for (size_t k = begin; k < end; k++) {
        sunder_i_cluster *c = &s->cluster[k];
        double *move = sunder_i_solver_load_moves(s, c);
        if (!is_improved(s, c) && !sunder_i_cluster_invite(&s->model, c, move)) return sunder_i_no_memory(err);
    }
    return SUNDER_OK;
}

/* Whoever is in the way of a cluster joins it. */
static sunder_status join_guests(sunder_i_solver *s, sunder_error *err)
{
    bool any = false;
    sunder_status status = sunder_i_parallel(s->model.rules.threads, s->clusters, 1, invite_to_clusters, s, err);
    for (size_t k = 0; k < s->clusters && !status; k++)
        for (size_t g = 0; g < s->cluster[k].guests && !status; g++) {
            const sunder_i_id_pair *pair = &s->cluster[k].guest[g];
            any = true;
            if (!sunder_i_solver_add_edge(s, pair->a, pair->b)) status = sunder_i_no_memory(err);
        }
    return status || !any ? status : sunder_i_solver_gather(s, err);
}

sunder_status sunder_i_solver_improve(sunder_i_solver *s, sunder_error *err)
{
    sunder_status status = sunder_i_solver_gather(s, err);
    if (!status) status = join_guests(s, err);
    if (!status) status = sunder_i_solver_unite_blocks(s, err);
    if (!status) status = sunder_i_parallel(s->model.rules.threads, s->clusters, 1, improve_clusters, s, err);
    if (status) return status;
    sunder_i_solver_commit(s);
    for (size_t k = 0; k < s->members; k++) s->improved[s->body[k]] = true;
    return sunder_i_solver_relate(s, err);
}
