/* line_arrays.h: the lines and points of geometries, in plain arrays. */
#ifndef GIS_LINE_ARRAYS_H
#define GIS_LINE_ARRAYS_H

#include <ogr_api.h>
#include <stdbool.h>

#include "base/gis_error.h"

/* Laid out as those of sunder_obstacle. Start zeroed. */
typedef struct gis_lines {
    double *xy;
    size_t *end; /* index past the last point of each */
    size_t points, lines, xy_capacity, end_capacity;
} gis_lines;

void gis_lines_clear(gis_lines *lines);
/* The lines and points of a geometry of any kind, polygons left out; *arcs is set where arcs were taken as
 * polylines. */
bool gis_lines_append(OGRGeometryH geometry, gis_lines *out, bool *arcs, gis_error *error);
/* The rings of its polygons. */
bool gis_lines_append_rings(OGRGeometryH geometry, gis_lines *out, bool *arcs, gis_error *error);

#endif
