/* subsums.h: the convex subsums P_i + Q_j of pairs of convex pieces: of all pairs, or of enough pairs that their union
 * is the same (needed_subsums.h).
 *
 * A point is in int P + int Q exactly if it is in the interior of some subsum, so that the union of the open subsums is
 * the whole open sum: diagonals of the decompositions and touching polygons are no special cases.
 *
 * A side is a *candidate* if it can contain boundary of the sum: it comes from a boundary edge of one operand and a
 * vertex of the other whose exterior angle contains the edge's direction (the reduced convolution [BL11]; the intervals
 * are closed, so that parallel edges are counted twice rather than not at all). Every boundary point and every
 * degenerate hole is on a candidate.
 *
 * The separation of a pair needs few subsums of P and -Q, nearest first, and computes them one by one: sunder_i_subsum
 * (separation/operands/pair_operands.h) is the same kind of object, without ranks. */
#ifndef SUNDER_I_SUBSUMS_H
#define SUNDER_I_SUBSUMS_H

#include "convex/pieces.h"

/* *out becomes the list of subsums of p and q, ranked, and *directions their directions; the caller frees both. vp, vq:
 * the vertices of p and q on the lattice. Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_subsums_build(sunder_i_lattice *lattice, const sunder_shape *p, const sunder_i_point *vp,
                                     const sunder_shape *q, const sunder_i_point *vq, sunder_i_directions *directions,
                                     sunder_i_convex_pieces *out, sunder_error *err);

#endif
