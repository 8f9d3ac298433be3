/* A whole layer: conflicts make clusters, clusters are solved, what they run into joins them, and exact checks have the
 * last word.
 *
 *     relations as it stands --> edges between bodies --> clusters --> moves, rounded
 *            ^                                                           |
 *            +---- relations of what moved, exact <----------------------+
 *
 * An edge is a pair of bodies that came into conflict at some time. Clusters are the components of the edges over
 * bodies that may move; a fixed body is a member of every cluster that has an edge to it, and joins none. Edges are
 * never removed, so each round either adds an edge between clusters, or widens the margin of a cluster whose result
 * failed the exact check (a limited number of times), or is the last: the loop ends. */
#include "displacement/clusters/settle.h"
#include "displacement/clusters/stages.h"
#include "displacement/report/report.h"

#include "base/clock.h"
#include "base/watch.h"

#include <string.h>

/* What was given up is looked at again, each time with what the search ran into since. */
#define RECONSIDERED 4
/* Better sides are looked for so often, where clusters joined since the last time. */
#define IMPROVED 3

static sunder_status start(sunder_i_job *w, const sunder_layer *layer, const sunder_layer_options *options,
                           sunder_report **report, sunder_error *err)
{
    sunder_i_rules rules;
    sunder_status status = sunder_i_rules_of(options, &rules, err);
    if (!status) status = sunder_i_town_init(layer, &rules, &w->town, err);
    if (!status) status = sunder_i_scene_init(&w->town, &w->scene, err);
    w->town.standing = &w->scene.tree;
    if (!status) status = sunder_i_scene_relate(&w->town, &w->scene, NULL, NULL, &w->start, err);
    if (!status) status = sunder_i_town_join(&w->town, &w->start, err);
    if (!status) status = sunder_i_report_new(&w->town, report, err);
    if (status) return status;
    (*report)->summary.pairs_tested = w->start.tested;
    sunder_i_count_relations(&w->town, &w->start, &(*report)->summary.before);
    return SUNDER_OK;
}

/* What is settled beforehand: pairs without a solution, the bodies in doubles, relations as they stand. */
static sunder_status prepare(sunder_i_job *w, sunder_error *err)
{
    sunder_status status = sunder_i_job_judge(w, err);
    if (!status) status = sunder_i_town_cut(&w->town, err);
    if (!status) status = sunder_i_job_init(w, err);
    if (status) return status;
    w->now.pair = sunder_i_alloc(w->start.n, sizeof *w->now.pair);
    if (!w->now.pair) return sunder_i_no_memory(err);
    if (w->start.n) memcpy(w->now.pair, w->start.pair, w->start.n * sizeof *w->now.pair);
    w->now.n = w->start.n;
    return SUNDER_OK;
}

/* Solves, looks again at what was given up, asks it once more, looks for better sides. Progress goes from `from` to
 * `to`. known: nothing is to be solved but what comes of looking again. */
static sunder_status seek(sunder_i_job *w, bool known, double from, double to, sunder_error *err)
{
    const double step = (to - from) / 7;
    bool again = true;
    sunder_status status = known ? SUNDER_OK : sunder_i_job_choose_holders(w, err);
    if (!status && !known) status = sunder_i_job_settle(w, from, from + 3 * step, err);
    for (int round = 0; round < RECONSIDERED && again && !status; round++) {
        status = sunder_i_job_reconsider(w, &again, err);
        if (!status && again) status = sunder_i_job_settle(w, from + 3 * step, from + 4 * step, err);
        known = known && !again;
    }
    if (status || known) return status;
    status = sunder_i_job_retry(w, err);
    if (!status) status = sunder_i_job_settle(w, from + 4 * step, from + 5 * step, err);
    /* What ran into others while it was improved is another cluster then. */
    for (int round = 0; round < IMPROVED && !status && !sunder_i_job_is_improved(w); round++) {
        status = sunder_i_job_improve(w, err);
        if (!status) status = sunder_i_job_settle(w, from + (5 + round / 2.0) * step, to, err);
    }
    return status;
}

/* Without limits first, and then within them. */
static sunder_status solve(sunder_i_job *w, sunder_error *err)
{
    bool lifted = false, back = false;
    sunder_status status = sunder_i_job_lift_limits(w, &lifted, err);
    if (!status && !lifted) status = sunder_i_job_enter(w, err);
    if (!status) status = seek(w, false, 0.1, lifted ? 0.4 : 0.8, err);
    if (!status && lifted) status = sunder_i_job_restore_limits(w, &back, err);
    if (!status && lifted) status = sunder_i_job_enter(w, err);
    if (!status && lifted) status = seek(w, !back, 0.4, 0.8, err);
    if (!status) status = sunder_i_job_uphold(w, err);
    return status ? status : sunder_i_job_gather(w, err);
}

/* Relations once more from nothing, so that the verdict leans on no earlier one; and what is proved of them. */
static sunder_status conclude(sunder_i_job *w, sunder_report *report, double began, sunder_error *err)
{
    const double solved = sunder_i_now();
    sunder_i_relations last = {0};
    sunder_status status = sunder_i_scene_relate(&w->town, &w->scene, NULL, NULL, &last, err);
    if (status) return status;
    sunder_i_free(w->now.pair);
    w->now = last;
    report->summary.seconds_solve = solved - began;
    report->summary.seconds_verify = sunder_i_now() - solved;
    sunder_i_count_relations(&w->town, &w->now, &report->summary.after);
    status = sunder_i_report_conflicts(report, &w->town, &w->scene, &w->now, true, err);
    if (!status) status = sunder_i_report_bound(report, w, err);
    if (!status) status = sunder_i_report_proofs(report, w, err);
    if (!status) status = sunder_i_report_blockers(report, w, err);
    if (!status) status = sunder_i_job_is_upheld(w, &report->summary.verified, err);
    if (status) return status;
    sunder_i_report_moves(report, &w->town);
    report->summary.clusters = w->clusters;
    return sunder_i_report_renumber(report, w->number, err);
}

static sunder_status separate(sunder_i_job *w, const sunder_layer *layer, const sunder_layer_options *options,
                              sunder_report **report, sunder_error *err)
{
    const double began = sunder_i_now();
    sunder_status status = sunder_i_order_layer(layer, &w->layer, &w->number, err);
    if (!status) status = start(w, &w->layer, options, report, err);
    if (!status) status = prepare(w, err);
    if (status) return status;
    if (!sunder_i_progress(&w->town.rules, 0.1)) return sunder_i_no_memory(err);
    status = solve(w, err);
    if (status) return status;
    if (!sunder_i_progress(&w->town.rules, 0.8)) return sunder_i_no_memory(err);
    status = conclude(w, *report, began, err);
    if (!status) sunder_i_progress(&w->town.rules, 1);
    return status;
}

static sunder_status check(sunder_i_job *w, const sunder_layer *layer, const sunder_layer_options *options,
                           sunder_report **report, sunder_error *err)
{
    const double began = sunder_i_now();
    sunder_status status = start(w, layer, options, report, err);
    if (!status) status = sunder_i_report_conflicts(*report, &w->town, &w->scene, &w->start, false, err);
    if (status) return status;
    sunder_layer_summary *s = &(*report)->summary;
    s->after = s->before;
    s->verified = true;
    s->seconds_verify = sunder_i_now() - began;
    return SUNDER_OK;
}

typedef sunder_status (*run_stages)(sunder_i_job *w, const sunder_layer *layer, const sunder_layer_options *options,
                                    sunder_report **report, sunder_error *err);

static sunder_status run(run_stages stages, const sunder_layer *layer, const sunder_layer_options *options,
                         sunder_report **out, sunder_error *err)
{
    sunder_i_job w = {0};
    sunder_i_watch watch;
    sunder_report *report = NULL;
    sunder_layer_options o;
    sunder_layer_options_init(&o);
    if (options) o = *options;
    sunder_i_watch_begin(&watch, &o.progress, &o.progress_user);
    const sunder_status status = stages(&w, layer, &o, &report, err);
    sunder_i_watch_end(&watch);
    sunder_i_job_free(&w);
    if (status)
        sunder_report_free(report);
    else
        *out = report;
    return status;
}

sunder_status sunder_layer_separate(const sunder_layer *layer, const sunder_layer_options *options, sunder_report **out,
                                    sunder_error *err)
{
    return run(separate, layer, options, out, err);
}

sunder_status sunder_layer_check(const sunder_layer *layer, const sunder_layer_options *options, sunder_report **out,
                                 sunder_error *err)
{
    return run(check, layer, options, out, err);
}
