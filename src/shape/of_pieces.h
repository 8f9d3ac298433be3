/* Convex pieces as a shape of their own: some of another shape's, segments, points. */
#ifndef SUNDER_I_OF_PIECES_H
#define SUNDER_I_OF_PIECES_H

#include "shape/shape.h"

/* A convex piece: one of a shape, or n points, one after the other, counter-clockwise and strictly convex: of two a
 * segment, of one a point. */
typedef struct sunder_i_piece_of {
    const sunder_shape *shape; /* NULL: points */
    uint32_t piece;
    uint32_t n;
    const double *xy;
} sunder_i_piece_of;

/* The union of n pieces, which are borrowed as long as it lives. It is for separation/ alone: it has no raw rings. */
sunder_status sunder_i_shape_of_pieces(const sunder_i_piece_of *piece, size_t n, sunder_shape **out, sunder_error *err);
/* Has one an area? Its box. */
bool sunder_i_piece_has_area(const sunder_i_piece_of *piece);
void sunder_i_piece_box(const sunder_i_piece_of *piece, double box[4]);

#endif
