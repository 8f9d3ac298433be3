/* sum.c: the command sunder sum. It writes the canonical sum as JSON to stdout, or as layers, and statistics. */
#include "base/core_error.h"
#include "base/interrupt.h"
#include "base/message.h"
#include "base/resources.h"
#include "commands/command_stats.h"
#include "commands/commands.h"
#include "commands/resolve.h"
#include "sum/sum_layers.h"

#include <math.h>

typedef struct sum_run {
    const gis_options *options;
    gis_destinations to;
    sunder_sum_options how;
    gis_operands operands;
    sunder_shape *reflected; /* -Q, if --reflect is given */
    sunder_sum *sum;
    gis_sink *sink;       /* NULL: no layers are written */
    double max_deviation; /* the largest deviation of coordinates in the layers; NaN: no layers are written */
    double read, decompose, compute, write, start;
} sum_run;

static bool compute_sum(sum_run *run, gis_error *error)
{
    sunder_error why;
    const sunder_shape *q = run->operands.q;
    gis_progress progress = gis_resolve_progress(run->options);
    gis_progress_stage(&progress, 0, 1);
    run->decompose = run->operands.building;
    if (run->options->given[OPT_REFLECT]) {
        double begin = gis_clock();
        if (sunder_shape_reflect(q, &run->reflected, &why) != SUNDER_OK) return gis_core_failed(error, "Q", &why);
        q = run->reflected;
        run->decompose += gis_clock() - begin;
    }
    sunder_sum_options how = run->how;
    how.progress = gis_progress_call;
    how.progress_user = &progress;
    double begin = gis_clock();
    sunder_status status = sunder_minkowski_sum(run->operands.p, q, &how, &run->sum, &why);
    if (status != SUNDER_OK) return gis_core_failed(error, NULL, &why);
    run->compute = run->decompose + (gis_clock() - begin);
    gis_progress_done(&progress);
    return true;
}

/* Writes one coordinate pair: with --exact rationals as strings, else decimals. */
static bool json_vertex(gis_json *out, const sum_run *run, uint32_t vertex, gis_error *error)
{
    if (!gis_go_on(error)) return false;
    gis_json_open(out, '[');
    if (run->options->given[OPT_EXACT]) {
        char *x, *y;
        sunder_error why;
        if (sunder_sum_vertex_text(run->sum, vertex, &x, &y, &why) != SUNDER_OK)
            return gis_core_failed(error, NULL, &why);
        gis_json_string(out, x);
        gis_json_string(out, y);
        sunder_free(x);
        sunder_free(y);
    } else {
        double xy[2];
        sunder_sum_vertex(run->sum, vertex, xy);
        if (!isfinite(xy[0]) || !isfinite(xy[1]))
            return gis_fail(error, "the sum leaves the range of doubles; --exact gives it as rationals");
        gis_json_double(out, xy[0]);
        gis_json_double(out, xy[1]);
    }
    gis_json_close(out, ']');
    return true;
}

static bool json_ring(gis_json *out, const sum_run *run, size_t polygon, size_t ring, gis_error *error)
{
    size_t n;
    const uint32_t *vertices = sunder_sum_ring(run->sum, polygon, ring, &n);
    gis_json_open(out, '[');
    for (size_t i = 0; i < n; i++)
        if (!json_vertex(out, run, vertices[i], error)) return false;
    gis_json_close(out, ']');
    return true;
}

static bool json_polygon(gis_json *out, const sum_run *run, size_t polygon, gis_error *error)
{
    gis_json_open(out, '{');
    gis_json_key(out, "outer");
    if (!json_ring(out, run, polygon, 0, error)) return false;
    gis_json_key(out, "holes");
    gis_json_open(out, '[');
    for (size_t r = 1; r < sunder_sum_rings(run->sum, polygon); r++)
        if (!json_ring(out, run, polygon, r, error)) return false;
    gis_json_close(out, ']');
    gis_json_close(out, '}');
    return true;
}

/* Writes the keys polygons, degenerate_segments and degenerate_points, which come after those of the summary. */
static bool json_geometry(gis_json *out, const sum_run *run, gis_error *error)
{
    sunder_sum_size size;
    sunder_sum_get_size(run->sum, &size);
    gis_json_line(out);
    gis_json_key(out, "polygons");
    gis_json_open(out, '[');
    for (size_t p = 0; p < size.polygons; p++) {
        gis_json_line(out);
        if (!json_polygon(out, run, p, error)) return false;
    }
    gis_json_close(out, ']');
    gis_json_line(out);
    gis_json_key(out, "degenerate_segments");
    gis_json_open(out, '[');
    for (size_t i = 0; i < size.degenerate_segments; i++) {
        uint32_t ends[2];
        sunder_sum_segment(run->sum, i, ends);
        gis_json_open(out, '[');
        if (!json_vertex(out, run, ends[0], error) || !json_vertex(out, run, ends[1], error)) return false;
        gis_json_close(out, ']');
    }
    gis_json_close(out, ']');
    gis_json_line(out);
    gis_json_key(out, "degenerate_points");
    gis_json_open(out, '[');
    for (size_t i = 0; i < size.degenerate_points; i++)
        if (!json_vertex(out, run, sunder_sum_point(run->sum, i), error)) return false;
    gis_json_close(out, ']');
    return true;
}

static void json_operand(gis_json *out, const char *key, const sunder_shape *shape)
{
    gis_json_key(out, key);
    gis_json_open(out, '{');
    gis_json_put_size(out, "polygons", sunder_shape_polygons(shape));
    gis_json_put_size(out, "vertices", sunder_shape_vertices(shape));
    gis_json_close(out, '}');
}

static bool json_result(gis_json *out, const sum_run *run, gis_error *error)
{
    sunder_sum_size size;
    char *area;
    sunder_error why;
    sunder_sum_get_size(run->sum, &size);
    if (sunder_sum_area_text(run->sum, &area, &why) != SUNDER_OK) return gis_core_failed(error, NULL, &why);
    gis_json_key(out, "result");
    gis_json_open(out, '{');
    gis_json_put_size(out, "polygons", size.polygons);
    gis_json_put_size(out, "holes", size.holes);
    gis_json_put_size(out, "vertices", size.vertices);
    gis_json_put_size(out, "degenerate_segments", size.degenerate_segments);
    gis_json_put_size(out, "degenerate_points", size.degenerate_points);
    gis_json_put_string(out, "area", area);
    gis_json_put_double(out, "max_deviation", run->max_deviation);
    gis_json_close(out, '}');
    sunder_free(area);
    return true;
}

static void json_seconds(gis_json *out, const sum_run *run)
{
    double decompose, subsums, unite;
    sunder_sum_seconds(run->sum, &decompose, &subsums, &unite);
    decompose += run->decompose;
    const struct {
        const char *key;
        double seconds;
    } times[] = {{"read", run->read},
                 {"decompose", decompose},
                 {"subsums", subsums},
                 {"union", unite},
                 {"write", run->write},
                 {"compute", run->compute},
                 {"total", gis_clock() - run->start}};
    gis_json_key(out, "seconds");
    gis_json_open(out, '{');
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) gis_json_seconds(out, times[i].key, times[i].seconds);
    gis_json_close(out, '}');
}

/* Writes the counts of operations, in total and by phase; the convolution counts no phases. */
static void json_operations(gis_json *out, const sum_run *run)
{
    sunder_counts counts;
    sunder_sum_get_counts(run->sum, &counts);
    gis_json_key(out, "operations");
    gis_json_open(out, '{');
    gis_json_operations(out, &counts);
    gis_json_key(out, "phases");
    gis_json_open(out, '{');
    for (int i = SUNDER_PHASE_DECOMPOSE; i <= SUNDER_PHASE_UNION; i++) {
        if (!sunder_sum_phase(run->sum, (sunder_phase)i, &counts)) break;
        gis_json_key(out, sunder_phase_string((sunder_phase)i));
        gis_json_open(out, '{');
        gis_json_operations(out, &counts);
        gis_json_close(out, '}');
    }
    gis_json_close(out, '}');
    gis_json_close(out, '}');
}

/* Writes the summary, followed by the text `geometry` (the keys of json_geometry()) unless that is NULL. */
static bool json_sum(gis_json *out, const sum_run *run, const char *geometry, gis_error *error)
{
    sunder_sum_method method;
    sunder_sum_get_method(run->sum, &method);
    /* false for the convolution, which has no decomposition and no order to report */
    bool united = method.decomposition != SUNDER_DECOMPOSITION_AUTO;
    gis_json_open(out, '{');
    gis_json_put_string(out, "command", "sum");
    gis_json_put_string(out, "algorithm", sunder_algorithm_string(method.algorithm));
    gis_json_put_string(out, "decomposition", united ? sunder_decomposition_string(method.decomposition) : NULL);
    gis_json_put_string(out, "order", united ? sunder_order_string(method.order) : NULL);
    json_operand(out, "p", run->operands.p);
    json_operand(out, "q", run->operands.q);
    gis_json_line(out);
    if (!json_result(out, run, error)) return false;
    gis_json_line(out);
    json_operations(out, run);
    gis_json_line(out);
    json_seconds(out, run);
    gis_json_put_size(out, "peak_rss_bytes", gis_peak_rss());
    if (geometry) gis_json_raw(out, geometry);
    gis_json_close(out, '}');
    gis_json_raw(out, "\n");
    return true;
}

/* Opens the output before the computation, so that an output that must be refused is refused at once. */
static bool open_sink(sum_run *run, gis_error *error)
{
    static const char *const suffixes[] = {
        "degenerate_segments", "degenerate_points", "faces", "edges", "vertices", NULL};
    static const char *const without_map[] = {"degenerate_segments", "degenerate_points", NULL};
    gis_sink_request request = gis_resolve_sink(run->options, run->to.output, "sum");
    request.suffixes = run->how.keep_map ? suffixes : without_map;
    request.polygons = true;
    return gis_operands_spare(&run->operands, run->to.output, request.update, error) &&
           gis_sink_open(&request, gis_operands_source(&run->operands), &run->sink, error);
}

/* Writes the layers; only gis_deliver(), which puts the files in place, is left to do. */
static bool write_layers(sum_run *run, gis_error *error)
{
    gis_sink_result result;
    if (!gis_write_sum(run->sink, run->sum, run->operands.crs, &run->max_deviation, error) ||
        (run->how.keep_map && !gis_write_map(run->sink, sunder_sum_map(run->sum), run->operands.crs, error)) ||
        !gis_sink_finish(run->sink, &result, error))
        return false;
    if (!result.exact) run->max_deviation += result.deviation;
    return true;
}

static bool deliver_sum(sum_run *run, bool taken, gis_error *error)
{
    bool wanted = !run->sink && !taken; /* the complete sum is printed to standard output */
    gis_json geometry = {.need_comma = true}, whole = {0}, stats = {0};
    double begin = gis_clock();
    bool ok = run->sink ? write_layers(run, error)
                        : !wanted || (json_geometry(&geometry, run, error) &&
                                      (gis_json_text(&geometry) || gis_no_memory(error)));
    run->write = gis_clock() - begin;
    ok = ok && (!run->to.stats || json_sum(&stats, run, NULL, error));
    ok = ok && (!wanted || (json_sum(&whole, run, gis_json_text(&geometry), error) &&
                            (gis_json_text(&whole) || gis_no_memory(error))));
    const gis_delivery delivery = {
        .to = &run->to, .sink = run->sink, .stats = &stats, .print = wanted ? gis_print_json : NULL, .run = &whole};
    ok = ok && gis_deliver(&delivery, error);
    gis_json_clear(&geometry);
    gis_json_clear(&whole);
    gis_json_clear(&stats);
    return ok;
}

int gis_command_sum(const gis_options *options)
{
    gis_error error;
    sum_run run = {
        .options = options, .to = gis_resolve_destinations(options), .max_deviation = NAN, .start = gis_clock()};
    gis_operands_request request;
    bool taken, ok = gis_resolve_road(options, &run.how, &error) && gis_destinations_check(&run.to, &taken, &error) &&
                     gis_resolve_operands(options, &request, &error) &&
                     gis_operands_read(&request, &run.operands, &error);
    run.read = gis_clock() - run.start - run.operands.building;
    ok = ok && (!run.to.output || open_sink(&run, &error));
    ok = ok && compute_sum(&run, &error) && deliver_sum(&run, taken, &error);
    gis_sink_free(run.sink);
    sunder_sum_free(run.sum);
    sunder_shape_free(run.reflected);
    gis_operands_clear(&run.operands);
    return ok ? GIS_DONE : gis_say_failure(&error);
}
