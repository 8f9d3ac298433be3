/* separate.c: the command sunder separate. It reads a layer, separates its features, writes the result and prints a
 * summary. */
#include "base/message.h"
#include "base/resources.h"
#include "commands/command_stats.h"
#include "commands/commands.h"
#include "commands/progress_shares.h"
#include "commands/resolve.h"
#include "commands/separate_run.h"
#include "layer/far_moves.h"
#include "layer/result_held.h"

#include <stdlib.h>

/* Copies the layer to disk and opens the source a second time, to write from. Features are read from it in batches,
 * unless the format requires that features be compared after writing. */
static bool read_in_parts(gis_separate_run *run, double memory, gis_error *error)
{
    return gis_shard_run_begin(&run->request, NULL, 1, memory, &run->parts, error) &&
           gis_shard_run_open_source(&run->parts, false, &run->input, error);
}

static bool separate_in_parts(gis_separate_run *run, gis_error *error)
{
    return gis_separate_in_parts_begin(run, error) &&
           gis_shard_run_separate(&run->parts, 1, run->stamp, &run->progress, error) &&
           gis_separate_in_parts_end(run, error);
}

static bool read_whole(gis_separate_run *run, gis_error *error)
{
    run->source_held = true;
    return gis_layer_input_read(&run->request, &run->input, error) && gis_layer_set_preferred(&run->input, error);
}

/* Refuses results that would replace an input. */
static bool spare_inputs(const gis_separate_run *run, gis_error *error)
{
    for (size_t k = 0; k < gis_layer_sources(&run->input); k++)
        if (!gis_destinations_spare(&run->to, gis_layer_source(&run->input, k), error)) return false;
    return true;
}

static bool separate_whole(gis_separate_run *run, gis_error *error)
{
    if (!gis_separate_open_sink(run, error)) return false;
    gis_progress_stage(&run->progress, GIS_SEPARATE_READ, GIS_SEPARATE_DONE);
    gis_trace *trace = run->to.trace ? &run->trace : NULL;
    run->trace.input = &run->input;
    if (!gis_layer_run(&run->input, sunder_layer_separate, &run->progress, trace, &run->report, &run->summary, error))
        return false;
    gis_far_moves_warn_all(&run->input, run->report);
    run->result = gis_result_held(&run->input, run->report);
    return gis_separate_write_layers(run, error);
}

/* Converts a fraction of the library's progress to a fraction of the whole run. */
#define OF_LIBRARY(fraction) (GIS_SEPARATE_READ + (fraction) * (GIS_SEPARATE_DONE - GIS_SEPARATE_READ))

/* The names of the stages, as in "seconds" of --stats. */
static const gis_progress_name stages[] = {{0, "read"},
                                           {GIS_SEPARATE_READ, "solve"},
                                           {OF_LIBRARY(SUNDER_PROGRESS_SOLVED), "explain"},
                                           {OF_LIBRARY(SUNDER_PROGRESS_EXPLAINED), "verify"},
                                           {GIS_SEPARATE_DONE, "write"},
                                           {1, NULL}};

bool gis_separate_begin(const gis_options *options, gis_separate_run *run, gis_error *error)
{
    *run = (gis_separate_run){.options = options,
                              .to = gis_resolve_destinations(options),
                              .progress = gis_resolve_progress(options),
                              .start = gis_clock()};
    if (!gis_destinations_check(&run->to, &run->taken, error)) return false;
    gis_progress_names(&run->progress, stages);
    gis_progress_stage(&run->progress, 0, GIS_SEPARATE_READ);
    return gis_resolve_layer(options, &run->request, error);
}

int gis_separate_end(gis_separate_run *run, bool done, const gis_error *error)
{
    const int status =
        done ? gis_complete_status(run->options, gis_any_conflict(&run->summary.after)) : gis_say_failure(error);
    gis_trace_clear(&run->trace);
    gis_sink_free(run->sink);
    free(run->more);
    gis_separate_clear_along(&run->along);
    sunder_report_free(run->report);
    gis_layer_input_clear(&run->input);
    gis_shard_run_clear(&run->parts);
    gis_layer_input_request_clear(&run->request);
    return status;
}

int gis_command_separate(const gis_options *options)
{
    if (options->given[OPT_SHARD]) return gis_command_shard(options);
    gis_error error;
    gis_separate_run run;
    double memory;
    bool ok = gis_separate_begin(options, &run, &error) && gis_resolve_memory(options, &memory, &error);
    run.request.rules.count_thin = gis_separate_is_summarised(&run);
    const bool in_parts = ok && memory > 0;
    if (in_parts && run.to.trace)
        ok = gis_fail_usage(&error, "--trace needs the whole layer in memory; leave out --max-memory");
    ok =
        ok && (in_parts ? read_in_parts(&run, memory, &error) : read_whole(&run, &error)) && spare_inputs(&run, &error);
    ok = ok && gis_separate_read_along(&run, &error);
    run.read = gis_clock() - run.start;
    ok = ok && (in_parts ? separate_in_parts(&run, &error) : separate_whole(&run, &error)) &&
         gis_separate_deliver(&run, &error);
    return gis_separate_end(&run, ok, &error);
}
