/* Convex pieces whose interiors cover the interior of a set, as what has no area asks for; see seamless.c. */
#ifndef SUNDER_I_SEAMLESS_H
#define SUNDER_I_SEAMLESS_H

#include "shape/shape.h"

typedef struct sunder_i_seamless {
    sunder_shape *shape; /* NULL: the set's own pieces do */
    sunder_shape *whole; /* what some of its pieces are borrowed from, or NULL */
    double *corner;      /* ... and others */
} sunder_i_seamless;

/* Of a shape, which is borrowed. Failure leaves what sunder_i_seamless_free() takes. */
sunder_status sunder_i_seamless_make(const sunder_shape *shape, sunder_i_seamless *out, sunder_error *err);
/* The quadrilaterals alone that cover the shape's diagonals, *n of them: 8 doubles each, counter-clockwise, in *corner,
 * which is the caller's. False if memory is out. */
bool sunder_i_seams_find(const sunder_shape *shape, double **corner, size_t *n);
/* One about a segment uv that two convex pieces share: corner has u, a corner of the piece on its right, v, and one of
 * the piece on its left. False if no doubles make one. */
bool sunder_i_seam_between(const double corner[8], double out[8]);
void sunder_i_seamless_free(sunder_i_seamless *seamless);

#endif
