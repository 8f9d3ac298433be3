/* Separates or checks a whole layer. Bodies in conflict form clusters, clusters are solved, bodies that a solved
 * cluster then runs into join it, and exact tests decide what is in conflict:
 *
 *     relations of the features --> edges between bodies --> clusters --> moves, rounded
 *            ^                                                              |
 *            +------------- relations of the moved features, exact <--------+
 *
 * Such rounds are run by solve/clusters/settle.c, and solve_layer.c contains the order in which it is called, as a
 * table. This file contains what comes before and after. */
#include "displacement/hide/hiding.h"
#include "displacement/prove/proofs/feasibility.h"
#include "displacement/report/report.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve_layer.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/sized_struct.h"
#include "base/watch.h"

#include <string.h>

/* Approximate shares of the whole work that are done when bounds and pushes are known, and when proofs are. */
#define BOUNDED 0.84
#define PROVED 0.9
/* Determines the relations of all near pairs; with `movers_only`, except pairs of two fixed features. */
static sunder_status relate_features(sunder_i_solver *s, bool movers_only, sunder_error *err)
{
    if (!movers_only) return sunder_i_placement_relate(&s->model, &s->placement, NULL, &s->start, err);
    sunder_i_changes movers;
    sunder_status status = sunder_i_changes_init(&movers, s->model.things) ? SUNDER_OK : sunder_i_failure_cause(err);
    for (uint32_t f = 0; f < s->model.features && !status; f++)
        if (s->model.present[f] && !sunder_i_feature(&s->layer, f).fixed) sunder_i_changes_add(&movers, f);
    if (!status && !sunder_i_changes_sort(&movers)) status = sunder_i_failure_cause(err);
    if (!status) status = sunder_i_placement_relate(&s->model, &s->placement, &movers, &s->start, err);
    sunder_i_changes_free(&movers);
    return status;
}

/* What a layer is read for: to separate its features; to list the conflicts in the order of the input; or to find out
 * whether its movable features have a solution. */
typedef enum purpose { TO_SEPARATE, TO_CHECK, TO_ANSWER } purpose;

static sunder_status read_layer(sunder_i_solver *s, const sunder_layer *layer, const sunder_layer_options *options,
                                purpose what_for, sunder_report **report, sunder_error *err)
{
    sunder_i_rules rules;
    sunder_status status = sunder_i_rules_of(options, &rules, err);
    if (what_for != TO_SEPARATE) rules.trace = NULL;
    if (!status) status = sunder_i_barriers_make(layer, &rules, &s->barriers, err);
    if (!status) status = sunder_i_order_layer(layer, &s->barriers, what_for == TO_CHECK, &s->layer, err);
    if (!status) status = sunder_i_model_init(&s->layer, &s->barriers, &rules, &s->model, err);
    if (!status) status = sunder_i_placement_init(&s->model, &s->placement, err);
    s->model.standing = &s->placement.tree;
    if (!status) status = relate_features(s, what_for == TO_ANSWER, err);
    if (!status) status = sunder_i_model_join(&s->model, &s->start, err);
    if (!status && what_for == TO_SEPARATE) status = sunder_i_model_note_crossed(&s->model, &s->start, err);
    if (!status) status = sunder_i_report_new(&s->model, report, err);
    if (status) return status;
    (*report)->summary.pairs_tested = s->start.tested;
    sunder_i_count_relations(&s->model, &s->start, &(*report)->summary.before);
    status = sunder_i_count_thin_overlaps(&s->model, &s->placement, &s->start, *report, err);
    return status ? status : sunder_i_report_keep_home(*report, &s->model, &s->start, err);
}

/* Makes s->now equal to the relations of the start. Returns false if memory is out. */
static bool begin_as_at_start(sunder_i_solver *s)
{
    const size_t n = s->start.n, size = sizeof *s->now.pair;
    if (!sunder_i_reserve(&s->now.pair, &s->now.room, n, size)) return false;
    if (n) memcpy(s->now.pair, s->start.pair, n * size);
    s->now.n = n;
    return true;
}

/* Prepares the data of the search: the bodies in doubles, the features that are shut in, and the relations of the
 * start. */
static sunder_status prepare_search(sunder_i_solver *s, sunder_error *err)
{
    sunder_status status = sunder_i_model_cut(&s->model, err);
    if (!status) status = sunder_i_model_anchor(&s->model, err);
    if (!status && sunder_i_has_bare_barriers(&s->model)) status = sunder_i_model_cover_diagonals(&s->model, err);
    if (!status) status = sunder_i_solver_find_shut_in(s, err);
    if (!status) status = sunder_i_solver_init(s, err);
    if (status) return status;
    return begin_as_at_start(s) ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* Leaves out the features that are hidden, by the caller's numbers, with their edges of rows, and gives the others the
 * shapes that they have now. */
static sunder_status lower_features(sunder_i_solver *s, const bool *hidden, sunder_error *err)
{
    bool *own = hidden ? sunder_i_alloc(s->model.features, sizeof *own) : NULL;
    if (hidden && !own) return sunder_i_failure_cause(err);
    for (size_t f = 0; f < s->model.features && own; f++) own[f] = hidden[s->layer.number[f]];
    s->layer.lowered = s->layer.given->at_level != NULL;
    const sunder_status status = sunder_i_placement_lower(&s->model, &s->placement, &s->start, own, err);
    sunder_i_free(own);
    return status ? status : sunder_i_rows_forget_hidden(&s->rows, &s->model, err);
}

/* Does everything up to the point where the report begins. hidden: NULL, or the features that are left out, by the
 * caller's numbers; blocks, inclusions and rows are those of all features. */
static sunder_status find_moves(sunder_i_solver *s, const sunder_layer *layer, const sunder_layer_options *options,
                                const bool *hidden, sunder_report **report, sunder_error *err)
{
    sunder_status status = read_layer(s, layer, options, TO_SEPARATE, report, err);
    const bool rows = !status && s->model.rules.rows;
    if (rows) status = sunder_i_rows_find(&s->model, &s->rows, err);
    if (!status && hidden) status = lower_features(s, hidden, err);
    if (!status) status = sunder_i_solver_begin_holding(s, err);
    if (!status) status = sunder_i_solver_find_infeasible(s, NULL, err);
    if (!status) status = prepare_search(s, err);
    if (!status && rows) status = sunder_i_rows_make_rule(&s->rows, &s->placement, &s->start, &s->model, err);
    if (!status && !sunder_i_model_prefer(&s->model)) status = sunder_i_failure_cause(err);
    if (!status) sunder_i_model_rest_springs(&s->model);
    if (!status) status = sunder_i_solver_begin_holding(s, err);
    if (!status && !sunder_i_progress(&s->model.rules, SUNDER_I_PREPARED)) status = sunder_i_failure_cause(err);
    if (!status) status = sunder_i_layer_solve(s, err);
    if (!status && !sunder_i_progress(&s->model.rules, SUNDER_PROGRESS_SOLVED)) status = sunder_i_failure_cause(err);
    return status;
}

/* Prepares the layer up to the point where proofs can be asked for. */
static sunder_status prepare_for_proofs(sunder_i_solver *s, const sunder_i_spared *list, sunder_error *err)
{
    sunder_status status = sunder_i_inclusions_note_nested(&s->model, &s->start, err);
    if (!status) status = sunder_i_solver_spare(s, list, err);
    if (!status) status = prepare_search(s, err);
    return status ? status : sunder_i_rows_take_rule(list->row, list->rows, s->layer.number, &s->model, err);
}

static sunder_status look_for_proof(sunder_i_solver *s, const sunder_i_spared *list, sunder_i_proof_found *found,
                                    sunder_error *err)
{
    sunder_i_verdict verdict;
    sunder_i_planes planes = {0};
    const sunder_i_proving how = {.spared = list, .planes = &planes};
    const sunder_status status = sunder_i_solver_prove(s, &how, &verdict, &s->refuted, err);
    sunder_i_planes_clear(&planes);
    s->hopeless = verdict == SUNDER_I_INFEASIBLE;
    *found = s->hopeless ? SUNDER_I_PROOF_FOUND : SUNDER_I_PROOF_IN_VAIN;
    return status;
}

/* Answers a question about a conflict: solves a small layer without a report, to find out whether all of it has a
 * solution. Work ends with the first pair that has no solution, with a proof, or with a cluster without a result; no
 * pair is given up, and no layout is improved. (If a contained feature has to leave its holder, this is found out only
 * by a search that fails, so work does not end then.) */
static sunder_status answer_question(const sunder_layer *layer, const sunder_layer_options *options,
                                     const sunder_i_spared *spared, sunder_i_proof_found *proof, sunder_i_solver *s,
                                     sunder_error *err)
{
    sunder_report *report = NULL;
    sunder_status status = read_layer(s, layer, options, TO_ANSWER, &report, err);
    sunder_report_free(report);
    if (!status && layer->at_level) status = lower_features(s, NULL, err);
    if (!status && *proof == SUNDER_I_PROOF_LATER) return prepare_for_proofs(s, spared, err);
    if (!status) status = sunder_i_solver_find_infeasible(s, spared, err);
    if (status) return status;
    s->refuted = options->gap;
    s->brief = s->model.inclusions == 0;
    s->hopeless = s->brief && sunder_i_solver_is_beyond_limits(s, spared);
    if (s->hopeless) return SUNDER_OK;
    status = sunder_i_solver_spare(s, spared, err);
    if (!status) status = prepare_search(s, err);
    if (!status) status = sunder_i_rows_take_rule(spared->row, spared->rows, s->layer.number, &s->model, err);
    /* Preparation may find that the two are shut in. */
    s->hopeless = s->brief && sunder_i_solver_is_beyond_limits(s, spared);
    if (!status && s->brief && !s->hopeless && *proof == SUNDER_I_PROOF_WANTED)
        status = look_for_proof(s, spared, proof, err);
    if (!status && !s->hopeless) status = sunder_i_solver_move_inside(s, err);
    if (!status && !s->hopeless) status = sunder_i_solver_choose_holders(s, err);
    if (!status && !s->hopeless) status = sunder_i_solver_settle(s, 0, 1, err);
    return status;
}

/* Determines the relations of all features that moved or were rounded once more, so that the report is based on no
 * relation that was found during the search. A pair in which neither feature did so has the relation that was found at
 * the start. */
static sunder_status relate_last(sunder_i_solver *s, sunder_error *err)
{
    sunder_i_changes elsewhere;
    sunder_status status = sunder_i_changes_init(&elsewhere, s->model.things) ? SUNDER_OK : sunder_i_failure_cause(err);
    for (uint32_t f = 0; f < s->model.features && !status; f++) {
        const double *t = s->placement.move + 2 * (size_t)f;
        if (t[0] != 0 || t[1] != 0 || s->placement.reshaped[f]) sunder_i_changes_add(&elsewhere, f);
    }
    if (!status && elsewhere.failed) status = sunder_i_failure_cause(err);
    if (!status && !begin_as_at_start(s)) status = sunder_i_failure_cause(err);
    if (!status) status = sunder_i_placement_relate_again(&s->model, &s->placement, &elsewhere, NULL, &s->now, err);
    sunder_i_changes_free(&elsewhere);
    return status ? status : sunder_i_jumps_update(&s->jumps, &s->model, NULL, err);
}

/* Reports progress, unless `status` is an error already. */
static sunder_status pass_progress(const sunder_i_solver *s, double fraction, sunder_status status, sunder_error *err)
{
    if (status || sunder_i_progress(&s->model.rules, fraction)) return status;
    return sunder_i_failure_cause(err);
}

static void trace_conflicts(sunder_i_solver *s, const sunder_report *report)
{
    s->model.pass = "report";
    for (size_t k = 0; k < report->conflicts; k++) {
        const sunder_conflict *c = &report->conflict[k];
        const char *reason = sunder_reason_string(c->reason);
        sunder_i_trace_pair(&s->model, "why it remains", reason, (uint32_t)c->a, (uint32_t)c->b);
    }
}

/* Determines what remains and why, what would free it, and the lower bound of the cost. */
static sunder_status explain_result(sunder_i_solver *s, const sunder_layer_options *options, sunder_report *report,
                                    sunder_error *err)
{
    sunder_i_count_relations(&s->model, &s->now, &report->summary.after);
    sunder_status status = sunder_i_report_cover_diagonals(s, err);
    if (!status) status = sunder_i_report_conflicts(report, &s->model, &s->placement, &s->now, true, err);
    if (!status) status = sunder_i_report_tight(report, &s->model, &s->placement, true, err);
    if (!status) status = sunder_i_report_eased(report, &s->model, err);
    if (!status) status = sunder_i_report_bound(report, s, err);
    if (!status) status = sunder_i_report_optimality(report, s, err);
    if (!status) status = sunder_i_report_pushes(report, s, err);
    if (!status) status = sunder_i_report_row_pairs(report, &s->model, &s->rows, err);
    status = pass_progress(s, BOUNDED, status, err);
    if (!status) status = sunder_i_report_proofs(report, s, sunder_i_decide, false, err);
    if (!status) status = sunder_i_report_blockers(report, s, err);
    status = pass_progress(s, PROVED, status, err);
    if (!status) trace_conflicts(s, report);
    if (!status) status = sunder_i_report_cluster_needs(report, s, true, err);
    if (!status) status = sunder_i_report_needs(report, s, options, answer_question, err);
    if (!status) status = sunder_i_report_cluster_needs(report, s, false, err);
    return pass_progress(s, SUNDER_PROGRESS_EXPLAINED, status, err);
}

/* Writes the result to the report, in the internal order of features. */
static sunder_status fill_report(sunder_i_solver *s, sunder_i_influence *influence, sunder_report *report,
                                 sunder_error *err)
{
    sunder_i_pieces_forget(&s->model, SUNDER_I_PIECES_HELD);
    /* The positions are not needed any more, unless worlds are kept for a layer that is combined of several. */
    if (!s->model.rules.keep_worlds) sunder_i_placement_free(&s->model, &s->placement);
    const sunder_status status = sunder_i_report_features(report, &s->model, err);
    if (status) return status;
    sunder_i_report_moves(report, &s->model);
    const sunder_status added = sunder_i_report_add_tight(report, &s->model, err);
    return added ? added : sunder_i_report_worlds(report, s, influence, err);
}

/* Determines the relations of moved features once more, explains the result, and then verifies that no remaining
 * conflict is worse than at the start. That no other pair is in conflict is known from the relations. */
static sunder_status conclude_report(sunder_i_solver *s, const sunder_layer_options *options,
                                     sunder_i_influence *influence, sunder_report *report, double began,
                                     sunder_error *err)
{
    const double solved = sunder_i_now();
    sunder_i_solver_forget_clusters(s);
    sunder_i_solver_end_holding(s);
    sunder_status status = relate_last(s, err);
    const double related = sunder_i_now();
    if (!status) status = explain_result(s, options, report, err);
    const double explained = sunder_i_now();
    if (!status) status = sunder_i_solver_is_upheld(s, &report->summary.verified, err);
    const double verified = sunder_i_now();
    if (!status) status = fill_report(s, influence, report, err);
    if (status) return status;
    report->summary.seconds_solve = solved - began;
    report->summary.seconds_verify = (related - solved) + (verified - explained);
    report->summary.seconds_explain = (explained - related) + (sunder_i_now() - verified);
    return SUNDER_OK;
}

/* Converts the report to the caller's numbers. That needs room for all moves once more, so the solver is freed
 * first. */
static sunder_status renumber_report(sunder_i_solver *s, sunder_report *report, sunder_error *err)
{
    uint32_t *number = s->layer.number;
    s->layer.number = NULL;
    sunder_i_solver_free(s);
    const sunder_status status = sunder_i_report_renumber(report, number, err);
    sunder_i_free(number);
    return status;
}

/* Lists the conflicts of a layout with their reasons and proofs. one_each: one proof for each cluster is enough. */
static sunder_status find_reasons(sunder_i_solver *s, sunder_report *report, bool one_each, sunder_error *err)
{
    sunder_i_solver_forget_clusters(s);
    sunder_i_solver_end_holding(s);
    sunder_status status = relate_last(s, err);
    if (!status) status = sunder_i_report_cover_diagonals(s, err);
    if (!status) status = sunder_i_report_conflicts(report, &s->model, &s->placement, &s->now, true, err);
    return status ? status : sunder_i_report_proofs(report, s, sunder_i_decide, one_each, err);
}

/* Lays a layer out anew in place of the layout at hand. */
static sunder_status lay_out_again(sunder_i_solver *s, const sunder_layer *layer, const sunder_layer_options *options,
                                   const bool *hidden, sunder_report **report, sunder_error *err)
{
    sunder_i_solver_free(s);
    sunder_report_free(*report);
    memset(s, 0, sizeof *s);
    *report = NULL;
    return find_moves(s, layer, options, hidden, report, err);
}

/* Lists the conflicts of a layout, and notes what influenced each other in it. */
static sunder_status look_at_layout(sunder_i_solver *s, sunder_i_hiding *hiding, sunder_report *report, bool one_each,
                                    sunder_error *err)
{
    const sunder_status status = find_reasons(s, report, one_each, err);
    if (status || !s->model.rules.keep_worlds) return status;
    return sunder_i_influence_add(&hiding->influence, s, report, err);
}

/* Lays the features out with the present choice, and lists the conflicts. */
static sunder_status try_choice(sunder_i_solver *s, const sunder_layer *lowered, const sunder_layer_options *options,
                                sunder_i_hiding *hiding, sunder_report **report, sunder_error *err)
{
    sunder_i_hiding_take_levels(hiding);
    const sunder_status status = lay_out_again(s, lowered, options, hiding->hidden, report, err);
    return status ? status : look_at_layout(s, hiding, *report, true, err);
}

/* Shows hidden features again that are in no conflict at their places in the last layout, except in worlds where more
 * conflicts would remain with them. */
static sunder_status show_fitting(sunder_i_solver *s, const sunder_layer *lowered, const sunder_layer_options *options,
                                  sunder_i_hiding *hiding, sunder_report **report, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (bool any = true; any && !status;) {
        bool again = false;
        status = sunder_i_hiding_note_conflicts(hiding, &s->model, *report, err);
        if (!status) status = sunder_i_hiding_unhide(hiding, &s->model, &s->placement, s->layer.number, &any, err);
        if (!status && any) status = try_choice(s, lowered, options, hiding, report, err);
        if (!status && any)
            status = sunder_i_hiding_hide_again(hiding, &s->model, s->layer.number, *report, &again, err);
        if (!status && again) status = try_choice(s, lowered, options, hiding, report, err);
    }
    return status;
}

/* Lays out the features that are not hidden, and hides more or makes them smaller, until nothing remains for which that
 * is possible. *lowered becomes the layer with the shapes of the last layout, which the solver refers to. */
static sunder_status lay_out_visible(sunder_i_solver *s, const sunder_layer *layer, const sunder_layer_options *options,
                                     sunder_i_hiding *hiding, sunder_layer *lowered, sunder_report **report,
                                     sunder_error *err)
{
    sunder_layer_options thorough = *options, quick;
    thorough.drop_proofs = false;                                 /* clauses need all of them */
    thorough.keep_worlds = options->keep_worlds || layer->hiding; /* what is shown again is decided by worlds */
    quick = thorough;
    quick.effort = 0;
    if (quick.full_gap <= quick.gap) quick.ease = 0; /* easing changes no verdict */
    sunder_status status = sunder_i_hiding_begin(layer, hiding, err);
    hiding->keep_proofs = options->keep_trees;
    *lowered = *layer;
    lowered->at_level = hiding->shape;
    while (!status && hiding->step != SUNDER_I_HIDING_END) {
        const sunder_layer_options *with = hiding->step == SUNDER_I_HIDING_THOROUGH ? &thorough : &quick;
        if (hiding->step != SUNDER_I_HIDING_PROVE)
            status = lay_out_again(s, lowered, with, hiding->hidden, report, err);
        else
            sunder_i_report_forget_conflicts(*report);
        /* With effort one proof for each cluster is enough: the choice after it changes the cluster. */
        const bool is_quick = hiding->step == SUNDER_I_HIDING_QUICK;
        s->model.rules.effort = is_quick ? 0 : options->effort;
        if (!status) status = look_at_layout(s, hiding, *report, !is_quick, err);
        if (!status) status = sunder_i_hiding_learn(hiding, &s->model, s->layer.number, *report, err);
    }
    if (!status && layer->hiding) status = show_fitting(s, lowered, &thorough, hiding, report, err);
    if (status) return status;
    sunder_i_report_forget_conflicts(*report);
    s->model.rules.keep_worlds = options->keep_worlds;
    s->model.rules.drop_proofs = (*report)->stripped = options->drop_proofs;
    return SUNDER_OK;
}

static sunder_status separate_layer(sunder_i_solver *s, const sunder_layer *layer, const sunder_layer_options *options,
                                    sunder_report **report, sunder_error *err)
{
    const double began = sunder_i_now();
    const bool may_lower = layer->hiding || layer->level_end;
    sunder_i_hiding hiding = {0};
    sunder_layer lowered;
    if (layer->preferred && (options->keep_worlds || options->keep_trees))
        return sunder_i_fail(err, SUNDER_EARG, "worlds and trees cannot be kept if features have preferred places");
    sunder_status status = may_lower ? lay_out_visible(s, layer, options, &hiding, &lowered, report, err)
                                     : find_moves(s, layer, options, NULL, report, err);
    if (!status) status = conclude_report(s, options, &hiding.influence, *report, began, err);
    if (!status && may_lower) status = sunder_i_hiding_report(&hiding, *report, err);
    const sunder_i_rules rules = s->model.rules;
    if (!status) status = renumber_report(s, *report, err);
    sunder_i_hiding_free(&hiding);
    if (!status) sunder_i_progress(&rules, 1);
    return status;
}

static sunder_status check_layer(sunder_i_solver *s, const sunder_layer *layer, const sunder_layer_options *options,
                                 sunder_report **report, sunder_error *err)
{
    const double began = sunder_i_now();
    sunder_status status = read_layer(s, layer, options, TO_CHECK, report, err);
    if (!status) status = sunder_i_report_conflicts(*report, &s->model, &s->placement, &s->start, false, err);
    if (!status) status = sunder_i_report_tight(*report, &s->model, &s->placement, false, err);
    if (!status) status = sunder_i_report_add_tight(*report, &s->model, err);
    if (!status) status = sunder_i_report_features(*report, &s->model, err);
    if (!status) status = sunder_i_report_renumber(*report, s->layer.number, err);
    if (status) return status;
    sunder_layer_summary *summary = &(*report)->summary;
    summary->after = summary->before;
    summary->verified = true;
    summary->seconds_verify = sunder_i_now() - began;
    return SUNDER_OK;
}

typedef sunder_status (*run_stages)(sunder_i_solver *s, const sunder_layer *layer, const sunder_layer_options *options,
                                    sunder_report **report, sunder_error *err);

static sunder_status run_stages_of(run_stages stages, const sunder_layer *layer, const sunder_layer_options *options,
                                   sunder_report **out, sunder_error *err)
{
    sunder_i_solver s = {0};
    sunder_i_watch watch;
    sunder_report *report = NULL;
    sunder_layer_options o;
    sunder_layer_options_init(&o);
    sunder_status status = sunder_i_options_read(&o, sizeof o, options, err);
    if (status) return status;
    sunder_i_watch_begin(&watch, &o.progress, &o.progress_user);
    status = stages(&s, layer, &o, &report, err);
    sunder_i_watch_end(&watch);
    sunder_i_solver_free(&s);
    if (status)
        sunder_report_free(report);
    else
        *out = report;
    return status;
}

sunder_status sunder_layer_separate(const sunder_layer *layer, const sunder_layer_options *options, sunder_report **out,
                                    sunder_error *err)
{
    return run_stages_of(separate_layer, layer, options, out, err);
}

sunder_status sunder_layer_check(const sunder_layer *layer, const sunder_layer_options *options, sunder_report **out,
                                 sunder_error *err)
{
    return run_stages_of(check_layer, layer, options, out, err);
}
