/* inner_convex.h: convex sets inside an operand, by position: its pieces, and the largest of the boxes that its
 * quadtree found inside (quadtree.h). With those of P and of -Q the subsums near a square of the plane are found, and
 * whether the sum of two sets covers it. A spike has no box inside, and a rugged coast has no single large piece behind
 * it; but the sum of a spike and a box can cover a square.
 *
 * Each node of the tree has a chief, its largest set, and a bound of how far the other sets extend beyond it: hence the
 * sum of two chiefs bounds how deep a square can be in any sum of sets of their nodes. */
#ifndef SUNDER_I_INNER_CONVEX_H
#define SUNDER_I_INNER_CONVEX_H

#include "separation/squares/dop_tree.h"
#include "separation/squares/quadtree.h"

/* Four vertices and the sides that leave them, counterclockwise; some are repeated if there are fewer. */
typedef struct sunder_i_inner_convex_block {
    float x[4], y[4], nx[4], ny[4], support[4]; /* (nx, ny): the outward unit normal of a side; support = n . (x, y) */
} sunder_i_inner_convex_block;

typedef struct sunder_i_inner_convex_node {
    uint32_t chief; /* the number of the chief; UINT32_MAX: the node has no convex sets */
    float reach;    /* no convex set of the node covers a square deeper than the chief by more than this */
} sunder_i_inner_convex_node;

/* The convex sets of an operand, in floats at the scale of the extents (dop_tree.h). */
typedef struct sunder_i_inner_convex {
    uint32_t n;    /* the number of sets; the pieces come first, in their order */
    uint32_t *end; /* [n] the end of the blocks of each set */
    sunder_i_inner_convex_block *block;
    /* [n] the additional error of heights over a set's sides if one of them is short; it is subtracted from their
     * supports, so that no square is wrongly found covered */
    float *vague;
    uint32_t boxes;
    double *box;                      /* [4 * boxes] the sets that are boxes, which come last */
    sunder_i_dop_tree pieces, all;    /* the tree of the pieces only, and that of all convex sets */
    sunder_i_inner_convex_node *node; /* [2 * all.leaves] */
} sunder_i_inner_convex;

/* Builds the sets of operand `side`. Returns false if out of memory; the caller frees *inner in any case. */
bool sunder_i_inner_convex_build(sunder_i_inner_convex *inner, const sunder_i_operands *operands, int side,
                                 const sunder_i_quadtree *quadtree);
void sunder_i_inner_convex_free(sunder_i_inner_convex *inner);

/* A square in floats: its centre, and half its widths. If these are negative, the depth is that of the centre in a sum
 * enlarged by a square of that size. */
typedef struct sunder_i_square_query {
    float x, y, hx, hy;
} sunder_i_square_query;

sunder_i_square_query sunder_i_inner_convex_query(const sunder_i_operands *operands, const double square[4]);

/* The position of a square relative to the sum of set i of P and set j of -Q: the least depth below one of the sum's
 * sides, of the square's farthest point (`in`: positive if it is covered) and of its nearest point (`touch`: negative
 * if they are disjoint and the set is not vague). Both have an error of at most SUNDER_I_INNER_CONVEX_ERROR. */
typedef struct sunder_i_square_depth {
    float in, touch;
} sunder_i_square_depth;

/* Coordinates are up to 2, those of the square up to 4, and u = 2^-24. A normal has an error of u, for points up to
 * 11.4 away; vertices, support, centre and widths are rounded with (2.9 + 2.9 + 5.7 + 5.7) u, their products and sums
 * with (5.7 + 11.4 + 11.4) u, and the three sums of these with (5.7 + 11.4 + 17) u: below 92 u in all. */
#define SUNDER_I_INNER_CONVEX_ERROR 0x1p-17f

sunder_i_square_depth sunder_i_inner_convex_depth(const sunder_i_inner_convex inner[2], uint32_t i, uint32_t j,
                                                  const sunder_i_square_query *query);

#endif
