/* contour.h: the contour of a union of open rectangles along the lines of one axis. Internal to this folder. */
#ifndef SUNDER_I_CONTOUR_H
#define SUNDER_I_CONTOUR_H

#include "rectilinear/rectangles.h"

/* A stretch of a line that no rectangle covers (its ends may be covered), with rectangles before it, after it, or both,
 * along the axis perpendicular to the line. */
typedef struct sunder_i_contour_stretch {
    uint32_t line;     /* the rank along the axis perpendicular to the line */
    uint32_t from, to; /* ranks along the line, from < to */
    uint32_t sides;    /* the covered sides: SUNDER_I_COVERED_BEFORE, SUNDER_I_COVERED_AFTER */
} sunder_i_contour_stretch;

enum { SUNDER_I_COVERED_BEFORE = 1, SUNDER_I_COVERED_AFTER = 2 };

/* A point that no rectangle covers, while all points around it are covered. */
typedef struct sunder_i_contour_point {
    uint32_t line, at;
} sunder_i_contour_point;

typedef struct sunder_i_contour {
    sunder_i_contour_stretch *stretch; /* sorted by line, and along each line; two that meet have different sides */
    size_t stretches, stretches_capacity;
    sunder_i_contour_point *point; /* sorted in the same way */
    size_t points, points_capacity;
} sunder_i_contour;

/* *out becomes the contour on the lines perpendicular to the axis: lines of constant x for axis 0, of constant y for
 * axis 1. Returns false if out of memory. */
bool sunder_i_contour_find(const sunder_i_ranked_rectangles *rectangles, int axis, sunder_i_contour *out);
void sunder_i_contour_free(sunder_i_contour *contour);

#endif
