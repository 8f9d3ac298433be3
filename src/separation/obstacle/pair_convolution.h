/* pair_convolution.h: the reduced convolution, segments that contain the whole boundary of the obstacle, with its
 * degenerate holes. */
#ifndef SUNDER_I_PAIR_CONVOLUTION_H
#define SUNDER_I_PAIR_CONVOLUTION_H

#include "separation/obstacle/carrier.h"

typedef struct sunder_i_candidate {
    double square; /* the squared distance of the segment from the origin; the distance has an error of at most 4
                    * operands->error */
    uint32_t edge, vertex; /* the edge that leaves vertex `edge` of operand `side`, translated by `vertex` of the other
                            * operand */
    int side;
} sunder_i_candidate;

typedef struct sunder_i_candidates {
    sunder_i_candidate *item;
    size_t n, capacity;
} sunder_i_candidates;

/* The first function appends a candidate; the second makes a heap of all candidates. The first returns false if out of
 * memory. */
bool sunder_i_candidates_push(sunder_i_operands *operands, sunder_i_candidates *heap, sunder_i_candidate candidate);
void sunder_i_candidates_order(sunder_i_candidates *heap);

/* Finds all segments nearer than `limit` units, as a heap with the nearest on top, in the lattice's arena. Returns
 * false if out of memory. */
bool sunder_i_candidates_find(sunder_i_operands *operands, double limit, sunder_i_candidates *out);
/* Removes and returns the nearest candidate; n > 0. */
sunder_i_candidate sunder_i_candidates_pop(sunder_i_candidates *heap);
sunder_i_carrier sunder_i_candidate_carrier(sunder_i_operands *operands, const sunder_i_candidate *candidate);

#endif
