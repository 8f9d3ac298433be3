/* check.c: the command sunder check. It lists all overlaps and all pairs that are too close in a layer, exactly. */
#include "base/interrupt.h"
#include "base/message.h"
#include "commands/command_stats.h"
#include "commands/commands.h"
#include "commands/progress_shares.h"
#include "commands/resolve.h"
#include "layer/levels.h"
#include "layer/moves.h"
#include "legible/legible.h"
#include "page/check_page.h"
#include "read/source_files.h"

#include <cpl_conv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct check_run {
    const gis_options *options;
    gis_destinations to;
    gis_layer_input_request request;
    gis_layer_input input;
    char *layer;    /* LAYER_conflicts, unless --output-layer gives another name; the sink borrows this string */
    gis_sink *sink; /* NULL: there is no OUTPUT */
    sunder_report *report;
    sunder_layer_summary summary;
    gis_layer_input_request original; /* of --before */
    gis_moves moves;                  /* the moves since */
    gis_legible legible;
    gis_progress progress;
} check_run;

/* Opens the output before the computation; does nothing without OUTPUT. */
static bool open_sink(check_run *run, gis_error *error)
{
    const char *path = run->to.output, *source = gis_layer_title(&run->input);
    if (!path) return true;
    size_t size = strlen(source) + sizeof "_conflicts";
    run->layer = malloc(size);
    if (!run->layer) return gis_no_memory(error);
    snprintf(run->layer, size, "%s_conflicts", source);
    gis_sink_request request = gis_resolve_sink(run->options, path, run->layer);
    return gis_sink_open(&request, run->input.source, &run->sink, error);
}

/* Refuses results that would replace an original. */
static bool spare_original(const check_run *run, const gis_source *before, gis_error *error)
{
    return gis_destinations_spare(&run->to, before, error) &&
           (!run->to.output || gis_source_spare(before, run->to.output, run->options->given[OPT_UPDATE], error));
}

/* Finds the moves since --before that break a rule; does nothing without --before. */
static bool check_moves(check_run *run, gis_error *error)
{
    double box[4];
    if (!run->options->given[OPT_BEFORE]) return true;
    gis_layer_box(&run->input, box);
    if (!gis_resolve_original(run->options, &run->request, gis_layer_title(&run->input), &run->original, error))
        return false;
    run->original.also = box;
    bool ok = gis_moves_check(&run->original, &run->input, &run->progress, &run->moves, error);
    run->original.also = NULL;
    for (size_t k = 0; ok && k < gis_layer_sources(&run->moves.original); k++)
        ok = spare_original(run, gis_layer_source(&run->moves.original, k), error);
    return ok;
}

static bool write_layer(check_run *run, gis_error *error)
{
    gis_sink_result result;
    gis_sink_layer *layer;
    if (!run->sink) return true;
    return gis_conflicts_begin(run->sink, "", gis_id_type(&run->input), gis_source_crs(run->input.source), false,
                               run->input.parts > 0, run->request.rules.has_least_gap, &layer, error) &&
           gis_write_report_conflicts(layer, &run->input, run->report, error) &&
           gis_write_moves(layer, &run->moves, error) && gis_write_legible(layer, &run->input, &run->legible, error) &&
           gis_sink_finish(run->sink, &result, error);
}

/* Examines the features of each layer by its own rules. */
static bool check_legible(check_run *run, gis_error *error)
{
    const gis_options *options = run->options;
    bool ok = run->input.parts || gis_legible_check(&run->input, options->legible, &run->legible, error);
    for (size_t k = 0; ok && k < run->input.parts; k++)
        ok = gis_legible_check(&run->input.part[k], k ? options->more[k - 1].legible : options->legible, &run->legible,
                               error);
    return ok;
}

/* Checks and writes everything; only gis_deliver(), which puts the files in place, is left to do. */
static bool check_and_write(check_run *run, gis_error *error)
{
    if (!open_sink(run, error)) return false;
    if (!check_legible(run, error)) return false;
    if (!run->options->given[OPT_BEFORE]) gis_layer_forget_demands(&run->input);
    gis_progress_stage(&run->progress, GIS_CHECK_READ, GIS_CHECK_CHECKED);
    if (!gis_layer_run(&run->input, sunder_layer_check, &run->progress, NULL, &run->report, &run->summary, error))
        return false;
    gis_progress_stage(&run->progress, GIS_CHECK_CHECKED, 1);
    if (!check_moves(run, error) || !write_layer(run, error)) return false;
    gis_progress_done(&run->progress);
    return true;
}

/* Prints a text with tabs and line breaks replaced by blanks, since they would break the columns. */
static void print_text(const char *text)
{
    for (; *text; text++) putchar(*text == '\t' || *text == '\n' || *text == '\r' ? ' ' : *text);
}

static void print_value(const gis_value *value)
{
    char number[GIS_NUMBER_MAX];
    switch (value->kind) {
    case GIS_NULL: break;
    case GIS_INTEGER: printf(CPL_FRMT_GIB, value->as.integer); break;
    case GIS_REAL:
        gis_number_text(value->as.real, number);
        fputs(number, stdout);
        break;
    case GIS_TEXT: print_text(value->as.text); break;
    }
}

static void print_row(const check_run *run, const gis_value values[N_CONFLICT_COLUMNS])
{
    for (int column = 0; column < N_CONFLICT_COLUMNS; column++) {
        if (column == COLUMN_BY_ROW || (column > COLUMN_BY_ROW && !run->input.parts)) continue;
        if (column) putchar('\t');
        print_value(&values[column]);
    }
    putchar('\n');
}

static bool print_lines(const check_run *run, gis_error *error)
{
    size_t n;
    const sunder_conflict *conflicts = sunder_report_conflicts(run->report, &n);
    gis_conflict_texts scratch = {0};
    bool ok = true;
    for (size_t k = 0; ok && k < n; k++) {
        gis_value values[N_CONFLICT_COLUMNS];
        ok = gis_go_on(error) && gis_conflict_values(&run->input, &conflicts[k], &scratch, values, error);
        if (ok) print_row(run, values);
    }
    for (size_t k = 0; ok && k < gis_moves_rows(&run->moves); k++) {
        gis_value values[N_CONFLICT_COLUMNS];
        double from[2], to[2];
        ok = gis_go_on(error) && gis_moves_row(&run->moves, k, &scratch, values, from, to, error);
        if (ok) print_row(run, values);
    }
    for (size_t k = 0; ok && k < run->legible.n; k++) {
        gis_value values[N_CONFLICT_COLUMNS];
        ok = gis_go_on(error) && gis_legible_row(&run->input, &run->legible, k, &scratch, values, error);
        if (ok) print_row(run, values);
    }
    gis_conflict_texts_clear(&scratch);
    return ok;
}

/* Is the kind one of the broken rules that were looked for? */
static bool is_asked_about(const gis_moves *moves, sunder_conflict_kind kind)
{
    if (kind == SUNDER_CONFLICT_NEEDLESS) return moves->hidden;
    if (kind == SUNDER_CONFLICT_ALTERED || kind == SUNDER_CONFLICT_TOO_SMALL)
        return gis_levels_asked(&moves->original.request->rules);
    return kind != SUNDER_CONFLICT_ROW || moves->original.request->rules.core.rows;
}

static void print_moves(const check_run *run)
{
    const gis_moves *moves = &run->moves;
    printf("since %s: %zu matched", run->options->text[OPT_BEFORE], moves->n);
    for (sunder_conflict_kind kind = SUNDER_CONFLICT_WORSE; kind <= SUNDER_CONFLICT_TOO_SMALL; kind++)
        if (is_asked_about(moves, kind))
            printf(", %s %zu", sunder_conflict_kind_string(kind), gis_moves_count(moves, kind));
    printf(", %s %zu\n", GIS_MOVES_LOST, moves->n_lost);
}

static void print_counts(const check_run *run)
{
    const sunder_conflict_counts *counts = &run->summary.before;
    printf("%s: %zu features (skipped %zu, invalid %zu, null %zu), %zu pairs tested; overlap %zu, too close %zu, "
           "barrier %zu, barrier drawn %zu, barrier near %zu, contained %zu, duplicate %zu, inside blocks %zu",
           gis_layer_title(&run->input), run->input.n, run->summary.skipped, run->input.invalid, run->input.null,
           run->summary.pairs_tested, counts->overlap, counts->too_close, counts->barrier, counts->barrier_drawn,
           counts->barrier_near, counts->contained, counts->duplicate, counts->inside_blocks);
    if (run->summary.inside_overlaps)
        printf(" (%zu of them listed: %s)", run->summary.inside_overlaps,
               run->summary.inside_overlaps == 1 ? "it overlaps" : "they overlap");
    if (run->request.rules.has_least_gap) printf(", tight %zu", run->summary.tight);
    putchar('\n');
}

static bool is_asked_to_be_legible(const gis_legible *legible)
{
    bool any = false;
    for (int kind = 0; kind < SUNDER_ILLEGIBLE_KINDS; kind++) any = any || legible->asked[kind];
    return any;
}

/* The numbers of features, or parts of them, that are below a least size. */
static void print_legible(const gis_legible *legible)
{
    const char *before = "legible: ";
    for (sunder_illegible_kind kind = 0; kind < SUNDER_ILLEGIBLE_KINDS; kind++)
        if (legible->asked[kind]) {
            printf("%s%s %zu", before, sunder_illegible_kind_string(kind), legible->count[kind]);
            before = ", ";
        }
    putchar('\n');
}

static bool print_check(const void *checked, gis_error *error)
{
    const check_run *run = checked;
    if (!print_lines(run, error)) return false;
    if (!run->options->given[OPT_QUIET]) print_counts(run);
    if (run->options->given[OPT_BEFORE] && !run->options->given[OPT_QUIET]) print_moves(run);
    if (is_asked_to_be_legible(&run->legible) && !run->options->given[OPT_QUIET]) print_legible(&run->legible);
    return true;
}

/* Adds the key "moves", the numbers of findings of --before by kind; it exists only with that option. */
static void json_moves(gis_json *out, const gis_moves *moves)
{
    gis_json_key(out, "moves");
    gis_json_open(out, '{');
    gis_json_put_size(out, "matched", moves->n);
    for (sunder_conflict_kind kind = SUNDER_CONFLICT_WORSE; kind <= SUNDER_CONFLICT_TOO_SMALL; kind++)
        if (is_asked_about(moves, kind))
            gis_json_put_size(out, sunder_conflict_kind_string(kind), gis_moves_count(moves, kind));
    gis_json_put_size(out, GIS_MOVES_LOST, moves->n_lost);
    gis_json_close(out, '}');
}

/* Adds the key "legible"; it exists only if the sheet asks for it. */
static void json_legible(gis_json *out, const gis_legible *legible)
{
    gis_json_key(out, "legible");
    gis_json_open(out, '{');
    for (sunder_illegible_kind kind = 0; kind < SUNDER_ILLEGIBLE_KINDS; kind++)
        if (legible->asked[kind]) gis_json_put_size(out, sunder_illegible_kind_string(kind), legible->count[kind]);
    gis_json_close(out, '}');
}

/* Adds the key "shortfall"; it exists only with a least gap. */
static void json_tight(gis_json *out, const check_run *run)
{
    gis_json_key(out, "shortfall");
    gis_json_open(out, '{');
    gis_json_put_size(out, "tight", run->summary.tight);
    gis_json_close(out, '}');
}

static void json_check(gis_json *out, const check_run *run)
{
    gis_json_open(out, '{');
    gis_json_put_string(out, "command", "check");
    gis_json_put_size(out, "features", run->input.n);
    gis_json_put_size(out, "skipped", run->summary.skipped);
    gis_json_put_size(out, "invalid", run->input.invalid);
    gis_json_put_size(out, "null", run->input.null);
    gis_json_put_size(out, "pairs_tested", run->summary.pairs_tested);
    gis_json_key(out, "conflicts");
    gis_json_conflict_counts(out, &run->summary.before);
    if (run->request.rules.has_least_gap) json_tight(out, run);
    if (run->options->given[OPT_BEFORE]) json_moves(out, &run->moves);
    if (is_asked_to_be_legible(&run->legible)) json_legible(out, &run->legible);
    gis_json_sheet(out, run->options);
    gis_json_close(out, '}');
    gis_json_raw(out, "\n");
}

static bool deliver_check(const check_run *run, bool taken, gis_error *error)
{
    gis_json stats = {0};
    gis_text page = {0};
    if (run->to.stats) json_check(&stats, run);
    const gis_findings found = {&run->input, run->report, &run->legible, &run->moves};
    const gis_delivery delivery = {.to = &run->to,
                                   .sink = run->sink,
                                   .stats = &stats,
                                   .report = &page,
                                   .print = taken ? NULL : print_check,
                                   .run = run};
    bool ok = (!run->to.report || gis_check_page_write(&found, &page, error)) && gis_deliver(&delivery, error);
    gis_json_clear(&stats);
    gis_text_clear(&page);
    return ok;
}

/* Refuses results that would replace an input. */
static bool spare_inputs(const check_run *run, gis_error *error)
{
    for (size_t k = 0; k < gis_layer_sources(&run->input); k++)
        if (!gis_destinations_spare(&run->to, gis_layer_source(&run->input, k), error)) return false;
    return true;
}

/* With a sheet an operand is a result. Who wants the findings in a file may give that as the only operand. */
static bool hint_at_output(const gis_options *options, gis_error *error)
{
    const char *operand = options->operand[0];
    if (!options->sheet || operand == options->original_source || options->n_operands > 1 ||
        !strstr(error->message, "no such file"))
        return false;
    return gis_fail(error,
                    "%s: no such file; with --spec the operand is the result to check, and --output FILE writes "
                    "what is found",
                    operand);
}

int gis_command_check(const gis_options *options)
{
    gis_error error;
    check_run run = {
        .options = options, .to = gis_resolve_destinations(options), .progress = gis_resolve_progress(options)};
    bool taken, ok = gis_destinations_check(&run.to, &taken, &error);
    gis_progress_stage(&run.progress, 0, GIS_CHECK_READ);
    ok = ok && gis_resolve_layer(options, &run.request, &error) &&
         (gis_layer_input_read(&run.request, &run.input, &error) || hint_at_output(options, &error)) &&
         spare_inputs(&run, &error) && check_and_write(&run, &error) && deliver_check(&run, taken, &error);
    int status = ok ? gis_complete_status(options, gis_any_conflict(&run.summary.before) ||
                                                       gis_moves_rows(&run.moves) || run.legible.n)
                    : gis_say_failure(&error);
    gis_sink_free(run.sink);
    free(run.layer);
    sunder_report_free(run.report);
    gis_moves_clear(&run.moves);
    free(run.original.with);
    free(run.original.alone);
    gis_legible_clear(&run.legible);
    gis_layer_input_clear(&run.input);
    gis_layer_input_request_clear(&run.request);
    return status;
}
