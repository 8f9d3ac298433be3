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
#include "displacement/solve/clusters/layer_stages.h"

/* The approximate share of the whole work that is done when the search without limits ends. The other shares are in the
 * headers. */
#define FOUND_WITHOUT_LIMITS 0.4
#define FOUND SUNDER_PROGRESS_SOLVED

#define LENGTH(table) (sizeof(table) / sizeof(table)[0])

/* ---- Conditions -------------------------------------------------------------------------------------------------- */

static bool any_body(const sunder_i_solver *s, sunder_i_body_test test)
{
    for (uint32_t b = 0; b < s->model.bodies; b++)
        if (test(s, b)) return true;
    return false;
}

static bool has_given_up(sunder_i_solver *s) { return any_body(s, sunder_i_is_to_retry); }

static bool has_no_limits(sunder_i_solver *s) { return !s->had_limits; }

static bool has_limits(sunder_i_solver *s) { return s->had_limits; }

static bool is_wanted_within_limits(sunder_i_solver *s) { return s->had_limits && any_body(s, sunder_i_is_wanted); }

static bool has_held(sunder_i_solver *s) { return sunder_i_solver_any_held(s); }

static bool has_let_go(sunder_i_solver *s) { return s->any_let_go; }

static bool has_price(sunder_i_solver *s) { return s->model.rules.ease > 0; }

static bool has_preferred(sunder_i_solver *s) { return s->model.preferred != NULL; }

static bool has_no_effort(sunder_i_solver *s) { return !(s->model.rules.effort > 0); }

/* ---- Stages of one search ---------------------------------------------------------------------------------------- */

/* Covers the diagonals that proofs may need, if there are pairs to be examined; most layers have few or none. */
static sunder_status cover_diagonals_for_proofs(sunder_i_solver *s, sunder_error *err)
{
    return s->model.given_up_n ? sunder_i_report_cover_diagonals(s, err) : SUNDER_OK;
}

/* Only causes the clusters to be settled. */
static sunder_status only_settle(sunder_i_solver *s, sunder_error *err)
{
    (void)err;
    s->changed = true;
    return SUNDER_OK;
}

/* Examines the pairs that were given up once more, each time with the bodies that the search has met since. */
static sunder_status reconsider_pairs(sunder_i_solver *s, sunder_error *err)
{
    const sunder_status status = cover_diagonals_for_proofs(s, err);
    return status ? status : sunder_i_solver_reconsider(s, &s->changed, err);
}

static sunder_status mark_for_retry(sunder_i_solver *s, sunder_error *err)
{
    (void)err;
    for (uint32_t b = 0; b < s->model.bodies; b++)
        sunder_i_body_event(&s->states, b, sunder_i_is_wanted(s, b) ? SUNDER_I_GIVES_UP : SUNDER_I_IS_RETRIED);
    return SUNDER_OK;
}

/* Tries the pairs that were given up once more. In each round bodies that may move again run into others, and more
 * pairs are given up. */
static sunder_status retry_pairs(sunder_i_solver *s, sunder_error *err)
{
    const sunder_status status = sunder_i_solver_retry(s, err);
    for (uint32_t b = 0; b < s->model.bodies; b++) sunder_i_body_event(&s->states, b, SUNDER_I_IS_RETRIED);
    s->changed = true;
    return status;
}

/* Improves the clusters that were joined since better sides were last looked for. */
static sunder_status improve_clusters(sunder_i_solver *s, sunder_error *err)
{
    s->changed = true;
    return sunder_i_solver_improve(s, err);
}

/* Examines the pairs that were given up one at a time; in each round one pair of each cluster is solved. A cluster of
 * symbols that stand on houses gives up dozens of pairs, so that it needs as many rounds. */
static sunder_status ask_one_by_one(sunder_i_solver *s, sunder_error *err)
{
    const sunder_status status = cover_diagonals_for_proofs(s, err);
    return status ? status : sunder_i_solver_ask_one_by_one(s, &s->changed, err);
}

static sunder_status fit_exactly(sunder_i_solver *s, sunder_error *err)
{
    s->changed = true;
    return sunder_i_solver_fit_exactly(s, err);
}

static const sunder_i_layer_stage seeking[] = {
    {"choose holders", NULL, sunder_i_solver_choose_holders, 1, 0, 0},
    {"settle", NULL, only_settle, 1, 0, 3. / 7},
    {"reconsider", NULL, reconsider_pairs, 4, 3. / 7, 4. / 7},
    {"mark for retry", NULL, mark_for_retry, 1, 0, 0},
    {"retry", has_given_up, retry_pairs, 3, 4. / 7, 5. / 7},
    {"improve", sunder_i_solver_is_to_improve, improve_clusters, 3, 5. / 7, 1},
    {"ask one by one", NULL, ask_one_by_one, 64, 6. / 7, 1},
    {"fit exactly", NULL, fit_exactly, 1, 1, 1},
};

static sunder_status run_search(sunder_i_solver *s, double from, double to, sunder_error *err)
{
    static const sunder_i_layer_table table = {"search", SUNDER_I_TABLE_OF_STAGES, seeking, LENGTH(seeking),
                                               sunder_i_solver_settle};
    return sunder_i_solver_run_stages(s, &table, from, to, err);
}

/* ---- Passes ------------------------------------------------------------------------------------------------------ */

static sunder_status seek_first(sunder_i_solver *s, sunder_error *err)
{
    return run_search(s, SUNDER_I_PREPARED, s->had_limits ? FOUND_WITHOUT_LIMITS : FOUND, err);
}

/* Proves contact groups and accepts the cheaper layouts that are found. Then removes the margins where features can be
 * in exact contact in doubles. */
static sunder_status optimise_groups(sunder_i_solver *s, sunder_error *err)
{
    sunder_status status = sunder_i_solver_optimise(s, err);
    if (!status && has_no_effort(s)) status = sunder_i_solver_gather_groups(s, err);
    return status ? status : sunder_i_solver_put_in_contact(s, err);
}

static sunder_status seek_within_limits(sunder_i_solver *s, sunder_error *err)
{
    return run_search(s, FOUND_WITHOUT_LIMITS, FOUND, err);
}

static sunder_status seek_without_holding(sunder_i_solver *s, sunder_error *err)
{
    return run_search(s, FOUND, FOUND, err);
}

/* Proves once more the groups of bodies that were changed since; no layout gets worse by that. */
static sunder_status prove_all(sunder_i_solver *s, sunder_error *err)
{
    for (uint32_t b = 0; b < s->model.bodies; b++) sunder_i_body_event(&s->states, b, SUNDER_I_IS_WANTED);
    return sunder_i_solver_optimise(s, err);
}

/* No pass has more than one round. "let go" allows held bodies to move that are still in conflict, or whose moves may
 * be of use to a neighbour. Their clusters begin again; "take better" keeps the better of the two layouts. */
static const sunder_i_layer_stage passes[] = {
    {"start preferred", has_preferred, sunder_i_solver_start_preferred, 1, 0, 0},
    {"lift limits", NULL, sunder_i_solver_lift_limits, 1, 0, 0},
    {"move inside", has_no_limits, sunder_i_solver_move_inside, 1, 0, 0},
    {"seek", NULL, seek_first, 1, 0, 0},
    {"optimise", NULL, optimise_groups, 1, 0, 0},
    {"restore limits", has_limits, sunder_i_solver_restore_limits, 1, 0, 0},
    {"move inside", has_limits, sunder_i_solver_move_inside, 1, 0, 0},
    {"seek within limits", has_limits, seek_within_limits, 1, 0, 0},
    {"optimise", is_wanted_within_limits, optimise_groups, 1, 0, 0},
    {"keep held", has_held, sunder_i_solver_keep_held, 1, 0, 0},
    {"let go", has_held, sunder_i_solver_let_go, 1, 0, 0},
    {"seek without holding", has_let_go, seek_without_holding, 1, 0, 0},
    {"optimise", has_let_go, optimise_groups, 1, 0, 0},
    {"uphold", has_let_go, sunder_i_solver_uphold, 1, 0, 0},
    {"take better", has_let_go, sunder_i_solver_take_better, 1, 0, 0},
    {"uphold", NULL, sunder_i_solver_uphold, 1, 0, 0},
    {"place lone bodies", NULL, sunder_i_solver_place_lone_bodies, 1, 0, 0},
    {"prove all", NULL, prove_all, 1, 0, 0},
    {"ease", has_price, sunder_i_solver_ease, 1, 0, 0},
    {"gather groups", has_no_effort, sunder_i_solver_gather_groups, 1, 0, 0},
    {"gather", NULL, sunder_i_solver_gather, 1, 0, 0},
    {"return home", NULL, sunder_i_solver_return_home, 1, 0, 0},
};

sunder_status sunder_i_layer_solve(sunder_i_solver *solver, sunder_error *err)
{
    static const sunder_i_layer_table table = {"layer", SUNDER_I_TABLE_OF_PASSES, passes, LENGTH(passes), NULL};
    sunder_i_held_layout held = {0};
    solver->held_layout = &held;
    const sunder_status status = sunder_i_solver_run_stages(solver, &table, 0, 0, err);
    solver->held_layout = NULL;
    sunder_i_held_layout_free(&held);
    return status;
}
