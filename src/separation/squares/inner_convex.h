/* Convex sets inside an operand, by position: its pieces, and the largest of the boxes that its quadtree found inside
 * (quadtree.h). Those of P and of -Q tell which subsums come near a square of the plane, and whether the sum of two
 * covers it. A spike has no box inside, and no single piece lies behind a rugged coast; but the sum of a spike and a
 * box covers as well as any.
 *
 * Each node of the tree has a chief among its sets, and a bound on how far the others stand out of it: so the sum of
 * two chiefs tells how deep a square can be in any sum of their nodes. */
#ifndef SUNDER_I_INNER_CONVEX_H
#define SUNDER_I_INNER_CONVEX_H

#include "separation/squares/dop_tree.h"
#include "separation/squares/quadtree.h"

/* Four corners and the sides that leave them, counter-clockwise; some twice where there are fewer. */
typedef struct sunder_i_inner_convex_block {
    float x[4], y[4], nx[4], ny[4], support[4]; /* n: a side's outward unit normal; support = n . (x, y) */
} sunder_i_inner_convex_block;

typedef struct sunder_i_inner_convex_node {
    uint32_t chief; /* UINT32_MAX: it has no convex sets */
    float reach;    /* no convex set of the node covers a square deeper than the chief does by more */
} sunder_i_inner_convex_node;

/* All in floats, in the scale of the extents (dop_tree.h). */
typedef struct sunder_i_inner_convex {
    uint32_t n;    /* pieces first, in their order */
    uint32_t *end; /* [n] past the last block of each */
    sunder_i_inner_convex_block *block;
    /* [n] what heights over its sides may be off by because one of them is short; it is taken off their supports, so
     * that nothing is covered that is not */
    float *vague;
    uint32_t boxes;
    double *box;                      /* [4 * boxes] the convex sets that are boxes, which are the last */
    sunder_i_dop_tree pieces, all;    /* the tree of the pieces only, and that of all convex sets */
    sunder_i_inner_convex_node *node; /* [2 * all.leaves] */
} sunder_i_inner_convex;

/* The tree of operand `side`. False if memory is out; the caller frees it in any case. */
bool sunder_i_inner_convex_build(sunder_i_inner_convex *inner, const sunder_i_operands *operands, int side,
                                 const sunder_i_quadtree *quadtree);
void sunder_i_inner_convex_free(sunder_i_inner_convex *inner);

/* A square as the sets see it: its middle, and half its widths; these may be negative, and then it is asked how deep
 * the middle is in a sum that is widened by a square so large. */
typedef struct sunder_i_square_query {
    float x, y, hx, hy;
} sunder_i_square_query;

sunder_i_square_query sunder_i_inner_convex_query(const sunder_i_operands *operands, const double square[4]);

/* How a square lies to the sum of set i of P and set j of -Q: its least height below one of the sum's sides, of its
 * farthest point (`in`: it is covered if that is positive) and of its nearest (`touch`: they are apart if that is
 * negative and not for vagueness). Both are good to SUNDER_I_INNER_CONVEX_ERROR. */
typedef struct sunder_i_square_depth {
    float in, touch;
} sunder_i_square_depth;

/* Coordinates are up to 2, the square's up to 4, and u = 2^-24. A normal is off by u, at a point up to 11.4 away;
 * corners, support, middle and widths are rounded (2.9 + 2.9 + 5.7 + 5.7) u, their products and sums
 * (5.7 + 11.4 + 11.4) u, and the three sums of these (5.7 + 11.4 + 17) u: below 92 u in all. */
#define SUNDER_I_INNER_CONVEX_ERROR 0x1p-17f

sunder_i_square_depth sunder_i_inner_convex_depth(const sunder_i_inner_convex inner[2], uint32_t i, uint32_t j,
                                                  const sunder_i_square_query *query);

#endif
