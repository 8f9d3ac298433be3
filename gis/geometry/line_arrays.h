/* line_arrays.h: the lines and points of geometries as plain arrays. */
#ifndef GIS_LINE_ARRAYS_H
#define GIS_LINE_ARRAYS_H

#include <ogr_api.h>
#include <stdbool.h>

#include "base/gis_error.h"

/* Points of lines, laid out as in sunder_obstacle; start from a zeroed struct. */
typedef struct gis_lines {
    double *xy;
    size_t *end; /* [lines] index past the last point of each line */
    size_t points, lines, xy_capacity, end_capacity;
} gis_lines;

void gis_lines_clear(gis_lines *lines);
/* Appends the lines and points of a geometry of any kind, without its polygons; *arcs is set if arcs were replaced by
 * polylines. */
bool gis_lines_append(OGRGeometryH geometry, gis_lines *out, bool *arcs, gis_error *error);
/* Appends the rings of its polygons as lines. */
bool gis_lines_append_rings(OGRGeometryH geometry, gis_lines *out, bool *arcs, gis_error *error);

#endif
