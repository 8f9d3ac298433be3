/* polygons.h: rings of a polygonal set that grows, in plain arrays. */
#ifndef GIS_POLYGONS_H
#define GIS_POLYGONS_H

#include "base/gis_error.h"
#include "sunder.h"

/* Laid out for sunder_shape_from_rings(). Start zeroed. */
typedef struct gis_polygons {
    double *xy;
    size_t *ring_end, *poly_end;
    size_t vertices, rings, polygons;
    size_t xy_capacity, ring_capacity, poly_capacity;
} gis_polygons;

void gis_polygons_clear(gis_polygons *set);
/* Reserves room for `vertices` further vertices. */
bool gis_polygons_reserve(gis_polygons *set, size_t vertices, gis_error *error);
bool gis_polygons_vertex(gis_polygons *set, double x, double y, gis_error *error);
bool gis_polygons_end_ring(gis_polygons *set, gis_error *error);
/* The same of a ring whose first vertex may stand at its end once more, to the bit: that one is taken back. Shapes keep
 * what they are given, and it would be kept with millions of rings. */
bool gis_polygons_end_closed_ring(gis_polygons *set, gis_error *error);
bool gis_polygons_end_polygon(gis_polygons *set, gis_error *error);
/* Rings [first, last) of another set, as one polygon; one polygon of it; all of it. */
bool gis_polygons_append(gis_polygons *set, const gis_polygons *from, size_t first, size_t last, gis_error *error);
bool gis_polygons_append_one(gis_polygons *set, const gis_polygons *from, size_t polygon, gis_error *error);
bool gis_polygons_append_all(gis_polygons *set, const gis_polygons *from, gis_error *error);
/* The polygons of a shape, each coordinate plus (dx, dy), rounded to the nearest double. */
bool gis_polygons_append_shape(gis_polygons *set, const sunder_shape *shape, double dx, double dy, gis_error *error);

/* Turns rings so that outer ones run counter-clockwise and holes clockwise; each starts where it did. */
void gis_polygons_wind(gis_polygons *set);

/* Outer rings less holes, whichever way they run; for polygons that do not overlap the area that they cover. Off by
 * no more than a few rounding errors of what its rings enclose. Infinite beyond the range of doubles. */
double gis_polygons_area(const gis_polygons *set);

/* sunder_shape_from_rings() of them. */
sunder_status gis_polygons_shape(const gis_polygons *set, sunder_validity validity, sunder_shape **out,
                                 sunder_error *why);

#endif
