/* geometry.h: OGR geometries to and from the plain arrays of the core, and moving an OGR geometry in place. */
#ifndef GIS_GEOMETRY_H
#define GIS_GEOMETRY_H

#include <ogr_api.h>

#include "geometry/polygons.h"

/* The polygons of a geometry; lines and points beside them are left out. A zeroed struct is empty; it can be filled
 * again and again and keeps its memory until gis_polygonal_part_clear(). */
typedef struct gis_polygonal_part {
    gis_polygons set;
    /* > 0 if arcs were replaced by chords: no point of a true arc is farther than this from the chords. So the true
     * polygons lie in the Minkowski sum of the polygons given and a disc of this radius; grow them by it (or by
     * sunder_shape_disc(linearised, n, false, ...)) before anything is proved of them. 0: no arcs. */
    double linearised;
} gis_polygonal_part;

typedef enum gis_content {
    GIS_NOTHING,  /* null or empty */
    GIS_POLYGONS, /* at least one polygon, alone or in a collection, curved ones, triangles and surfaces included */
    GIS_POINTS,   /* points, and no polygon and no line */
    GIS_OTHER,    /* lines, or a mixture without polygons */
    GIS_BROKEN    /* a coordinate is not finite; set by gis_source_content() only */
} gis_content;
enum { GIS_CONTENTS = GIS_BROKEN + 1 };

/* What a geometry (NULL is fine) holds. */
gis_content gis_geometry_content(OGRGeometryH geometry);

/* Takes the polygons out of a geometry of any kind (NULL: none), in the order in which it holds them; Z and M are
 * ignored, arcs linearised by GDAL (its default step). Coordinates are copied as they are, also such as are
 * not finite. Fails where memory is out or GDAL cannot linearise. */
bool gis_geometry_polygonal_part(OGRGeometryH geometry, gis_polygonal_part *part, gis_error *error);
void gis_polygonal_part_clear(gis_polygonal_part *part);

/* All vertices of a geometry of any kind (of arcs the control points; of a MultiPoint its points) in the order in which
 * it holds them: *n pairs in *xy, freed with CPLFree(). */
bool gis_geometry_points(OGRGeometryH geometry, double **xy, size_t *n, gis_error *error);

/* Is every X and Y of the geometry (control points of arcs included) a finite number? NULL and empty: yes. */
bool gis_geometry_is_finite(OGRGeometryH geometry);

/* Adds (dx, dy) to every vertex, in place: x becomes the double nearest to x + dx. Z and M stay; so do ring order,
 * orientation and start, arcs (their control points move) and the kind of geometry. dx == dy == 0 changes nothing at
 * all. False only where memory is out. */
bool gis_geometry_translate(OGRGeometryH geometry, double dx, double dy, gis_error *error);

/* Turns the rings of all polygons (not curved ones) so that outer rings run clockwise and holes counter-clockwise, as
 * Shapefiles want them; the direction is taken at the lowest vertex, exactly. Z and M go along. */
bool gis_geometry_wind_clockwise(OGRGeometryH geometry, gis_error *error);

/* New geometries for layers that the program makes; the caller owns them (gis_sink_write takes them over). NULL if
 * memory is out. A polygon set is a Polygon if it has one member and `multi` is false, else a MultiPolygon; rings may
 * lack the closing vertex. A line from == to is a line of two equal points. */
OGRGeometryH gis_geometry_line(const double from[2], const double to[2]);
OGRGeometryH gis_geometry_point(const double xy[2]);
OGRGeometryH gis_geometry_polygons(const gis_polygons *set, bool multi);
/* One polygon of a set. */
OGRGeometryH gis_geometry_polygon(const gis_polygons *set, size_t p);

#endif
