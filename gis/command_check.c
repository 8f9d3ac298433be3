/* command_check.c: sunder check. The exact list of what overlaps or is too close, whoever made the layer. */
#include "commands.h"
#include "layer_output.h"
#include "message.h"
#include "report.h"

#include <cpl_conv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct check_run {
    const gis_options *options;
    gis_layer_input input;
    sunder_report *report;
    sunder_layer_summary summary;
    gis_progress progress;
} check_run;

static bool check(check_run *run, gis_error *error)
{
    sunder_layer_options how = gis_layer_core_options(&run->input);
    sunder_error why;
    gis_progress_stage(&run->progress, 0.3, 0.9);
    how.progress = gis_progress_call;
    how.progress_user = &run->progress;
    sunder_status status = sunder_layer_check(run->input.layer, &how, &run->report, &why);
    if (status == SUNDER_ECANCEL)
        return gis_fail(error, "interrupted");
    if (status == SUNDER_EARG)
        return gis_fail_usage(error, "%s", why.message);
    if (status != SUNDER_OK)
        return gis_fail(error, "layer %s: %s", gis_source_name(run->input.source), why.message);
    sunder_report_summary(run->report, &run->summary);
    return true;
}

/* LAYER_conflicts, or the name that --output-layer gives. */
static bool write_layer(const check_run *run, const char *path, gis_error *error)
{
    const char *source = gis_source_name(run->input.source);
    size_t size = strlen(source) + sizeof "_conflicts";
    char *name = malloc(size);
    if (!name)
        return gis_no_memory(error);
    snprintf(name, size, "%s_conflicts", source);
    gis_sink_request request = gis_options_sink(run->options, path, name);
    gis_sink *sink;
    gis_sink_result result;
    bool ok = gis_sink_open(&request, run->input.source, &sink, error);
    if (ok) {
        ok = gis_write_conflicts(sink, &run->input, run->report, "", error) && gis_output_finish(sink, &result, error);
        gis_sink_free(sink);
    }
    free(name);
    return ok;
}

/* Tabs and line breaks in a user's key would break the columns: they become blanks. */
static void print_text(const char *text)
{
    for (; *text; text++)
        putchar(*text == '\t' || *text == '\n' || *text == '\r' ? ' ' : *text);
}

static void print_value(const gis_value *value)
{
    char number[GIS_NUMBER_MAX];
    switch (value->kind) {
    case GIS_NULL:
        break;
    case GIS_INTEGER:
        printf(CPL_FRMT_GIB, value->as.integer);
        break;
    case GIS_REAL:
        gis_number_text(value->as.real, number);
        fputs(number, stdout);
        break;
    case GIS_TEXT:
        print_text(value->as.text);
        break;
    }
}

static bool print_lines(const check_run *run, gis_error *error)
{
    size_t n;
    const sunder_conflict *conflicts = sunder_report_conflicts(run->report, &n);
    gis_conflict_texts scratch = {0};
    bool ok = true;
    for (size_t k = 0; ok && k < n; k++) {
        gis_value values[N_CONFLICT_COLUMNS];
        ok = gis_conflict_values(&run->input, &conflicts[k], &scratch, values, error);
        for (int column = 0; ok && column < N_CONFLICT_COLUMNS; column++) {
            if (column)
                putchar('\t');
            print_value(&values[column]);
        }
        if (ok)
            putchar('\n');
    }
    gis_conflict_texts_clear(&scratch);
    return ok;
}

static void print_summary(const check_run *run)
{
    const sunder_conflict_counts *counts = &run->summary.before;
    printf("%s: %zu features, %zu pairs tested; overlap %zu, too close %zu, barrier %zu, contained %zu, duplicate %zu, "
           "inside blocks %zu\n",
           gis_source_name(run->input.source), run->input.n, run->summary.pairs_tested, counts->overlap,
           counts->too_close, counts->barrier, counts->contained, counts->duplicate, counts->inside_blocks);
}

static bool write_stats(const check_run *run, const char *path, gis_error *error)
{
    gis_json out = {0};
    gis_json_open(&out, '{');
    gis_json_key(&out, "command");
    gis_json_string(&out, "check");
    gis_json_key(&out, "features");
    gis_json_size(&out, run->input.n);
    gis_json_key(&out, "pairs_tested");
    gis_json_size(&out, run->summary.pairs_tested);
    gis_json_key(&out, "conflicts");
    gis_json_conflict_counts(&out, &run->summary.before);
    gis_json_close(&out, '}');
    gis_json_raw(&out, "\n");
    bool ok = (gis_json_text(&out) || gis_no_memory(error)) &&
              gis_write_text(path, gis_json_text(&out), out.length, "--stats", error);
    gis_json_clear(&out);
    return ok;
}

static bool report(check_run *run, bool taken, gis_error *error)
{
    const char *stats = gis_stats_path(run->options), *output = run->options->operand[1];
    gis_progress_stage(&run->progress, 0.9, 1);
    if (output && !write_layer(run, output, error))
        return false;
    gis_progress_done(&run->progress);
    if (stats && !write_stats(run, stats, error))
        return false;
    if (taken)
        return true;
    if (!print_lines(run, error))
        return false;
    if (!run->options->given[OPT_QUIET])
        print_summary(run);
    return true;
}

int gis_command_check(const gis_options *options)
{
    gis_error error;
    check_run run = {.options = options, .progress = gis_progress_of(options)};
    bool taken, ok = gis_stdout_taken(options, options->operand[1], &taken, &error) && gis_stats_check(options, &error);
    gis_progress_stage(&run.progress, 0, 0.3);
    ok = ok && gis_layer_input_read(options, &run.input, &error) && check(&run, &error) && report(&run, taken, &error);
    int status = !ok ? gis_say_failure(&error)
                 : gis_any_conflict(&run.summary.before) && !options->given[OPT_ALLOW_CONFLICTS] ? GIS_CONFLICTS
                                                                                                 : GIS_DONE;
    sunder_report_free(run.report);
    gis_layer_input_clear(&run.input);
    return status;
}
