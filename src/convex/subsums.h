/* The convex subsums P_i + Q_j of all pairs of convex pieces, as lists of corners and sides.
 *
 * A point is in int P + int Q exactly when it is in the interior of some subsum, so the union of the open subsums
 * is the whole open sum: diagonals of the decompositions and members that touch need no care.
 *
 * Directions are ranked once for all: every side of every piece has a class (its direction modulo 180 degrees,
 * counted counter-clockwise from the positive x axis) and a rank in [0, 2 * classes): the class itself for
 * directions in [0, pi), classes + class for the opposite ones. From there on, merging convex pieces, the angular
 * intervals of the convolution and the order of edges around a vertex are questions about small integers.
 *
 * A side is a *candidate* where it can carry boundary of the sum: it comes from a boundary edge of one operand and
 * a vertex of the other whose exterior angle holds the edge's direction (the reduced convolution [BL11]; closed
 * intervals, so that parallel edges are in twice rather than not at all). Every boundary point and every degenerate
 * hole lies on a candidate. */
#ifndef SUNDER_I_SUBSUMS_H
#define SUNDER_I_SUBSUMS_H

#include "shape/shape.h"

typedef struct sunder_i_subsums {
    sunder_i_lattice *lattice;
    uint32_t classes;
    sunder_i_point *direction; /* [classes] a vector of each, angle in [0, pi) */
    size_t n, sides;
    uint32_t *end;             /* [n] past the last side of each */
    sunder_i_point *corner;    /* [sides] where each side starts; counter-clockwise, ranks not falling in each subsum */
    uint32_t *rank;            /* [sides] */
    bool *candidate;           /* [sides] */
} sunder_i_subsums;

/* vp, vq: the vertices of p and q on the lattice. Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_subsums_build(sunder_i_lattice *lattice, const sunder_shape *p, const sunder_i_point *vp,
                                     const sunder_shape *q, const sunder_i_point *vq, sunder_i_subsums *out,
                                     sunder_error *err);
void sunder_i_subsums_free(sunder_i_subsums *subsums);

/* Subsum s has the sides from this index on, up to end[s]. */
static inline uint32_t sunder_i_subsum_first(const sunder_i_subsums *subsums, size_t s)
{
    return s ? subsums->end[s - 1] : 0;
}

#endif
