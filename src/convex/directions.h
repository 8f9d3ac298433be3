/* Directions of sides, ranked once for all: from there on, merging convex pieces, the angular intervals of the
 * convolution and the order of edges around a vertex are questions about small integers.
 *
 * Every side has a *class*, its direction modulo 180 degrees, counted counter-clockwise from the positive x axis, and a
 * *rank* in [0, 2 * classes): the class itself for directions in [0, pi), classes + class for the opposite ones. */
#ifndef SUNDER_I_DIRECTIONS_H
#define SUNDER_I_DIRECTIONS_H

#include "number/lattice.h"

typedef struct sunder_i_directions {
    uint32_t classes;
    sunder_i_point *vector; /* [classes] one of each, its angle in [0, pi) */
} sunder_i_directions;

/* Ranks n vectors, none of which is zero; they are turned into [0, pi) where they stand. False if memory is out. */
bool sunder_i_directions_rank(sunder_i_lattice *lattice, sunder_i_point *side, size_t n, uint32_t *rank,
                              sunder_i_directions *out);
/* The order of two ranks, for merges. */
static inline int sunder_i_rank_cmp(uint32_t a, uint32_t b) { return (a > b) - (a < b); }

void sunder_i_directions_free(sunder_i_directions *directions);

#endif
