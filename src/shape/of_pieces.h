/* of_pieces.h: convex pieces as a shape: some pieces of another shape, segments, points. */
#ifndef SUNDER_I_OF_PIECES_H
#define SUNDER_I_OF_PIECES_H

#include "shape/shape.h"

/* A convex piece: one of a shape, or n points, counterclockwise and strictly convex: two are a segment, one is a
 * point. */
typedef struct sunder_i_piece_of {
    const sunder_shape *shape; /* NULL: n points xy */
    uint32_t piece;
    uint32_t n;
    const double *xy;
} sunder_i_piece_of;

/* *out becomes the union of n pieces, which are borrowed as long as it exists. It has no raw rings, and is for
 * separation/ only. */
sunder_status sunder_i_shape_of_pieces(const sunder_i_piece_of *piece, size_t n, sunder_shape **out, sunder_error *err);
/* Returns the number of corners of a piece. */
uint32_t sunder_i_piece_corners(const sunder_i_piece_of *piece);
/* Sets `vertex` to the ends of side k of a piece, from corner k on, as vertices of its shape, or else as corners.
 * Returns false if the side is a diagonal of the shape, if the piece is a point, or if it is a segment and k is not
 * 0. */
bool sunder_i_piece_edge(const sunder_i_piece_of *piece, uint32_t k, uint32_t vertex[2]);
/* Returns whether a piece has an area; the second function computes its box. */
bool sunder_i_piece_has_area(const sunder_i_piece_of *piece);
void sunder_i_piece_box(const sunder_i_piece_of *piece, double box[4]);

#endif
