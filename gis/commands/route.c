/* route.c: the command sunder route. It finds a shortest path of a robot among obstacles, with contact allowed, and
 * writes it as JSON or as layers. */
#include "base/core_error.h"
#include "base/message.h"
#include "commands/command_stats.h"
#include "commands/commands.h"
#include "commands/resolve.h"
#include "read/source_files.h"
#include "route/route_layers.h"

#include <math.h>
#include <stdio.h>

typedef struct route_run {
    const gis_options *options;
    gis_destinations to;
    gis_route_request request;
    gis_route_input input;
    sunder_route *route;
    gis_sink *sink;                  /* NULL: no layers are written */
    double max_deviation;            /* the largest deviation of coordinates in the layers; NaN: no layers are
                                      * written */
    char reason[GIS_WHO_SIZE + 128]; /* why there is no route; "" if there is one */
} route_run;

static bool open_sink(route_run *run, gis_error *error)
{
    static const char *const suffixes[] = {"placements",          "obstacles",         "free_space",
                                           "degenerate_segments", "degenerate_points", NULL};
    static const char *const fewer[] = {"placements", NULL};
    const char *path = run->to.output;
    gis_sink_request request = gis_resolve_sink(run->options, path, "route");
    request.suffixes = run->request.free_space ? suffixes : fewer;
    return gis_source_spare(run->input.source, path, request.update, error) &&
           gis_source_spare(run->input.robot_source, path, request.update, error) &&
           gis_sink_open(&request, run->input.source ? run->input.source : run->input.robot_source, &run->sink, error);
}

static bool find_route(route_run *run, gis_error *error)
{
    sunder_error why;
    gis_progress progress = gis_resolve_progress(run->options);
    gis_progress_stage(&progress, 0, 1);
    const sunder_route_options how = {
        .size = sizeof how, .gap = run->input.gap, .progress = gis_progress_call, .progress_user = &progress};
    sunder_status status = sunder_route_find(run->input.obstacle, run->input.n, run->input.robot, &run->request.from.at,
                                             &run->request.to.at, &how, &run->route, &why);
    if (status != SUNDER_OK) return gis_core_failed(error, NULL, &why);
    gis_progress_done(&progress);
    size_t obstacle;
    sunder_route_status reason = sunder_route_reason(run->route, &obstacle);
    if (reason == SUNDER_ROUTE_DISCONNECTED) {
        snprintf(run->reason, sizeof run->reason, "start and goal lie in different components of free space");
    } else if (reason != SUNDER_ROUTE_FOUND) {
        char name[GIS_WHO_SIZE];
        gis_route_obstacle_name(&run->input, obstacle, name, sizeof name);
        snprintf(run->reason, sizeof run->reason, "at the %s the robot's interior meets %s",
                 reason == SUNDER_ROUTE_START_COLLIDES ? "start" : "goal", name);
    }
    return true;
}

static bool json_path(gis_json *out, const route_run *run, gis_error *error)
{
    gis_json_open(out, '[');
    for (size_t i = 0; i < sunder_route_vertices(run->route); i++) {
        gis_json_open(out, '[');
        if (run->options->given[OPT_EXACT]) {
            const char *x, *y;
            sunder_route_vertex_text(run->route, i, &x, &y);
            gis_json_string(out, x);
            gis_json_string(out, y);
        } else {
            double xy[2];
            sunder_route_vertex(run->route, i, xy);
            if (!isfinite(xy[0]) || !isfinite(xy[1]))
                return gis_fail(error, "the path leaves the range of doubles; --exact gives it as rationals");
            gis_json_double(out, xy[0]);
            gis_json_double(out, xy[1]);
        }
        gis_json_close(out, ']');
    }
    gis_json_close(out, ']');
    return true;
}

static bool json_route(gis_json *out, const route_run *run, gis_error *error)
{
    const bool found = !run->reason[0];
    gis_json_open(out, '{');
    gis_json_put_string(out, "command", "route");
    gis_json_put_bool(out, "found", found);
    gis_json_put_double(out, "length", found ? sunder_route_length(run->route) : (double)NAN);
    gis_json_key(out, "path");
    if (!json_path(out, run, error)) return false;
    gis_json_key(out, "rounded_is_free");
    if (found)
        gis_json_bool(out, sunder_route_rounded_is_free(run->route));
    else
        gis_json_null(out);
    gis_json_put_double(out, "max_deviation", run->max_deviation);
    gis_json_put_string(out, "reason", found ? NULL : run->reason);
    gis_json_close(out, '}');
    gis_json_raw(out, "\n");
    return true;
}

static bool write_layers(route_run *run, gis_error *error)
{
    gis_sink_result result;
    if (!gis_write_route(run->sink, &run->input, run->route, &run->max_deviation, error) ||
        !gis_sink_finish(run->sink, &result, error))
        return false;
    if (!result.exact) run->max_deviation += result.deviation;
    return true;
}

static bool deliver_route(route_run *run, bool taken, gis_error *error)
{
    gis_json text = {0};
    bool ok = (!run->sink || write_layers(run, error)) && json_route(&text, run, error) &&
              (gis_json_text(&text) || gis_no_memory(error));
    const gis_delivery delivery = {
        .to = &run->to, .sink = run->sink, .stats = &text, .print = taken ? NULL : gis_print_json, .run = &text};
    ok = ok && gis_deliver(&delivery, error);
    gis_json_clear(&text);
    return ok;
}

int gis_command_route(const gis_options *options)
{
    gis_error error;
    route_run run = {.options = options, .to = gis_resolve_destinations(options), .max_deviation = NAN};
    bool taken,
        ok = gis_destinations_check(&run.to, &taken, &error) && gis_resolve_route(options, &run.request, &error) &&
             gis_route_input_read(&run.request, &run.input, &error) && (!run.to.output || open_sink(&run, &error));
    ok = ok && find_route(&run, &error) && deliver_route(&run, taken, &error);
    int status = ok ? gis_complete_status(options, run.reason[0] != '\0') : gis_say_failure(&error);
    gis_sink_free(run.sink);
    sunder_route_free(run.route);
    gis_route_input_clear(&run.input);
    gis_route_request_clear(&run.request);
    return status;
}
