/* follow.c: the command sunder follow. It reads the result of a separation and another layer, and moves each feature of
 * that layer with what it belongs to. */
#include "base/message.h"
#include "commands/command_stats.h"
#include "commands/commands.h"
#include "commands/progress_shares.h"
#include "commands/resolve.h"
#include "read/crs_units.h"
#include "read/source_files.h"

#include <stdio.h>
#include <stdlib.h>

typedef struct follow_run {
    const gis_options *options;
    gis_destinations to;
    gis_follow_request request;
    gis_follow follow;
    gis_follow_targets targets;
    gis_sink *sink;
    gis_progress progress;
} follow_run;

static bool read_layers(follow_run *run, gis_error *error)
{
    gis_follow *f = &run->follow;
    f->request = &run->request;
    f->targets = &run->targets;
    if (!gis_follow_read_moved(f, &run->targets, error) || !gis_follow_open(&run->request, f, error)) return false;
    return gis_crs_may_be_same(gis_source_crs(f->input), gis_source_crs(f->moved)) ||
           gis_fail(error, "INPUT and MOVED are in different CRSs; reproject one of them");
}

/* Opens the output before the work, so that an output that must be refused is refused at once. */
static bool open_sink(follow_run *run, gis_error *error)
{
    gis_sink_request request = gis_resolve_sink(run->options, run->to.output, gis_source_name(run->follow.input));
    request.features = true;
    return gis_source_spare(run->follow.moved, request.path, request.update, error) &&
           gis_sink_open(&request, run->follow.input, &run->sink, error);
}

static bool print_summary(const void *made, gis_error *error)
{
    (void)error; /* an error of stdio is found when stdout is flushed */
    gis_print_follow(made);
    return true;
}

static bool deliver_follow(const follow_run *run, bool taken, gis_error *error)
{
    gis_json stats = {0};
    if (run->to.stats) {
        gis_json_open(&stats, '{');
        gis_json_put_string(&stats, "command", "follow");
        gis_json_follow(&stats, &run->follow);
        gis_json_close(&stats, '}');
        gis_json_raw(&stats, "\n");
    }
    const gis_delivery delivery = {.to = &run->to,
                                   .sink = run->sink,
                                   .stats = &stats,
                                   .print = taken || run->options->given[OPT_QUIET] ? NULL : print_summary,
                                   .run = &run->follow};
    bool ok = gis_deliver(&delivery, error);
    gis_json_clear(&stats);
    return ok;
}

/* Finds the groups and writes everything; only gis_deliver(), which puts the files in place, is left to do. */
static bool attach_and_write(follow_run *run, gis_error *error)
{
    gis_sink_result result;
    gis_progress_stage(&run->progress, GIS_FOLLOW_READ, GIS_FOLLOW_ATTACHED);
    if (!open_sink(run, error) || !gis_follow_attach(&run->follow, &run->progress, error)) return false;
    gis_progress_stage(&run->progress, GIS_FOLLOW_ATTACHED, 1);
    if (!gis_follow_write(run->sink, 0, &run->follow, error) || !gis_sink_finish(run->sink, &result, error))
        return false;
    gis_progress_done(&run->progress);
    return true;
}

int gis_command_follow(const gis_options *options)
{
    gis_error error;
    follow_run run = {
        .options = options, .to = gis_resolve_destinations(options), .progress = gis_resolve_progress(options)};
    bool taken,
        ok = gis_resolve_follow(options, &run.request, &error) && gis_destinations_check(&run.to, &taken, &error);
    gis_progress_stage(&run.progress, 0, GIS_FOLLOW_READ);
    ok = ok && read_layers(&run, &error) && gis_destinations_spare(&run.to, run.follow.input, &error) &&
         gis_destinations_spare(&run.to, run.follow.moved, &error) && attach_and_write(&run, &error) &&
         deliver_follow(&run, taken, &error);
    int status = ok ? GIS_DONE : gis_say_failure(&error);
    gis_sink_free(run.sink);
    gis_follow_clear(&run.follow);
    gis_follow_targets_clear(&run.targets);
    return status;
}
