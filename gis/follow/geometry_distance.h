/* geometry_distance.h: how far a geometry is from a shape, or from points, in doubles. */
#ifndef GIS_FOLLOW_GEOMETRY_DISTANCE_H
#define GIS_FOLLOW_GEOMETRY_DISTANCE_H

#include <ogr_api.h>

#include "sunder.h"

/* The distance of the vertices and lines of a geometry, rings included, from a shape; 0 if they meet. */
double gis_follow_distance(OGRGeometryH geometry, const sunder_shape *shape);
/* The distance of the vertices and lines of a geometry from the nearest of n points. */
double gis_follow_distance_to_points(OGRGeometryH geometry, const double *point, size_t n);

#endif
