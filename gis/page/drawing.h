/* drawing.h: converts shapes to SVG paths of a picture, and simplifies them. Results are for display only and are not
 * exact. */
#ifndef GIS_PAGE_DRAWING_H
#define GIS_PAGE_DRAWING_H

#include "base/gis_error.h"
#include "base/text.h"
#include "sunder.h"

/* A window of the map (minimum x, minimum y, maximum x, maximum y) as a picture with integer coordinates; the y axis of
 * the picture points down. */
typedef struct gis_picture {
    double window[4];
    int width, height;
} gis_picture;

/* Converts a point of the map to coordinates of the picture; points outside the window are converted, too. */
void gis_picture_place(const gis_picture *picture, double x, double y, double at[2]);
/* Converts a length of the map to units of the picture. */
double gis_picture_length(const gis_picture *picture, double length);

/* An array of vertices that is reused for many shapes. A zeroed struct is empty; clear it after use. */
typedef struct gis_corners {
    double *xy;
    size_t n, capacity; /* the capacity, in doubles */
} gis_corners;

void gis_corners_clear(gis_corners *corners);

/* Adds the data of an SVG path ("M12 30l4 0 0 5z", fill rule nonzero): the shape, translated by `move`, clipped by a
 * box slightly larger than the window, with coordinates rounded to units of the picture. Adds nothing if no ring meets
 * the box. */
bool gis_picture_add_shape(const gis_picture *picture, const sunder_shape *shape, const double move[2],
                           gis_corners *scratch, gis_text *to, gis_error *error);

/* Adds a polyline of n vertices in the same form; a polyline of one vertex is drawn as a point. Segments that lie far
 * outside the window are omitted. */
void gis_picture_add_line(const gis_picture *picture, const double *xy, size_t n, gis_text *to);

/* Simplifies a ring of n vertices: vertices are omitted while the result stays within the distance `tolerance` of the
 * ring [DP73]. The result is in corners->xy. It has at least three vertices, or none if the ring is too small. */
bool gis_corners_simplify(gis_corners *corners, const double *xy, size_t n, double tolerance, gis_error *error);
/* Simplifies a polyline in the same way; its ends are kept. */
bool gis_corners_simplify_line(gis_corners *corners, const double *xy, size_t n, double tolerance, gis_error *error);

#endif
