/* buffer.c: the command sunder buffer. It reads a layer, dilates or erodes it, rounds the result and writes it. */
#include "base/message.h"
#include "base/resources.h"
#include "commands/command_stats.h"
#include "commands/commands.h"
#include "commands/progress_shares.h"
#include "commands/resolve.h"
#include "read/source_files.h"

#include <stdio.h>

typedef struct buffer_run {
    const gis_options *options;
    gis_destinations to;
    gis_buffer_request request;
    gis_buffer buffer;
    gis_sink *sink;
    gis_progress progress;
    double start;
} buffer_run;

/* Opens the output before the computation, so that an output that must be refused is refused at once. */
static bool open_sink(buffer_run *run, gis_error *error)
{
    static const char *const suffixes[] = {"degenerate_segments", "degenerate_points", NULL};
    const gis_source *source = run->buffer.input.source;
    gis_sink_request request = gis_resolve_sink(run->options, run->to.output, gis_source_name(source));
    if (run->request.degenerate) request.suffixes = suffixes;
    request.polygons = true;
    request.features = !run->request.dissolve && !run->request.explode;
    request.new_fids = run->request.explode && !run->request.dissolve;
    return gis_source_spare(run->buffer.shape_source, request.path, request.update, error) &&
           gis_sink_open(&request, source, &run->sink, error);
}

/* Computes and writes everything; only gis_deliver(), which puts the files in place, is left to do. */
static bool make_and_write(buffer_run *run, gis_error *error)
{
    gis_sink_result result;
    gis_progress_stage(&run->progress, GIS_BUFFER_READ, GIS_BUFFER_MADE);
    if (!open_sink(run, error) || !gis_buffer_make(&run->buffer, &run->progress, error)) return false;
    gis_progress_stage(&run->progress, GIS_BUFFER_MADE, 1);
    if (!gis_write_buffer(run->sink, &run->buffer, error) || !gis_sink_finish(run->sink, &result, error)) return false;
    if (!result.exact) run->buffer.deviation += result.deviation;
    gis_progress_done(&run->progress);
    return true;
}

static void json_buffer(gis_json *out, const gis_buffer *buffer)
{
    gis_json_open(out, '{');
    gis_json_put_string(out, "command", "buffer");
    gis_json_put_size(out, "features", buffer->input.n);
    gis_json_put_size(out, "empty", buffer->empty);
    gis_json_put_size(out, "vertices", buffer->vertices);
    gis_json_put_double(out, "area", buffer->area);
    gis_json_put_double(out, "max_deviation", buffer->deviation);
    gis_json_put_size(out, "invalid", buffer->input.invalid);
    gis_json_put_size(out, "rounded_again", buffer->rounded_again);
    gis_json_close(out, '}');
    gis_json_raw(out, "\n");
}

static bool print_summary(const void *made, gis_error *error)
{
    const buffer_run *run = made;
    const gis_buffer *buffer = &run->buffer;
    (void)error; /* an error of stdio is found when stdout is flushed */
    printf("%s: %zu features (invalid %zu, null %zu)", gis_source_name(buffer->input.source), buffer->input.n,
           buffer->input.invalid, buffer->input.null);
    if (run->request.dissolve) printf(" in %zu set%s", buffer->sets, buffer->sets == 1 ? "" : "s");
    printf(", %zu came out empty; %zu vertices, area %.12g\n", buffer->empty, buffer->vertices, buffer->area);
    printf("exact up to rounding: no boundary moved by more than %.3g; %zu polygons were rounded again to stay valid; "
           "%.3g s\n",
           buffer->deviation, buffer->rounded_again, gis_clock() - run->start);
    return true;
}

static bool deliver_buffer(const buffer_run *run, bool taken, gis_error *error)
{
    gis_json stats = {0};
    if (run->to.stats) json_buffer(&stats, &run->buffer);
    const gis_delivery delivery = {.to = &run->to,
                                   .sink = run->sink,
                                   .stats = &stats,
                                   .print = taken || run->options->given[OPT_QUIET] ? NULL : print_summary,
                                   .run = run};
    bool ok = gis_deliver(&delivery, error);
    gis_json_clear(&stats);
    return ok;
}

int gis_command_buffer(const gis_options *options)
{
    gis_error error;
    buffer_run run = {.options = options,
                      .to = gis_resolve_destinations(options),
                      .progress = gis_resolve_progress(options),
                      .start = gis_clock()};
    bool taken,
        ok = gis_resolve_buffer(options, &run.request, &error) && gis_destinations_check(&run.to, &taken, &error);
    gis_progress_stage(&run.progress, 0, GIS_BUFFER_READ);
    ok = ok && gis_buffer_read(&run.request, &run.buffer, &error) &&
         gis_destinations_spare(&run.to, run.buffer.input.source, &error) && make_and_write(&run, &error) &&
         deliver_buffer(&run, taken, &error);
    int status = ok ? GIS_DONE : gis_say_failure(&error);
    gis_sink_free(run.sink);
    gis_buffer_clear(&run.buffer);
    return status;
}
