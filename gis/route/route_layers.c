/* route_layers.c: writes a route as layers: legs, placements of the robot, configuration-space obstacles and free
 * space. The core's results are exact; the largest deviation of the written doubles from them is determined while
 * writing. */
#include "route/route_layers.h"

#include "base/core_error.h"
#include "geometry/geometry.h"
#include "sum/sum_layers.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The largest number of placements on a leg. Below it, the distance between placements is at most the smaller side of
 * the robot's box. */
static const double most_steps = 100;

typedef struct route_writer {
    gis_sink *sink;
    const gis_route_input *input;
    const sunder_route *route;
    double deviation;
} route_writer;

static bool add_layer(route_writer *w, const char *suffix, OGRwkbGeometryType type, const gis_field *fields,
                      size_t n_fields, gis_sink_layer **layer, gis_error *error)
{
    const gis_sink_layer_request request = {.suffix = suffix,
                                            .type = type,
                                            .crs = w->input->crs,
                                            .fields = fields,
                                            .n_fields = n_fields,
                                            .style = fields ? GIS_STYLE_NONE : GIS_STYLE_RESULT};
    return gis_sink_add(w->sink, &request, layer, error);
}

static bool route_vertex(route_writer *w, size_t i, double xy[2], gis_error *error)
{
    const char *text[2];
    sunder_route_vertex(w->route, i, xy);
    if (!isfinite(xy[0]) || !isfinite(xy[1]))
        return gis_fail(
            error,
            "the path leaves the range of doubles, so a layer cannot hold it; `sunder route --exact` gives it as JSON");
    sunder_route_vertex_text(w->route, i, &text[0], &text[1]);
    w->deviation = fmax(w->deviation, hypot(gis_text_deviation(text[0], xy[0]), gis_text_deviation(text[1], xy[1])));
    return true;
}

/* Writes a line for each leg. A route whose start and goal are equal has no leg. */
static bool write_legs(route_writer *w, gis_error *error)
{
    static const gis_field fields[] = {{"leg", OFTInteger64, 0}, {"len", OFTReal, 0}};
    gis_sink_layer *layer;
    if (!add_layer(w, "", wkbLineString, fields, 2, &layer, error)) return false;
    for (size_t i = 0; i + 1 < sunder_route_vertices(w->route); i++) {
        double from[2], to[2];
        if (!route_vertex(w, i, from, error) || !route_vertex(w, i + 1, to, error)) return false;
        const gis_value values[] = {{GIS_INTEGER, {.integer = (GIntBig)i + 1}},
                                    {GIS_REAL, {.real = hypot(to[0] - from[0], to[1] - from[1])}}};
        OGRGeometryH line = gis_geometry_line(from, to);
        if (!line) return gis_no_memory(error);
        if (!gis_sink_write(layer, NULL, line, values, error)) return false;
    }
    return true;
}

static bool write_placement(route_writer *w, gis_sink_layer *layer, size_t leg, double along, const double at[2],
                            gis_error *error)
{
    gis_polygons set = {0};
    bool ok = gis_polygons_append_shape(&set, w->input->robot, at[0], at[1], error);
    OGRGeometryH geometry = ok ? gis_geometry_polygons(&set, true) : NULL;
    gis_polygons_clear(&set);
    if (!ok) return false;
    if (!geometry) return gis_no_memory(error);
    const gis_value values[] = {{GIS_INTEGER, {.integer = (GIntBig)leg}}, {GIS_REAL, {.real = along}}};
    return gis_sink_write(layer, NULL, geometry, values, error);
}

static bool write_placements(route_writer *w, gis_error *error)
{
    static const gis_field fields[] = {{"leg", OFTInteger64, 0}, {"along", OFTReal, 0}};
    gis_sink_layer *layer;
    size_t n = sunder_route_vertices(w->route);
    double box[4], from[2], to[2], along = 0;
    if (!add_layer(w, "placements", wkbMultiPolygon, fields, 2, &layer, error)) return false;
    sunder_shape_box(w->input->robot, box);
    double step = fmin(box[2] - box[0], box[3] - box[1]);
    for (size_t i = 0; i + 1 < n; i++) {
        sunder_route_vertex(w->route, i, from);
        sunder_route_vertex(w->route, i + 1, to);
        double length = hypot(to[0] - from[0], to[1] - from[1]), steps = fmin(ceil(length / step), most_steps);
        steps = steps >= 1 ? steps : 1;
        for (double k = 0; k < steps; k++) {
            const double t = k / steps, at[2] = {from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])};
            if (!write_placement(w, layer, i + 1, along + t * length, at, error)) return false;
        }
        along += length;
    }
    if (n == 0) return true;
    sunder_route_vertex(w->route, n - 1, to);
    return write_placement(w, layer, n > 1 ? n - 1 : 0, along, to, error);
}

/* ---- Free space -------------------------------------------------------------------------------------------------- */

static void grow_box(double box[4], const double xy[2])
{
    for (int k = 0; k < 2; k++) {
        box[k] = fmin(box[k], xy[k]);
        box[k + 2] = fmax(box[k + 2], xy[k]);
    }
}

/* The margin of the frame is the larger side of its content divided by this, so that free space outside is visible. */
static const double margins_across = 10;

/* Sets `box` to the box of obstacles and route with a margin, limited to the range of doubles. */
static void frame_route(const route_writer *w, const gis_polygons *obstacles, double box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    for (size_t i = 0; i < obstacles->vertices; i++) grow_box(box, obstacles->xy + 2 * i);
    for (size_t i = 0; i < sunder_route_vertices(w->route); i++) {
        double xy[2];
        sunder_route_vertex(w->route, i, xy);
        grow_box(box, xy);
    }
    if (!(box[0] <= box[2])) box[0] = box[1] = box[2] = box[3] = 0;
    double robot[4];
    sunder_shape_box(w->input->robot, robot);
    const double size = fmax(box[2] - box[0], box[3] - box[1]);
    const double margin = size / margins_across + (robot[2] - robot[0]) + (robot[3] - robot[1]);
    for (int k = 0; k < 2; k++) {
        box[k] = fmax(box[k] - margin, -DBL_MAX);
        box[k + 2] = fmin(box[k + 2] + margin, DBL_MAX);
    }
}

/* Sets *out to the frame minus the obstacles. It is the even-odd set of the frame and all rings of the obstacles, since
 * the obstacles' interiors are disjoint. */
static bool free_space(const gis_polygons *obstacles, const double box[4], gis_polygons *out, gis_error *error)
{
    const double corner[4][2] = {{box[0], box[1]}, {box[2], box[1]}, {box[2], box[3]}, {box[0], box[3]}};
    gis_polygons all = {0};
    sunder_shape *shape = NULL;
    sunder_error why;
    bool ok = true;
    for (int i = 0; ok && i < 4; i++) ok = gis_polygons_vertex(&all, corner[i][0], corner[i][1], error);
    ok = ok && gis_polygons_end_ring(&all, error);
    for (size_t r = 0; ok && r < obstacles->rings; r++) {
        for (size_t v = r ? obstacles->ring_end[r - 1] : 0; ok && v < obstacles->ring_end[r]; v++)
            ok = gis_polygons_vertex(&all, obstacles->xy[2 * v], obstacles->xy[2 * v + 1], error);
        ok = ok && gis_polygons_end_ring(&all, error);
    }
    ok = ok && gis_polygons_end_polygon(&all, error);
    if (ok && gis_polygons_shape(&all, SUNDER_VALIDITY_EVEN_ODD, &shape, &why) != SUNDER_OK)
        ok = gis_core_failed(error, "free space", &why);
    ok = ok && gis_polygons_append_shape(out, shape, 0, 0, error);
    sunder_shape_free(shape);
    gis_polygons_clear(&all);
    return ok;
}

static bool write_degenerate(route_writer *w, gis_error *error)
{
    const sunder_sum *sum = sunder_route_obstacles(w->route);
    sunder_sum_size size;
    gis_sink_layer *layer;
    sunder_sum_get_size(sum, &size);
    if (!add_layer(w, "degenerate_segments", wkbLineString, NULL, 0, &layer, error) ||
        !gis_write_sum_segments(layer, sum, size.degenerate_segments, &w->deviation, error))
        return false;
    return add_layer(w, "degenerate_points", wkbPoint, NULL, 0, &layer, error) &&
           gis_write_sum_points(layer, sum, size.degenerate_points, &w->deviation, error);
}

static bool write_spaces(route_writer *w, gis_error *error)
{
    gis_rounded rounded = {0};
    gis_polygons open = {0};
    double box[4];
    gis_sink_layer *layer;
    bool ok = gis_round_sum(sunder_route_obstacles(w->route), &rounded, error);
    if (ok) {
        frame_route(w, &rounded.set, box);
        ok = free_space(&rounded.set, box, &open, error) &&
             add_layer(w, "obstacles", wkbPolygon, NULL, 0, &layer, error) &&
             gis_write_polygons(layer, &rounded.set, NULL, error) &&
             add_layer(w, "free_space", wkbPolygon, NULL, 0, &layer, error) &&
             gis_write_polygons(layer, &open, NULL, error);
        w->deviation = fmax(w->deviation, rounded.deviation);
    }
    gis_polygons_clear(&open);
    gis_rounded_clear(&rounded);
    return ok && write_degenerate(w, error);
}

bool gis_write_route(gis_sink *sink, const gis_route_input *input, const sunder_route *route, double *deviation,
                     gis_error *error)
{
    route_writer w = {sink, input, route, 0};
    bool ok = write_legs(&w, error);
    if (ok && gis_sink_takes_more(sink)) {
        ok = write_placements(&w, error);
        if (ok && input->request->free_space) ok = write_spaces(&w, error);
    }
    *deviation = w.deviation;
    return ok;
}
