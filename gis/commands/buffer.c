/* buffer.c: sunder buffer. Read, grow or shrink, round, write. */
#include "base/message.h"
#include "buffer/buffer.h"
#include "commands/commands.h"
#include "commands/report.h"
#include "write/deliver.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

typedef struct buffer_run {
    gis_buffer buffer;
    const gis_options *options;
    gis_sink *sink;
    gis_progress progress;
    double start;
} buffer_run;

/* What can be refused before anything is read. */
static bool check_options(const gis_options *options, gis_error *error)
{
    const char *shape = options->text[OPT_SHAPE];
    if (!options->given[OPT_SHAPE])
        return gis_fail_usage(error, "--shape is missing: what to grow or shrink by, as in --shape square:6");
    const char *meant = gis_shape_is_text(shape) || access(shape, F_OK) == 0 ? NULL : gis_shape_prefix_meant(shape);
    if (meant)
        return gis_fail_usage(error, "--shape %s: no such file, and no shape; did you mean %s?", shape, meant);
    if (options->given[OPT_DISSOLVE] && options->given[OPT_DISSOLVE_FIELD])
        return gis_fail_usage(error, "--dissolve makes one set of all features, --dissolve-field one of each value: "
                              "give one of them");
    return true;
}

static sunder_operation operation_of(const gis_options *options)
{
    sunder_operation operation = SUNDER_OPERATION_DILATE;
    while (strcmp(sunder_operation_string(operation), options->text[OPT_OPERATION]) != 0)
        operation++;
    return operation;
}

static bool read_input(buffer_run *run, gis_error *error)
{
    gis_buffer *buffer = &run->buffer;
    const gis_options *options = run->options;
    buffer->options = options;
    buffer->operation = operation_of(options);
    buffer->field = -1;
    buffer->dissolve = options->given[OPT_DISSOLVE] || options->given[OPT_DISSOLVE_FIELD];
    if (!gis_layer_shapes_read(options, &buffer->input, error) ||
        !gis_layer_field(&buffer->input, OPT_DISSOLVE_FIELD, &buffer->field, error) ||
        !gis_shape_of_option(options, OPT_SHAPE, &buffer->input.rule, gis_source_crs(buffer->input.source),
                             &buffer->shape_source, &buffer->shape, error))
        return false;
    gis_layer_warn_of_crs(&buffer->input);
    if (buffer->input.other > 0)
        gis_say_warning("%s: %zu features are no polygons; they are written without geometry",
                        gis_source_name(buffer->input.source), buffer->input.other);
    return gis_buffer_gather(buffer, error);
}

/* Opened before the work is done: what can be refused is refused at once. */
static bool open_sink(buffer_run *run, gis_error *error)
{
    static const char *const suffixes[] = {"degenerate_segments", "degenerate_points", NULL};
    const gis_source *source = run->buffer.input.source;
    gis_sink_request request = gis_options_sink(run->options, run->options->operand[1], gis_source_name(source));
    if (run->options->given[OPT_DEGENERATE])
        request.suffixes = suffixes;
    return gis_source_spare(run->buffer.shape_source, run->options, request.path, error) &&
           gis_sink_open(&request, source, &run->sink, error);
}

/* All but the last step, which is gis_deliver()'s. */
static bool make_and_write(buffer_run *run, gis_error *error)
{
    gis_sink_result result;
    gis_progress_stage(&run->progress, 0.1, 0.9);
    if (!open_sink(run, error) || !gis_buffer_make(&run->buffer, &run->progress, error))
        return false;
    gis_progress_stage(&run->progress, 0.9, 1);
    if (!gis_write_buffer(run->sink, &run->buffer, error) || !gis_sink_finish(run->sink, &result, error))
        return false;
    if (!result.exact)
        run->buffer.deviation += result.deviation;
    gis_progress_done(&run->progress);
    return true;
}

static void json_buffer(gis_json *out, const gis_buffer *buffer)
{
    gis_json_open(out, '{');
    gis_json_key(out, "command");
    gis_json_string(out, "buffer");
    gis_json_key(out, "features");
    gis_json_size(out, buffer->input.n);
    gis_json_key(out, "empty");
    gis_json_size(out, buffer->empty);
    gis_json_key(out, "vertices");
    gis_json_size(out, buffer->vertices);
    gis_json_key(out, "area");
    gis_json_double(out, buffer->area);
    gis_json_key(out, "max_deviation");
    gis_json_double(out, buffer->deviation);
    gis_json_key(out, "repaired");
    gis_json_size(out, buffer->repaired);
    gis_json_close(out, '}');
    gis_json_raw(out, "\n");
}

static bool print_summary(const void *made, gis_error *error)
{
    const buffer_run *run = made;
    const gis_buffer *buffer = &run->buffer;
    (void)error; /* what stdio refuses shows when it is flushed */
    printf("%s: %zu features", gis_source_name(buffer->input.source), buffer->input.n);
    if (buffer->dissolve)
        printf(" in %zu set%s", buffer->sets, buffer->sets == 1 ? "" : "s");
    printf(", %zu came out empty; %zu vertices, area %.12g\n", buffer->empty, buffer->vertices, buffer->area);
    printf("exact up to rounding: no boundary moved by more than %.3g; %zu polygons were mended for it; %.3g s\n",
           buffer->deviation, buffer->repaired, gis_clock() - run->start);
    return true;
}

static bool deliver(const buffer_run *run, bool taken, gis_error *error)
{
    gis_json stats = {0};
    if (gis_stats_path(run->options))
        json_buffer(&stats, &run->buffer);
    const gis_delivery delivery = {run->options, run->sink, &stats,
                                   taken || run->options->given[OPT_QUIET] ? NULL : print_summary, run};
    bool ok = gis_deliver(&delivery, error);
    gis_json_clear(&stats);
    return ok;
}

int gis_command_buffer(const gis_options *options)
{
    gis_error error;
    buffer_run run = {.options = options, .progress = gis_progress_of(options), .start = gis_clock()};
    bool taken, ok = check_options(options, &error) && gis_stdout_taken(options, options->operand[1], &taken, &error) &&
                     gis_stats_check(options, &error);
    gis_progress_stage(&run.progress, 0, 0.1);
    ok = ok && read_input(&run, &error) && make_and_write(&run, &error) && deliver(&run, taken, &error);
    int status = ok ? GIS_DONE : gis_say_failure(&error);
    gis_sink_free(run.sink);
    gis_buffer_clear(&run.buffer);
    return status;
}
