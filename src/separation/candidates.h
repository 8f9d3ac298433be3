/* The reduced convolution: segments that carry the whole boundary of the obstacle, degenerate holes included. */
#ifndef SUNDER_I_CANDIDATES_H
#define SUNDER_I_CANDIDATES_H

#include "separation/line.h"

typedef struct sunder_i_candidate {
    double square;         /* squared distance of the segment from the origin, whose root is good to 4 pairing->error */
    uint32_t edge, vertex; /* the edge that leaves vertex `edge` of operand `side`, moved to `vertex` of the other */
    int side;
} sunder_i_candidate;

typedef struct sunder_i_candidates {
    sunder_i_candidate *item;
    size_t n, capacity;
} sunder_i_candidates;

/* All segments nearer than `limit` units, as a heap with the nearest on top. Memory: the lattice's arena. */
bool sunder_i_candidates_find(sunder_i_pairing *pairing, double limit, sunder_i_candidates *out);
/* Takes the top off. n > 0. */
sunder_i_candidate sunder_i_candidates_pop(sunder_i_candidates *heap);
sunder_i_line sunder_i_candidate_line(sunder_i_pairing *pairing, const sunder_i_candidate *candidate);

#endif
