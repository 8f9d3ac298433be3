/* Conflicts that no moves resolve, with or without limits: one body stands in a yard of the other that is too small for
 * it, and would have to jump out (prove/optimum/shut_in.c). They are found before anything moves, so that no search
 * begins by looking for a solution: all conflicts of two such bodies are left. Conflicts where this holds feature by
 * feature, with the rest of their blocks only adding shadows, are infeasible, like those that limits leave no solution.
 * One of the others may have a solution if the rest is left, so they are given up, and asked for again at the end,
 * except those that are proved to have none (shut_in_conflicts.c). */
#include "displacement/solve/clusters/cluster_stages.h"

#include "base/parallel.h"

#include <stdlib.h>
#include <string.h>

typedef struct judging {
    const sunder_i_model *model;
    const sunder_i_id_pair *pair;
    bool *shut;
} judging;

static sunder_status judge_pairs(void *context, size_t begin, size_t end, sunder_error *err)
{
    const judging *g = context;
    for (size_t k = begin; k < end; k++)
        if (!sunder_i_is_shut_in(g->model, g->pair[k].a, g->pair[k].b, &g->shut[k])) return sunder_i_failure_cause(err);
    return SUNDER_OK;
}

static sunder_i_id_pair bodies_of(const sunder_i_model *model, const sunder_i_relation *r)
{
    const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
    return i < j ? (sunder_i_id_pair){i, j} : (sunder_i_id_pair){j, i};
}

/* Lists the pairs of bodies in conflict, sorted. Returns their number. */
static size_t list_pairs(const sunder_i_solver *s, sunder_i_id_pair *pair)
{
    const sunder_i_model *model = &s->model;
    size_t n = 0, out = 0;
    for (size_t k = 0; k < s->start.n; k++) {
        const sunder_i_relation *r = &s->start.pair[k];
        if (sunder_i_is_open_conflict(model, r) && !sunder_i_is_barrier(model, r->b)) pair[n++] = bodies_of(model, r);
    }
    if (n) qsort(pair, n, sizeof *pair, sunder_i_by_id_pair);
    for (size_t k = 0; k < n; k++)
        if (k == 0 || sunder_i_by_id_pair(&pair[k - 1], &pair[k])) pair[out++] = pair[k];
    return out;
}

/* Sets shut[] for the pairs that may be shut in, by a quick test. */
static sunder_status suspect_pairs(void *context, size_t begin, size_t end, sunder_error *err)
{
    const judging *g = context;
    (void)err;
    for (size_t k = begin; k < end; k++) g->shut[k] = sunder_i_may_be_shut_in(g->model, g->pair[k].a, g->pair[k].b);
    return SUNDER_OK;
}

/* Keeps those of n pairs for which shut[] is set; returns their number. */
static size_t keep_shut(sunder_i_id_pair *pair, const bool *shut, size_t n)
{
    size_t out = 0;
    for (size_t k = 0; k < n; k++)
        if (shut[k]) pair[out++] = pair[k];
    return out;
}

/* A conflict between two bodies that are shut in. shut: it has no solution by itself. */
typedef struct shut_in_conflict {
    sunder_i_id_pair bodies, pair;
    bool shut;
    sunder_i_relaxation relaxation;
} shut_in_conflict;

static int by_pair(const void *a, const void *b)
{
    return sunder_i_by_id_pair(&((const shut_in_conflict *)a)->pair, &((const shut_in_conflict *)b)->pair);
}

/* Decides, for the n conflicts between two bodies, which have no solution, and computes their relaxations. */
static sunder_status judge_features(const sunder_i_model *model, shut_in_conflict *list, size_t n, sunder_error *err)
{
    sunder_i_id_pair *pair = sunder_i_alloc(n, sizeof *pair);
    sunder_i_relaxation *relaxation = sunder_i_alloc(n, sizeof *relaxation);
    bool *shut = sunder_i_calloc(n, sizeof *shut);
    bool ok = pair && relaxation && shut;
    for (size_t k = 0; k < n && ok; k++) pair[k] = list[k].pair;
    ok = ok && sunder_i_find_shut_in_pairs(model, list->bodies.a, list->bodies.b, pair, n, shut);
    sunder_status status = ok ? SUNDER_OK : sunder_i_failure_cause(err);
    for (size_t k = 0; k < n && !status; k++) {
        status = sunder_i_relaxation_of(model, pair[k].a, pair[k].b, &relaxation[k], err);
        list[k].shut = relaxation[k].infeasible = shut[k];
    }
    if (!status) status = sunder_i_find_unsolvable(model, &list->bodies, relaxation, n, err);
    for (size_t k = 0; k < n && !status; k++) list[k].relaxation = relaxation[k];
    sunder_i_free_all(pair, relaxation, shut);
    return status;
}

typedef struct judging_features {
    const sunder_i_model *model;
    shut_in_conflict *shut_in_conflict;
    const size_t *first; /* [pairs of bodies + 1] index of the first conflict of each */
} judging_features;

static sunder_status judge_pairs_of_bodies(void *context, size_t begin, size_t end, sunder_error *err)
{
    const judging_features *g = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++)
        status = judge_features(g->model, g->shut_in_conflict + g->first[k], g->first[k + 1] - g->first[k], err);
    return status;
}

/* Stores the conflicts between the n sorted pairs of bodies in `out`, and returns their number. out NULL: they are only
 * counted. */
static size_t find_conflicts(const sunder_i_solver *s, const sunder_i_id_pair *list, size_t n, shut_in_conflict *out)
{
    size_t found = 0;
    for (size_t k = 0; k < s->start.n; k++) {
        const sunder_i_relation *r = &s->start.pair[k];
        if (!sunder_i_is_open_conflict(&s->model, r) || sunder_i_is_barrier(&s->model, r->b)) continue;
        const sunder_i_id_pair bodies = bodies_of(&s->model, r);
        if (!bsearch(&bodies, list, n, sizeof bodies, sunder_i_by_id_pair)) continue;
        if (out) out[found] = (shut_in_conflict){.bodies = bodies, .pair = {r->a, r->b}};
        found++;
    }
    return found;
}

/* Stores the conflicts between the n sorted pairs of bodies in `out`, sorted by pairs of bodies. first[k] is the index
 * of the first conflict of the k-th pair of bodies, *pairs the number of such pairs. */
static void list_conflicts(const sunder_i_solver *s, const sunder_i_id_pair *list, size_t n, shut_in_conflict *out,
                           size_t *first, size_t *pairs)
{
    const size_t found = find_conflicts(s, list, n, out);
    if (found) qsort(out, found, sizeof *out, sunder_i_by_id_quadruple);
    *pairs = 0;
    for (size_t k = 0; k < found; k++)
        if (k == 0 || sunder_i_by_id_pair(&out[k - 1].bodies, &out[k].bodies)) first[(*pairs)++] = k;
    first[*pairs] = found;
}

static sunder_status leave_conflict(sunder_i_model *model, const shut_in_conflict *m, sunder_i_relaxations *more,
                                    sunder_error *err)
{
    sunder_i_trace_pair(model, "jumps",
                        m->shut ? "proved: no solution without a jump" : "left with a pair that is shut in",
                        m->relaxation.a, m->relaxation.b);
    if (m->shut) {
        model->shut_in[model->shut_in_n++] = m->pair;
    } else {
        model->given_up[model->given_up_n++] = m->bodies;
    }
    return sunder_i_relaxations_add(more, &m->relaxation) ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* Relaxes all conflicts between the n sorted pairs of bodies. */
static sunder_status relax_conflicts(sunder_i_solver *s, const sunder_i_id_pair *list, size_t n, sunder_error *err)
{
    sunder_i_model *model = &s->model;
    sunder_i_relaxations more = {0};
    const size_t conflicts = find_conflicts(s, list, n, NULL);
    shut_in_conflict *found = sunder_i_alloc(conflicts, sizeof *found);
    size_t *first = sunder_i_alloc(conflicts + 1, sizeof *first), pairs = 0;
    model->shut_in = sunder_i_alloc(conflicts, sizeof *model->shut_in);
    model->given_up = sunder_i_alloc(conflicts, sizeof *model->given_up);
    const bool ok = found && first && model->shut_in && model->given_up;
    sunder_status status = ok ? SUNDER_OK : sunder_i_failure_cause(err);
    if (ok) list_conflicts(s, list, n, found, first, &pairs);
    judging_features g = {model, found, first};
    if (!status)
        status = sunder_i_parallel(model->rules.threads, pairs, SUNDER_I_GRAIN_WHOLE, judge_pairs_of_bodies, &g, err);
    if (ok && conflicts) qsort(found, conflicts, sizeof *found, by_pair);
    for (size_t k = 0; k < conflicts && !status; k++) status = leave_conflict(model, &found[k], &more, err);
    for (size_t k = 0; k < more.n && !status; k++)
        if (!sunder_i_relaxations_add(&model->relaxations, &more.item[k])) status = sunder_i_failure_cause(err);
    sunder_i_relaxations_free(&more);
    sunder_i_free_all(found, first);
    if (model->shut_in_n) qsort(model->shut_in, model->shut_in_n, sizeof *model->shut_in, sunder_i_by_id_pair);
    sunder_i_sort_given_up(model);
    if (!status && !sunder_i_relaxations_index(&model->relaxations, model)) status = sunder_i_failure_cause(err);
    return status;
}

/* Makes the covers of the diagonals between pieces, and of the walls between members, of these bodies. */
static sunder_status cover_pairs(sunder_i_model *model, const sunder_i_id_pair *pair, size_t n, sunder_error *err)
{
    uint32_t *body = sunder_i_alloc(2 * n, sizeof *body);
    if (!body) return sunder_i_failure_cause(err);
    memcpy(body, pair, 2 * n * sizeof *body);
    const size_t bodies = sunder_i_set_make(body, 2 * n);
    sunder_status status = sunder_i_model_cover_diagonals_of(model, body, bodies, err);
    if (!status) status = sunder_i_model_cover_walls(model, body, bodies, err);
    sunder_i_free(body);
    return status;
}

sunder_status sunder_i_solver_find_shut_in(sunder_i_solver *solver, sunder_error *err)
{
    sunder_i_model *model = &solver->model;
    if (model->rules.jumps) return SUNDER_OK;
    sunder_i_id_pair *pair = sunder_i_alloc(solver->start.n, sizeof *pair);
    if (!pair) return sunder_i_failure_cause(err);
    size_t n = list_pairs(solver, pair);
    judging g = {model, pair, sunder_i_calloc(n, sizeof *g.shut)};
    sunder_status status = g.shut ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) status = sunder_i_parallel(model->rules.threads, n, SUNDER_I_GRAIN_TESTS, suspect_pairs, &g, err);
    if (!status) n = keep_shut(pair, g.shut, n);
    if (!status && n) status = cover_pairs(model, pair, n, err);
    if (!status) status = sunder_i_parallel(model->rules.threads, n, SUNDER_I_GRAIN_WHOLE, judge_pairs, &g, err);
    const size_t out = status ? 0 : keep_shut(pair, g.shut, n);
    if (!status && out) {
        status = relax_conflicts(solver, pair, out, err);
        sunder_i_id_pair *confined = sunder_i_realloc(pair, out, sizeof *pair);
        model->confined = confined ? confined : pair;
        model->confined_n = out;
        pair = NULL;
    }
    sunder_i_free_all(g.shut, pair);
    return status;
}
