/* The interior cover of a set: convex pieces whose interiors cover its whole interior, needed against things without
 * area; see interior_cover.c. */
#ifndef SUNDER_I_SEAMLESS_H
#define SUNDER_I_SEAMLESS_H

#include "shape/shape.h"

typedef struct sunder_i_interior_cover {
    sunder_shape *shape; /* owned: a shape with these pieces; NULL: the pieces of the set itself have the property */
    sunder_shape *whole; /* owned: the union of the members, from which some of these pieces are taken; or NULL */
    double *corner;      /* owned: the corners of the quadrilaterals */
} sunder_i_interior_cover;

/* Makes the interior cover of a shape. The shape is borrowed and has to outlive *out. After a failure, too, the caller
 * frees *out by sunder_i_interior_cover_free(). */
sunder_status sunder_i_interior_cover_make(const sunder_shape *shape, sunder_i_interior_cover *out, sunder_error *err);
/* A quadrilateral that covers a diagonal, counter-clockwise, and the vertices from which it is recomputed: the ends of
 * the diagonal and the corners beside it, as in sunder_i_diagonals. */
typedef struct sunder_i_diagonal_cover {
    double corner[8];
    uint32_t diagonal[4];
} sunder_i_diagonal_cover;

/* Finds the quadrilaterals around the diagonals of a shape. Sets *diagonal_cover to an array of *n, which the caller
 * frees. Diagonals without one are left out. Returns false if memory is out. */
bool sunder_i_diagonal_covers_find(const sunder_shape *shape, sunder_i_diagonal_cover **diagonal_cover, size_t *n);
/* Recomputes the corners of a quadrilateral from the vertices in sunder_i_diagonal_cover.diagonal. */
void sunder_i_diagonal_cover_corners(const sunder_shape *shape, const uint32_t diagonal[4], double corner[8]);
/* Makes a quadrilateral around a segment uv that two convex pieces share. corner: u, a corner of the piece on its
 * right, v, and a corner of the piece on its left. Returns false if no doubles make one. */
bool sunder_i_cover_shared_segment(const double corner[8], double out[8]);
void sunder_i_interior_cover_free(sunder_i_interior_cover *interior_cover);

#endif
