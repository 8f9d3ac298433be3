/* gis_box.h: boxes as xmin, ymin, xmax, ymax. An empty box has xmin > xmax. */
#ifndef GIS_GEOMETRY_BOX_H
#define GIS_GEOMETRY_BOX_H

#include <math.h>
#include <stdbool.h>

static inline void gis_box_clear(double box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
}

static inline bool gis_box_is_empty(const double box[4]) { return !(box[0] <= box[2]); }

/* Enlarges the box so that it contains the other one. */
static inline void gis_box_join(double box[4], const double other[4])
{
    if (gis_box_is_empty(other)) return;
    for (int k = 0; k < 2; k++) {
        box[k] = fmin(box[k], other[k]);
        box[k + 2] = fmax(box[k + 2], other[k + 2]);
    }
}

/* Sets `out` to the box enlarged by `by` on all sides, rounded outward by more than the error of the sums. */
static inline void gis_box_grow(const double box[4], double by, double out[4])
{
    for (int k = 0; k < 4; k++) {
        const double to = k < 2 ? -INFINITY : INFINITY;
        out[k] = nextafter(nextafter(box[k] + (k < 2 ? -by : by), to), to);
    }
}

/* Do the boxes have a point in common? */
static inline bool gis_box_meets(const double a[4], const double b[4])
{
    return a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];
}

#endif
