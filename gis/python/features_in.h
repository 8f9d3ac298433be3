/* features_in.h: geometries of Python as plain arrays.
 *
 * A geometry is one of: None; bytes of well-known binary (ISO or extended); an object with `wkb` (Shapely's) or
 * `__geo_interface__`; a mapping as in GeoJSON; an array of the shape (n, 2), which is one ring; a sequence of pairs,
 * likewise; a sequence of rings in one of these forms: an outer ring and holes. Z and M are ignored. */
#ifndef GIS_PYTHON_FEATURES_IN_H
#define GIS_PYTHON_FEATURES_IN_H

#include "geometry/polygons.h"
#include "python/extension.h"

typedef enum gis_py_content { GIS_PY_NOTHING, GIS_PY_POLYGONS, GIS_PY_LINES, GIS_PY_POINTS } gis_py_content;

/* Geometries, one after the other. A zeroed struct is empty. */
typedef struct gis_py_features {
    gis_polygons areas; /* the polygons of all */
    gis_polygons lines; /* the lines and points of all: its rings; a line of one point is a point */
    size_t *area_end;   /* [n] index past the last polygon of each */
    size_t *line_end;   /* [n] index past the last line of each */
    bool *points;       /* [n] the lines are points, and there is nothing else */
    size_t n, area_capacity, line_capacity, points_capacity;
} gis_py_features;

/* Adds one geometry. `who` begins messages. False: ValueError or MemoryError is set. */
bool gis_py_features_add(gis_py_features *to, PyObject *geometry, const char *who);
/* Adds each item of a sequence or iterable; messages begin with "WHO i". */
bool gis_py_features_add_all(gis_py_features *to, PyObject *geometries, const char *who);
/* Adds geometries that are given as arrays: coordinates of the shape (n, 2), and offsets from 0 on (GeoArrow): those of
 * rings, of polygons and, unless None, of geometries. */
bool gis_py_features_add_ragged(gis_py_features *to, PyObject *coordinates, PyObject *rings, PyObject *polygons,
                                PyObject *geometries, const char *who);
gis_py_content gis_py_features_content(const gis_py_features *from, size_t i);
void gis_py_features_clear(gis_py_features *features);

/* ---- wkb_in.c: well-known binary --------------------------------------------------------------------------------- */

/* Adds the polygons, lines and points of one geometry. */
bool gis_py_wkb_add(gis_py_features *to, const unsigned char *bytes, size_t n, const char *who);
/* Adds (dx, dy) to each x and y in place, Z and M stay. The bytes have to be valid: gis_py_wkb_add() took them. */
void gis_py_wkb_move(unsigned char *bytes, size_t n, double dx, double dy);

/* ---- geojson_in.c: mappings and sequences ------------------------------------------------------------------------ */

/* Adds a mapping as in GeoJSON: a geometry, a feature, or a collection of these. */
bool gis_py_mapping_add(gis_py_features *to, PyObject *mapping, const char *who, int depth);
/* Adds a polygon given as a sequence of pairs, or of rings. */
bool gis_py_sequence_add(gis_py_features *to, PyObject *sequence, const char *who);

/* Ends a ring, a polygon, a line; false: MemoryError is set. */
bool gis_py_vertex(gis_polygons *to, double x, double y);
bool gis_py_end_ring(gis_py_features *to);
bool gis_py_end_polygon(gis_py_features *to);
bool gis_py_end_line(gis_py_features *to);

/* Geometries may contain each other no deeper than this. */
enum { GIS_PY_DEEPEST = 32 };

#endif
