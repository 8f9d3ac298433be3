/* A tree over convex pieces: the longest piece of each group stands at its root, the others fall into two groups by
 * position. So opening a group near the root gives a long piece first, whose sums are wide.
 *
 * A group is a single piece or a node of the tree; all of it in doubles, in the units of sunder_i_approx(). */
#ifndef SUNDER_I_PIECE_TREE_H
#define SUNDER_I_PIECE_TREE_H

#include "convex/pieces.h"

/* Extents are taken along x, y, x + y and x - y. */
#define SUNDER_I_WAYS 4
#define SUNDER_I_NO_GROUP UINT32_MAX

typedef struct sunder_i_piece_group {
    double low[SUNDER_I_WAYS], high[SUNDER_I_WAYS]; /* of all pieces together */
    double widest[SUNDER_I_WAYS];                   /* the greatest extent of one piece */
    uint32_t pieces;                                /* how many */
    uint32_t piece;                                 /* the longest */
    uint32_t part[3]; /* the subgroups: the longest piece alone, then the others; NO_GROUP */
} sunder_i_piece_group;

/* A side that starts in a corner, and that corner. */
typedef struct sunder_i_approx_side {
    double x, y, dx, dy;
} sunder_i_approx_side;

typedef struct sunder_i_piece_tree {
    const sunder_i_convex_pieces *pieces;
    sunder_i_approx_side *side;  /* [pieces->corners] */
    sunder_i_piece_group *group; /* [groups] the first holds all pieces */
    uint32_t groups;
    double most; /* the greatest magnitude of a coordinate */
} sunder_i_piece_tree;

/* Of ranked pieces, at least one; they must outlive the tree. False if memory is out. */
bool sunder_i_piece_tree_build(const sunder_i_convex_pieces *pieces, sunder_i_piece_tree *out);
void sunder_i_piece_tree_free(sunder_i_piece_tree *tree);
/* The box xmin, ymin, xmax, ymax of a piece. */
void sunder_i_piece_tree_box(const sunder_i_piece_tree *tree, uint32_t piece, double box[4]);

/* Extents of a box xmin, ymin, xmax, ymax along the ways. */
static inline void sunder_i_half_planes_of_box(const double box[4], double low[SUNDER_I_WAYS],
                                               double high[SUNDER_I_WAYS])
{
    low[0] = box[0], high[0] = box[2];
    low[1] = box[1], high[1] = box[3];
    low[2] = box[0] + box[1], high[2] = box[2] + box[3];
    low[3] = box[0] - box[3], high[3] = box[2] - box[1];
}

#endif
