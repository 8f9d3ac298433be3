/* One cluster as the search sees it: its bodies, where they stand, and what that costs. */
#include "displacement/solve/search/cluster_search.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The mean size of the bodies that may move. The size of others says nothing about how far a body has to move: a
 * barrier may be long, and a fixed feature may have one corrupt vertex a thousand kilometres away. */
static double mean_extent(const sunder_i_model *model, const uint32_t *body, size_t n)
{
    size_t counted = 0;
    double extent = 0;
    for (size_t k = 0; k < n; k++) counted += !model->body[body[k]].fixed;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *b = &model->body[body[k]];
        if (b->pieces && !b->fixed)
            extent += sunder_i_max(b->box[2] - b->box[0], b->box[3] - b->box[1]) / (double)counted;
    }
    return extent;
}

bool sunder_i_search_init(sunder_i_search *search, const sunder_i_model *model, const uint32_t *body, size_t n,
                          double margin, const double *move)
{
    memset(search, 0, sizeof *search);
    search->model = model;
    search->body = body;
    search->n = search->own = n;
    search->gap = model->rules.gap + margin;
    search->tolerance = margin / 4;
    search->settled = SETTLED;
    search->cap = INFINITY;
    search->patience = UINT64_MAX;
    search->hope = INFINITY;
    search->mass = sunder_i_alloc(n, sizeof *search->mass);
    search->away = sunder_i_calloc(n, sizeof *search->away);
    search->preferred = sunder_i_calloc(2 * n, sizeof *search->preferred);
    search->t = sunder_i_alloc(2 * n, sizeof *search->t);
    search->next = sunder_i_alloc(2 * n, sizeof *search->next);
    search->box = sunder_i_alloc(4 * n, sizeof *search->box);
    search->order = sunder_i_alloc(n, sizeof *search->order);
    search->place = n > LARGE_CROWD ? sunder_i_alloc(2 * n, sizeof *search->place) : NULL;
    if (n > LARGE_CROWD && !search->place) return false;
    if (!search->mass || !search->away || !search->preferred || !search->t || !search->next || !search->box ||
        !search->order)
        return false;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *b = &model->body[body[k]];
        search->mass[k] = sunder_i_may_move(b) ? 0.5 / b->weight : 0;
        if (search->mass[k] > 0)
            memcpy(search->preferred + 2 * k, sunder_i_preferred(model, body[k]), 2 * sizeof *move);
        if (search->place) memcpy(search->place + 2 * k, b->origin, 2 * sizeof *search->place);
    }
    search->extent = mean_extent(model, body, n);
    memcpy(search->t, move, 2 * n * sizeof *search->t);
    search->program.bodies = n;
    search->program.mass = search->mass;
    search->program.preferred = model->preferred ? search->preferred : NULL;
    search->program.t = search->next;
    search->program.place = search->place;
    return true;
}

#ifndef NDEBUG
const char *sunder_i_search_check(const sunder_i_search *search)
{
    for (size_t k = 0; k < search->n; k++) {
        if (k && k != search->own && search->body[k - 1] >= search->body[k]) return "bodies do not ascend";
        if (!(search->mass[k] >= 0) || !isfinite(search->t[2 * k] + search->t[2 * k + 1]))
            return "a body that stands nowhere";
    }
    for (size_t k = 1; k < search->restored_n; k++)
        if (sunder_i_by_restored(&search->restored[k - 1], &search->restored[k]) >= 0)
            return "pairs restored are not sorted";
    return NULL;
}
#endif

void sunder_i_search_free(sunder_i_search *search)
{
    sunder_i_free_all(search->listed, search->mass, search->place, search->away, search->preferred, search->t,
                      search->next, search->box, search->order, search->program.constraint, search->old, search->clash);
    sunder_i_relaxations_free(&search->relaxations);
    sunder_i_free(search->restored);
    sunder_i_rtree_free(&search->visited);
    sunder_i_free_all(search->visited_at, search->about.item, search->scratch.xy, search->shortfall,
                      search->creditor.item, search->member, search->tight);
    sunder_i_grown_cache_free(&search->grown);
    sunder_i_obstacle_cache_free(&search->cache);
    sunder_i_measures_free(&search->measures);
    sunder_i_obstacles_free(&search->obstacles);
    sunder_i_free(search->shifted);
    memset(search, 0, sizeof *search);
}

double sunder_i_search_stray(const sunder_i_search *search, size_t k)
{
    const double *t = search->t + 2 * k, *a = search->preferred + 2 * k;
    return hypot(t[0] - a[0], t[1] - a[1]);
}

double sunder_i_search_stray_square(const sunder_i_search *search, size_t k, const double *t)
{
    const double *a = search->preferred + 2 * k, x = t[2 * k] - a[0], y = t[2 * k + 1] - a[1];
    return x * x + y * y;
}

double sunder_i_search_limit(const sunder_i_search *search, uint32_t i)
{
    return sunder_i_min(search->cap, search->model->body[search->body[i]].limit);
}

bool sunder_i_search_next_row(const sunder_i_search *search, sunder_i_row_walk *walk, sunder_i_row_link *link)
{
    const sunder_i_model *model = search->model;
    for (; model->row_sides && walk->i < search->n; walk->i++, walk->k = 0) {
        const sunder_i_extras *has = model->body[search->body[walk->i]].has;
        while (walk->k < has->row_sides) {
            const sunder_i_row_side *side = model->row_side + has->row_side + walk->k++;
            const uint32_t j = sunder_i_search_place_of(search, side->other);
            const bool is_listed = j != SUNDER_I_NOBODY;
            if (is_listed ? j < walk->i || !(search->mass[walk->i] + search->mass[j] > 0)
                          : !(search->mass[walk->i] > 0))
                continue;
            *link = (sunder_i_row_link){walk->i, is_listed ? j : SUNDER_I_GROUND, model->move + 2 * (size_t)side->other,
                                        side};
            return true;
        }
    }
    return false;
}

double *sunder_i_search_copy_moves(sunder_i_search *search)
{
    double *copy = search->failed ? NULL : sunder_i_alloc(2 * search->n, sizeof *copy);
    search->failed = !copy;
    if (copy) memcpy(copy, search->t, 2 * search->n * sizeof *copy);
    return copy;
}

void sunder_i_search_end_copy(sunder_i_search *search, double *copy, bool back)
{
    if (copy && back) memcpy(search->t, copy, 2 * search->n * sizeof *copy);
    sunder_i_free(copy);
}

size_t sunder_i_search_movers(const sunder_i_search *search)
{
    size_t movers = 0;
    for (size_t k = 0; k < search->n; k++) movers += search->mass[k] > 0;
    return movers;
}

uint32_t sunder_i_search_place_of(const sunder_i_search *search, uint32_t body)
{
    for (size_t half = 0; half < 2; half++) {
        const uint32_t *set = half ? search->body + search->own : search->body;
        const uint32_t *found =
            bsearch(&body, set, half ? search->n - search->own : search->own, sizeof body, sunder_i_by_number);
        if (found) return (uint32_t)(found - search->body);
    }
    return SUNDER_I_NOBODY;
}

void sunder_i_search_path_box(const sunder_i_search *search, const double *t, uint32_t k, double box[4])
{
    const sunder_i_body *b = &search->model->body[search->body[k]], *first = &search->model->body[search->body[0]];
    for (uint32_t c = 0; c < 4; c++) {
        const double home = b->box[c] + (b->origin[c & 1] - first->origin[c & 1]), at = t[2 * k + (c & 1)];
        box[c] = home + (c < 2 ? sunder_i_min(at, 0) : sunder_i_max(at, 0));
    }
}
