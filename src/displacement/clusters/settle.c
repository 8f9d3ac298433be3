/* The loop: clusters are solved, their moves checked exactly, and what is found makes work for the next round. */
#include "displacement/clusters/settle.h"
#include "displacement/clusters/stages.h"
#include "displacement/layer/inclusion.h"
#include "displacement/layer/resolution.h"
#include "displacement/layer/rounding.h"

#include "base/parallel.h"
#include "base/union_find.h"

#include <string.h>

#define MOST_MARGINS 14

bool sunder_i_job_is_dirty(const sunder_i_job *w, const sunder_i_cluster *c)
{
    for (size_t k = 0; k < c->n; k++)
        if (w->dirty[c->body[k]]) return true;
    return false;
}

void sunder_i_job_load_moves(const sunder_i_job *w, const sunder_i_cluster *c, double *move)
{
    for (size_t k = 0; k < c->n; k++) {
        const uint32_t b = c->body[k], from = w->carrier[b] == SUNDER_I_NOBODY ? b : w->carrier[b];
        memcpy(move + 2 * k, w->town.move + 2 * (size_t)from, 2 * sizeof *move);
    }
}

static sunder_status solve_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_job *w = context;
    for (size_t k = begin; k < end; k++) {
        sunder_i_cluster *c = &w->cluster[k];
        double *move = w->move + 2 * (size_t)(c->body - w->body);
        sunder_i_job_load_moves(w, c, move);
        if (!sunder_i_job_is_dirty(w, c)) continue;
        const sunder_status status = sunder_i_cluster_solve(&w->town, c, move, err);
        if (status) return status;
    }
    return SUNDER_OK;
}

static bool is_improved(const sunder_i_job *w, const sunder_i_cluster *c)
{
    for (size_t k = 0; k < c->n; k++)
        if (!w->improved[c->body[k]] && !w->town.body[c->body[k]].fixed) return false;
    return true;
}

bool sunder_i_job_is_improved(const sunder_i_job *w)
{
    for (size_t e = 0; e < w->edges; e++)
        for (int k = 0; k < 2; k++) {
            const uint32_t b = k ? w->edge[e].b : w->edge[e].a;
            if (!w->improved[b] && !w->town.body[b].fixed) return false;
        }
    return true;
}

/* What was solved again is to be improved again. */
static void note_solved(sunder_i_job *w)
{
    for (size_t k = 0; k < w->clusters; k++) {
        const sunder_i_cluster *c = &w->cluster[k];
        if (!sunder_i_job_is_dirty(w, c)) continue;
        for (size_t m = 0; m < c->n; m++) w->improved[c->body[m]] = false;
    }
}

static sunder_status improve_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_job *w = context;
    for (size_t k = begin; k < end; k++) {
        const sunder_i_cluster *c = &w->cluster[k];
        double *move = w->move + 2 * (size_t)(c->body - w->body);
        sunder_i_job_load_moves(w, c, move);
        if (is_improved(w, c)) continue;
        const sunder_status status = sunder_i_cluster_improve(&w->town, c, move, err);
        if (status) return status;
    }
    return SUNDER_OK;
}

void sunder_i_job_place(sunder_i_job *w, uint32_t b, const double *to)
{
    sunder_i_town *town = &w->town;
    const sunder_i_body *body = &town->body[b];
    double *move = town->move + 2 * (size_t)b, exact_move[2];
    if (body->fixed || memcmp(move, to, 2 * sizeof *move) == 0) return;
    memcpy(move, to, 2 * sizeof *move);
    const bool exact = sunder_i_round_move(town, b, move, exact_move, NULL);
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = town->member[body->member + m];
        w->changed[f] = true;
        town->inexact[f] = !exact;
    }
}

void sunder_i_job_commit(sunder_i_job *w)
{
    memset(w->changed, 0, w->town.features * sizeof *w->changed);
    for (size_t k = 0; k < w->members; k++) sunder_i_job_place(w, w->body[k], w->move + 2 * k);
}

/* Exact relations of what changed. */
sunder_status sunder_i_job_check(sunder_i_job *w, sunder_error *err)
{
    sunder_status status = sunder_i_scene_move(&w->town, &w->scene, w->changed, err);
    if (status) return status;
    sunder_i_relations now;
    status = sunder_i_scene_relate(&w->town, &w->scene, w->changed, &w->now, &now, err);
    if (status) return status;
    sunder_i_free(w->now.pair);
    w->now = now;
    return SUNDER_OK;
}

bool sunder_i_job_is_conflict(const sunder_i_town *town, const sunder_i_relation *r)
{
    return !sunder_i_is_at_peace(r) && town->body_of[r->a] != town->body_of[r->b];
}

bool sunder_i_job_is_between(const sunder_i_town *town, const sunder_i_relation *r)
{
    return sunder_i_job_is_conflict(town, r) && !sunder_i_truces_find(&town->truces, r->a, r->b);
}

/* What has not moved yet and is cut by the edge of its holder, which has: it starts from where the holder would carry
 * it, so that the cluster begins from a position without conflicts. */
static void carry(sunder_i_job *w, uint32_t f, uint32_t g)
{
    const sunder_i_town *town = &w->town;
    sunder_i_keeping keeping;
    for (int e = 0; e < 2; e++) {
        const uint32_t holder = town->body_of[e ? g : f], inner = town->body_of[e ? f : g];
        const double *t = town->move + 2 * (size_t)holder, *own = town->move + 2 * (size_t)inner;
        if (sunder_i_holds(town, e ? g : f, e ? f : g, &keeping) && own[0] == 0 && own[1] == 0 &&
            !town->body[inner].fixed && !town->body[inner].pinned && sunder_i_within(t, town->body[inner].limit))
            w->carrier[inner] = holder;
    }
}

/* Are the two in one cluster? A fixed body is in those that were last gathered with it: edges added since then are not
 * known, and may be added again. */
static bool are_together(const sunder_i_job *w, uint32_t i, uint32_t j)
{
    const bool fixed = w->town.body[i].fixed || w->town.body[j].fixed;
    if (!fixed) return sunder_i_union_find(w->parent, i) == sunder_i_union_find(w->parent, j);
    const uint32_t still = w->town.body[i].fixed ? i : j, other = still == i ? j : i;
    return sunder_i_job_has_member(w, sunder_i_union_find(w->parent, other), still);
}

/* A truce between bodies of different clusters is not in the way of either, unless it was broken. */
static sunder_status heed_truce(sunder_i_job *w, const sunder_i_relation *r, bool *any, sunder_error *err)
{
    const uint32_t i = w->town.body_of[r->a], j = w->town.body_of[r->b];
    bool worse;
    if (are_together(w, i, j)) return SUNDER_OK;
    const sunder_status status = sunder_i_job_is_worse(w, r, &worse, err);
    if (status || !worse) return status;
    *any = true;
    return sunder_i_job_add_edge(w, i, j) ? SUNDER_OK : sunder_i_no_memory(err);
}

/* Conflicts as the features stand make bodies dirty: by a new edge between clusters, or a wider margin within one.
 * Returns whether there is anything to do. */
static sunder_status find_work(sunder_i_job *w, bool *any, sunder_error *err)
{
    sunder_i_town *town = &w->town;
    memset(w->dirty, 0, town->bodies * sizeof *w->dirty);
    *any = false;
    for (size_t k = 0; k < w->now.n; k++) {
        const sunder_i_relation *r = &w->now.pair[k];
        const uint32_t i = town->body_of[r->a], j = town->body_of[r->b];
        const bool fi = town->body[i].fixed, fj = town->body[j].fixed;
        if (w->aside && (w->aside[i] || w->aside[j])) continue;
        if (sunder_i_is_at_peace(r) || i == j) continue;
        if ((fi || town->body[i].pinned) && (fj || town->body[j].pinned)) continue;
        if (sunder_i_truces_find(&town->truces, r->a, r->b)) {
            const sunder_status status = heed_truce(w, r, any, err);
            if (status) return status;
            continue;
        }
        if (!are_together(w, i, j)) {
            if (!sunder_i_job_add_edge(w, i, j)) return sunder_i_no_memory(err);
            carry(w, r->a, r->b);
            *any = true;
            continue;
        }
        const uint32_t b = fi ? j : i;
        /* What lay in another, and was not kept inside. */
        const size_t kept = sunder_i_kept_at(town, r->a, r->b);
        if (kept < town->kept_n && town->keeping[kept] != SUNDER_I_LAPSED) {
            town->keeping[kept]++;
            w->dirty[b] = *any = true;
            continue;
        }
        if (w->widened[b] >= MOST_MARGINS) continue;
        if (w->dirty[b] && w->widened[b]) continue; /* once a round */
        w->widened[b]++;
        w->dirty[b] = *any = true;
    }
    return SUNDER_OK;
}

sunder_status sunder_i_job_unite_blocks(sunder_i_job *w, sunder_error *err)
{
    bool *seen = sunder_i_calloc(w->town.bodies, sizeof *seen);
    uint32_t *body = sunder_i_alloc(w->members, sizeof *body);
    sunder_status status = seen && body ? SUNDER_OK : sunder_i_no_memory(err);
    size_t n = 0;
    for (size_t k = 0; !status && k < w->members; k++) {
        if (!seen[w->body[k]]) body[n++] = w->body[k];
        seen[w->body[k]] = true;
    }
    if (!status) status = sunder_i_town_unite(&w->town, body, n, err);
    sunder_i_free(seen);
    sunder_i_free(body);
    return status;
}

sunder_status sunder_i_job_settle(sunder_i_job *w, double from, double to, sunder_error *err)
{
    bool any;
    sunder_status status = find_work(w, &any, err);
    for (size_t round = 0; !status && any; round++) {
        if (!sunder_i_progress(&w->town.rules, from + (to - from) * (1 - 1 / (1 + 0.25 * (double)round))))
            return sunder_i_cancelled(err);
        status = sunder_i_job_gather(w, err);
        if (!status) status = sunder_i_job_unite_blocks(w, err);
        if (!status) status = sunder_i_parallel(w->town.rules.threads, w->clusters, 1, solve_clusters, w, err);
        if (status) return status;
        sunder_i_job_commit(w);
        note_solved(w);
        for (size_t k = 0; k < w->members; k++) w->carrier[w->body[k]] = SUNDER_I_NOBODY;
        status = sunder_i_job_note_truces(w, err);
        if (!status) status = sunder_i_job_check(w, err);
        if (!status) status = find_work(w, &any, err);
    }
    return status;
}

static sunder_status invite_to_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_job *w = context;
    for (size_t k = begin; k < end; k++) {
        sunder_i_cluster *c = &w->cluster[k];
        double *move = w->move + 2 * (size_t)(c->body - w->body);
        sunder_i_job_load_moves(w, c, move);
        if (!is_improved(w, c) && !sunder_i_cluster_invite(&w->town, c, move)) return sunder_i_no_memory(err);
    }
    return SUNDER_OK;
}

/* Whoever is in the way of a cluster joins it. */
static sunder_status join_guests(sunder_i_job *w, sunder_error *err)
{
    bool any = false;
    sunder_status status = sunder_i_parallel(w->town.rules.threads, w->clusters, 1, invite_to_clusters, w, err);
    for (size_t k = 0; k < w->clusters && !status; k++)
        for (size_t g = 0; g < w->cluster[k].guests && !status; g++) {
            const sunder_i_couple *pair = &w->cluster[k].guest[g];
            any = true;
            if (!sunder_i_job_add_edge(w, pair->a, pair->b)) status = sunder_i_no_memory(err);
        }
    return status || !any ? status : sunder_i_job_gather(w, err);
}

sunder_status sunder_i_job_improve(sunder_i_job *w, sunder_error *err)
{
    sunder_status status = sunder_i_job_gather(w, err);
    if (!status) status = join_guests(w, err);
    if (!status) status = sunder_i_job_unite_blocks(w, err);
    if (!status) status = sunder_i_parallel(w->town.rules.threads, w->clusters, 1, improve_clusters, w, err);
    if (status) return status;
    sunder_i_job_commit(w);
    for (size_t k = 0; k < w->members; k++) w->improved[w->body[k]] = true;
    return sunder_i_job_check(w, err);
}
