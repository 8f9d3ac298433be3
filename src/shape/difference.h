/* difference.h: what convex polygons leave of a shape. */
#ifndef SUNDER_I_DIFFERENCE_H
#define SUNDER_I_DIFFERENCE_H

#include "shape/shape.h"

/* Convex polygons, one after the other: their corners, counterclockwise. */
typedef struct sunder_i_cuts {
    double *xy;
    size_t corners, room;
    size_t *end; /* [n] index past the last corner of each */
    size_t n, end_room;
} sunder_i_cuts;

/* Sets *out to the largest polygon of what is left of the shape outside of the cuts, with corners that are doubles: a
 * corner on an edge of the shape is rounded to the nearest double that is not outside of this edge, any other corner to
 * the nearest double. So the result lies in the shape except where corners are within rounding of each other, which the
 * caller has to test. *out is NULL if nothing is left, or if the rounded rings are not valid. The shape's corners must
 * be doubles. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_shape_subtract(const sunder_shape *shape, const sunder_i_cuts *cuts, sunder_shape **out,
                                      sunder_error *err);

/* Replaces xy, a point near the line from a to b, by the nearest point of doubles on the line or, if there is none
 * near, by the nearest one that is not on its right. So two shapes that share a wall with doubles on it, such as one
 * along an axis, get the same corner. Returns false if there is neither. */
bool sunder_i_round_inward(const double *a, const double *b, double xy[2]);

#endif
