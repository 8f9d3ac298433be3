/* line_arrays.c: see line_arrays.h. The functions recurse on the nesting of collections, which GDAL's readers limit. */
#include "geometry/line_arrays.h"

#include "base/array.h"

#include <stdlib.h>

void gis_lines_clear(gis_lines *lines)
{
    free(lines->xy);
    free(lines->end);
    *lines = (gis_lines){0};
}

static bool is_polygon(OGRwkbGeometryType flat)
{
    return flat == wkbPolygon || flat == wkbCurvePolygon || flat == wkbTriangle;
}

/* Appends a point, or a line with vertices of its own; a ring counts as a line. */
static bool append_points(OGRGeometryH line, gis_lines *out, gis_error *error)
{
    int n = OGR_G_GetPointCount(line);
    if (n <= 0) return true;
    if (!gis_array_reserve(&out->xy, &out->xy_capacity, 2 * (out->points + (size_t)n), sizeof *out->xy) ||
        !gis_array_reserve(&out->end, &out->end_capacity, out->lines + 1, sizeof *out->end))
        return gis_no_memory(error);
    double *to = out->xy + 2 * out->points;
    OGR_G_GetPoints(line, to, 2 * (int)sizeof *to, to + 1, 2 * (int)sizeof *to, NULL, 0);
    out->points += (size_t)n;
    out->end[out->lines++] = out->points;
    return true;
}

/* Appends a point or line; arcs become the polylines that GDAL makes of them. */
static bool append_linear(OGRGeometryH line, gis_lines *out, bool *arcs, gis_error *error)
{
    if (!OGR_G_HasCurveGeometry(line, TRUE)) return append_points(line, out, error);
    OGRGeometryH linear = OGR_G_GetLinearGeometry(line, 0, NULL);
    *arcs = true;
    bool ok = linear ? append_points(linear, out, error) : gis_fail(error, "GDAL cannot linearise an arc");
    OGR_G_DestroyGeometry(linear);
    return ok;
}

/* Appends a ring, and its first vertex once more if the ring is not closed. */
static bool append_ring(OGRGeometryH ring, gis_lines *out, bool *arcs, gis_error *error)
{
    const size_t lines = out->lines, first = 2 * out->points;
    if (!append_linear(ring, out, arcs, error)) return false;
    if (out->lines == lines) return true;
    const size_t last = 2 * (out->points - 1);
    if (out->xy[first] == out->xy[last] && out->xy[first + 1] == out->xy[last + 1]) return true;
    if (!gis_array_reserve(&out->xy, &out->xy_capacity, last + 4, sizeof *out->xy)) return gis_no_memory(error);
    out->xy[last + 2] = out->xy[first];
    out->xy[last + 3] = out->xy[first + 1];
    out->end[lines] = ++out->points;
    return true;
}

/* rings = false: appends all points and lines; true: the rings of all polygons. */
static bool append_lines(OGRGeometryH geometry, bool rings, gis_lines *out, bool *arcs, gis_error *error)
{
    if (OGR_G_IsEmpty(geometry)) return true;
    OGRwkbGeometryType flat = wkbFlatten(OGR_G_GetGeometryType(geometry));
    bool polygon = is_polygon(flat), whole = true;
    if (flat == wkbPoint || flat == wkbLineString || flat == wkbCircularString || flat == wkbCompoundCurve)
        return rings || append_linear(geometry, out, arcs, error);
    if (polygon && !rings) return true;
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry) && whole; i++) {
        OGRGeometryH part = OGR_G_GetGeometryRef(geometry, i);
        whole = polygon ? append_ring(part, out, arcs, error) : append_lines(part, rings, out, arcs, error);
    }
    return whole;
}

bool gis_lines_append(OGRGeometryH geometry, gis_lines *out, bool *arcs, gis_error *error)
{
    return append_lines(geometry, false, out, arcs, error);
}

bool gis_lines_append_rings(OGRGeometryH geometry, gis_lines *out, bool *arcs, gis_error *error)
{
    return append_lines(geometry, true, out, arcs, error);
}
