/* quadtree.h: boxes inside an operand, by position; queries of large operands use them before the pieces. */
#ifndef SUNDER_I_QUADTREE_H
#define SUNDER_I_QUADTREE_H

#include "separation/operands/pair_operands.h"

/* The value of a node that is not divided. */
enum { SUNDER_I_QUADTREE_FULL = -1, SUNDER_I_QUADTREE_REST = -2 };

typedef struct sunder_i_quadtree {
    /* A box around the operand, divided into quarters repeatedly: a full node is in the interior of the operand with a
     * margin of more than the error; of the rest nothing is known. */
    double box[4];
    int32_t *child; /* the first of the four children of each node, or its value; node 0 is the root */
    size_t nodes, nodes_capacity;
} sunder_i_quadtree;

/* Builds the quadtree of operand `side`. Returns false if out of memory; the caller frees it in any case. */
bool sunder_i_quadtree_build(sunder_i_quadtree *quadtree, const sunder_i_operands *operands, int side);
void sunder_i_quadtree_free(sunder_i_quadtree *quadtree);

/* Returns quarter k of a box. */
static inline void sunder_i_quadtree_quarter(const double box[4], int k, double out[4])
{
    const double x = box[0] / 2 + box[2] / 2, y = box[1] / 2 + box[3] / 2;
    out[0] = k & 1 ? x : box[0];
    out[1] = k & 2 ? y : box[1];
    out[2] = k & 1 ? box[2] : x;
    out[3] = k & 2 ? box[3] : y;
}

#endif
