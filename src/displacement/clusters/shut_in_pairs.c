/* Pairs of bodies in conflict that no moves resolve, with or without limits: one stands in a yard of the other that is
 * too small for it, and would have to jump out (optimum/shut_in.c). They are found before anything moves, so that
 * nobody looks for a solution: all conflicts of two such bodies are left, like those that limits leave no solution. */
#include "displacement/clusters/stages.h"

#include "base/parallel.h"

#include <stdlib.h>
#include <string.h>

typedef struct judging {
    const sunder_i_model *model;
    const sunder_i_id_pair *pair;
    bool *shut;
} judging;

static sunder_status judge(void *context, size_t begin, size_t end, sunder_error *err)
{
    const judging *g = context;
    for (size_t k = begin; k < end; k++)
        if (!sunder_i_is_shut_in(g->model, g->pair[k].a, g->pair[k].b, &g->shut[k])) return sunder_i_no_memory(err);
    return SUNDER_OK;
}

static sunder_i_id_pair bodies_of(const sunder_i_model *model, const sunder_i_relation *r)
{
    const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
    return i < j ? (sunder_i_id_pair){i, j} : (sunder_i_id_pair){j, i};
}

/* Pairs of bodies in conflict that might be shut in, sorted. Returns how many. */
static size_t list_pairs(const sunder_i_solver *s, sunder_i_id_pair *pair)
{
    const sunder_i_model *model = &s->model;
    size_t n = 0, out = 0;
    for (size_t k = 0; k < s->start.n; k++) {
        const sunder_i_relation *r = &s->start.pair[k];
        if (sunder_i_is_open_conflict(model, r) && !sunder_i_is_barrier(model, r->b)) pair[n++] = bodies_of(model, r);
    }
    if (n) qsort(pair, n, sizeof *pair, sunder_i_by_id_pair);
    for (size_t k = 0; k < n; k++) {
        if (k && sunder_i_by_id_pair(&pair[k - 1], &pair[k]) == 0) continue;
        const sunder_i_id_pair candidate = pair[k];
        if (sunder_i_may_be_shut_in(model, candidate.a, candidate.b)) pair[out++] = candidate;
    }
    return out;
}

/* Leaves the conflicts between them. */
static sunder_status relax(sunder_i_solver *s, sunder_error *err)
{
    sunder_i_model *model = &s->model;
    sunder_i_relaxations more = {0};
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < s->start.n && !status; k++) {
        const sunder_i_relation *r = &s->start.pair[k];
        sunder_i_relaxation relaxation;
        if (!sunder_i_is_open_conflict(model, r) || !sunder_i_are_shut_in(model, r->a, r->b)) continue;
        status = sunder_i_relaxation_of(model, r->a, r->b, &relaxation, err);
        relaxation.infeasible = true;
        if (!status && !sunder_i_relaxations_add(&more, &relaxation)) status = sunder_i_no_memory(err);
    }
    for (size_t k = 0; k < more.n && !status; k++)
        if (!sunder_i_relaxations_add(&model->relaxations, &more.item[k])) status = sunder_i_no_memory(err);
    sunder_i_relaxations_free(&more);
    if (!status && !sunder_i_relaxations_index(&model->relaxations, model)) status = sunder_i_no_memory(err);
    return status;
}

/* Seams and joints: whatever is between pieces of theirs. */
static sunder_status find_seams(sunder_i_model *model, const sunder_i_id_pair *pair, size_t n, sunder_error *err)
{
    uint32_t *body = sunder_i_alloc(2 * n, sizeof *body);
    if (!body) return sunder_i_no_memory(err);
    memcpy(body, pair, 2 * n * sizeof *body);
    sunder_status status = sunder_i_model_find_seams(model, err);
    if (!status) status = sunder_i_model_find_joints(model, body, sunder_i_set_make(body, 2 * n), err);
    sunder_i_free(body);
    return status;
}

sunder_status sunder_i_solver_find_shut_in(sunder_i_solver *s, sunder_error *err)
{
    sunder_i_model *model = &s->model;
    if (model->rules.jumps) return SUNDER_OK;
    model->shut_in = sunder_i_alloc(s->start.n, sizeof *model->shut_in);
    if (!model->shut_in) return sunder_i_no_memory(err);
    const size_t n = list_pairs(s, model->shut_in);
    if (n == 0) return SUNDER_OK;
    judging g = {model, model->shut_in, sunder_i_calloc(n, sizeof *g.shut)};
    sunder_status status = g.shut ? find_seams(model, model->shut_in, n, err) : sunder_i_no_memory(err);
    if (!status) status = sunder_i_parallel(model->rules.threads, n, SUNDER_I_GRAIN_WHOLE, judge, &g, err);
    for (size_t k = 0; k < n && !status; k++)
        if (g.shut[k]) model->shut_in[model->shut_in_n++] = model->shut_in[k];
    sunder_i_free(g.shut);
    return status || model->shut_in_n == 0 ? status : relax(s, err);
}
