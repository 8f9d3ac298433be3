/* Elimination orders of a graph. Eliminating a node joins its neighbours to each other and removes it; its neighbours
 * at that moment are its column in the factor of a matrix with the graph's edges [GL81, chapter 5]. */
#ifndef SUNDER_I_ELIMINATION_H
#define SUNDER_I_ELIMINATION_H

#include "base/list.h"

/* Lists of neighbours, each ascending, of n nodes; those of a node become its neighbours at its turn, in no order. */
typedef struct sunder_i_elimination {
    size_t n;
    sunder_i_list *near; /* [n] */
    uint32_t *rank;      /* [n] out: the turn of each; lent */
} sunder_i_elimination;

/* A graph of edges (a, b), a != b, with repeats allowed. False if memory is out; the caller frees it in any case. */
bool sunder_i_elimination_init(sunder_i_elimination *e, size_t n, const sunder_i_id_pair *pair, size_t pairs,
                               uint32_t *rank);
void sunder_i_elimination_free(sunder_i_elimination *e);

/* All, by one of the methods below: by place, if that is known, where there are many; in postorder of the elimination
 * tree. place: NULL, or [2 n] where they stand. False if memory is out. */
bool sunder_i_eliminate(sunder_i_elimination *e, const double *place);

/* Minimum degree: the node with the fewest remaining neighbours first (minimum_degree.c). False if memory is out. */
bool sunder_i_minimum_degree(sunder_i_elimination *e);
/* Nested dissection: separators after the two halves they separate (dissection.c); place: [2 n] the positions of the
 * nodes. *done is false, and nothing is changed, where separators are too large. False if memory is out. */
bool sunder_i_dissect(sunder_i_elimination *e, const double *place, bool *done);

#endif
