/* polygons.h: a growing polygonal set in plain arrays. */
#ifndef GIS_POLYGONS_H
#define GIS_POLYGONS_H

#include "base/gis_error.h"
#include "sunder.h"

/* The arrays are laid out for sunder_shape_from_rings(); start from a zeroed struct. */
typedef struct gis_polygons {
    double *xy;
    size_t *ring_end, *poly_end;
    size_t vertices, rings, polygons;
    size_t xy_capacity, ring_capacity, poly_capacity;
} gis_polygons;

void gis_polygons_clear(gis_polygons *set);
/* Reserves room for `vertices` more vertices. */
bool gis_polygons_reserve(gis_polygons *set, size_t vertices, gis_error *error);
bool gis_polygons_vertex(gis_polygons *set, double x, double y, gis_error *error);
bool gis_polygons_end_ring(gis_polygons *set, gis_error *error);
/* Ends a ring; if its last vertex equals its first, to the bit, the last one is dropped. Shapes keep the vertices they
 * are given, and so would keep the duplicates of millions of rings. */
bool gis_polygons_end_closed_ring(gis_polygons *set, gis_error *error);
bool gis_polygons_end_polygon(gis_polygons *set, gis_error *error);
/* Append, as one polygon, the rings first ... last - 1 of another set; one polygon of it; all its polygons. */
bool gis_polygons_append(gis_polygons *set, const gis_polygons *from, size_t first, size_t last, gis_error *error);
bool gis_polygons_append_one(gis_polygons *set, const gis_polygons *from, size_t polygon, gis_error *error);
bool gis_polygons_append_all(gis_polygons *set, const gis_polygons *from, gis_error *error);
/* Appends the polygons of a shape, with (dx, dy) added to each vertex and the sums rounded to the nearest doubles. */
bool gis_polygons_append_shape(gis_polygons *set, const sunder_shape *shape, double dx, double dy, gis_error *error);

/* Orients rings: outer ones counter-clockwise, holes clockwise. The first vertex of each ring stays the first. */
void gis_polygons_wind(gis_polygons *set);

/* The area: outer rings minus holes, whatever their orientation; for polygons that do not overlap, the area covered.
 * The error is at most a few rounding errors of the areas enclosed by rings. Infinite beyond the range of doubles. */
double gis_polygons_area(const gis_polygons *set);

/* Makes a shape of the set with sunder_shape_from_rings(). */
sunder_status gis_polygons_shape(const gis_polygons *set, sunder_validity validity, sunder_shape **out,
                                 sunder_error *why);

#endif
