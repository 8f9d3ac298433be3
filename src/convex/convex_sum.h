/* convex_sum.h: the Minkowski sum of two convex pieces of decompositions, whose corners may have denominators: their
 * sides are merged by angle (merge.h). */
#ifndef SUNDER_I_CONVEX_SUM_H
#define SUNDER_I_CONVEX_SUM_H

#include "decomposition/decomposition.h"

/* The sum: counterclockwise and strictly convex; two sides of equal direction become one, so that pieces with m and n
 * sides give at most m + n. The first side has the least angle in [0, 2 pi), and angles ascend. Corner k is corner
 * of_p[k] of the decomposition of p plus corner of_q[k] of that of q; the side from corner k to the next has the
 * direction along[k]. */
typedef struct sunder_i_convex_sum {
    uint32_t corners;
    sunder_i_rational_point *at; /* [corners] on the common lattice; w is 1 unless a summand is a Steiner point */
    sunder_i_point *along;       /* [corners] a lattice vector, as in the pieces */
    uint32_t *of_p, *of_q;       /* [corners] */
    bool *side_p,
        *side_q; /* [corners] is a side of p's piece, of q's piece, part of the side that starts at this corner? At
                  * least one is */
} sunder_i_convex_sum;

/* *out becomes the sum of piece i of p and piece j of q, both decompositions on `lattice`. All its memory is from
 * `arena`. Returns false if out of memory (in the arena or the lattice). */
bool sunder_i_convex_sum_of(sunder_i_lattice *lattice, const sunder_i_decomposition *p, uint32_t i,
                            const sunder_i_decomposition *q, uint32_t j, sunder_i_arena *arena,
                            sunder_i_convex_sum *out);

#endif
