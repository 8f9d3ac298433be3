/* A limit that would solve all remaining conflicts of a crowd. A question about one pair, with all others as in the
 * result (question.c), is useless in a crowd: no feature has room unless the whole crowd spreads. But layouts of whole
 * clusters are known: the positions of its bodies while limits were lifted; and where these were given up, the cluster
 * stretched as a whole (spread_out.c). The longest move of a layout that is a solution is a limit that suffices for all
 * its pairs.
 *
 * The layout is checked exactly, in place of the result: the bodies of the cluster are put there, and so is each body
 * in their way that has another place in the layout, until none is in the way or one has no place. Then no pair may be
 * in conflict that is not in conflict in the result, no remaining conflict may be worse than at the start, and nothing
 * may have jumped. All others stand as in the result; afterwards all go back. The cost is to relate a cluster three
 * times, however many of its pairs remain. So crowds are examined before any of their pairs is examined by itself,
 * which is then done for fewer of them (needs.c); of other clusters only what these questions left open. */
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/trial.h"

#include "base/extremes.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct crowd {
    sunder_report *report;
    sunder_i_trial trial; /* the bodies that it moves, and their places in the result */
    sunder_i_list body;   /* the bodies it begins with */
    const double *goal;   /* [2 * bodies] of the layout */
    bool *taken;          /* [bodies] */
    bool *stays;          /* [conflicts] of the report: in conflict in that layout, too */
    bool any;             /* another body was moved */
} crowd;

static const double *goal(const crowd *g, uint32_t body) { return g->goal + 2 * (size_t)body; }

/* One body as it stands from now on. */
static sunder_status put(crowd *g, uint32_t body, const double *move, sunder_error *err)
{
    sunder_i_solver *s = g->trial.solver;
    sunder_i_solver_place(s, body, move);
    const sunder_status status = sunder_i_placement_move_body(&s->model, &s->placement, body, err);
    return status ? status : sunder_i_jumps_follow(&s->jumps, &s->model, body, err);
}

/* Puts a body where the layout has it; *done: it may move, and stood elsewhere. */
static sunder_status take(crowd *g, uint32_t body, bool *done, sunder_error *err)
{
    const sunder_i_model *model = &g->trial.solver->model;
    *done = sunder_i_may_move(&model->body[body]) && !g->taken[body] &&
            memcmp(goal(g, body), model->move + 2 * (size_t)body, 2 * sizeof(double)) != 0;
    if (!*done) return SUNDER_OK;
    if (!sunder_i_trial_take(&g->trial, body)) return sunder_i_no_memory(err);
    g->taken[body] = g->any = true;
    return put(g, body, goal(g, body), err);
}

/* The conflict of the report, if it is one; else NULL. */
static const sunder_conflict *find_listed(const crowd *g, const sunder_i_relation *r)
{
    size_t low = 0, high = g->report->conflicts;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const sunder_conflict *c = &g->report->conflict[middle];
        if (c->a == r->a && c->b == r->b) return c;
        if (c->a < r->a || (c->a == r->a && c->b < r->b))
            low = middle + 1;
        else
            high = middle;
    }
    return NULL;
}

/* A body in the way goes to its place in the layout, too. */
static sunder_status make_way(void *context, const sunder_i_relation *r, bool *on, sunder_error *err)
{
    crowd *g = context;
    const sunder_i_model *model = &g->trial.solver->model;
    if (!sunder_i_is_conflict_of_bodies(model, r)) return SUNDER_OK;
    const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
    bool done = false;
    sunder_status status = take(g, i, &done, err);
    if (!status && !done) status = take(g, j, &done, err);
    g->trial.well = *on = done || find_listed(g, r);
    return status;
}

/* Is the pair in no conflict but one that is listed, and no worse than at the start? */
static sunder_status look_at_pair(void *context, const sunder_i_relation *r, bool *on, sunder_error *err)
{
    crowd *g = context;
    if (!sunder_i_is_conflict_of_bodies(&g->trial.solver->model, r)) return SUNDER_OK;
    const sunder_conflict *c = find_listed(g, r);
    bool worse = !c;
    const sunder_status status = c ? sunder_i_solver_is_worse(g->trial.solver, r, &worse, err) : SUNDER_OK;
    if (c) g->stays[c - g->report->conflict] = true;
    g->trial.well = *on = !worse;
    return status;
}

static sunder_status visit_all(crowd *g, sunder_i_visit_relation visit, sunder_error *err)
{
    sunder_i_solver *s = g->trial.solver;
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < g->trial.n && g->trial.well && !status; k++)
        status = sunder_i_placement_visit(&s->model, &s->placement, g->trial.body[k], &g->trial.near, visit, g, err);
    return status;
}

static sunder_status ask_for_jumps(crowd *g, sunder_error *err)
{
    sunder_i_solver *s = g->trial.solver;
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < g->trial.n && g->trial.well && !status; k++) {
        bool jumps;
        status = sunder_i_jumps_of_body(&s->jumps, &s->model, g->trial.body[k], &g->trial.near, &jumps, err);
        g->trial.well = !jumps;
    }
    return status;
}

/* Is that layout a solution, and how far do they go in it? All stand as in the result before and behind. */
static sunder_status try_layout(crowd *g, double *longest, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    g->trial.n = 0;
    g->trial.well = true;
    g->any = false;
    for (size_t k = 0; k < g->body.n && !status; k++) {
        bool done;
        status = take(g, g->body.item[k], &done, err);
    }
    while (g->any && g->trial.well && !status) {
        g->any = false;
        status = visit_all(g, make_way, err);
    }
    if (!status) status = visit_all(g, look_at_pair, err);
    if (!status) status = ask_for_jumps(g, err);
    *longest = 0;
    for (size_t k = 0; k < g->trial.n; k++) {
        const uint32_t body = g->trial.body[k];
        *longest = sunder_i_max(*longest, hypot(goal(g, body)[0], goal(g, body)[1]));
        g->taken[body] = false;
        const sunder_status back = put(g, body, g->trial.stood + 2 * k, err);
        if (!status) status = back;
    }
    return status;
}

/* The cluster that a conflict belongs to. */
static uint32_t root_of(const sunder_i_solver *s, const sunder_conflict *c)
{
    const uint32_t i = s->model.body_of[c->a], j = s->model.body_of[c->b];
    return sunder_i_union_find(s->parent, s->model.body[i].fixed ? j : i);
}

static bool is_asked(const sunder_conflict *c)
{
    return !c->inside_block && c->reason != SUNDER_REASON_KEPT && c->reason != SUNDER_REASON_FIXED;
}

/* Of one cluster, by a layout: all its conflicts that this solves, if it is a solution; item[] of them, by their
 * places. */
static sunder_status free_by(crowd *g, const double *layout, const sunder_i_id_pair *item, size_t n, bool *well,
                             sunder_error *err)
{
    double longest;
    g->goal = layout;
    for (size_t k = 0; k < n; k++) g->stays[item[k].b] = false;
    const sunder_status status = try_layout(g, &longest, err);
    *well = !status && g->trial.n && g->trial.well;
    /* A value rounded once is covered by one unit in the last place more. */
    longest = nextafter(longest, INFINITY);
    for (size_t k = 0; k < n && *well; k++) {
        sunder_conflict *c = &g->report->conflict[item[k].b];
        if (!g->stays[item[k].b] && !(c->need_shift <= longest)) c->need_shift = longest;
    }
    return status;
}

/* Before and after the call, `spread` holds the moves of all bodies in the result. */
static sunder_status free_cluster(crowd *g, const sunder_i_id_pair *item, size_t n, double *spread, sunder_error *err)
{
    const sunder_i_model *model = &g->trial.solver->model;
    size_t members;
    const uint32_t *member = sunder_i_solver_members(g->trial.solver, item[0].a, &members);
    bool well = false, found = false;
    sunder_i_reading reading;
    g->body.n = 0;
    for (size_t k = 0; k < members; k++)
        if (!sunder_i_list_push(&g->body, member[k])) return sunder_i_no_memory(err);
    sunder_i_reads_begin(&reading, model, item[0].a);
    sunder_status status = free_by(g, model->lifted, item, n, &well, err);
    if (!status && !well) status = sunder_i_spread_out(g->trial.solver, &g->body, spread, &found, err);
    if (!status && found) status = free_by(g, spread, item, n, &well, err);
    sunder_i_reads_end(&reading);
    for (size_t k = 0; k < g->body.n; k++) {
        const size_t at = 2 * (size_t)g->body.item[k];
        memcpy(spread + at, model->move + at, 2 * sizeof *spread);
    }
    return status;
}

/* Conflicts by clusters: the root and the place of each. */
static size_t group(const sunder_i_solver *s, const sunder_report *report, sunder_i_id_pair *item)
{
    size_t n = 0;
    for (size_t k = 0; k < report->conflicts; k++)
        if (is_asked(&report->conflict[k]))
            item[n++] = (sunder_i_id_pair){root_of(s, &report->conflict[k]), (uint32_t)k};
    if (n) qsort(item, n, sizeof *item, sunder_i_by_id_pair);
    return n;
}

sunder_status sunder_i_report_crowd_needs(sunder_report *report, sunder_i_solver *solver, bool crowds,
                                          sunder_error *err)
{
    crowd g = {.report = report, .trial = {.solver = solver}};
    if (!solver->model.lifted || !(solver->model.rules.effort > 0) || report->conflicts == 0) return SUNDER_OK;
    sunder_i_id_pair *item = sunder_i_alloc(report->conflicts, sizeof *item);
    double *spread = sunder_i_alloc(2 * solver->model.bodies, sizeof *spread);
    g.taken = sunder_i_calloc(solver->model.bodies, sizeof *g.taken);
    g.stays = sunder_i_calloc(report->conflicts, sizeof *g.stays);
    sunder_status status = item && spread && g.taken && g.stays ? SUNDER_OK : sunder_i_no_memory(err);
    if (!status) memcpy(spread, solver->model.move, 2 * solver->model.bodies * sizeof *spread);
    const size_t n = status ? 0 : group(solver, report, item);
    for (size_t k = 0, end; k < n && !status; k = end) {
        bool open = false;
        for (end = k; end < n && item[end].a == item[k].a; end++)
            open = open || isnan(report->conflict[item[end].b].need_shift);
        if (open && (end - k > NEED_PATIENCE) == crowds) status = free_cluster(&g, item + k, end - k, spread, err);
    }
    sunder_i_changes_clear(&solver->changes);
    sunder_i_trial_free(&g.trial);
    sunder_i_free(g.body.item);
    sunder_i_free(item);
    sunder_i_free(spread);
    sunder_i_free(g.taken);
    sunder_i_free(g.stays);
    return status;
}
