/* wkt.h: POLYGON and MULTIPOLYGON texts into plain arrays. Decimals become the nearest doubles, whatever their length;
 * Z and M are read and dropped; EMPTY is the empty set. Other types, and anything else, are errors that name the place.
 */
#ifndef GIS_WKT_H
#define GIS_WKT_H

#include "error.h"

/* Rings of a polygonal set that grows, laid out for sunder_shape_from_rings(). Start zeroed. */
typedef struct gis_polygons {
    double *xy;
    size_t *ring_end, *poly_end;
    size_t vertices, rings, polygons;
    size_t xy_capacity, ring_capacity, poly_capacity;
} gis_polygons;

void gis_polygons_clear(gis_polygons *set);
bool gis_polygons_vertex(gis_polygons *set, double x, double y, gis_error *error);
bool gis_polygons_end_ring(gis_polygons *set, gis_error *error);
bool gis_polygons_end_polygon(gis_polygons *set, gis_error *error);

/* Does the text begin as WKT does: a word, then Z, M, EMPTY or a bracket? */
bool gis_wkt_looks_like(const char *text);

/* Appends the polygons of the text. `who` opens the message of a failure. */
bool gis_wkt_read(const char *text, const char *who, gis_polygons *out, gis_error *error);

#endif
