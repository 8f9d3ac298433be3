/* Bodies that are near each other, and neighbours in the relative neighbourhood graph by distance: no third body is
 * nearer to both of them than they are to each other (Toussaint, The relative neighbourhood graph of a finite planar
 * set, Pattern Recognition 12, 1980). */
#include "displacement/rows/row_pairs.h"
#include "displacement/layer/reads.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "base/watch.h"
#include "separation/separation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Near pairs -------------------------------------------------------------------------------------------------- */

/* The pairs found for a run of features. */
typedef struct found {
    sunder_i_row_pair *pair;
    size_t n, capacity;
} found;

typedef struct near_search {
    const sunder_i_model *model;
    const sunder_i_rows_wanted *wanted;
    double reach;
    found *found; /* [(features - 1) / SUNDER_I_GRAIN_TESTS + 1] */
} near_search;

/* May the body be in a pair that is looked for? */
static bool is_wanted(const sunder_i_rows_wanted *w, uint32_t body)
{
    return !w->row || (w->row[body] >= 0 && w->joined[body] < 2);
}

/* May the two, which may be in pairs, be in one? */
static bool are_wanted(const sunder_i_rows_wanted *w, uint32_t i, uint32_t j)
{
    return i != j && (!w->row || (w->row[i] == w->row[j] && w->path[i] != w->path[j]));
}

/* May the feature be in a row that is found, or its body in one that is given? */
static bool may_be_in_row(const near_search *s, uint32_t f)
{
    return is_wanted(s->wanted, s->model->body_of[f]) &&
           (s->wanted->row || !sunder_i_demands_on(s->model, f)->in_no_row);
}

/* Adds the pair of features f and g of different bodies if they are within reach. */
static sunder_status add_if_near(const near_search *s, uint32_t f, uint32_t g, found *to, sunder_error *err)
{
    const uint32_t i = s->model->body_of[f], j = s->model->body_of[g];
    const double home[2] = {0, 0};
    const sunder_shape *p = sunder_i_thing_shape(s->model, f), *q = sunder_i_thing_shape(s->model, g);
    if (sunder_i_surely_apart(p, home, q, home, s->reach)) return SUNDER_OK;
    sunder_i_row_pair pair = {.i = i, .j = j, .f = f, .g = g};
    const sunder_status status = sunder_i_distance(p, home, q, home, &pair.distance, pair.from, pair.to, err);
    if (status || !(pair.distance <= s->reach)) return status;
    if (i > j) {
        pair = (sunder_i_row_pair){j, i, g, f, pair.distance, {pair.to[0], pair.to[1]}, {pair.from[0], pair.from[1]}};
    }
    if (!sunder_i_reserve(&to->pair, &to->capacity, to->n + 1, sizeof pair)) return sunder_i_failure_cause(err);
    to->pair[to->n++] = pair;
    return SUNDER_OK;
}

static sunder_status find_near(void *context, size_t begin, size_t end, sunder_error *err)
{
    const near_search *s = context;
    const sunder_i_model *model = s->model;
    sunder_i_list near = {0};
    sunder_status status = SUNDER_OK;
    for (size_t f = begin; f < end && !status; f++) {
        double box[4];
        if (!model->present[f] || !may_be_in_row(s, (uint32_t)f)) continue;
        near.n = 0;
        sunder_i_box_grow(sunder_i_thing_shape(model, f)->box, s->reach, box);
        if (!sunder_i_look_about(model, &model->tree, box, &near)) status = sunder_i_failure_cause(err);
        for (size_t k = 0; k < near.n && !status; k++) {
            const uint32_t g = near.item[k];
            if (g <= f || sunder_i_is_barrier(model, g) || !may_be_in_row(s, g) ||
                !are_wanted(s->wanted, model->body_of[f], model->body_of[g]))
                continue;
            status = add_if_near(s, (uint32_t)f, g, &s->found[begin / SUNDER_I_GRAIN_TESTS], err);
        }
    }
    sunder_i_free(near.item);
    return status;
}

int sunder_i_row_pair_compare(const sunder_i_row_pair *p, const sunder_i_row_pair *q)
{
    const double values[4][2] = {{p->distance, q->distance},
                                 {p->from[0] + p->to[0], q->from[0] + q->to[0]},
                                 {p->from[1] + p->to[1], q->from[1] + q->to[1]},
                                 {fabs(p->from[0] - p->to[0]), fabs(q->from[0] - q->to[0])}};
    for (int k = 0; k < 4; k++)
        if (values[k][0] != values[k][1]) return values[k][0] < values[k][1] ? -1 : 1;
    return 0;
}

/* Orders pairs by their bodies, those of the same bodies by distance. Pairs at one distance are ordered by the ends of
 * their links, so that numbers of features do not matter. */
static int by_bodies(const void *x, const void *y)
{
    const sunder_i_row_pair *p = x, *q = y;
    int order = sunder_i_by_id_pair(p, q);
    if (!order) order = sunder_i_row_pair_compare(p, q);
    if (order) return order;
    return p->f != q->f ? (p->f < q->f ? -1 : 1) : p->g < q->g ? -1 : p->g > q->g;
}

/* Appends the nearest features of each pair of bodies to `pairs`, which is empty. */
static bool keep_nearest(found *part, size_t parts, sunder_i_row_pairs *pairs)
{
    size_t n = 0;
    for (size_t k = 0; k < parts; k++) n += part[k].n;
    pairs->pair = sunder_i_alloc(n, sizeof *pairs->pair);
    if (!pairs->pair) return false;
    for (size_t k = 0, at = 0; k < parts; at += part[k++].n)
        if (part[k].n) memcpy(pairs->pair + at, part[k].pair, part[k].n * sizeof *pairs->pair);
    if (n) qsort(pairs->pair, n, sizeof *pairs->pair, by_bodies);
    for (size_t k = 0; k < n; k++)
        if (k == 0 || sunder_i_by_id_pair(&pairs->pair[k], &pairs->pair[k - 1]) != 0)
            pairs->pair[pairs->n++] = pairs->pair[k];
    return true;
}

sunder_status sunder_i_row_pairs_find(const sunder_i_model *model, const sunder_i_rows_wanted *wanted,
                                      sunder_i_row_pairs *pairs, sunder_error *err)
{
    const size_t parts = (model->features + SUNDER_I_GRAIN_TESTS - 1) / SUNDER_I_GRAIN_TESTS;
    near_search s = {model, wanted, wanted->reach, sunder_i_calloc(parts, sizeof *s.found)};
    sunder_status status = s.found ? SUNDER_OK : sunder_i_failure_cause(err);
    *pairs = (sunder_i_row_pairs){0};
    if (!status)
        status = sunder_i_parallel(model->rules.threads, model->features, SUNDER_I_GRAIN_TESTS, find_near, &s, err);
    if (!status && !keep_nearest(s.found, parts, pairs)) status = sunder_i_failure_cause(err);
    for (size_t k = 0; s.found && k < parts; k++) sunder_i_free(s.found[k].pair);
    sunder_i_free(s.found);
    return status;
}

/* ---- Neighbours -------------------------------------------------------------------------------------------------- */

/* The bodies near each body. */
typedef struct neighbour {
    double distance;
    uint32_t body;
} neighbour;

typedef struct neighbours {
    neighbour *of; /* those of body i are [end[i - 1], end[i]), the nearest first */
    size_t *end;   /* [bodies] */
} neighbours;

static size_t first_of(const neighbours *n, uint32_t body) { return body ? n->end[body - 1] : 0; }

static int by_distance(const void *x, const void *y)
{
    const neighbour *p = x, *q = y;
    return p->distance != q->distance ? (p->distance < q->distance ? -1 : 1) : p->body < q->body ? -1 : 1;
}

static bool list_neighbours(const sunder_i_row_pairs *pairs, size_t bodies, neighbours *out)
{
    out->of = sunder_i_alloc(2 * pairs->n, sizeof *out->of);
    out->end = sunder_i_calloc(bodies + 1, sizeof *out->end);
    if (!out->of || !out->end) return false;
    /* First end[i + 1] counts the neighbours of i; their sums are where each begins, and these advance to the ends. */
    for (size_t k = 0; k < pairs->n; k++) {
        if (pairs->pair[k].i + 1 < bodies) out->end[pairs->pair[k].i + 1]++;
        if (pairs->pair[k].j + 1 < bodies) out->end[pairs->pair[k].j + 1]++;
    }
    for (size_t i = 1; i < bodies; i++) out->end[i] += out->end[i - 1];
    for (size_t k = 0; k < pairs->n; k++) {
        const sunder_i_row_pair *p = &pairs->pair[k];
        out->of[out->end[p->i]++] = (neighbour){p->distance, p->j};
        out->of[out->end[p->j]++] = (neighbour){p->distance, p->i};
    }
    for (uint32_t i = 0; i < bodies; i++) {
        const size_t first = first_of(out, i), n = out->end[i] - first;
        if (!sunder_i_steps(n)) return false;
        if (n) sunder_i_sort_few(out->of + first, n, sizeof *out->of, by_distance);
    }
    return true;
}

/* The number of neighbours that are compared in one step of the watch. */
#define COMPARED 1024

/* Sets *between to whether a third body is nearer to both bodies of the pair than they are to each other. away: the
 * distance of each body from p->i. Returns false if the work is to stop.
 *
 * Such a body is usually among the nearest neighbours of p->j, which are tried first. */
static bool find_between(const neighbours *n, const double *away, const sunder_i_row_pair *p, bool *between)
{
    const size_t first = first_of(n, p->j);
    size_t k = first;
    while (k < n->end[p->j] && n->of[k].distance < p->distance && !(away[n->of[k].body] < p->distance)) k++;
    *between = k < n->end[p->j] && n->of[k].distance < p->distance;
    return sunder_i_steps(1 + (k - first) / COMPARED);
}

/* Keeps the neighbours among the pairs [begin, end), which have the same i, and appends them to *kept. away: [bodies]
 * INFINITY, as afterwards. */
static bool keep_neighbours(const neighbours *n, double *away, size_t begin, size_t end, sunder_i_row_pair *pair,
                            size_t *kept)
{
    const uint32_t i = pair[begin].i;
    bool ok = true;
    for (size_t k = first_of(n, i); k < n->end[i]; k++) away[n->of[k].body] = n->of[k].distance;
    for (size_t k = begin; k < end && ok; k++) {
        bool between;
        ok = find_between(n, away, &pair[k], &between);
        if (!between) pair[(*kept)++] = pair[k];
    }
    for (size_t k = first_of(n, i); k < n->end[i]; k++) away[n->of[k].body] = INFINITY;
    return ok;
}

bool sunder_i_row_pairs_thin_out(sunder_i_row_pairs *pairs, size_t bodies)
{
    neighbours n = {0};
    double *away = sunder_i_alloc(bodies, sizeof *away);
    bool ok = away && list_neighbours(pairs, bodies, &n);
    size_t kept = 0;
    for (size_t i = 0; away && i < bodies; i++) away[i] = INFINITY;
    for (size_t k = 0, end; k < pairs->n && ok; k = end) {
        for (end = k + 1; end < pairs->n && pairs->pair[end].i == pairs->pair[k].i;) end++;
        ok = keep_neighbours(&n, away, k, end, pairs->pair, &kept);
    }
    pairs->n = kept;
    sunder_i_free_all(n.of, n.end, away);
    return ok;
}
