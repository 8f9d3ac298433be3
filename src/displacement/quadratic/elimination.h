/* Elimination orders of a graph. Eliminating a node joins its neighbours to each other and removes it; its neighbours
 * at that moment are its column in the factor of a matrix with the graph's edges [GL81, chapter 5]. */
#ifndef SUNDER_I_ELIMINATION_H
#define SUNDER_I_ELIMINATION_H

#include "base/list.h"

/* A graph of n nodes. `near` has the neighbours of each node, ascending; elimination replaces them by its neighbours at
 * its turn, unordered. */
typedef struct sunder_i_elimination {
    size_t n;
    sunder_i_list *near; /* [n] */
    uint32_t *rank;      /* [n] out, borrowed: the position of each node in the order */
} sunder_i_elimination;

/* Sets up a graph of edges (a, b), a != b; repeats are allowed. Returns false if memory is out; the caller frees *e in
 * any case. */
bool sunder_i_elimination_init(sunder_i_elimination *e, size_t n, const sunder_i_id_pair *pair, size_t pairs,
                               uint32_t *rank);
void sunder_i_elimination_free(sunder_i_elimination *e);

/* Eliminates all nodes: by nested dissection if positions are known and there are many nodes, else by minimum degree;
 * the order is a postorder of the elimination tree. place: NULL, or [2 n] the positions of the nodes. Returns false if
 * memory is out. */
bool sunder_i_eliminate(sunder_i_elimination *e, const double *place);

/* Eliminates the node with the fewest remaining neighbours first (minimum_degree.c). Returns false if memory is out. */
bool sunder_i_minimum_degree(sunder_i_elimination *e);
/* Eliminates by nested dissection, separators after the two halves that they separate (dissection.c). place: [2 n] the
 * positions of the nodes. If separators are too large *done is set to false and *e is not changed, except for ranks.
 * Returns false if memory is out. */
bool sunder_i_dissect(sunder_i_elimination *e, const double *place, bool *done);

#endif
