/* separate_in_parts.c: from parts on the disk to an output: of a layer that memory does not hold, or of a plan. */
#include "base/resources.h"
#include "commands/progress_shares.h"
#include "commands/separate_run.h"

static bool open_sink_in_parts(gis_separate_run *run, gis_error *error)
{
    if (!gis_separate_open_sink(run, error)) return false;
    if (!gis_sink_remembers(run->sink)) return true;
    gis_sink_free(run->sink);
    run->sink = NULL;
    gis_layer_input_clear(&run->input);
    run->whole = true;
    return gis_shard_run_open_source(&run->parts, true, &run->input, error) && gis_separate_open_sink(run, error);
}

bool gis_separate_in_parts(gis_separate_run *run, gis_error *error)
{
    gis_sink_result result;
    if (!open_sink_in_parts(run, error)) return false;
    gis_progress_stage(&run->progress, GIS_SEPARATE_READ, GIS_SEPARATE_DONE);
    const double began = gis_clock();
    if ((!run->merges && !gis_shard_run_separate(&run->parts, 1, run->stamp, &run->progress, error)) ||
        !gis_shard_run_join(&run->parts, run->stamp, &run->summary, error))
        return false;
    run->summary.seconds_solve = gis_clock() - began - run->summary.seconds_explain - run->summary.seconds_verify;
    gis_progress_stage(&run->progress, GIS_SEPARATE_DONE, 1);
    const double begin = gis_clock();
    const gis_shard_run_layers layers = {
        (run->chosen & GIS_SEPARATE_MAIN) != 0, (run->chosen & GIS_SEPARATE_DISPLACEMENT) != 0,
        (run->chosen & GIS_SEPARATE_CONFLICTS) != 0, (run->chosen & GIS_SEPARATE_PUSHES) != 0,
        (run->chosen & GIS_SEPARATE_SYMBOLS) != 0};
    if (!gis_shard_run_write(&run->parts, &run->input, &layers, run->sink, error) ||
        !gis_sink_finish(run->sink, &result, error))
        return false;
    run->write = gis_clock() - begin;
    run->verified = run->summary.verified && result.exact;
    gis_progress_done(&run->progress);
    return true;
}
