/* The Minkowski sum of two convex pieces of decompositions, corners with denominators among them: their sides merged
 * by angle (merge.h). */
#ifndef SUNDER_I_CONVEX_SUM_H
#define SUNDER_I_CONVEX_SUM_H

#include "decomposition/decomposition.h"

/* Counter-clockwise and strictly convex; sides of equal direction are one, so there are at most m + n. Begins with
 * the side of the least angle in [0, 2 pi), angles ascend. Corner k is corner of_p[k] of p's decomposition plus
 * corner of_q[k] of q's; the side from it to the next has the direction along[k]. */
typedef struct sunder_i_convex_sum {
    uint32_t corners;
    sunder_i_rational_point *at; /* [corners] on the lattice of both; w is 1 where neither is a Steiner point */
    sunder_i_point *along;       /* [corners] a lattice vector, as in the pieces */
    uint32_t *of_p, *of_q;       /* [corners] */
    bool *side_p,
        *side_q; /* [corners] is a side of p's piece part of the side that starts here? of q's? At least one is */
} sunder_i_convex_sum;

/* Piece i of p plus piece j of q, both decomposed on this lattice. All of the result lives in the arena. False if
 * memory is out (the arena's or the lattice's). */
bool sunder_i_convex_sum_of(sunder_i_lattice *lattice, const sunder_i_decomposition *p, uint32_t i,
                            const sunder_i_decomposition *q, uint32_t j, sunder_i_arena *arena,
                            sunder_i_convex_sum *out);

#endif
