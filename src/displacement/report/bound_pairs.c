/* Chooses the pairs that the lower bound uses, and measures for each the least relative move that separates it. */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/report/report.h"

#include "base/parallel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct measuring {
    const sunder_i_model *model;
    sunder_bound_pair *pair;
    const sunder_bound_pair *known; /* [known_n] pairs whose least relative move was measured during the search; sorted
                                     * by pair */
    size_t known_n;
} measuring;

static int by_pair(const void *a, const void *b)
{
    const sunder_bound_pair *p = a, *q = b;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

static sunder_status measure_pairs(void *context, size_t begin, size_t end, sunder_error *err)
{
    const measuring *m = context;
    for (size_t k = begin; k < end; k++) {
        sunder_i_resolution resolution;
        const sunder_bound_pair *known =
            m->known_n ? bsearch(&m->pair[k], m->known, m->known_n, sizeof *known, by_pair) : NULL;
        if (known) {
            m->pair[k].least = known->least;
            continue;
        }
        const sunder_status status =
            sunder_i_resolve_things(m->model, m->pair[k].a, m->pair[k].b, INFINITY, &resolution, err);
        if (status) return status;
        m->pair[k].least = resolution.least;
    }
    return SUNDER_OK;
}

/* Measures the least relative move of n pairs; those that the solver has measured are looked up. */
static sunder_status measure_all(const sunder_i_solver *s, sunder_bound_pair *pair, size_t n, sunder_error *err)
{
    sunder_bound_pair *known = sunder_i_alloc(s->measured_n, sizeof *known);
    if (!known) return sunder_i_failure_cause(err);
    if (s->measured_n) memcpy(known, s->measured, s->measured_n * sizeof *known);
    if (s->measured_n) qsort(known, s->measured_n, sizeof *known, by_pair);
    measuring m = {&s->model, pair, known, s->measured_n};
    const sunder_status status =
        sunder_i_parallel(s->model.rules.threads, n, SUNDER_I_GRAIN_PAIRS, measure_pairs, &m, err);
    sunder_i_free(known);
    return status;
}

typedef struct key_pair {
    uint64_t bodies;
    size_t at;
} key_pair;

static int by_bodies(const void *a, const void *b)
{
    const key_pair *p = a, *q = b;
    if (p->bodies != q->bodies) return p->bodies < q->bodies ? -1 : 1;
    return p->at < q->at ? -1 : p->at > q->at;
}

static uint64_t bodies_of(const sunder_i_model *model, size_t a, size_t b)
{
    const uint32_t i = model->body_of[a], j = model->body_of[b];
    return i < j ? (uint64_t)i << 32 | j : (uint64_t)j << 32 | i;
}

/* Returns whether the features of r, or the feature and any part of its barrier, are still in conflict in the
 * result. */
static bool is_left(const sunder_i_solver *s, const sunder_i_relation *r)
{
    const sunder_i_relation key = {.a = r->a, .b = sunder_i_whole_of(&s->model, r->b)};
    size_t k = sunder_i_lower_bound(&key, s->now.pair, s->now.n, sizeof key, sunder_i_by_id_pair);
    for (; k < s->now.n && s->now.pair[k].a == key.a && sunder_i_whole_of(&s->model, s->now.pair[k].b) == key.b; k++)
        if (sunder_i_is_conflict(&s->now.pair[k])) return true;
    return false;
}

/* Do the two bodies prefer equal moves? Then the least relative move that separates them is the same from there. */
static bool prefer_alike(const sunder_i_model *model, const sunder_i_relation *r)
{
    return !sunder_i_is_astray(model, model->body_of[r->a], sunder_i_preferred(model, model->body_of[r->b]));
}

/* Uses the pairs of features of different bodies, or of a feature and a barrier, that were in conflict at the start and
 * are not in conflict in the result, and prefer equal moves. If several of them belong to the same two bodies, only the
 * one with the longest least relative move is kept. */
sunder_status sunder_i_report_bound(sunder_report *report, const sunder_i_solver *solver, sunder_error *err)
{
    const sunder_i_model *model = &solver->model;
    size_t n = 0;
    key_pair *key = sunder_i_alloc(solver->start.n, sizeof *key);
    report->bound_pair = sunder_i_calloc(solver->start.n, sizeof *report->bound_pair);
    sunder_status status = key && report->bound_pair ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) {
        for (size_t k = 0; k < solver->start.n; k++) {
            const sunder_i_relation *r = &solver->start.pair[k];
            const uint32_t b = sunder_i_whole_of(model, r->b);
            if (!sunder_i_is_conflict_of_bodies(model, r) || is_left(solver, r) || !prefer_alike(model, r)) continue;
            if (n && report->bound_pair[n - 1].a == r->a && report->bound_pair[n - 1].b == b) continue;
            report->bound_pair[n].a = r->a;
            report->bound_pair[n++].b = b;
        }
        status = measure_all(solver, report->bound_pair, n, err);
    }
    if (!status) {
        for (size_t k = 0; k < n; k++)
            key[k] = (key_pair){bodies_of(model, report->bound_pair[k].a, report->bound_pair[k].b), k};
        qsort(key, n, sizeof *key, by_bodies);
        /* Among the pairs of members with the same two bodies only the one with the longest move is kept; the others
         * get least < 0 and are removed below. */
        for (size_t k = 1; k < n; k++) {
            if (key[k].bodies != key[k - 1].bodies) continue;
            sunder_bound_pair *p = &report->bound_pair[key[k - 1].at], *q = &report->bound_pair[key[k].at];
            if (p->least > q->least) {
                const size_t swap = key[k].at;
                key[k].at = key[k - 1].at;
                key[k - 1].at = swap;
                p = q;
            }
            p->least = -1;
        }
        size_t out = 0;
        for (size_t k = 0; k < n; k++)
            if (report->bound_pair[k].least > 0) report->bound_pair[out++] = report->bound_pair[k];
        report->bound_pairs = out;
        status = sunder_i_bound(model, report->bound_pair, out, &report->summary.pair_bound, &report->proved, err);
        report->summary.lower_bound = report->summary.pair_bound;
    }
    sunder_i_free(key);
    return status;
}
