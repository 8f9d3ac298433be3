/* The order of the stages of one layer, as two tables.
 *
 * `passes` is the order of the whole work: a search without limits; if a limit is exceeded, a search within the limits,
 * which leaves the moves that exceed no limit as they are; after each search, proofs of contact groups; at the end the
 * check that no pair is worse than at the start.
 *
 * `seeking` is the order of the stages of one search. A stage is run again as long as it changes something, up to its
 * number of rounds. After each change clusters are settled (solve/clusters/settle.c), since a change makes new
 * conflicts. A stage leaves a cluster unchanged if it does not apply to it, so that the result of a cluster does not
 * depend on the number of rounds that others take. */
#include "displacement/solve_layer.h"

#include "displacement/report/report.h"
#include "displacement/solve/clusters/cluster_stages.h"

#include "base/invariant.h"
#include "base/stage_switch.h"

/* The approximate share of the whole work that is done when the search without limits ends. The other shares are in the
 * headers. */
#define FOUND_WITHOUT_LIMITS 0.4
#define FOUND SUNDER_PROGRESS_SOLVED

typedef struct stage {
    const char *name;
    /* The condition under which a round is run; NULL if there is none. */
    sunder_status (*applies)(const sunder_i_solver *s, bool *applies, sunder_error *err);
    /* Runs one round. *changed becomes whether clusters have to be settled and the stage may have another round. */
    sunder_status (*run)(sunder_i_solver *s, bool *changed, sunder_error *err);
    int rounds;      /* the largest number of rounds */
    double from, to; /* the range of the search's progress, from 0 to 1, that settling after this stage covers */
} stage;

/* ---- Conditions -------------------------------------------------------------------------------------------------- */

static bool any_body(const sunder_i_solver *s, sunder_i_body_test test)
{
    for (uint32_t b = 0; b < s->model.bodies; b++)
        if (test(s, b)) return true;
    return false;
}

static sunder_status has_given_up(const sunder_i_solver *s, bool *applies, sunder_error *err)
{
    (void)err;
    *applies = any_body(s, sunder_i_is_to_retry);
    return SUNDER_OK;
}

static sunder_status is_not_improved(const sunder_i_solver *s, bool *applies, sunder_error *err)
{
    bool improved = false;
    const sunder_status status = sunder_i_solver_is_improved(s, &improved, err);
    *applies = !improved;
    return status;
}

static sunder_status has_no_limits(const sunder_i_solver *s, bool *applies, sunder_error *err)
{
    (void)err;
    *applies = !s->had_limits;
    return SUNDER_OK;
}

static sunder_status has_limits(const sunder_i_solver *s, bool *applies, sunder_error *err)
{
    (void)err;
    *applies = s->had_limits;
    return SUNDER_OK;
}

static sunder_status is_wanted_within_limits(const sunder_i_solver *s, bool *applies, sunder_error *err)
{
    (void)err;
    *applies = s->had_limits && any_body(s, sunder_i_is_wanted);
    return SUNDER_OK;
}

static sunder_status has_held(const sunder_i_solver *s, bool *applies, sunder_error *err)
{
    (void)err;
    *applies = sunder_i_solver_any_held(s);
    return SUNDER_OK;
}

static sunder_status has_let_go(const sunder_i_solver *s, bool *applies, sunder_error *err)
{
    (void)err;
    *applies = s->any_let_go;
    return SUNDER_OK;
}

static sunder_status has_no_effort(const sunder_i_solver *s, bool *applies, sunder_error *err)
{
    (void)err;
    *applies = !(s->model.rules.effort > 0);
    return SUNDER_OK;
}

/* ---- Stages of one search ---------------------------------------------------------------------------------------- */

/* Covers the diagonals that proofs may need, if there are pairs to be examined; most layers have few or none. */
static sunder_status cover_diagonals_for_proofs(sunder_i_solver *s, sunder_error *err)
{
    return s->model.given_up_n ? sunder_i_report_cover_diagonals(s, err) : SUNDER_OK;
}

static sunder_status choose_holders(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return sunder_i_solver_choose_holders(s, err);
}

/* Only causes the clusters to be settled. */
static sunder_status only_settle(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)s;
    (void)err;
    *changed = true;
    return SUNDER_OK;
}

/* Examines the pairs that were given up once more, each time with the bodies that the search has met since. */
static sunder_status reconsider_pairs(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    const sunder_status status = cover_diagonals_for_proofs(s, err);
    return status ? status : sunder_i_solver_reconsider(s, changed, err);
}

static sunder_status mark_for_retry(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    (void)err;
    for (uint32_t b = 0; b < s->model.bodies; b++)
        sunder_i_body_event(&s->states, b, sunder_i_is_wanted(s, b) ? SUNDER_I_GIVES_UP : SUNDER_I_IS_RETRIED);
    return SUNDER_OK;
}

/* Tries the pairs that were given up once more. In each round bodies that may move again run into others, and more
 * pairs are given up. */
static sunder_status retry_pairs(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    const sunder_status status = sunder_i_solver_retry(s, err);
    for (uint32_t b = 0; b < s->model.bodies; b++) sunder_i_body_event(&s->states, b, SUNDER_I_IS_RETRIED);
    *changed = true;
    return status;
}

/* Improves the clusters that were joined since better sides were last looked for. */
static sunder_status improve_clusters(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    *changed = true;
    return sunder_i_solver_improve(s, err);
}

/* Examines the pairs that were given up one at a time; in each round one pair of each cluster is solved. */
static sunder_status ask_one_by_one(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    const sunder_status status = cover_diagonals_for_proofs(s, err);
    return status ? status : sunder_i_solver_ask_one_by_one(s, changed, err);
}

static sunder_status fit_exactly(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    *changed = true;
    return sunder_i_solver_fit_exactly(s, err);
}

static const stage seeking[] = {
    {"choose holders", NULL, choose_holders, 1, 0, 0},
    {"settle", NULL, only_settle, 1, 0, 3. / 7},
    {"reconsider", NULL, reconsider_pairs, 4, 3. / 7, 4. / 7},
    {"mark for retry", NULL, mark_for_retry, 1, 0, 0},
    {"retry", has_given_up, retry_pairs, 3, 4. / 7, 5. / 7},
    {"improve", is_not_improved, improve_clusters, 3, 5. / 7, 1},
    {"ask one by one", NULL, ask_one_by_one, 16, 6. / 7, 1},
    {"fit exactly", NULL, fit_exactly, 1, 1, 1},
};

/* ---- Running the tables ------------------------------------------------------------------------------------------ */

/* Runs the rounds of one stage. `from` and `to` are the progress at the beginning and the end of the search. */
static sunder_status run_stage(sunder_i_solver *s, const stage *x, double from, double to, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    bool changed = true;
    for (int round = 0; round < x->rounds && changed && !status; round++) {
        bool applies = true;
        if (x->applies) status = x->applies(s, &applies, err);
        if (status || !applies) break;
        changed = false;
        s->model.round = x->rounds > 1 ? round + 1 : 0;
        status = x->run(s, &changed, err);
        if (!status && changed)
            status = sunder_i_solver_settle(s, from + (to - from) * x->from, from + (to - from) * x->to, err);
        if (!status) SUNDER_I_CHECK(sunder_i_solver_check_states(s), s->model.bodies);
        if (!status) sunder_i_trace_layer(&s->model, changed ? "changed" : "done");
    }
    return status;
}

/* Runs the stages of a table, in order. */
static sunder_status run_table(sunder_i_solver *s, const stage *table, size_t n, double from, double to,
                               sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < n && !status; k++) {
        *(table == seeking ? &s->model.stage : &s->model.pass) = table[k].name;
        if (sunder_i_stage_is_on(table == seeking ? "search" : "layer", table[k].name))
            status = run_stage(s, &table[k], from, to, err);
    }
    s->model.stage = NULL;
    return status;
}

#define LENGTH(table) (sizeof(table) / sizeof(table)[0])

static sunder_status run_search(sunder_i_solver *s, double from, double to, sunder_error *err)
{
    return run_table(s, seeking, LENGTH(seeking), from, to, err);
}

/* ---- Passes ------------------------------------------------------------------------------------------------------ */

static sunder_status lift_limits(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return sunder_i_solver_lift_limits(s, &s->had_limits, err);
}

static sunder_status move_inside(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return sunder_i_solver_move_inside(s, err);
}

static sunder_status seek_first(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return run_search(s, SUNDER_I_PREPARED, s->had_limits ? FOUND_WITHOUT_LIMITS : FOUND, err);
}

/* Proves contact groups and accepts the cheaper layouts that are found. Then removes the margins where features can be
 * in exact contact in doubles. */
static sunder_status optimise_groups(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    sunder_status status = sunder_i_solver_optimise(s, err);
    if (!status && !(s->model.rules.effort > 0)) status = sunder_i_solver_gather_groups(s, err);
    return status ? status : sunder_i_solver_put_in_contact(s, err);
}

static sunder_status restore_limits(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return sunder_i_solver_restore_limits(s, err);
}

static sunder_status seek_within_limits(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return run_search(s, FOUND_WITHOUT_LIMITS, FOUND, err);
}

static sunder_status keep_held(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return sunder_i_solver_keep_held(s, s->held_layout, err);
}

/* Allows held bodies to move that are still in conflict, or whose moves may be of use to a neighbour. Their clusters
 * begin again; "take better" keeps the better of the two layouts. */
static sunder_status let_go(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return sunder_i_solver_let_go(s, &s->any_let_go, err);
}

static sunder_status seek_without_holding(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return run_search(s, FOUND, FOUND, err);
}

static sunder_status take_better(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return sunder_i_solver_take_better(s, s->held_layout, err);
}

static sunder_status uphold_pairs(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return sunder_i_solver_uphold(s, err);
}

static sunder_status place_lone_bodies(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return sunder_i_solver_place_lone_bodies(s, err);
}

/* Proves once more the groups of bodies that were changed since; no layout gets worse by that. */
static sunder_status prove_all(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    for (uint32_t b = 0; b < s->model.bodies; b++) sunder_i_body_event(&s->states, b, SUNDER_I_IS_WANTED);
    return sunder_i_solver_optimise(s, err);
}

static sunder_status gather_groups(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return sunder_i_solver_gather_groups(s, err);
}

static sunder_status gather_clusters(sunder_i_solver *s, bool *changed, sunder_error *err)
{
    (void)changed;
    return sunder_i_solver_gather(s, err);
}

/* No pass has more than one round. */
static const stage passes[] = {
    {"lift limits", NULL, lift_limits, 1, 0, 0},
    {"move inside", has_no_limits, move_inside, 1, 0, 0},
    {"seek", NULL, seek_first, 1, 0, 0},
    {"optimise", NULL, optimise_groups, 1, 0, 0},
    {"restore limits", has_limits, restore_limits, 1, 0, 0},
    {"move inside", has_limits, move_inside, 1, 0, 0},
    {"seek within limits", has_limits, seek_within_limits, 1, 0, 0},
    {"optimise", is_wanted_within_limits, optimise_groups, 1, 0, 0},
    {"keep held", has_held, keep_held, 1, 0, 0},
    {"let go", has_held, let_go, 1, 0, 0},
    {"seek without holding", has_let_go, seek_without_holding, 1, 0, 0},
    {"optimise", has_let_go, optimise_groups, 1, 0, 0},
    {"uphold", has_let_go, uphold_pairs, 1, 0, 0},
    {"take better", has_let_go, take_better, 1, 0, 0},
    {"uphold", NULL, uphold_pairs, 1, 0, 0},
    {"place lone bodies", NULL, place_lone_bodies, 1, 0, 0},
    {"prove all", NULL, prove_all, 1, 0, 0},
    {"gather groups", has_no_effort, gather_groups, 1, 0, 0},
    {"gather", NULL, gather_clusters, 1, 0, 0},
};

sunder_status sunder_i_layer_solve(sunder_i_solver *solver, sunder_error *err)
{
    sunder_i_held_layout held = {0};
    solver->held_layout = &held;
    const sunder_status status = run_table(solver, passes, LENGTH(passes), 0, 0, err);
    solver->held_layout = NULL;
    sunder_i_held_layout_free(&held);
    return status;
}
