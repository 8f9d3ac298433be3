/* diagonals.h: the part of a robot's interior that the interiors of its pieces do not cover.
 *
 * The interiors of the convex pieces of a shape cover its interior except for the diagonals between them. In the sum
 * with an obstacle that has an area nothing is missing: o + d with d on a diagonal equals o' + d' with d' beside the
 * diagonal. In the sum with a segment or a point it is, so that a point obstacle could pass through the robot along a
 * diagonal. Therefore each diagonal uv gets a convex quadrilateral u - p - v - q with p and q in the two pieces that it
 * separates: the interior of the quadrilateral is in the robot's interior and contains the whole diagonal except for
 * its ends, which are corners of the robot.
 *
 *              v
 *            / | \
 *           q -m- p         p = m + (w - m) / 2^j for a corner w of one piece, m the midpoint of uv; likewise q
 *            \ | /          j so large that the quadrilateral is convex: |p - m|, |q - m| <= |uv| / 4 is sufficient
 *              u
 *
 * The corners p and q are on a finer lattice: it needs as many more bits as the largest j, and one for m. */
#ifndef SUNDER_I_DIAGONALS_H
#define SUNDER_I_DIAGONALS_H

#include "convex/pieces.h"
#include "shape/shape.h"

typedef struct sunder_i_diagonals {
    size_t n;
    uint32_t (
        *corner)[4]; /* u, w, v, x: uv is the diagonal, w the next corner of the piece on its right and x that of the
                      * piece on its left */
    unsigned bits;   /* the number of bits by which the lattice must be finer */
} sunder_i_diagonals;

/* Finds all diagonals of `shape`, and the additional bits that their quadrilaterals need. Returns false if out of
 * memory. */
bool sunder_i_diagonals_find(const sunder_shape *shape, sunder_i_diagonals *out);
void sunder_i_diagonals_free(sunder_i_diagonals *diagonals);

/* Appends the quadrilaterals to `list`, which must have room for them. at[v]: the point of vertex v of the shape; the
 * differences of these points must be multiples of 2^bits. Numbers are allocated in the lattice's arena; out of memory
 * sets its `failed`. */
void sunder_i_diagonals_add(const sunder_i_diagonals *diagonals, sunder_i_lattice *lattice, const sunder_i_point *at,
                            sunder_i_convex_pieces *list);

#endif
