/* drawing.h: shapes as paths of a picture, and with fewer corners. For eyes alone: nothing is decided here. */
#ifndef GIS_REPORT_DRAWING_H
#define GIS_REPORT_DRAWING_H

#include "base/gis_error.h"
#include "base/text.h"
#include "sunder.h"

/* A window of the map as a picture of whole units, y downwards. */
typedef struct gis_picture {
    double window[4];
    int width, height;
} gis_picture;

/* A place of the map in the picture; beyond it where it lies outside of the window. */
void gis_picture_place(const gis_picture *picture, double x, double y, double at[2]);
/* How long a length of the map is in it. */
double gis_picture_length(const gis_picture *picture, double length);

/* Room for corners on their way, kept from one shape to the next. Start zeroed; clear at the end. */
typedef struct gis_corners {
    double *xy;
    size_t n, capacity; /* in doubles */
} gis_corners;

void gis_corners_clear(gis_corners *corners);

/* The shape, moved, as data of an SVG path ("M12 30l4 0 0 5z"), for the fill rule nonzero: cut off just outside of the
 * window, corners rounded to the picture's units. Adds nothing where nothing is to be seen. */
bool gis_picture_add_shape(const gis_picture *picture, const sunder_shape *shape, const double move[2],
                           gis_corners *scratch, gis_text *to, gis_error *error);

/* A line likewise; a line of one point is a point. Pieces of it that lie well outside are left out. */
void gis_picture_add_line(const gis_picture *picture, const double *xy, size_t n, gis_text *to);

/* A ring (n corners) without those that are not needed to stay within `tolerance` of it [DP73]; at least three stay,
 * unless all of it is that small: then none. The result is in corners->xy. */
bool gis_corners_simplify(gis_corners *corners, const double *xy, size_t n, double tolerance, gis_error *error);
/* A line likewise: its ends stay. */
bool gis_corners_simplify_line(gis_corners *corners, const double *xy, size_t n, double tolerance, gis_error *error);

#endif
