/* directions.h: the directions of sides, ranked once: then merging convex pieces, the angular intervals of the
 * convolution and the order of edges around a vertex are comparisons of small integers.
 *
 * Every side has a *class*, the number of its direction modulo 180 degrees, counted counterclockwise from the positive
 * x axis, and a *rank* in [0, 2 * classes): the class for directions in [0, pi), classes + class for the opposite
 * ones. */
#ifndef SUNDER_I_DIRECTIONS_H
#define SUNDER_I_DIRECTIONS_H

#include "number/lattice.h"

typedef struct sunder_i_directions {
    uint32_t classes;
    sunder_i_point *vector; /* [classes] a vector of each class, with its angle in [0, pi) */
} sunder_i_directions;

/* Ranks n vectors, none of which is zero: rank[i] becomes the rank of side[i]. The vectors are rotated into [0, pi) in
 * place. Returns false if out of memory. */
bool sunder_i_directions_rank(sunder_i_lattice *lattice, sunder_i_point *side, size_t n, uint32_t *rank,
                              sunder_i_directions *out);
/* Compares two ranks: -1, 0 or 1. */
static inline int sunder_i_rank_cmp(uint32_t a, uint32_t b) { return (a > b) - (a < b); }

void sunder_i_directions_free(sunder_i_directions *directions);

#endif
