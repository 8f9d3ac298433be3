/* separate_figures.c: the statistics of a separation: JSON for --stats, and the summary on standard output. Scripts may
 * rely on the keys of JSON. */
#include "base/resources.h"
#include "commands/command_stats.h"
#include "commands/resolve.h"
#include "commands/separate_run.h"
#include "layer/levels.h"
#include "read/crs_units.h"
#include "sunder_hiding.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Returns the FID of the feature with the longest move; OGRNullFID if no feature moved or it has no FID. */
static GIntBig longest_fid(const gis_separate_run *run)
{
    const size_t feature = run->summary.max_feature;
    if (feature >= run->input.n) return OGRNullFID;
    return run->result.kind->longest_fid(&run->result, feature);
}

double gis_separate_optimality_gap(const sunder_layer_summary *summary)
{
    if (isinf(summary->cost)) return 1;
    const double cost = summary->cost - summary->cost_alone;
    return cost > 0 ? (summary->cost - summary->lower_bound) / cost : 0;
}

static void json_displacement(gis_json *out, const gis_separate_run *run)
{
    const sunder_layer_summary *summary = &run->summary;
    gis_json_key(out, "displacement");
    gis_json_open(out, '{');
    gis_json_put_double(out, "total", summary->total);
    gis_json_put_double(out, "mean", summary->mean);
    gis_json_put_double(out, "max", summary->max);
    gis_json_key(out, "max_fid");
    if (longest_fid(run) != OGRNullFID)
        gis_json_signed(out, longest_fid(run));
    else
        gis_json_null(out);
    gis_json_put_double(out, "cost", summary->cost);
    const sunder_layer_options *rules = &run->request.rules.core;
    if (rules->rows || rules->ease > 0) gis_json_put_double(out, "cost_moves", summary->cost_moves);
    if (rules->rows) gis_json_put_double(out, "cost_rows", summary->cost_rows);
    if (rules->ease > 0) {
        gis_json_put_double(out, "cost_shortfall", summary->cost_shortfall);
        gis_json_put_double(out, "cost_alone", summary->cost_alone);
    }
    gis_json_put_double(out, "lower_bound", summary->lower_bound);
    gis_json_put_double(out, "optimality_gap", gis_separate_optimality_gap(summary));
    gis_json_close(out, '}');
}

static void json_shortfall(gis_json *out, const sunder_layer_summary *summary)
{
    gis_json_key(out, "shortfall");
    gis_json_open(out, '{');
    gis_json_put_size(out, "pairs", summary->short_pairs);
    gis_json_put_double(out, "sum", summary->shortfall);
    gis_json_put_size(out, "tight", summary->tight);
    gis_json_close(out, '}');
}

const char *gis_separate_unit(const gis_separate_run *run)
{
    OGRSpatialReferenceH crs = gis_source_crs(run->input.source);
    char *name = NULL;
    if (!gis_crs_is_known(crs)) return "unknown";
    if (run->input.units.geographic)
        OSRGetAngularUnits(crs, &name);
    else
        OSRGetLinearUnits(crs, &name);
    return name ? name : "unknown"; /* the CRS owns the string */
}

static void json_losses(gis_json *out, const gis_sentences *losses)
{
    gis_json_open(out, '[');
    for (size_t i = 0; i < losses->n; i++) gis_json_string(out, losses->items[i]);
    gis_json_close(out, ']');
}

static void json_rows(gis_json *out, const sunder_layer_summary *summary)
{
    gis_json_key(out, "rows");
    gis_json_open(out, '{');
    gis_json_put_size(out, "rows", summary->rows);
    gis_json_put_size(out, "features", summary->row_features);
    gis_json_put_double(out, "kink_mean", summary->kink_mean);
    gis_json_put_double(out, "kink_p95", summary->kink_p95);
    gis_json_put_double(out, "kink_share", summary->kink_share);
    gis_json_put_double(out, "spacing_mean", summary->spacing_mean);
    gis_json_put_double(out, "spacing_p95", summary->spacing_p95);
    gis_json_put_double(out, "turn_mean", summary->turn_mean);
    gis_json_put_double(out, "turn_p95", summary->turn_p95);
    gis_json_close(out, '}');
}

/* The hidden features of each class, their weight, and its lower bound. */
static void json_by_class(gis_json *out, const sunder_hiding_class *class, size_t n)
{
    gis_json_key(out, "by_class");
    gis_json_open(out, '{');
    for (size_t k = 0; k < n; k++) {
        char key[16] = "null";
        if (class[k].hierarchy != GIS_LAST_CLASS) snprintf(key, sizeof key, "%u", class[k].hierarchy);
        gis_json_key(out, key);
        gis_json_open(out, '{');
        gis_json_put_size(out, "count", class[k].hidden);
        gis_json_put_double(out, "weight", (double)class[k].weight / GIS_HIDING_UNIT);
        gis_json_put_double(out, "lower_bound", (double)class[k].least / GIS_HIDING_UNIT);
        gis_json_close(out, '}');
    }
    gis_json_close(out, '}');
}

static void json_hidden(gis_json *out, const gis_separate_run *run)
{
    gis_hiding all;
    run->result.kind->hiding(&run->result, &all);
    const sunder_hiding_summary hiding = all.sum;
    gis_json_key(out, "hidden");
    gis_json_open(out, '{');
    gis_json_put_size(out, "count", hiding.hidden);
    gis_json_put_double(out, "weight", (double)hiding.weight / GIS_HIDING_UNIT);
    gis_json_put_double(out, "lower_bound", (double)hiding.least / GIS_HIDING_UNIT);
    gis_json_put_size(out, "forced", hiding.forced);
    json_by_class(out, all.class, all.classes);
    gis_json_put_size(out, "components", hiding.components);
    gis_json_put_size(out, "components_proved", hiding.components_best);
    gis_json_put_size(out, "clauses", hiding.clauses);
    gis_json_put_size(out, "rounds", hiding.rounds);
    gis_json_close(out, '}');
}

static const char *const rung_word[GIS_RUNGS] = {"trimmed", "inset", "scaled", "symbols"};

static void json_shrunk(gis_json *out, const gis_separate_run *run)
{
    gis_hiding all;
    run->result.kind->hiding(&run->result, &all);
    const sunder_hiding_summary hiding = all.sum;
    gis_json_key(out, "shrunk");
    gis_json_open(out, '{');
    for (int kind = 0; kind < GIS_RUNGS; kind++) gis_json_put_size(out, rung_word[kind], all.on_rung[kind]);
    gis_json_put_double(out, "area_lost", (double)hiding.smaller_cost / GIS_SHRINKING_UNIT);
    gis_json_put_double(out, "lower_bound", (double)hiding.smaller_least / GIS_SHRINKING_UNIT);
    gis_json_close(out, '}');
    gis_json_put_size(out, "enlarged", all.enlarged);
}

/* What became of the moves of an earlier result. */
typedef struct gis_moves_since {
    size_t kept, changed, new, edited, relaxed, gone;
} gis_moves_since;

/* Adds those of one layer. */
static void count_moves_of(const gis_separate_run *run, const gis_layer_input *input, gis_moves_since *count)
{
    const gis_previous *previous = &input->previous;
    count->gone += previous->gone;
    for (size_t i = 0; i < input->n; i++) {
        double dx, dy;
        const double *was = previous->move + 2 * i;
        sunder_report_move(run->report, input->first + i, &dx, &dy);
        count->edited += previous->edited[i];
        count->relaxed += previous->relaxed[i] && !previous->edited[i];
        if (previous->of[i] == SIZE_MAX)
            count->new ++;
        else if (dx == was[0] && dy == was[1])
            count->kept++;
        else
            count->changed++;
    }
}

static gis_moves_since count_moves_since(const gis_separate_run *run)
{
    gis_moves_since count = {0};
    if (!run->input.parts) count_moves_of(run, &run->input, &count);
    for (size_t k = 0; k < run->input.parts; k++) count_moves_of(run, &run->input.part[k], &count);
    return count;
}

static void json_previous(gis_json *out, const gis_separate_run *run)
{
    const gis_moves_since count = count_moves_since(run);
    gis_json_key(out, "previous");
    gis_json_open(out, '{');
    gis_json_put_size(out, "kept", count.kept);
    gis_json_put_size(out, "changed", count.changed);
    gis_json_put_size(out, "new", count.new);
    gis_json_put_size(out, "gone", count.gone);
    gis_json_put_size(out, "edited", count.edited);
    gis_json_put_size(out, "relaxed", count.relaxed);
    gis_json_close(out, '}');
}

/* The layers that move together. */
static void json_layers(gis_json *out, const gis_separate_run *run)
{
    gis_json_key(out, "layers");
    gis_json_open(out, '[');
    for (size_t k = 0; k < run->input.parts; k++) {
        const gis_layer_input *part = &run->input.part[k];
        size_t count[SUNDER_FEATURE_HIDDEN + 1] = {0};
        for (size_t i = 0; i < part->n; i++) count[sunder_report_status(run->report, part->first + i)]++;
        gis_json_open(out, '{');
        gis_json_put_string(out, "name", gis_layer_name(part));
        gis_json_put_size(out, "features", part->n);
        for (int status = 0; status <= SUNDER_FEATURE_HIDDEN; status++)
            if (count[status])
                gis_json_put_size(out, sunder_feature_status_string((sunder_feature_status)status), count[status]);
        gis_json_close(out, '}');
    }
    gis_json_close(out, ']');
    gis_json_line(out);
}

/* The layers that went along. */
static void json_along(gis_json *out, const gis_separate_run *run)
{
    gis_json_key(out, "follow");
    gis_json_open(out, '[');
    for (size_t k = 0; k < run->along.n; k++) {
        gis_json_open(out, '{');
        gis_json_put_string(out, "name", gis_follow_name(&run->along.follow[k]));
        gis_json_follow(out, &run->along.follow[k]);
        gis_json_close(out, '}');
    }
    gis_json_close(out, ']');
    gis_json_line(out);
}

void gis_separate_stats(gis_json *out, const gis_separate_run *run)
{
    const sunder_layer_summary *summary = &run->summary;
    gis_json_open(out, '{');
    gis_json_put_string(out, "command", "separate");
    gis_json_put_string(out, "layer", gis_layer_title(&run->input));
    gis_json_put_string(out, "unit", gis_separate_unit(run));
    gis_json_put_size(out, "features", run->input.n);
    gis_json_put_size(out, "vertices", summary->vertices);
    gis_json_put_size(out, "blocks", summary->blocks);
    gis_json_put_size(out, "clusters", summary->clusters);
    gis_json_put_size(out, "clusters_optimal", summary->clusters_optimal);
    gis_json_line(out);
    if (run->input.parts) json_layers(out, run);
    if (run->along.n) json_along(out, run);
    gis_json_key(out, "conflicts");
    gis_json_open(out, '{');
    gis_json_key(out, "before");
    gis_json_conflict_counts(out, &summary->before);
    gis_json_key(out, "after");
    gis_json_conflict_counts(out, &summary->after);
    gis_json_close(out, '}');
    gis_json_line(out);
    gis_json_put_size(out, "moved", summary->moved);
    gis_json_put_size(out, "blocked", summary->blocked);
    gis_json_put_size(out, "skipped", summary->skipped);
    gis_json_put_size(out, "invalid", run->input.invalid);
    gis_json_put_size(out, "null", run->input.null);
    gis_json_put_size(out, "rounded", summary->rounded);
    gis_json_line(out);
    json_displacement(out, run);
    gis_json_line(out);
    if (run->request.rules.core.rows) {
        json_rows(out, summary);
        gis_json_line(out);
    }
    if (run->request.rules.core.ease > 0) {
        json_shortfall(out, summary);
        gis_json_line(out);
    }
    if (run->request.previous) {
        json_previous(out, run);
        gis_json_line(out);
    }
    if (run->request.rules.hide || gis_levels_asked(&run->request.rules)) {
        json_hidden(out, run);
        json_shrunk(out, run);
        gis_json_line(out);
    }
    gis_json_put_bool(out, "verified", run->verified);
    gis_json_key(out, "losses");
    json_losses(out, gis_sink_losses(run->sink));
    gis_json_line(out);
    gis_json_key(out, "seconds");
    gis_json_open(out, '{');
    gis_json_seconds(out, "read", run->read);
    gis_json_seconds(out, "solve", summary->seconds_solve);
    gis_json_seconds(out, "explain", summary->seconds_explain);
    gis_json_seconds(out, "verify", summary->seconds_verify);
    gis_json_seconds(out, "write", run->write);
    gis_json_seconds(out, "total", gis_clock() - run->start);
    gis_json_close(out, '}');
    gis_json_put_size(out, "peak_rss_bytes", gis_peak_rss());
    gis_json_sheet(out, run->options);
    gis_json_close(out, '}');
    gis_json_raw(out, "\n");
}

/* Prints the number of pairs that overlap only slightly, and the --touch-tolerance that would join them into blocks.
 * Without a gap the default tolerance is 0, which does not join walls that were digitised twice. */
static void print_thin(const gis_separate_run *run)
{
    size_t thin = run->summary.thin;
    if (thin == 0) return;
    const char *unit = gis_crs_is_known(gis_source_crs(run->input.source)) ? gis_separate_unit(run) : "units";
    double length = gis_layer_thin(&run->input);
    printf("%zu %s by no more than %.6g %s; --touch-tolerance %.6g would join %s\n", thin,
           thin == 1 ? "pair overlaps" : "pairs overlap", length, unit, length,
           thin == 1 ? "it into one block" : "them into blocks");
}

/* Prints the numbers of conflicts before and after. A kind with a note is explained if there are conflicts of it. */
static void print_counts(const sunder_layer_summary *summary)
{
    const sunder_conflict_counts *before = &summary->before, *after = &summary->after;
    char listed[96] = "";
    if (summary->inside_overlaps)
        snprintf(listed, sizeof listed, "%zu listed: %s, reason same_block", summary->inside_overlaps,
                 summary->inside_overlaps == 1 ? "it overlaps" : "they overlap");
    const struct {
        const char *name;
        size_t before, after;
        const char *note;
    } rows[] = {
        {"overlap", before->overlap, after->overlap, ""},
        {"too close", before->too_close, after->too_close, ""},
        {"barrier", before->barrier, after->barrier, "meets the stored line or area"},
        {"barrier drawn", before->barrier_drawn, after->barrier_drawn, "meets its drawn width only"},
        {"barrier near", before->barrier_near, after->barrier_near, "meets neither, but is nearer than the gap"},
        {"contained", before->contained, after->contained, ""},
        {"duplicate", before->duplicate, after->duplicate, ""},
        {"inside blocks", before->inside_blocks, after->inside_blocks, listed}};
    printf("conflicts           before      after\n");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const bool noted = *rows[i].note && (rows[i].before || rows[i].after);
        printf("  %-13s %10zu %10zu%s%s\n", rows[i].name, rows[i].before, rows[i].after, noted ? "  " : "",
               noted ? rows[i].note : "");
    }
}

static void print_rows(const gis_separate_run *run)
{
    const sunder_layer_summary *summary = &run->summary;
    if (summary->rows == 0) return;
    printf("rows %zu, features in them %zu\n", summary->rows, summary->row_features);
    printf("kink of neighbours in rows (%s): mean %.3g, 95 %% at most %.3g, above %.3g: %.3g %%\n",
           gis_separate_unit(run), summary->kink_mean, summary->kink_p95, gis_layer_kink(&run->input),
           100 * summary->kink_share);
    printf("change of spacing in rows (%s): mean %.3g, 95 %% at most %.3g\n", gis_separate_unit(run),
           summary->spacing_mean, summary->spacing_p95);
    printf("turn of the lines between neighbours (degrees): mean %.3g, 95 %% at most %.3g\n", summary->turn_mean,
           summary->turn_p95);
}

static void print_shrunk(const gis_separate_run *run, const gis_hiding *all)
{
    bool any = false;
    for (int kind = 0; kind < GIS_RUNGS; kind++) {
        if (!gis_rung_asked(&run->request.rules, (gis_rung)kind)) continue;
        printf("%s %zu, ", rung_word[kind], all->on_rung[kind]);
        any = true;
    }
    if (any)
        printf("weight times share of lost area %.6g, at least %.6g is needed\n",
               (double)all->sum.smaller_cost / GIS_SHRINKING_UNIT, (double)all->sum.smaller_least / GIS_SHRINKING_UNIT);
}

static void print_hidden(const gis_separate_run *run)
{
    gis_hiding all;
    if (!run->request.rules.hide && !gis_levels_asked(&run->request.rules)) return;
    run->result.kind->hiding(&run->result, &all);
    const sunder_hiding_summary hiding = all.sum;
    printf("hidden %zu, weight %.6g, at least %.6g is needed; %zu of %zu groups proved\n", hiding.hidden,
           (double)hiding.weight / GIS_HIDING_UNIT, (double)hiding.least / GIS_HIDING_UNIT, hiding.components_best,
           hiding.components);
    if (run->request.rules.enlarge) printf("enlarged %zu\n", all.enlarged);
    print_shrunk(run, &all);
}

static void print_shortfall(const gis_separate_run *run)
{
    const sunder_layer_summary *summary = &run->summary;
    if (summary->short_pairs == 0 && summary->tight == 0) return;
    printf("pairs that lack a part of their distance %zu, which is %.6g in sum (%s)", summary->short_pairs,
           summary->shortfall, gis_separate_unit(run));
    if (run->request.rules.has_least_gap) printf("; tight %zu", summary->tight);
    putchar('\n');
}

static void print_previous(const gis_separate_run *run)
{
    if (!run->request.previous) return;
    const gis_moves_since count = count_moves_since(run);
    printf("since the previous result: kept %zu, changed %zu, new %zu, gone %zu, edited %zu; free to go back %zu\n",
           count.kept, count.changed, count.new, count.gone, count.edited, count.relaxed);
}

bool gis_separate_print(const void *separated, gis_error *error)
{
    const gis_separate_run *run = separated;
    (void)error; /* an error of stdio is found when stdout is flushed */
    const sunder_layer_summary *summary = &run->summary;
    printf("%s: %zu features, %zu vertices, %zu blocks, %zu clusters\n", gis_layer_title(&run->input), run->input.n,
           summary->vertices, summary->blocks, summary->clusters);
    print_counts(summary);
    print_thin(run);
    printf("moved %zu, blocked %zu", summary->moved, summary->blocked);
    if (summary->blocked_moved) printf(" (%zu of them moved, too)", summary->blocked_moved);
    printf(", skipped %zu, invalid %zu, null %zu, rounded %zu\n", summary->skipped, run->input.invalid, run->input.null,
           summary->rounded);
    printf("displacement (%s): total %.6g, mean %.6g, max %.6g", gis_separate_unit(run), summary->total, summary->mean,
           summary->max);
    if (summary->max_feature < run->input.n) printf(" (FID " CPL_FRMT_GIB ")", longest_fid(run));
    printf("\ncost %.6g, at least %.6g is needed (optimality gap %.3g)\n", summary->cost, summary->lower_bound,
           gis_separate_optimality_gap(summary));
    print_previous(run);
    print_rows(run);
    print_shortfall(run);
    print_hidden(run);
    for (size_t k = 0; k < run->along.n; k++) gis_print_follow(&run->along.follow[k]);
    if (gis_any_conflict(&summary->after) && (run->chosen & GIS_SEPARATE_CONFLICTS))
        printf("the remaining conflicts are listed with their reasons in %s_conflicts\n",
               gis_resolve_sink(run->options, NULL, gis_layer_title(&run->input)).main_layer);
    printf("%s; %.3g s\n", run->verified ? "verified on the coordinates as written" : "not verified",
           gis_clock() - run->start);
    return true;
}
