/* What limits and fixed bodies leave no solution for: pairs that no admissible moves can part, found exactly; pairs
 * that a cluster gave up, of which the best is made at the end. */
#include "displacement/job.h"
#include "displacement/peace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

sunder_status sunder_i_job_choose_holders(sunder_i_job *w, sunder_error *err)
{
    if (w->town.kept_n == 0) return SUNDER_OK;
    bool *conflict = sunder_i_calloc(w->start.n, sizeof *conflict);
    if (!conflict) return sunder_i_no_memory(err);
    for (size_t k = 0; k < w->start.n; k++) conflict[k] = sunder_i_job_is_between(&w->town, &w->start.pair[k]);
    const sunder_status status = sunder_i_keep_choose(&w->town, &w->start, conflict, err);
    sunder_i_free(conflict);
    return status;
}

/* In clusters of more bodies than this a pair that its limits cannot part is left as it is: to make the worst of
 * hundreds of such violations least would take hours, and gain nobody anything. */
#define LARGE 50

typedef struct judging {
    const sunder_i_town *town;
    const sunder_i_relations *start;
    const uint32_t *root, *size;
    bool *hopeless; /* [start->n] */
} judging;

static double limit_of(const sunder_i_body *body) { return body->fixed ? 0 : body->limit; }

static sunder_status judge(void *context, size_t begin, size_t end, sunder_error *err)
{
    const judging *g = context;
    const sunder_i_town *town = g->town;
    for (size_t k = begin; k < end; k++) {
        const sunder_i_relation *r = &g->start->pair[k];
        const uint32_t i = town->body_of[r->a], j = town->body_of[r->b];
        const double reach = limit_of(&town->body[i]) + limit_of(&town->body[j]);
        const uint32_t root = town->body[i].fixed ? g->root[j] : g->root[i];
        if (!sunder_i_job_is_between(town, r) || reach == INFINITY || g->size[root] <= LARGE) continue;
        sunder_i_peace peace;
        const sunder_status status =
            sunder_i_make_peace(&town->rules, town->layer->feature[r->a].shape, town->layer->feature[r->b].shape,
                                nextafter(reach, INFINITY), &peace, err);
        if (status) return status;
        g->hopeless[k] = peace.beyond;
    }
    return SUNDER_OK;
}

/* Finds the pairs of large clusters that cannot be parted within their limits; exact. */
sunder_status sunder_i_job_find_hopeless(sunder_i_job *w, sunder_error *err)
{
    sunder_i_town *town = &w->town;
    const size_t n = town->bodies;
    uint32_t *root = sunder_i_alloc(n, sizeof *root), *size = sunder_i_calloc(n, sizeof *size);
    bool *hopeless = sunder_i_calloc(w->start.n, sizeof *hopeless);
    sunder_status status = root && size && hopeless ? SUNDER_OK : sunder_i_no_memory(err);
    if (!status) {
        for (size_t b = 0; b < n; b++) root[b] = (uint32_t)b;
        for (size_t k = 0; k < w->start.n; k++) {
            const sunder_i_relation *r = &w->start.pair[k];
            const uint32_t i = town->body_of[r->a], j = town->body_of[r->b];
            if (!sunder_i_job_is_between(town, r) || town->body[i].fixed || town->body[j].fixed) continue;
            const uint32_t a = sunder_i_union_find(root, i), b = sunder_i_union_find(root, j);
            if (a != b) root[a < b ? b : a] = a < b ? a : b;
        }
        for (size_t b = 0; b < n; b++) root[b] = sunder_i_union_find(root, (uint32_t)b);
        for (size_t b = 0; b < n; b++) size[root[b]]++;
        judging g = {town, &w->start, root, size, hopeless};
        status = sunder_i_parallel(town->rules.threads, w->start.n, 8, judge, &g, err);
    }
    size_t found = 0;
    for (size_t k = 0; !status && k < w->start.n; k++) found += hopeless[k];
    if (!status) town->hopeless = sunder_i_alloc(found, sizeof *town->hopeless);
    if (!status && !town->hopeless) status = sunder_i_no_memory(err);
    for (size_t k = 0; !status && k < w->start.n; k++)
        if (hopeless[k]) town->hopeless[town->hopeless_n++] = (sunder_i_couple){w->start.pair[k].a, w->start.pair[k].b};
    sunder_i_free(root);
    sunder_i_free(size);
    sunder_i_free(hopeless);
    return status;
}

static bool gave_up(const sunder_i_job *w, const sunder_i_cluster *c)
{
    const sunder_i_town *town = &w->town;
    for (size_t k = 0; k < town->given_n; k++)
        if (sunder_i_set_has(c->body, c->n, town->given[k].a) && sunder_i_set_has(c->body, c->n, town->given[k].b))
            return true;
    return false;
}

static sunder_status relax_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_job *w = context;
    for (size_t k = begin; k < end; k++) {
        const sunder_i_cluster *c = &w->cluster[k];
        double *move = w->move + 2 * (size_t)(c->body - w->body);
        sunder_i_job_load_moves(w, c, move);
        if (!gave_up(w, c)) continue;
        const sunder_status status = sunder_i_cluster_relax(&w->town, c, move, err);
        if (status) return status;
    }
    return SUNDER_OK;
}

/* Where two clusters that were relaxed side by side came into conflict, both go back to where they stood before. */
static sunder_status undo_harm(sunder_i_job *w, const double *before, sunder_error *err)
{
    sunder_i_town *town = &w->town;
    bool *back = sunder_i_alloc(town->bodies, sizeof *back);
    sunder_status status = back ? SUNDER_OK : sunder_i_no_memory(err);
    for (bool any = true; any && !status;) {
        any = false;
        memset(back, 0, town->bodies * sizeof *back);
        for (size_t k = 0; k < w->now.n; k++) {
            const sunder_i_relation *r = &w->now.pair[k];
            if (!sunder_i_job_is_between(town, r)) continue;
            const uint32_t pair[2] = {town->body_of[r->a], town->body_of[r->b]};
            for (int e = 0; e < 2; e++)
                if (!town->body[pair[e]].fixed) back[sunder_i_union_find(w->parent, pair[e])] = true;
        }
        for (size_t k = 0; k < w->members; k++) {
            const uint32_t b = w->body[k];
            const double *stood = before + 2 * (size_t)b;
            double *move = w->move + 2 * k;
            memcpy(move, town->move + 2 * (size_t)b, 2 * sizeof *move);
            if (town->body[b].fixed || !back[sunder_i_union_find(w->parent, b)]) continue;
            any = any || memcmp(move, stood, 2 * sizeof *move) != 0;
            memcpy(move, stood, 2 * sizeof *move);
        }
        if (!any) break;
        sunder_i_job_commit(w);
        status = sunder_i_job_check(w, err);
    }
    sunder_i_free(back);
    return status;
}

/* Once nothing joins clusters any more: makes the best of the pairs given up. */
sunder_status sunder_i_job_relax(sunder_i_job *w, sunder_error *err)
{
    if (w->town.given_n == 0) return SUNDER_OK;
    const size_t n = 2 * w->town.bodies;
    double *before = sunder_i_alloc(n, sizeof *before);
    sunder_status status = before ? sunder_i_job_gather(w, err) : sunder_i_no_memory(err);
    if (!status) {
        memcpy(before, w->town.move, n * sizeof *before);
        status = sunder_i_parallel(w->town.rules.threads, w->clusters, 1, relax_clusters, w, err);
    }
    if (!status) {
        sunder_i_job_commit(w);
        status = sunder_i_job_check(w, err);
    }
    if (!status) status = undo_harm(w, before, err);
    sunder_i_free(before);
    return status;
}
