/* What would free a conflict that was left: a longer limit, a smaller gap, one feature less. Each is asked of a small
 * layer about it (question.c). */
#include "displacement/report/question.h"
#include "displacement/report/tuning.h"

#include "base/parallel.h"

#include <math.h>

/* ---- The three needs --------------------------------------------------------------------------------------------- */

/* A limit of moves: what they need where they may go as far as is known, and then less, by halves. */
static sunder_status need_shift(const sunder_i_questions *g, const sunder_i_surroundings *a, sunder_conflict *c,
                                sunder_error *err)
{
    sunder_i_supposition what = {a->farthest, c->required, SUNDER_I_NOBODY};
    double longest, low = INFINITY;
    bool yes;
    what.gap = g->options->gap;
    for (size_t k = 0; k < a->moving; k++) low = fmin(low, a->as[k].max_shift);
    if (!(low < what.limit)) return SUNDER_OK;
    for (int k = 0; k <= g->halvings; k++) {
        const sunder_status status = sunder_i_ask(g, a, c, &what, &yes, &longest, err);
        if (status) return status;
        /* One unit above what is rounded once holds the move. */
        if (yes)
            c->need_shift = nextafter(longest, INFINITY);
        else if (k == 0)
            return SUNDER_OK;
        else
            low = what.limit;
        what.limit = low + (c->need_shift - low) / 2;
        if (!(low < what.limit && what.limit < c->need_shift)) return SUNDER_OK;
    }
    return SUNDER_OK;
}

static sunder_status need_gap(const sunder_i_questions *g, const sunder_i_surroundings *a, sunder_conflict *c,
                              sunder_error *err)
{
    sunder_i_supposition what = {0, 0, SUNDER_I_NOBODY};
    double high = g->options->gap, longest;
    bool yes;
    for (int k = 0; k <= g->halvings && high > 0; k++) {
        const sunder_status status = sunder_i_ask(g, a, c, &what, &yes, &longest, err);
        if (status) return status;
        if (yes)
            c->need_gap = what.gap;
        else if (k == 0)
            return SUNDER_OK;
        else
            high = what.gap;
        what.gap = c->need_gap + (high - c->need_gap) / 2;
    }
    return SUNDER_OK;
}

/* The first of those in the way, without which all others are solved. */
static sunder_status need_gone(const sunder_i_questions *g, const sunder_i_surroundings *a, sunder_conflict *c,
                               sunder_error *err)
{
    const sunder_i_supposition none = {0, g->options->gap, SUNDER_I_NOBODY};
    double longest;
    bool yes = false;
    for (size_t k = 0; k < c->n_blocked_by && k < g->leaves && !yes; k++) {
        sunder_i_supposition what = none;
        what.gone = (uint32_t)c->blocked_by[k];
        const sunder_status status = sunder_i_ask(g, a, c, &what, &yes, &longest, err);
        if (status) return status;
        if (yes) c->need_gone = c->blocked_by[k];
    }
    return SUNDER_OK;
}

static size_t members_that_move(const sunder_i_model *model, size_t feature)
{
    const sunder_i_body *body = &model->body[model->body_of[feature]];
    return body->fixed ? 0 : body->members;
}

static sunder_status find_needs(const sunder_i_questions *g, sunder_conflict *c, sunder_error *err)
{
    const sunder_i_model *model = &g->solver->model;
    sunder_i_surroundings a = {0};
    if (members_that_move(model, c->a) + members_that_move(model, c->b) > NEED_MOST) return SUNDER_OK;
    sunder_status status = sunder_i_surround(g->solver, c, &a, err);
    a.farthest = fmin(a.farthest, g->options->barrier_reach); /* what it has not been told of may stand beyond */
    if (!status) status = need_shift(g, &a, c, err);
    if (!status) status = need_gap(g, &a, c, err);
    if (!status) status = need_gone(g, &a, c, err);
    sunder_i_surroundings_clear(&a);
    return status;
}

static sunder_status find_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_questions *g = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++) {
        sunder_conflict *c = &g->report->conflict[k];
        if (!c->inside_block && c->reason != SUNDER_REASON_KEPT) status = find_needs(g, c, err);
    }
    return status;
}

sunder_status sunder_i_report_needs(sunder_report *report, const sunder_i_solver *solver,
                                    const sunder_layer_options *options, sunder_i_solve_layer solve, sunder_error *err)
{
    const double effort = fmin(ceil(options->effort), NEED_EFFORT);
    const sunder_i_questions g = {solver, report, options, solve, (int)effort, NEED_GONE * (size_t)effort};
    if (!(effort > 0)) return SUNDER_OK;
    return sunder_i_parallel(solver->model.rules.threads, report->conflicts, SUNDER_I_GRAIN_WHOLE, find_some,
                             (void *)&g, err);
}
