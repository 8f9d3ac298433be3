/* The reduced convolution: segments that carry the whole boundary of the obstacle, degenerate holes included. */
#ifndef SUNDER_I_PAIR_CONVOLUTION_H
#define SUNDER_I_PAIR_CONVOLUTION_H

#include "separation/obstacle/carrier.h"

typedef struct sunder_i_candidate {
    double square; /* squared distance of the segment from the origin, whose root is good to 4 operands->error */
    uint32_t edge, vertex; /* the edge that leaves vertex `edge` of operand `side`, moved to `vertex` of the other */
    int side;
} sunder_i_candidate;

typedef struct sunder_i_candidates {
    sunder_i_candidate *item;
    size_t n, capacity;
} sunder_i_candidates;

/* Adds a candidate; order() then makes a heap of them all. */
bool sunder_i_candidates_push(sunder_i_operands *operands, sunder_i_candidates *heap, sunder_i_candidate candidate);
void sunder_i_candidates_order(sunder_i_candidates *heap);

/* All segments nearer than `limit` units, as a heap with the nearest on top. Memory: the lattice's arena. */
bool sunder_i_candidates_find(sunder_i_operands *operands, double limit, sunder_i_candidates *out);
/* Takes the top off. n > 0. */
sunder_i_candidate sunder_i_candidates_pop(sunder_i_candidates *heap);
sunder_i_carrier sunder_i_candidate_carrier(sunder_i_operands *operands, const sunder_i_candidate *candidate);

#endif
