/* Finds a limit that would solve the remaining conflicts of a whole cluster. In a dense cluster questions about a
 * single pair with all other features as in the result (question.c) have no solution, because no feature has room
 * unless the whole cluster spreads. But layouts of whole clusters are known: the moves of its bodies from the search
 * without limits, and, where those are no solution, the cluster stretched as a whole (spread_out.c). The longest move
 * of a layout that is a solution is a sufficient limit for all pairs of the cluster.
 *
 * A layout is checked exactly, in place of the result: the bodies of the cluster are moved to their places in the
 * layout, and so is each body that is then in conflict with them and has another place in the layout, until no further
 * body has to move or one has no other place. Then every pair that is in conflict must also be in conflict in the
 * result, no remaining conflict may be worse than at the start, and no feature may have jumped. All other bodies stay
 * as in the result; afterwards all bodies are moved back. The cost is that of finding the conflicts of a cluster three
 * times, whatever the number of its remaining pairs. Clusters with many conflicts are therefore examined this way
 * before any of their pairs is examined by itself, and fewer of their pairs are then examined (needs.c); other clusters
 * are examined this way only if questions about their pairs left some without an answer. */
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/trial.h"

#include "base/extremes.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct cluster_trial {
    sunder_report *report;
    sunder_i_trial trial; /* the bodies that were moved, and their moves in the result */
    sunder_i_list body;   /* the bodies that are moved first, those of the cluster */
    const double *goal;   /* [2 * bodies] the moves in the layout */
    bool *taken;          /* [bodies] whether the body was moved */
    bool *stays;          /* [conflicts] whether the report's conflict remains in the layout */
    bool any;             /* another body was moved in the current round */
} cluster_trial;

static const double *goal_of(const cluster_trial *g, uint32_t body) { return g->goal + 2 * (size_t)body; }

/* Moves one body, and updates the placement and the paths for it. */
static sunder_status put_body(cluster_trial *g, uint32_t body, const double *move, sunder_error *err)
{
    sunder_i_solver *s = g->trial.solver;
    sunder_i_solver_place(s, body, move);
    const sunder_status status = sunder_i_placement_move_body(&s->model, &s->placement, body, err);
    return status ? status : sunder_i_jumps_follow(&s->jumps, &s->model, body, err);
}

/* Moves a body to its place in the layout. Sets *done to whether it did so: the body must be movable, must not have
 * been moved by this layout before, and its place in the layout must differ from its present one. */
static sunder_status take_body(cluster_trial *g, uint32_t body, bool *done, sunder_error *err)
{
    const sunder_i_model *model = &g->trial.solver->model;
    *done = sunder_i_may_move(&model->body[body]) && !g->taken[body] &&
            memcmp(goal_of(g, body), model->move + 2 * (size_t)body, 2 * sizeof(double)) != 0;
    if (!*done) return SUNDER_OK;
    if (!sunder_i_trial_take(&g->trial, body)) return sunder_i_failure_cause(err);
    g->taken[body] = g->any = true;
    return put_body(g, body, goal_of(g, body), err);
}

/* Returns the report's conflict with the pair of relation r, or NULL if there is none. */
static const sunder_conflict *find_listed(const cluster_trial *g, const sunder_i_relation *r)
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

/* Moves one of two bodies that are in conflict to its place in the layout. The layout fails (trial.well = false) if
 * neither can be moved and the pair is not among the report's conflicts. */
static sunder_status move_aside(void *context, const sunder_i_relation *r, bool *on, sunder_error *err)
{
    cluster_trial *g = context;
    const sunder_i_model *model = &g->trial.solver->model;
    if (!sunder_i_is_conflict_of_bodies(model, r)) return SUNDER_OK;
    const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
    bool done = false;
    sunder_status status = take_body(g, i, &done, err);
    if (!status && !done) status = take_body(g, j, &done, err);
    g->trial.well = *on = done || find_listed(g, r);
    return status;
}

/* For a pair in conflict in the layout: the layout fails (trial.well = false) if the pair is not among the report's
 * conflicts, or if it is worse than at the start. If it is among them, that conflict is marked in stays[]. */
static sunder_status look_at_pair(void *context, const sunder_i_relation *r, bool *on, sunder_error *err)
{
    cluster_trial *g = context;
    if (!sunder_i_is_conflict_of_bodies(&g->trial.solver->model, r)) return SUNDER_OK;
    const sunder_conflict *c = find_listed(g, r);
    bool worse = !c;
    const sunder_status status = c ? sunder_i_solver_is_worse(g->trial.solver, r, &worse, err) : SUNDER_OK;
    if (c) g->stays[c - g->report->conflict] = true;
    g->trial.well = *on = !worse;
    return status;
}

static sunder_status visit_all(cluster_trial *g, sunder_i_visit_relation visit, sunder_error *err)
{
    sunder_i_solver *s = g->trial.solver;
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < g->trial.n && g->trial.well && !status; k++)
        status = sunder_i_placement_visit(&s->model, &s->placement, g->trial.body[k], &g->trial.near, visit, g, err);
    return status;
}

static sunder_status ask_for_jumps(cluster_trial *g, sunder_error *err)
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

/* Sets trial.well to whether the layout is a solution, and *longest to the longest move of a body that was moved. All
 * bodies have their moves of the result before and after the call. */
static sunder_status try_layout(cluster_trial *g, double *longest, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    g->trial.n = 0;
    g->trial.well = true;
    g->any = false;
    for (size_t k = 0; k < g->body.n && !status; k++) {
        bool done;
        status = take_body(g, g->body.item[k], &done, err);
    }
    while (g->any && g->trial.well && !status) {
        g->any = false;
        status = visit_all(g, move_aside, err);
    }
    if (!status) status = visit_all(g, look_at_pair, err);
    if (!status) status = ask_for_jumps(g, err);
    *longest = 0;
    for (size_t k = 0; k < g->trial.n; k++) {
        const uint32_t body = g->trial.body[k];
        *longest = sunder_i_max(*longest, hypot(goal_of(g, body)[0], goal_of(g, body)[1]));
        g->taken[body] = false;
        const sunder_status back = put_body(g, body, g->trial.stood + 2 * k, err);
        if (!status) status = back;
    }
    return status;
}

/* Returns the root of the cluster that the conflict c belongs to. */
static uint32_t root_of(const sunder_i_solver *s, const sunder_conflict *c)
{
    const uint32_t i = s->model.body_of[c->a], j = s->model.body_of[c->b];
    return sunder_i_union_find(s->parent, s->model.body[i].fixed ? j : i);
}

static bool is_asked(const sunder_conflict *c)
{
    return !c->inside_block && c->reason != SUNDER_REASON_KEPT && c->reason != SUNDER_REASON_FIXED;
}

/* Tries a layout for one cluster, whose n conflicts have the indices item[].b in the report. If it is a solution, *well
 * is set, and need_shift of all conflicts that it solves becomes at most its longest move. */
static sunder_status free_by(cluster_trial *g, const double *layout, const sunder_i_id_pair *item, size_t n, bool *well,
                             sunder_error *err)
{
    double longest;
    g->goal = layout;
    for (size_t k = 0; k < n; k++) g->stays[item[k].b] = false;
    const sunder_status status = try_layout(g, &longest, err);
    *well = !status && g->trial.n && g->trial.well;
    /* The length was rounded once, so the next larger double is an upper bound. */
    longest = nextafter(longest, INFINITY);
    for (size_t k = 0; k < n && *well; k++) {
        sunder_conflict *c = &g->report->conflict[item[k].b];
        if (!g->stays[item[k].b] && !(c->need_shift <= longest)) c->need_shift = longest;
    }
    return status;
}

/* Tries the known layouts of one cluster, whose n conflicts are item[]: first that of the search without limits
 * (model->lifted), then, if that is no solution, the cluster stretched (sunder_i_spread_out()). `spread` contains the
 * moves of all bodies in the result, before and after the call. */
static sunder_status free_cluster(cluster_trial *g, const sunder_i_id_pair *item, size_t n, double *spread,
                                  sunder_error *err)
{
    const sunder_i_model *model = &g->trial.solver->model;
    size_t members;
    const uint32_t *member = sunder_i_solver_members(g->trial.solver, item[0].a, &members);
    bool well = false, found = false;
    sunder_i_reading reading;
    g->body.n = 0;
    for (size_t k = 0; k < members; k++)
        if (!sunder_i_list_push(&g->body, member[k])) return sunder_i_failure_cause(err);
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

/* Lists the conflicts as (root of the cluster, index in the report), sorted. Returns their number. */
static size_t group_by_cluster(const sunder_i_solver *s, const sunder_report *report, sunder_i_id_pair *item)
{
    size_t n = 0;
    for (size_t k = 0; k < report->conflicts; k++)
        if (is_asked(&report->conflict[k]))
            item[n++] = (sunder_i_id_pair){root_of(s, &report->conflict[k]), (uint32_t)k};
    if (n) qsort(item, n, sizeof *item, sunder_i_by_id_pair);
    return n;
}

sunder_status sunder_i_report_cluster_needs(sunder_report *report, sunder_i_solver *solver, bool large,
                                            sunder_error *err)
{
    cluster_trial g = {.report = report, .trial = {.solver = solver}};
    if (!solver->model.lifted || !(solver->model.rules.effort > 0) || report->conflicts == 0) return SUNDER_OK;
    sunder_i_id_pair *item = sunder_i_alloc(report->conflicts, sizeof *item);
    double *spread = sunder_i_alloc(2 * solver->model.bodies, sizeof *spread);
    g.taken = sunder_i_calloc(solver->model.bodies, sizeof *g.taken);
    g.stays = sunder_i_calloc(report->conflicts, sizeof *g.stays);
    sunder_status status = item && spread && g.taken && g.stays ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) memcpy(spread, solver->model.move, 2 * solver->model.bodies * sizeof *spread);
    const size_t n = status ? 0 : group_by_cluster(solver, report, item);
    for (size_t k = 0, end; k < n && !status; k = end) {
        bool open = false;
        for (end = k; end < n && item[end].a == item[k].a; end++)
            open = open || isnan(report->conflict[item[end].b].need_shift);
        if (open && (end - k > NEED_PATIENCE) == large) status = free_cluster(&g, item + k, end - k, spread, err);
    }
    sunder_i_changes_clear(&solver->changes);
    sunder_i_trial_free(&g.trial);
    sunder_i_free_all(g.body.item, item, spread, g.taken, g.stays);
    return status;
}
