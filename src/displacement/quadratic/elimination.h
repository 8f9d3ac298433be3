/* Orders in which the nodes of a graph are eliminated: each joins its neighbours to each other and is gone, and who
 * those are at that moment is its column of the factor of a matrix that has the graph's edges [GL81, chapter 5]. */
#ifndef SUNDER_I_ELIMINATION_H
#define SUNDER_I_ELIMINATION_H

#include "base/list.h"

/* Lists of neighbours, each ascending, of n nodes; those of a node become its neighbours at its turn, in no order. */
typedef struct sunder_i_elimination {
    size_t n;
    sunder_i_list *near; /* [n] */
    uint32_t *rank;      /* [n] out: the turn of each; lent */
} sunder_i_elimination;

/* Of edges (a, b), a != b, that may come again. False if memory is out; free it all the same. */
bool sunder_i_elimination_init(sunder_i_elimination *e, size_t n, const sunder_i_id_pair *pair, size_t pairs,
                               uint32_t *rank);
void sunder_i_elimination_free(sunder_i_elimination *e);

/* All, by one of the methods below: by place, if that is known, where there are many; in postorder of the elimination
 * tree. place: NULL, or [2 n] where they stand. False if memory is out. */
bool sunder_i_eliminate(sunder_i_elimination *e, const double *place);

/* Who has fewest neighbours left first (minimum_degree.c). False if memory is out. */
bool sunder_i_minimum_degree(sunder_i_elimination *e);
/* By halves of the plane, who parts two halves after both (dissection.c); place: [2 n] where they stand. *done: false
 * where what parts them is too much, and nothing was done. False if memory is out. */
bool sunder_i_dissect(sunder_i_elimination *e, const double *place, bool *done);

#endif
