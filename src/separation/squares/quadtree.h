/* Boxes that an operand has inside, by place: what large operands are asked before their pieces are looked at. */
#ifndef SUNDER_I_QUADTREE_H
#define SUNDER_I_QUADTREE_H

#include "separation/operands/pair_operands.h"

/* What a box of the quartering is, if it is not quartered further. */
enum { SUNDER_I_QUADTREE_FULL = -1, SUNDER_I_QUADTREE_REST = -2 };

typedef struct sunder_i_quadtree {
    /* A box around the operand, quartered again and again: all of a full node is in the operand's interior, with more
     * than the operands' error to spare; of the rest nothing is known. */
    double box[4];
    int32_t *child; /* of each node the first of four, or what it is; node 0 is the whole */
    size_t nodes, nodes_capacity;
} sunder_i_quadtree;

/* The quadtree of operand `side`. False if memory is out; the caller frees it in any case. */
bool sunder_i_quadtree_build(sunder_i_quadtree *quadtree, const sunder_i_operands *operands, int side);
void sunder_i_quadtree_free(sunder_i_quadtree *quadtree);

/* Quarter k of a box. */
static inline void sunder_i_quadtree_quarter(const double box[4], int k, double out[4])
{
    const double x = box[0] / 2 + box[2] / 2, y = box[1] / 2 + box[3] / 2;
    out[0] = k & 1 ? x : box[0];
    out[1] = k & 2 ? y : box[1];
    out[2] = k & 1 ? box[2] : x;
    out[3] = k & 2 ? box[3] : y;
}

#endif
