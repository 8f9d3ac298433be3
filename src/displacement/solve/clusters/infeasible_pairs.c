/* Pairs in conflict that no moves within the limits of the two resolve, found exactly before anything moves; a fixed
 * body has the limit 0. Features that a barrier's line crosses are treated alike, if they are kept. (Pairs that
 * clusters give up later: given_up.c.) */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/solve/clusters/cluster_stages.h"

#include "base/extremes.h"
#include "base/parallel.h"

#include <math.h>

typedef struct judging {
    const sunder_i_solver *solver;
    const sunder_i_model *model;
    const sunder_i_spared *spared; /* pairs that need no test; NULL: none */
    const sunder_i_relations *start;
    sunder_i_relaxation *relaxation; /* [start->n] filled for infeasible pairs */
    sunder_i_resolution *resolution; /* [start->n] */
} judging;

/* Can moves of at most `reach` in all separate the boxes by the gap? Then the exact question is not needed. */
static bool boxes_can_part(const double *a, const double *b, double gap, double reach)
{
    const double out = sunder_i_min(sunder_i_min(a[2] - b[0], b[2] - a[0]), sunder_i_min(a[3] - b[1], b[3] - a[1]));
    return out + gap < reach * (1 - 0x1p-40);
}

/* Does the pair r need no test? A spared pair is relaxed in any case, unless one of its features may go inside the
 * other. */
static bool is_left(const judging *g, const sunder_i_relation *r)
{
    return g->spared && !sunder_i_may_be_inside(&g->model->rules) &&
           sunder_i_solver_is_spared(g->solver, g->spared, r->a, r->b);
}

/* Sets *stays to whether pair k stays in conflict: since it is crossed and kept, or since no moves resolve it. */
static sunder_status judge_pair(const judging *g, size_t k, bool *stays, sunder_error *err)
{
    const sunder_i_model *model = g->model;
    const sunder_i_relation *r = &g->start->pair[k];
    const double limit[2] = {sunder_i_limit_of(&model->body[model->body_of[r->a]]),
                             sunder_i_limit_of(&model->body[model->body_of[r->b]])},
                 reach = limit[0] + limit[1];
    *stays = false;
    if (!sunder_i_is_open_conflict(model, r)) return SUNDER_OK;
    *stays = sunder_i_is_crossed(model, r->a, r->b);
    if (*stays || reach == INFINITY || is_left(g, r)) return SUNDER_OK;
    if (!sunder_i_is_barrier(model, r->b) &&
        boxes_can_part(sunder_i_home_box(model, r->a), sunder_i_home_box(model, r->b), model->rules.gap, reach))
        return SUNDER_OK;
    const sunder_status status = sunder_i_resolve_within(model, r->a, r->b, limit, &g->resolution[k], err);
    *stays = !status && g->resolution[k].beyond;
    return status;
}

static sunder_status judge_pairs(void *context, size_t begin, size_t end, sunder_error *err)
{
    const judging *g = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++) {
        const sunder_i_relation *r = &g->start->pair[k];
        bool stays;
        status = judge_pair(g, k, &stays, err);
        if (status || !stays) continue;
        status = sunder_i_relaxation_of(g->model, r->a, r->b, &g->relaxation[k], err);
        g->relaxation[k].infeasible = true;
    }
    return status;
}

/* Is the relaxation on the list already, for another part of the same barrier? */
static bool is_known(const sunder_i_relaxations *list, const sunder_i_relaxation *t)
{
    for (size_t k = list->n; k > 0 && list->item[k - 1].a == t->a; k--)
        if (list->item[k - 1].b == t->b) return true;
    return false;
}

/* Stores the result for pair r: a relaxation, or an entry to be moved inside. */
static sunder_status take_judgement(sunder_i_solver *s, const sunder_i_relation *r,
                                    const sunder_i_relaxation *relaxation, const sunder_i_resolution *resolution,
                                    sunder_error *err)
{
    sunder_i_model *model = &s->model;
    if (relaxation->infeasible && is_known(&model->relaxations, relaxation)) return SUNDER_OK;
    if (relaxation->infeasible)
        sunder_i_trace_pair(model, "limits",
                            sunder_i_is_crossed(model, r->a, r->b)
                                ? "a line crosses the feature, which is kept"
                                : "proved: no solution of the two within their limits",
                            r->a, r->b);
    if (relaxation->infeasible)
        return sunder_i_relaxations_spread(&model->relaxations, model, relaxation, model->rules.gap)
                   ? SUNDER_OK
                   : sunder_i_failure_cause(err);
    const sunder_i_body *p = &model->body[model->body_of[r->a]], *q = &model->body[model->body_of[r->b]];
    const double reach = sunder_i_limit_of(p) + sunder_i_limit_of(q);
    if (!resolution->apart_beyond || !resolution->inside || hypot(resolution->place[0], resolution->place[1]) > reach)
        return SUNDER_OK;
    if (!sunder_i_reserve(&s->entry, &s->entry_capacity, s->entries + 1, sizeof *s->entry))
        return sunder_i_failure_cause(err);
    s->entry[s->entries++] =
        (sunder_i_entry){r->a, r->b, resolution->a_inside, {resolution->place[0], resolution->place[1]}};
    return sunder_i_inclusions_add(model, r->a, r->b, resolution->a_inside, err);
}

sunder_status sunder_i_solver_find_infeasible(sunder_i_solver *solver, const sunder_i_spared *spared, sunder_error *err)
{
    const size_t n = solver->start.n;
    judging g = {.solver = solver,
                 .model = &solver->model,
                 .spared = spared,
                 .start = &solver->start,
                 .relaxation = sunder_i_calloc(n, sizeof *g.relaxation),
                 .resolution = sunder_i_calloc(n, sizeof *g.resolution)};
    sunder_status status = g.relaxation && g.resolution ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) status = sunder_i_inclusions_note_nested(&solver->model, &solver->start, err);
    if (!status) status = sunder_i_parallel(solver->model.rules.threads, n, SUNDER_I_GRAIN_PAIRS, judge_pairs, &g, err);
    for (size_t k = 0; !status && k < n; k++)
        status = take_judgement(solver, &solver->start.pair[k], &g.relaxation[k], &g.resolution[k], err);
    if (!status && !sunder_i_relaxations_index(&solver->model.relaxations, &solver->model))
        status = sunder_i_failure_cause(err);
    sunder_i_free_all(g.relaxation, g.resolution);
    return status;
}
