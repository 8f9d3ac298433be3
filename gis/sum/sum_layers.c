/* sum_layers.c: writes the layers of a sum: a feature for each polygon, degenerate segments, and degenerate points.
 * Polygons are rounded so that they stay valid. The vertices of segments and points are rounded to the nearest doubles
 * and may coincide afterwards. */
#include "sum/sum_layers.h"

#include "geometry/geometry.h"

#include <math.h>

bool gis_write_polygons(gis_sink_layer *layer, const gis_polygons *set, const gis_value *values, gis_error *error)
{
    for (size_t p = 0; p < set->polygons; p++) {
        OGRGeometryH polygon = gis_geometry_polygon(set, p);
        if (!polygon) return gis_no_memory(error);
        if (!gis_sink_write(layer, NULL, polygon, values, error)) return false;
    }
    return true;
}

/* Rounds a vertex of the sum to doubles; *deviation is raised to the distance from its exact position. Fails if a
 * coordinate exceeds the range of doubles. */
static bool to_doubles(const sunder_sum *sum, uint32_t vertex, double xy[2], double *deviation, gis_error *error)
{
    double here;
    if (!gis_vertex_deviation(sum, vertex, &here, error)) return false;
    if (!isfinite(here))
        return gis_fail(error, "the sum leaves the range of doubles; `sunder sum --exact` gives it as JSON");
    *deviation = fmax(*deviation, here);
    sunder_sum_vertex(sum, vertex, xy);
    return true;
}

bool gis_write_sum_segments(gis_sink_layer *layer, const sunder_sum *sum, size_t n, double *deviation, gis_error *error)
{
    for (size_t i = 0; i < n; i++) {
        uint32_t ends[2];
        double from[2], to[2];
        sunder_sum_segment(sum, i, ends);
        if (!to_doubles(sum, ends[0], from, deviation, error) || !to_doubles(sum, ends[1], to, deviation, error))
            return false;
        OGRGeometryH line = gis_geometry_line(from, to);
        if (!line) return gis_no_memory(error);
        if (!gis_sink_write(layer, NULL, line, NULL, error)) return false;
    }
    return true;
}

bool gis_write_sum_points(gis_sink_layer *layer, const sunder_sum *sum, size_t n, double *deviation, gis_error *error)
{
    for (size_t i = 0; i < n; i++) {
        double xy[2];
        if (!to_doubles(sum, sunder_sum_point(sum, i), xy, deviation, error)) return false;
        OGRGeometryH point = gis_geometry_point(xy);
        if (!point) return gis_no_memory(error);
        if (!gis_sink_write(layer, NULL, point, NULL, error)) return false;
    }
    return true;
}

bool gis_write_sum(gis_sink *sink, const sunder_sum *sum, OGRSpatialReferenceH crs, double *deviation, gis_error *error)
{
    gis_rounded rounded = {0};
    sunder_sum_size size;
    sunder_sum_get_size(sum, &size);
    gis_sink_layer_request request = {.suffix = "", .type = wkbPolygon, .crs = crs, .style = GIS_STYLE_RESULT};
    gis_sink_layer *layer;
    bool ok = gis_round_sum(sum, &rounded, error) && gis_sink_add(sink, &request, &layer, error) &&
              gis_write_polygons(layer, &rounded.set, NULL, error);
    if (ok && gis_sink_takes_more(sink)) {
        request.suffix = "degenerate_segments";
        request.type = wkbLineString;
        ok = gis_sink_add(sink, &request, &layer, error) &&
             gis_write_sum_segments(layer, sum, size.degenerate_segments, &rounded.deviation, error);
    }
    if (ok && gis_sink_takes_more(sink)) {
        request.suffix = "degenerate_points";
        request.type = wkbPoint;
        ok = gis_sink_add(sink, &request, &layer, error) &&
             gis_write_sum_points(layer, sum, size.degenerate_points, &rounded.deviation, error);
    }
    *deviation = rounded.deviation;
    gis_rounded_clear(&rounded);
    return ok;
}
