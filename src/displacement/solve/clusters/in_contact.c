/* Contact without a margin, and bodies that a margin alone has moved.
 *
 * The search demands a margin beyond the distances owed, to cover rounding, and bodies stand that much too far apart.
 * Where coordinates and distances are multiples of a step that is coarse compared with rounding, doubles can represent
 * places in exact contact, and rows of bodies in contact are moved there (../../prove/optimum/tight_place.c). A contact
 * group takes these places if they cost less and hold exactly (trial.c). Two isolated features are in contact already
 * (../search/lone_pair.c).
 *
 * The margins of its neighbours push a body from home, the place that it prefers, that has nothing to gain. When no
 * neighbour needs its margin any more, since coordinates are rounded or a neighbour stands in exact contact, it returns
 * home. */
#include "displacement/prove/optimum/optimum.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/trial.h"
#include "displacement/solve/clusters/tuning.h"

#include <string.h>

/* Computes places in exact contact for the group's bodies; *found if there are any. move: [2 * n] the present moves,
 * then those places. */
static sunder_status find_places(const sunder_i_solver *s, const sunder_i_group *g, double *move, bool *found,
                                 sunder_error *err)
{
    const sunder_i_waived waived = {s->groups.waived, s->groups.waived_n, s->states.of[SUNDER_I_DIAGONALS]};
    bool may;
    *found = false;
    if (!sunder_i_may_be_tight(&s->model, g->body, g->n, &may)) return sunder_i_failure_cause(err);
    if (!may) return SUNDER_OK;
    return sunder_i_tight_place(&s->model, &waived, g->body, g->n, g->margin, move, found)
               ? SUNDER_OK
               : sunder_i_failure_cause(err);
}

/* The increase of the group's cost, body by body, since it is the difference of two almost equal sums. */
static double cost_increase(const sunder_i_model *model, const sunder_i_group *g, const double *move)
{
    double more = 0;
    for (size_t k = 0; k < g->n; k++) {
        const double *to = move + 2 * k, *at = model->move + 2 * (size_t)g->body[k];
        const double *a = sunder_i_preferred(model, g->body[k]);
        for (size_t c = 0; c < 2; c++)
            more += model->body[g->body[k]].weight * ((to[c] - at[c]) * (to[c] - a[c] + (at[c] - a[c])));
    }
    return more;
}

static sunder_status put_group_in_contact(sunder_i_solver *s, const sunder_i_group *g, sunder_error *err)
{
    const double none[2] = {0, 0};
    const sunder_i_cluster bodies = {.body = g->body, .n = g->n};
    sunder_i_trial t = {.solver = s};
    double *move = sunder_i_alloc(2 * g->n, sizeof *move);
    if (!move) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < g->n; k++) memcpy(move + 2 * k, s->model.move + 2 * (size_t)g->body[k], 2 * sizeof *move);
    bool found;
    sunder_i_reading reading;
    sunder_i_reads_begin(&reading, &s->model, g->number);
    sunder_status status = find_places(s, g, move, &found, err);
    sunder_i_reads_end(&reading);
    if (!status && found && cost_increase(&s->model, g, move) < 0) {
        if (!sunder_i_trial_take_moved(&t, &bodies, move)) status = sunder_i_failure_cause(err);
        if (!status) status = sunder_i_trial_place(&t, none, err);
    }
    sunder_i_trial_free(&t);
    sunder_i_free(move);
    return status;
}

static bool has_moved(const sunder_i_model *model, const sunder_i_group *g)
{
    for (size_t k = 0; k < g->n; k++) {
        if (sunder_i_is_astray(model, g->body[k], model->move + 2 * (size_t)g->body[k])) return true;
    }
    return false;
}

sunder_status sunder_i_solver_put_in_contact(sunder_i_solver *solver, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < solver->groups.n && !status; k++) {
        const sunder_i_group *g = &solver->groups.group[k];
        if (sunder_i_solver_any_of(solver, g->body, g->n, sunder_i_is_wanted) && has_moved(&solver->model, g))
            status = put_group_in_contact(solver, g, err);
    }
    return status;
}

/* ---- Home again -------------------------------------------------------------------------------------------------- */

static bool is_hardly_moved(const sunder_i_model *model, const sunder_i_cluster *c, uint32_t body)
{
    const double far = sunder_i_stray(model, body, model->move + 2 * (size_t)body);
    return far > 0 && far <= HARDLY * c->margin && sunder_i_may_move(&model->body[body]);
}

/* Sets the goal of each body of the trial to the place that it prefers. False if memory is out. */
static bool aim_at_preferred(const sunder_i_solver *s, sunder_i_trial *t)
{
    if (!s->model.preferred || t->n == 0) return true;
    t->goal = sunder_i_alloc(2 * t->n, sizeof *t->goal);
    for (size_t k = 0; k < t->n && t->goal; k++)
        memcpy(t->goal + 2 * k, sunder_i_preferred(&s->model, t->body[k]), 2 * sizeof *t->goal);
    return t->goal != NULL;
}

/* Tries to send home body `only`, or all bodies of the cluster that hardly moved. *well: whether that was possible. */
static sunder_status send_home(sunder_i_solver *s, const sunder_i_cluster *c, uint32_t only, bool *well,
                               sunder_error *err)
{
    const double home[2] = {0, 0};
    bool ok = true;
    sunder_i_trial t = {.solver = s, .along = 3, .whole_rows = true};
    for (size_t k = 0; k < c->n && ok; k++)
        if (is_hardly_moved(&s->model, c, c->body[k]) && (only == SUNDER_I_NOBODY || only == c->body[k]))
            ok = sunder_i_trial_take(&t, c->body[k]);
    ok = ok && aim_at_preferred(s, &t);
    sunder_status status = ok ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status && t.n) status = sunder_i_trial_place(&t, home, err);
    *well = t.well || t.n == 0;
    sunder_i_trial_free(&t);
    return status;
}

sunder_status sunder_i_solver_return_home(sunder_i_solver *solver, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < solver->clusters && !status; k++) {
        const sunder_i_cluster *c = &solver->cluster[k];
        bool well;
        sunder_i_reading reading;
        sunder_i_reads_begin(&reading, &solver->model, sunder_i_reader_for(solver, c));
        status = send_home(solver, c, SUNDER_I_NOBODY, &well, err);
        for (size_t m = 0; m < c->n && !well && !status; m++) {
            bool ignored;
            status = send_home(solver, c, c->body[m], &ignored, err);
        }
        sunder_i_reads_end(&reading);
    }
    return status;
}
