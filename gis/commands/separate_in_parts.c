/* separate_in_parts.c: writes the output from parts on disk, for a layer that exceeds the memory and for a plan. */
#include "base/resources.h"
#include "commands/progress_shares.h"
#include "commands/separate_run.h"

/* Opens the output. If its format changes values, the source is opened again with all features in memory, so that they
 * can be compared with what was written. */
static bool open_sink(gis_separate_run *run, gis_error *error)
{
    run->scratch = gis_shard_run_scratch(&run->parts, error);
    if (!run->scratch || !gis_separate_open_sink(run, error)) return false;
    if (!gis_sink_remembers(run->sink)) return true;
    gis_sink_free(run->sink);
    run->sink = NULL;
    gis_layer_input_clear(&run->input);
    run->source_held = true;
    return gis_shard_run_open_source(&run->parts, true, &run->input, error) && gis_separate_open_sink(run, error);
}

bool gis_separate_in_parts_begin(gis_separate_run *run, gis_error *error)
{
    if (!open_sink(run, error)) return false;
    gis_progress_stage(&run->progress, GIS_SEPARATE_READ, GIS_SEPARATE_DONE);
    run->began = gis_clock();
    return true;
}

bool gis_separate_in_parts_end(gis_separate_run *run, gis_error *error)
{
    if (!gis_shard_run_join(&run->parts, run->stamp, &run->summary, error)) return false;
    run->summary.seconds_solve = gis_clock() - run->began - run->summary.seconds_explain - run->summary.seconds_verify;
    run->result = gis_shard_run_result(&run->parts, &run->input);
    return gis_separate_write_layers(run, error);
}
