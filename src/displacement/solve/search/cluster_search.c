/* One cluster as the search sees it: its bodies, where they stand, and what that costs. */
#include "displacement/solve/search/cluster_search.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The mean size of the bodies that are not parts of barriers: how long those are says nothing of how far a
 * body has to go. */
static double mean_extent(const sunder_i_model *model, const uint32_t *body, size_t n)
{
    size_t counted = 0;
    double extent = 0;
    for (size_t k = 0; k < n; k++) counted += !sunder_i_is_barrier_body(model, &model->body[body[k]]);
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *b = &model->body[body[k]];
        if (b->pieces && !sunder_i_is_barrier_body(model, b))
            extent += sunder_i_max(b->box[2] - b->box[0], b->box[3] - b->box[1]) / (double)counted;
    }
    return extent;
}

bool sunder_i_search_init(sunder_i_search *s, const sunder_i_model *model, const uint32_t *body, size_t n,
                          double margin, const double *move)
{
    memset(s, 0, sizeof *s);
    s->model = model;
    s->body = body;
    s->n = s->own = n;
    s->gap = model->rules.gap + margin;
    s->tolerance = margin / 4;
    s->settled = SETTLED;
    s->clashing = MOST_CLASHING;
    s->cap = INFINITY;
    s->patience = UINT64_MAX;
    s->hope = INFINITY;
    s->mass = sunder_i_alloc(n, sizeof *s->mass);
    s->away = sunder_i_calloc(n, sizeof *s->away);
    s->t = sunder_i_alloc(2 * n, sizeof *s->t);
    s->next = sunder_i_alloc(2 * n, sizeof *s->next);
    s->box = sunder_i_alloc(4 * n, sizeof *s->box);
    s->order = sunder_i_alloc(n, sizeof *s->order);
    s->place = n > LARGE_CROWD ? sunder_i_alloc(2 * n, sizeof *s->place) : NULL;
    if (n > LARGE_CROWD && !s->place) return false;
    if (!s->mass || !s->away || !s->t || !s->next || !s->box || !s->order) return false;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *b = &model->body[body[k]];
        s->mass[k] = sunder_i_may_move(b) ? 0.5 / b->weight : 0;
        if (s->place) memcpy(s->place + 2 * k, b->origin, 2 * sizeof *s->place);
    }
    s->extent = mean_extent(model, body, n);
    memcpy(s->t, move, 2 * n * sizeof *s->t);
    s->program.bodies = n;
    s->program.mass = s->mass;
    s->program.t = s->next;
    s->program.place = s->place;
    return true;
}

#ifndef NDEBUG
const char *sunder_i_search_check(const sunder_i_search *s)
{
    for (size_t k = 0; k < s->n; k++) {
        if (k && k != s->own && s->body[k - 1] >= s->body[k]) return "bodies do not ascend";
        if (!(s->mass[k] >= 0) || !isfinite(s->t[2 * k] + s->t[2 * k + 1])) return "a body that stands nowhere";
    }
    for (size_t k = 1; k < s->restored_n; k++)
        if (sunder_i_by_restored(&s->restored[k - 1], &s->restored[k]) >= 0) return "pairs restored are not sorted";
    return NULL;
}
#endif

void sunder_i_search_free(sunder_i_search *s)
{
    sunder_i_free(s->listed);
    sunder_i_free(s->mass);
    sunder_i_free(s->place);
    sunder_i_free(s->away);
    sunder_i_free(s->t);
    sunder_i_free(s->next);
    sunder_i_free(s->box);
    sunder_i_free(s->order);
    sunder_i_free(s->program.constraint);
    sunder_i_free(s->old);
    sunder_i_free(s->clash);
    sunder_i_relaxations_free(&s->relaxations);
    sunder_i_free(s->restored);
    sunder_i_rtree_free(&s->ways);
    sunder_i_free(s->went);
    sunder_i_free(s->about.item);
    sunder_i_free(s->scratch.xy);
    sunder_i_grown_cache_free(&s->grown);
    sunder_i_obstacle_cache_free(&s->cache);
    sunder_i_measures_free(&s->measures);
    sunder_i_obstacles_free(&s->obstacles);
    sunder_i_free(s->shifted);
    memset(s, 0, sizeof *s);
}

double sunder_i_search_limit(const sunder_i_search *s, uint32_t i)
{
    return sunder_i_min(s->cap, s->model->body[s->body[i]].limit);
}

double sunder_i_search_cost(const sunder_i_search *s, const double *t)
{
    double cost = 0;
    for (size_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) cost += (t[2 * k] * t[2 * k] + t[2 * k + 1] * t[2 * k + 1]) / (2 * s->mass[k]);
    return cost;
}

size_t sunder_i_search_movers(const sunder_i_search *s)
{
    size_t movers = 0;
    for (size_t k = 0; k < s->n; k++) movers += s->mass[k] > 0;
    return movers;
}

uint32_t sunder_i_search_place_of(const sunder_i_search *s, uint32_t body)
{
    for (size_t part = 0; part < 2; part++) {
        const uint32_t *set = part ? s->body + s->own : s->body;
        const uint32_t *found = bsearch(&body, set, part ? s->n - s->own : s->own, sizeof body, sunder_i_by_number);
        if (found) return (uint32_t)(found - s->body);
    }
    return SUNDER_I_NOBODY;
}
