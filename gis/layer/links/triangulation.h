/* triangulation.h: the Delaunay triangulation of points with small integer coordinates. All decisions are exact. */
#ifndef GIS_TRIANGULATION_H
#define GIS_TRIANGULATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The coordinates of points are in 0 ... GIS_GRID_CELLS, those of places that are looked for within four times that of
 * the origin. */
#define GIS_GRID_CELLS (INT64_C(1) << 30)

typedef struct gis_grid_point {
    int64_t x, y;
} gis_grid_point;

/* A triangle, counter-clockwise. beyond[k] is the one across the edge that corner k is not on, GIS_NO_TRIANGLE if there
 * is none. */
typedef struct gis_triangle {
    size_t corner[3], beyond[3];
} gis_triangle;
#define GIS_NO_TRIANGLE SIZE_MAX

typedef struct gis_triangulation {
    const gis_grid_point *point; /* [n] borrowed */
    size_t n;
    gis_triangle *triangle; /* [triangles]; there are none if all points are on one line */
    size_t triangles;
    size_t *rim; /* [rims] the points on the boundary, counter-clockwise; if there are no triangles, along the line */
    size_t rims;
} gis_triangulation;

/* Triangulates n >= 1 points, which are sorted by x, then y, and different. Of four points on an empty circle the
 * diagonal depends on this order alone. Returns false if out of memory; clear *out in any case.
 *
 * Cost    O(n log n) for points of a map, O(n^2) at worst.
 * Source  sweep with Lawson's flips: C. L. Lawson, Software for C1 surface interpolation, 1977. */
bool gis_triangulate(const gis_grid_point *point, size_t n, gis_triangulation *out);
void gis_triangulation_clear(gis_triangulation *triangulation);

/* Returns a triangle that contains p, GIS_NO_TRIANGLE if none does. *hint: where the search begins, and begins next. */
size_t gis_triangulation_locate(const gis_triangulation *triangulation, gis_grid_point p, size_t *hint);
/* Twice the area of the triangle abc, positive if it is counter-clockwise; rounded once. */
double gis_grid_area(gis_grid_point a, gis_grid_point b, gis_grid_point c);

#endif
