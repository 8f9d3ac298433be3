/* piece_tree.h: a tree over convex pieces: the longest piece of each group is stored at the group's root, the others
 * form two subgroups by position. So a search that descends from the root tests long pieces first, whose sums are
 * large.
 *
 * A group is a single piece or a node of the tree; all its numbers are doubles, in the units of sunder_i_approx(). */
#ifndef SUNDER_I_PIECE_TREE_H
#define SUNDER_I_PIECE_TREE_H

#include "convex/pieces.h"

/* The number of directions in which extents are measured: x, y, x + y and x - y. */
#define SUNDER_I_WAYS 4
#define SUNDER_I_NO_GROUP UINT32_MAX

typedef struct sunder_i_piece_group {
    double low[SUNDER_I_WAYS], high[SUNDER_I_WAYS]; /* the extent of all pieces together */
    double widest[SUNDER_I_WAYS];                   /* the greatest extent of a single piece */
    uint32_t pieces;                                /* the number of pieces */
    uint32_t piece;                                 /* the number of the longest piece */
    uint32_t part[3]; /* the numbers of the subgroups: the longest piece alone, then the others; SUNDER_I_NO_GROUP:
                       * none */
} sunder_i_piece_group;

/* A corner, and the vector of the side that starts there. */
typedef struct sunder_i_approx_side {
    double x, y, dx, dy;
} sunder_i_approx_side;

typedef struct sunder_i_piece_tree {
    const sunder_i_convex_pieces *pieces;
    sunder_i_approx_side *side;  /* [pieces->corners] */
    sunder_i_piece_group *group; /* [groups] the first contains all pieces */
    uint32_t groups;
    double most; /* the greatest magnitude of a coordinate */
} sunder_i_piece_tree;

/* Builds the tree of a ranked list with at least one piece, which must outlive the tree. Returns false if out of
 * memory. */
bool sunder_i_piece_tree_build(const sunder_i_convex_pieces *pieces, sunder_i_piece_tree *out);
void sunder_i_piece_tree_free(sunder_i_piece_tree *tree);
/* *box becomes the box xmin, ymin, xmax, ymax of a piece. */
void sunder_i_piece_tree_box(const sunder_i_piece_tree *tree, uint32_t piece, double box[4]);

/* Stores the extents of the box xmin, ymin, xmax, ymax in the SUNDER_I_WAYS directions. */
static inline void sunder_i_half_planes_of_box(const double box[4], double low[SUNDER_I_WAYS],
                                               double high[SUNDER_I_WAYS])
{
    low[0] = box[0], high[0] = box[2];
    low[1] = box[1], high[1] = box[3];
    low[2] = box[0] + box[1], high[2] = box[2] + box[3];
    low[3] = box[0] - box[3], high[3] = box[2] - box[1];
}

#endif
