/* separate.c: sunder separate. Read, separate, write, say what came of it. */
#include "base/message.h"
#include "base/resources.h"
#include "commands/call.h"
#include "commands/commands.h"
#include "commands/progress_shares.h"
#include "commands/report.h"
#include "commands/resolve.h"
#include "layer/in_parts.h"
#include "layer/output.h"
#include "layer/proof.h"
#include "read/crs_units.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Bits of --layers. */
enum {
    LAYER_MAIN = 1,
    LAYER_DISPLACEMENT = 2,
    LAYER_CONFLICTS = 4,
    LAYER_PUSHES = 8,
    LAYER_SYMBOLS = 16,
    N_LAYERS = 5
};

typedef struct separate_run {
    const gis_options *options;
    gis_destinations to;
    gis_layer_input_request request;
    gis_layer_input input;
    const char *suffixes[N_LAYERS]; /* of the layers besides the main one; the sink borrows them */
    gis_sink *sink;
    sunder_report *report;
    sunder_layer_summary summary;
    gis_progress progress;
    unsigned chosen; /* which layers are written */
    bool taken;      /* standard output is */
    bool verified;
    double start, read, write;
    double memory; /* --max-memory; 0: the layer is held whole */
    bool whole;    /* ... but for its source, which is compared with what was written */
    gis_in_parts parts;
} separate_run;

static bool write_layers(const separate_run *run, gis_error *error)
{
    unsigned chosen = run->chosen;
    gis_sink *sink = run->sink;
    const gis_layer_input *input = &run->input;
    if ((chosen & LAYER_MAIN) && !gis_write_main(sink, input, run->report, error)) return false;
    if ((chosen & LAYER_DISPLACEMENT) && !gis_write_displacement(sink, input, run->report, error)) return false;
    if ((chosen & LAYER_CONFLICTS) && !gis_write_conflicts(sink, input, run->report, error)) return false;
    if ((chosen & LAYER_PUSHES) && !gis_write_pushes(sink, input, run->report, error)) return false;
    return !(chosen & LAYER_SYMBOLS) || gis_write_symbols(sink, input, run->report, error);
}

/* What --layers chooses of those that apply; an unknown name is wrong usage. */
static bool choose_layers(const char *list, bool points, unsigned *chosen, gis_error *error)
{
    static const char *const names[N_LAYERS] = {"main", "displacement", "conflicts", "pushes", "symbols"};
    const unsigned apply =
        LAYER_MAIN | LAYER_DISPLACEMENT | LAYER_CONFLICTS | LAYER_PUSHES | (points ? LAYER_SYMBOLS : 0u);
    *chosen = list ? 0 : apply;
    for (const char *rest = list; rest;) {
        size_t n = strcspn(rest, ","), k = 0;
        while (k < N_LAYERS && (strlen(names[k]) != n || memcmp(names[k], rest, n) != 0)) k++;
        if (k == N_LAYERS)
            return gis_fail_usage(error, "--layers: %.*s is none of main, displacement, conflicts, pushes, symbols",
                                  (int)n, rest);
        *chosen |= 1u << k;
        rest = rest[n] ? rest + n + 1 : NULL;
    }
    *chosen &= apply;
    return *chosen || gis_fail_usage(error, "--layers %s: nothing of that applies to this layer", list);
}

/* Whose move is the longest; OGRNullFID: nobody's, or it has no FID. */
static GIntBig longest_fid(const separate_run *run)
{
    const size_t feature = run->summary.max_feature;
    if (feature >= run->input.n) return OGRNullFID;
    return run->memory > 0 ? gis_in_parts_fid(&run->parts, feature) : gis_source_fid(run->input.source, feature);
}

/* Is the summary printed? */
static bool is_summarised(const separate_run *run) { return !run->taken && !run->options->given[OPT_QUIET]; }

/* The sink is opened before the work is done: what can be refused is refused before hours of computing. */
static bool open_sink(separate_run *run, gis_error *error)
{
    size_t n = 0;
    if (!choose_layers(run->options->text[OPT_LAYERS], run->input.points, &run->chosen, error)) return false;
    if (run->chosen & LAYER_DISPLACEMENT) run->suffixes[n++] = "displacement";
    if (run->chosen & LAYER_CONFLICTS) run->suffixes[n++] = "conflicts";
    if (run->chosen & LAYER_PUSHES) run->suffixes[n++] = "pushes";
    if (run->chosen & LAYER_SYMBOLS) run->suffixes[n++] = "symbols";
    gis_sink_request request = gis_resolve_sink(run->options, run->to.output, gis_source_name(run->input.source));
    request.suffixes = run->suffixes;
    if (!gis_sink_open(&request, run->input.source, &run->sink, error)) return false;
    if (gis_sink_remembers(run->sink) && (run->memory == 0 || run->whole) &&
        !gis_source_unpack(run->input.source, error))
        return false;
    if (!gis_sink_takes_more(run->sink)) run->chosen = LAYER_MAIN;
    if (!run->to.proof) gis_layer_forget_demands(&run->input);
    run->request.rules.keep_pushes = (run->chosen & LAYER_PUSHES) != 0;
    return true;
}

/* The layer onto the disk; the source once more, to be written from, by batches unless the format compares features in
 * the end. */
static bool read_in_parts(separate_run *run, gis_error *error)
{
    if (run->to.report || run->to.proof)
        return gis_fail_usage(error, "--max-memory: a layer is not separated in parts with %s",
                              run->to.report ? "--report" : "--proof");
    return gis_in_parts_begin(&run->request, run->memory, &run->parts, error) &&
           gis_in_parts_open(&run->parts, false, &run->input, error);
}

static bool open_sink_in_parts(separate_run *run, gis_error *error)
{
    if (!open_sink(run, error)) return false;
    if (!gis_sink_remembers(run->sink)) return true;
    gis_sink_free(run->sink);
    run->sink = NULL;
    gis_layer_input_clear(&run->input);
    run->whole = true;
    return gis_in_parts_open(&run->parts, true, &run->input, error) && open_sink(run, error);
}

static bool solve_and_write_in_parts(separate_run *run, gis_error *error)
{
    gis_sink_result result;
    if (!open_sink_in_parts(run, error)) return false;
    gis_progress_stage(&run->progress, GIS_SEPARATE_READ, GIS_SEPARATE_SOLVED);
    if (!gis_in_parts_solve(&run->parts, &run->input, &run->progress, &run->summary, error)) return false;
    gis_progress_stage(&run->progress, GIS_SEPARATE_SOLVED, 1);
    const double begin = gis_clock();
    const gis_in_parts_layers layers = {(run->chosen & LAYER_MAIN) != 0, (run->chosen & LAYER_DISPLACEMENT) != 0,
                                        (run->chosen & LAYER_CONFLICTS) != 0, (run->chosen & LAYER_PUSHES) != 0};
    if (!gis_in_parts_write(&run->parts, &run->input, &layers, run->sink, error) ||
        !gis_sink_finish(run->sink, &result, error))
        return false;
    run->write = gis_clock() - begin;
    run->verified = run->summary.verified && result.exact;
    gis_progress_done(&run->progress);
    return true;
}

/* All but the last step, which is gis_deliver()'s. */
static bool solve_and_write(separate_run *run, gis_error *error)
{
    gis_sink_result result;
    if (!open_sink(run, error)) return false;
    gis_progress_stage(&run->progress, GIS_SEPARATE_READ, GIS_SEPARATE_SOLVED);
    if (!gis_layer_run(&run->input, sunder_layer_separate, &run->progress, &run->report, &run->summary, error))
        return false;
    gis_progress_stage(&run->progress, GIS_SEPARATE_SOLVED, 1);
    double begin = gis_clock();
    if (!write_layers(run, error) || !gis_sink_finish(run->sink, &result, error)) return false;
    run->write = gis_clock() - begin;
    run->verified = run->summary.verified && result.exact;
    gis_progress_done(&run->progress);
    return true;
}

/* What part of the cost is not proved to be needed; of a cost beyond doubles all of it, as far as a double can tell. */
static double optimality_gap(const sunder_layer_summary *summary)
{
    if (isinf(summary->cost)) return 1;
    return summary->cost > 0 ? (summary->cost - summary->lower_bound) / summary->cost : 0;
}

static void json_displacement(gis_json *out, const separate_run *run)
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
    gis_json_put_double(out, "lower_bound", summary->lower_bound);
    gis_json_put_double(out, "optimality_gap", optimality_gap(summary));
    gis_json_close(out, '}');
}

static const char *unit_name(const separate_run *run)
{
    OGRSpatialReferenceH crs = gis_source_crs(run->input.source);
    char *name = NULL;
    if (!gis_crs_is_known(crs)) return "unknown";
    if (run->input.units.geographic)
        OSRGetAngularUnits(crs, &name);
    else
        OSRGetLinearUnits(crs, &name);
    return name ? name : "unknown"; /* the CRS owns it */
}

static void json_losses(gis_json *out, const gis_sentences *losses)
{
    gis_json_open(out, '[');
    for (size_t i = 0; i < losses->n; i++) gis_json_string(out, losses->items[i]);
    gis_json_close(out, ']');
}

static void json_separate(gis_json *out, const separate_run *run)
{
    const sunder_layer_summary *summary = &run->summary;
    gis_json_open(out, '{');
    gis_json_put_string(out, "command", "separate");
    gis_json_put_string(out, "layer", gis_source_name(run->input.source));
    gis_json_put_string(out, "unit", unit_name(run));
    gis_json_put_size(out, "features", run->input.n);
    gis_json_put_size(out, "vertices", summary->vertices);
    gis_json_put_size(out, "blocks", summary->blocks);
    gis_json_put_size(out, "clusters", summary->clusters);
    gis_json_put_size(out, "clusters_optimal", summary->clusters_optimal);
    gis_json_line(out);
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
    gis_json_put_bool(out, "verified", run->verified);
    gis_json_key(out, "losses");
    json_losses(out, gis_sink_losses(run->sink));
    gis_json_line(out);
    gis_json_key(out, "seconds");
    gis_json_open(out, '{');
    gis_json_seconds(out, "read", run->read);
    gis_json_seconds(out, "solve", summary->seconds_solve);
    gis_json_seconds(out, "verify", summary->seconds_verify);
    gis_json_seconds(out, "write", run->write);
    gis_json_seconds(out, "total", gis_clock() - run->start);
    gis_json_close(out, '}');
    gis_json_put_size(out, "peak_rss_bytes", gis_peak_rss());
    gis_json_close(out, '}');
    gis_json_raw(out, "\n");
}

/* A tolerance of 0 is the default where the gap is, and joins no walls that were drawn twice. */
static void print_thin(const separate_run *run)
{
    size_t thin = run->summary.thin;
    if (thin == 0) return;
    const char *unit = gis_crs_is_known(gis_source_crs(run->input.source)) ? unit_name(run) : "units";
    double length = gis_layer_thin(&run->input);
    printf("%zu %s by no more than %.6g %s; --touch-tolerance %.6g would join %s\n", thin,
           thin == 1 ? "pair overlaps" : "pairs overlap", length, unit, length,
           thin == 1 ? "it into one block" : "them into blocks");
}

static bool print_summary(const void *separated, gis_error *error)
{
    const separate_run *run = separated;
    (void)error; /* what stdio refuses shows when it is flushed */
    const sunder_layer_summary *summary = &run->summary;
    const sunder_conflict_counts *before = &summary->before, *after = &summary->after;
    const struct {
        const char *name;
        size_t before, after;
    } rows[] = {{"overlap", before->overlap, after->overlap},
                {"too close", before->too_close, after->too_close},
                {"barrier", before->barrier, after->barrier},
                {"barrier near", before->barrier_near, after->barrier_near},
                {"contained", before->contained, after->contained},
                {"duplicate", before->duplicate, after->duplicate},
                {"inside blocks", before->inside_blocks, after->inside_blocks}};
    printf("%s: %zu features, %zu vertices, %zu blocks, %zu clusters\n", gis_source_name(run->input.source),
           run->input.n, summary->vertices, summary->blocks, summary->clusters);
    printf("conflicts           before      after\n");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        printf("  %-13s %10zu %10zu\n", rows[i].name, rows[i].before, rows[i].after);
    print_thin(run);
    printf("moved %zu, blocked %zu, skipped %zu, invalid %zu, null %zu, rounded %zu\n", summary->moved,
           summary->blocked, summary->skipped, run->input.invalid, run->input.null, summary->rounded);
    printf("displacement (%s): total %.6g, mean %.6g, max %.6g", unit_name(run), summary->total, summary->mean,
           summary->max);
    if (summary->max_feature < run->input.n) printf(" (FID " CPL_FRMT_GIB ")", longest_fid(run));
    printf("\ncost %.6g, at least %.6g is needed (optimality gap %.3g)\n", summary->cost, summary->lower_bound,
           optimality_gap(summary));
    if (gis_any_conflict(after) && (run->chosen & LAYER_CONFLICTS))
        printf("what remains in conflict is listed, each pair with its reason, in %s_conflicts\n",
               gis_resolve_sink(run->options, NULL, gis_source_name(run->input.source)).main_layer);
    printf("%s; %.3g s\n", run->verified ? "verified on the coordinates as written" : "not verified",
           gis_clock() - run->start);
    return true;
}

static bool write_page(const separate_run *run, gis_text *page, gis_error *error)
{
    gis_call call = {0};
    bool ok = gis_call_list(run->options, &call, error);
    const gis_page_request request = {
        .input = &run->input,
        .report = run->report,
        .summary = &run->summary,
        .unit = unit_name(run),
        .output = run->to.output,
        .main_layer = gis_resolve_sink(run->options, NULL, gis_source_name(run->input.source)).main_layer,
        .verified = run->verified,
        .optimality_gap = optimality_gap(&run->summary),
        .losses = gis_sink_losses(run->sink),
        .options = call.option,
        .n_options = call.n,
    };
    ok = ok && gis_page_write(&request, page, error);
    gis_call_clear(&call);
    return ok;
}

static bool deliver(const separate_run *run, gis_error *error)
{
    gis_json stats = {0};
    gis_text page = {0}, proof = {0};
    bool ok = (!run->to.report || write_page(run, &page, error)) &&
              (!run->to.proof || gis_proof_write(&run->input, run->report, &proof, error));
    if (run->to.stats) json_separate(&stats, run);
    const gis_delivery delivery = {
        &run->to, run->sink, &stats, &page, &proof, is_summarised(run) ? print_summary : NULL, run};
    ok = ok && gis_deliver(&delivery, error);
    gis_json_clear(&stats);
    gis_text_clear(&page);
    gis_text_clear(&proof);
    return ok;
}

int gis_command_separate(const gis_options *options)
{
    gis_error error;
    separate_run run = {.options = options,
                        .to = gis_resolve_destinations(options),
                        .progress = gis_resolve_progress(options),
                        .start = gis_clock()};
    bool ok = gis_destinations_check(&run.to, &run.taken, &error);
    gis_progress_stage(&run.progress, 0, GIS_SEPARATE_READ);
    ok = ok && gis_resolve_layer(options, &run.request, &error);
    run.request.rules.count_thin = is_summarised(&run);
    ok = ok && gis_resolve_memory(options, &run.memory, &error);
    ok = ok &&
         (run.memory > 0 ? read_in_parts(&run, &error) : gis_layer_input_read(&run.request, &run.input, &error)) &&
         gis_destinations_spare(&run.to, run.input.source, &error);
    run.read = gis_clock() - run.start;
    ok = ok && (run.memory > 0 ? solve_and_write_in_parts(&run, &error) : solve_and_write(&run, &error)) &&
         deliver(&run, &error);
    int status = ok ? gis_complete_status(options, gis_any_conflict(&run.summary.after)) : gis_say_failure(&error);
    gis_sink_free(run.sink);
    sunder_report_free(run.report);
    gis_layer_input_clear(&run.input);
    gis_in_parts_clear(&run.parts);
    gis_layer_input_request_clear(&run.request);
    return status;
}
