/* What the pieces of a robot leave out of its interior.
 *
 * The interiors of the convex pieces of a shape cover its interior but for the diagonals between them. Summed with an
 * obstacle that has area this is made up for: o + d with d on a diagonal is o' + d' with d' beside it. A segment or a
 * point has nothing to trade, so a point could pass through the robot along a diagonal. There each diagonal uv gets a
 * convex quadrilateral of its own, u - p - v - q with p and q in the two pieces that it parts: its interior lies in the
 * robot's and covers all of the diagonal but its ends, which are corners of the robot.
 *
 *              v
 *            / | \
 *           q -m- p         p = m + (w - m) / 2^j for a corner w of one piece, m the middle of uv; likewise q
 *            \ | /          j so great that the quadrilateral is convex: |p - m|, |q - m| <= |uv| / 4 is enough
 *              u
 *
 * Corners p and q stand on a finer lattice, by as many bits as the greatest j takes, and one for m. */
#ifndef SUNDER_I_DIAGONALS_H
#define SUNDER_I_DIAGONALS_H

#include "convex/pieces.h"
#include "shape/shape.h"

typedef struct sunder_i_diagonals {
    size_t n;
    uint32_t (
        *corner)[4]; /* u, w, v, x: the diagonal uv, then a corner of the piece on its left, v, one on its right */
    unsigned bits;   /* how much finer the lattice has to be */
} sunder_i_diagonals;

/* All diagonals of a shape, and the bits for them. False if memory is out. */
bool sunder_i_diagonals_find(const sunder_shape *shape, sunder_i_diagonals *out);
void sunder_i_diagonals_free(sunder_i_diagonals *diagonals);

/* Appends the quadrilaterals. at: where the vertices of the shape stand, differences multiples of 2^bits. The list has
 * room. Memory in the lattice's arena, whose `failed` tells. */
void sunder_i_diagonals_add(const sunder_i_diagonals *diagonals, sunder_i_lattice *lattice, const sunder_i_point *at,
                            sunder_i_convex_pieces *list);

#endif
