/* Convex pieces whose interiors cover the interior of a set, as needed against things without area; see seamless.c. */
#ifndef SUNDER_I_SEAMLESS_H
#define SUNDER_I_SEAMLESS_H

#include "shape/shape.h"

typedef struct sunder_i_seamless {
    sunder_shape *shape; /* owned, with such pieces; NULL: the pieces of the set itself are such */
    sunder_shape *whole; /* owned: the shape that has some of these pieces, or NULL */
    double *corner;      /* owned: the corners of the other ones */
} sunder_i_seamless;

/* Makes such pieces for a shape. The shape is borrowed and has to outlive *out. On failure, too, the caller frees
 * *out with sunder_i_seamless_free(). */
sunder_status sunder_i_seamless_make(const sunder_shape *shape, sunder_i_seamless *out, sunder_error *err);
/* A quadrilateral that covers a diagonal, counter-clockwise; and that by which it is found again: the numbers of the
 * diagonal's ends and of the corners beside it, as sunder_i_diagonals has them. */
typedef struct sunder_i_seam {
    double corner[8];
    uint32_t diagonal[4];
} sunder_i_seam;

/* Those alone, of all diagonals that have one, *n of them in *seam, which is the caller's. False if memory is out. */
bool sunder_i_seams_find(const sunder_shape *shape, sunder_i_seam **seam, size_t *n);
/* The corners of one of these pieces. */
void sunder_i_seam_again(const sunder_shape *shape, const uint32_t diagonal[4], double corner[8]);
/* One about a segment uv that two convex pieces share: corner has u, a corner of the piece on its right, v, and one of
 * the piece on its left. False if no doubles make one. */
bool sunder_i_seam_between(const double corner[8], double out[8]);
void sunder_i_seamless_free(sunder_i_seamless *seamless);

#endif
