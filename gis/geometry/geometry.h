/* geometry.h: converts OGR geometries to and from the core's plain arrays, and translates OGR geometries in place. */
#ifndef GIS_GEOMETRY_H
#define GIS_GEOMETRY_H

#include <ogr_api.h>

#include "geometry/polygons.h"

/* The polygons of a geometry, without its lines and points. A zeroed struct is empty; it may be filled repeatedly, and
 * keeps its memory until gis_polygonal_part_clear(). */
typedef struct gis_polygonal_part {
    gis_polygons set;
    /* > 0 if arcs were replaced by chords: no point of a true arc is farther than this from the chords. So the true
     * polygons lie within the Minkowski sum of the given polygons and a disc of this radius; enlarge them by it (for
     * example by sunder_shape_disc(linearised, n, false, ...)) before anything is proved about them. 0: there were no
     * arcs. */
    double linearised;
} gis_polygonal_part;

typedef enum gis_content {
    GIS_NOTHING,  /* null or empty */
    GIS_POLYGONS, /* at least one polygon, possibly in a collection; curved polygons, triangles and surfaces count */
    GIS_POINTS,   /* points, without polygons and lines */
    GIS_OTHER,    /* lines, or a mixture without polygons */
    GIS_BROKEN    /* a coordinate is not finite; only gis_source_content() returns this */
} gis_content;
enum { GIS_CONTENTS = GIS_BROKEN + 1 };

/* Returns the kind of content of a geometry; NULL is allowed. */
gis_content gis_geometry_content(OGRGeometryH geometry);

/* Extracts the polygons of a geometry of any kind (NULL: none), in their order; Z and M are ignored, and arcs are
 * linearised by GDAL with its default step. Coordinates are copied without change, even if they are not finite. Fails
 * if out of memory or GDAL cannot linearise an arc. */
bool gis_geometry_polygonal_part(OGRGeometryH geometry, gis_polygonal_part *part, gis_error *error);
void gis_polygonal_part_clear(gis_polygonal_part *part);

/* Gets all vertices of a geometry of any kind (control points of arcs; points of a MultiPoint) in their order: *n pairs
 * in *xy, to be freed with CPLFree(). */
bool gis_geometry_points(OGRGeometryH geometry, double **xy, size_t *n, gis_error *error);

/* Returns true if all X and Y of the geometry, including control points of arcs, are finite; also for NULL and empty
 * geometries. */
bool gis_geometry_is_finite(OGRGeometryH geometry);

/* Adds (dx, dy) to every vertex, in place: x becomes the double nearest to x + dx. Z and M do not change, nor do the
 * order, orientation and start of rings, arcs (their control points move) and the type. dx == dy == 0 changes nothing.
 * Fails only if out of memory. */
bool gis_geometry_translate(OGRGeometryH geometry, double dx, double dy, gis_error *error);

/* Changes every vertex and control point in place: calls change(user, xy), which sets its new X and Y, for each in
 * order; equal vertices have to become equal ones, so that rings stay closed. All else stays as for a translation.
 * Stops at a failure of `change`. */
typedef bool gis_vertex_change(void *user, double xy[2], gis_error *error);
bool gis_geometry_change(OGRGeometryH geometry, gis_vertex_change *change, void *user, gis_error *error);

/* Orients the rings of all polygons (except curved ones) as Shapefiles require: outer rings clockwise, holes
 * counter-clockwise. The orientation is determined exactly, at the lowest vertex. Z and M are kept. */
bool gis_geometry_wind_clockwise(OGRGeometryH geometry, gis_error *error);

/* Make new geometries, which the caller owns (gis_sink_write() takes them over). Return NULL if out of memory. A set
 * becomes a Polygon if it has one polygon and `multi` is false, else a MultiPolygon; rings may lack the closing vertex.
 * A line with from == to has two equal points. */
OGRGeometryH gis_geometry_line(const double from[2], const double to[2]);
OGRGeometryH gis_geometry_point(const double xy[2]);
OGRGeometryH gis_geometry_polygons(const gis_polygons *set, bool multi);
/* Makes a Polygon of polygon p of a set. */
OGRGeometryH gis_geometry_polygon(const gis_polygons *set, size_t p);

#endif
