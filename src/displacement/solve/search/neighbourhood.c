/* A search among a few bodies of a cluster: they move, the bodies around them stand, and all others are ignored.
 *
 * When one pair is tried anew in a cluster of hundreds, most of the cluster is irrelevant. So the pair is tried with
 * the bodies that it could run into, the bodies that these could run into, and so on, up to the number that the caller
 * allows. This search does not know bodies farther off; so the moved bodies are checked against all before the result
 * is accepted. */
#include "displacement/solve/search/neighbourhood.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include <string.h>

static void box_at(const sunder_i_search *s, uint32_t i, double grown, double box[4])
{
    const sunder_i_body *b = &s->model->body[s->body[i]], *first = &s->model->body[s->body[0]];
    for (uint32_t c = 0; c < 4; c++)
        box[c] =
            b->box[c] + (b->origin[c & 1] - first->origin[c & 1]) + s->t[2 * i + (c & 1)] + (c < 2 ? -grown : grown);
}

bool sunder_i_neighbourhood_init(sunder_i_neighbourhood *neighbourhood, sunder_i_search *all)
{
    memset(neighbourhood, 0, sizeof *neighbourhood);
    neighbourhood->all = all;
    double *box = sunder_i_alloc(4 * all->n, sizeof *box);
    bool *present = sunder_i_alloc(all->n, sizeof *present);
    neighbourhood->place = sunder_i_alloc(all->n, sizeof *neighbourhood->place);
    neighbourhood->moves = sunder_i_calloc(all->n, sizeof *neighbourhood->moves);
    neighbourhood->body = sunder_i_alloc(all->n, sizeof *neighbourhood->body);
    neighbourhood->t = sunder_i_alloc(2 * all->n, sizeof *neighbourhood->t);
    bool ok = box && present && neighbourhood->place && neighbourhood->moves && neighbourhood->body && neighbourhood->t;
    for (uint32_t i = 0; i < all->n && ok; i++) {
        box_at(all, i, 0, box + 4 * i);
        present[i] = all->model->body[all->body[i]].pieces > 0;
    }
    ok = ok && !sunder_i_rtree_build(box, present, all->n, &neighbourhood->tree, NULL);
    sunder_i_free_all(box, present);
    return ok;
}

void sunder_i_neighbourhood_free(sunder_i_neighbourhood *neighbourhood)
{
    sunder_i_rtree_free(&neighbourhood->tree);
    sunder_i_free_all(neighbourhood->place, neighbourhood->moves, neighbourhood->body, neighbourhood->t,
                      neighbourhood->near.item);
    memset(neighbourhood, 0, sizeof *neighbourhood);
}

/* Stores in neighbourhood->near, ascending, the bodies whose boxes come within `reach` of the box of body i, i itself
 * included. Returns false if memory is out. */
static bool look_about(sunder_i_neighbourhood *neighbourhood, uint32_t i, double reach)
{
    double box[4];
    box_at(neighbourhood->all, i, reach, box);
    neighbourhood->near.n = 0;
    if (!sunder_i_rtree_query(&neighbourhood->tree, box, &neighbourhood->near)) return false;
    neighbourhood->near.n = sunder_i_set_make(neighbourhood->near.item, neighbourhood->near.n);
    return true;
}

/* Adds a movable body to the neighbourhood. SUNDER_I_NOBODY is a body that the search does not contain. */
static void take_in(sunder_i_neighbourhood *v, uint32_t i)
{
    if (i == SUNDER_I_NOBODY || v->moves[i] || !(v->all->mass[i] > 0)) return;
    v->moves[i] = true;
    v->place[v->n++] = i;
}

/* Collects bodies i and j, the bodies within `reach` of these, and so on, up to `most` movable ones; then all fixed and
 * remaining bodies around them, which do not move. v->wider: there would have been more movable ones. */
static bool gather_bodies(sunder_i_neighbourhood *v, uint32_t i, uint32_t j, size_t most, double reach)
{
    v->n = 0;
    v->wider = false;
    take_in(v, i);
    take_in(v, j);
    for (size_t at = 0; at < v->n && !v->wider; at++) {
        if (!look_about(v, v->place[at], reach)) return false;
        for (size_t k = 0; k < v->near.n && !v->wider; k++) {
            v->wider = v->n >= most && !v->moves[v->near.item[k]] && v->all->mass[v->near.item[k]] > 0;
            if (!v->wider) take_in(v, v->near.item[k]);
        }
    }
    v->moving = v->n;
    for (size_t at = 0; at < v->moving; at++) {
        if (!look_about(v, v->place[at], reach)) return false;
        for (size_t k = 0; k < v->near.n; k++) {
            const uint32_t who = v->near.item[k];
            if (v->moves[who]) continue;
            v->moves[who] = true; /* this marks it as listed, for now */
            v->place[v->n++] = who;
        }
    }
    for (size_t k = 0; k < v->n; k++) v->moves[v->place[k]] = k < v->moving;
    return true;
}

/* Begins the search among the collected bodies. It borrows the relaxations and the obstacle cache of the whole
 * search. */
static bool begin_search(sunder_i_neighbourhood *v, sunder_i_search *inner)
{
    sunder_i_search *s = v->all;
    sunder_i_set_make(v->place, v->n);
    for (size_t k = 0; k < v->n; k++) {
        v->body[k] = s->body[v->place[k]];
        memcpy(v->t + 2 * k, s->t + 2 * (size_t)v->place[k], 2 * sizeof *v->t);
    }
    /* Indices ascend, and bodies ascend below s->own and again above it; so they do here. */
    if (!sunder_i_search_init(inner, s->model, v->body, v->n, s->gap - s->model->rules.gap, v->t)) return false;
    inner->own = 0;
    for (size_t k = 0; k < v->n; k++) {
        inner->own += v->place[k] < s->own;
        if (!v->moves[v->place[k]]) inner->mass[k] = 0;
    }
    inner->tolerance = s->tolerance;
    inner->extent = s->extent;
    inner->relaxations = s->relaxations;
    inner->restored = s->restored;
    inner->restored_n = s->restored_n;
    inner->cache = s->cache; /* give_back_cache() returns it */
    memset(&s->cache, 0, sizeof s->cache);
    inner->patience = PATIENCE + PATIENCE_EACH * (uint64_t)v->n;
    return true;
}

/* Returns the cache. This has to happen before the whole search computes obstacles, since that would begin another
 * cache. */
static void give_back_cache(sunder_i_neighbourhood *v, sunder_i_search *inner)
{
    if (inner->cache.slots) v->all->cache = inner->cache;
    memset(&inner->cache, 0, sizeof inner->cache);
}

static void end_search(sunder_i_neighbourhood *v, sunder_i_search *inner)
{
    v->all->steps += inner->steps + inner->program.work;
    v->all->failed = v->all->failed || inner->failed;
    memset(&inner->relaxations, 0, sizeof inner->relaxations);
    inner->restored = NULL;
    give_back_cache(v, inner);
    sunder_i_search_free(inner);
    for (size_t k = 0; k < v->n; k++) v->moves[v->place[k]] = false;
}

/* Do the moved bodies clash with no body of the whole search? */
static bool is_free(sunder_i_neighbourhood *v)
{
    sunder_i_search *s = v->all;
    for (size_t m = 0; m < v->n && !s->failed; m++) {
        const uint32_t i = v->place[m];
        if (!v->moves[i]) continue;
        if (!look_about(v, i, s->gap)) s->failed = true;
        for (size_t k = 0; k < v->near.n && !s->failed; k++) {
            const uint32_t j = v->near.item[k], p = i < j ? i : j, q = i < j ? j : i;
            const double u[2] = {s->t[2 * q] - s->t[2 * p], s->t[2 * q + 1] - s->t[2 * p + 1]};
            bool yields;
            if (i != j && sunder_i_search_pair(s, p, q, u, &yields) > s->tolerance) return false;
        }
    }
    return !s->failed;
}

/* Gives the movable bodies of v->place the moves t[2 * v->n]. */
static void put_bodies(sunder_i_neighbourhood *v, const double *t)
{
    for (size_t k = 0; k < v->n; k++) {
        double box[4];
        if (!v->moves[v->place[k]]) continue;
        memcpy(v->all->t + 2 * (size_t)v->place[k], t + 2 * k, 2 * sizeof *t);
        box_at(v->all, v->place[k], 0, box);
        if (v->all->model->body[v->body[k]].pieces) sunder_i_rtree_move(&v->tree, v->place[k], box);
    }
}

/* Collects the bodies around bodies i and j, and begins the inner search among them. If it returns false, memory is out
 * and the inner search has ended already. */
static bool open_search(sunder_i_neighbourhood *v, uint32_t i, uint32_t j, size_t most, double reach,
                        sunder_i_search *inner)
{
    memset(inner, 0, sizeof *inner);
    if (gather_bodies(v, i, j, most, reach) && begin_search(v, inner)) return true;
    inner->failed = true;
    end_search(v, inner);
    return false;
}

/* Ends the inner search. If it found a layout (`done`), its bodies take their new moves, unless they clash with bodies
 * outside it. Returns whether the bodies have the new moves. */
static bool end_where_it_went(sunder_i_neighbourhood *v, sunder_i_search *inner, bool done)
{
    if (done && !inner->failed) {
        give_back_cache(v, inner);
        put_bodies(v, inner->t);
        done = is_free(v);
        if (!done) put_bodies(v, v->t);
    }
    end_search(v, inner);
    return done && !v->all->failed;
}

bool sunder_i_neighbourhood_settle(sunder_i_neighbourhood *neighbourhood, uint32_t i, uint32_t j, size_t most,
                                   double reach)
{
    sunder_i_search inner;
    if (!open_search(neighbourhood, i, j, most, reach, &inner)) return false;
    bool done = neighbourhood->moving > 0 && sunder_i_search_descend(&inner);
    if (!done && neighbourhood->moving && !inner.failed && sunder_i_search_jump_soon(&inner)) {
        inner.patience += PATIENCE + PATIENCE_EACH * (uint64_t)neighbourhood->n;
        done = sunder_i_search_descend(&inner);
    }
    return end_where_it_went(neighbourhood, &inner, done);
}

bool sunder_i_neighbourhood_repair(sunder_i_neighbourhood *neighbourhood, uint32_t i, uint32_t j, size_t most,
                                   double reach)
{
    sunder_i_search inner;
    if (!open_search(neighbourhood, i, j, most, reach, &inner)) return false;
    inner.patience *= MENDING_TIMES;
    const bool done = neighbourhood->moving > 0 && sunder_i_search_repair(&inner);
    return end_where_it_went(neighbourhood, &inner, done);
}

/* The cost of the movable bodies at t[2 * v->n], minus their cost at `best`, which has moves of all bodies. */
static double costs_more(const sunder_i_neighbourhood *v, const double *t, const double *best)
{
    double sum = 0;
    for (size_t k = 0; k < v->n; k++) {
        const uint32_t i = v->place[k];
        const double *a = v->all->preferred + 2 * (size_t)i, *from = best + 2 * (size_t)i,
                     to[2] = {t[2 * k] - a[0], t[2 * k + 1] - a[1]}, at[2] = {from[0] - a[0], from[1] - a[1]};
        if (v->moves[i]) sum += (to[0] * to[0] + to[1] * to[1] - at[0] * at[0] - at[1] * at[1]) / (2 * v->all->mass[i]);
    }
    return sum;
}

double sunder_i_neighbourhood_descend(sunder_i_neighbourhood *neighbourhood, uint32_t i, uint32_t j, size_t most,
                                      double reach, const double *best, double least)
{
    sunder_i_search inner;
    double gain = 0;
    if (!open_search(neighbourhood, i, j, most, reach, &inner)) return 0;
    for (size_t k = 0; k < neighbourhood->n; k++)
        memcpy(neighbourhood->t + 2 * k, best + 2 * (size_t)neighbourhood->place[k], 2 * sizeof *neighbourhood->t);
    inner.settled = neighbourhood->all->settled;
    inner.patience = inner.steps + SHORT_PATIENCE + SHORT_PATIENCE_EACH * (uint64_t)neighbourhood->n;
    inner.hope = sunder_i_search_cost(&inner, neighbourhood->t);
    if (sunder_i_search_descend(&inner) && !inner.failed) gain = -costs_more(neighbourhood, inner.t, best);
    if (gain > least) {
        give_back_cache(neighbourhood, &inner);
        put_bodies(neighbourhood, inner.t);
        if (!is_free(neighbourhood)) gain = 0;
    }
    if (!(gain > least)) {
        put_bodies(neighbourhood, neighbourhood->t);
        gain = 0;
    }
    end_search(neighbourhood, &inner);
    return gain;
}
