/* The convex pieces of an operand, by place: a tree with their extents in eight directions, so that long thin pieces
 * that lie aslant are told apart too. Of two such trees, one of P and one of -Q, it is asked which subsums come near a
 * square of the plane, and which may hold it.
 *
 * Extents are single floats, rounded as it comes: the square is widened instead, by more than all that (aim). */
#ifndef SUNDER_I_PIECE_TREE_H
#define SUNDER_I_PIECE_TREE_H

#include "separation/pairing.h"

#define SUNDER_I_WAYS 8 /* multiples of pi / 8; the first is along x, the middle one along y */

typedef struct sunder_i_extents {
    float low[SUNDER_I_WAYS], high[SUNDER_I_WAYS];
} sunder_i_extents;

/* A perfect binary tree: node k has the children 2k and 2k + 1, node 1 is the root, node leaves + i has piece[i]. */
typedef struct sunder_i_piece_tree {
    uint32_t leaves;
    uint32_t *piece;          /* [leaves] UINT32_MAX: none */
    sunder_i_extents *extent; /* [2 * leaves] infinite, low above high, for leaves without a piece */
} sunder_i_piece_tree;

/* Of operand `side` of a pairing. False if memory is out; to be freed all the same. */
bool sunder_i_piece_tree_build(sunder_i_piece_tree *tree, const sunder_i_pairing *pairing, int side);
void sunder_i_piece_tree_free(sunder_i_piece_tree *tree);

/* The extents of a square, widened by what doubles and floats may be off by. */
sunder_i_extents sunder_i_piece_tree_aim(const sunder_i_pairing *pairing, const double square[4]);

/* May a subsum of pieces with the extents u and v come near the square aimed at? */
static inline bool sunder_i_extents_near(const sunder_i_extents *u, const sunder_i_extents *v,
                                         const sunder_i_extents *aim)
{
    int32_t off[SUNDER_I_WAYS]; /* without branches, four ways at a time */
    for (int k = 0; k < SUNDER_I_WAYS; k++)
        off[k] = (u->low[k] + v->low[k] > aim->high[k]) | (u->high[k] + v->high[k] < aim->low[k]);
    for (int k = 0; k < SUNDER_I_WAYS / 2; k++) off[k] |= off[k + SUNDER_I_WAYS / 2];
    return !(off[0] | off[1] | off[2] | off[3]);
}

/* How far inside such a subsum all of the square may be at most; it is not held where that is not positive. */
static inline float sunder_i_extents_depth(const sunder_i_extents *u, const sunder_i_extents *v,
                                           const sunder_i_extents *aim)
{
    float depth[SUNDER_I_WAYS];
    for (int k = 0; k < SUNDER_I_WAYS; k++) {
        const float below = aim->low[k] - (u->low[k] + v->low[k]), above = u->high[k] + v->high[k] - aim->high[k];
        depth[k] = below < above ? below : above;
    }
    for (int n = SUNDER_I_WAYS / 2; n > 0; n /= 2)
        for (int k = 0; k < n; k++) depth[k] = depth[k] < depth[k + n] ? depth[k] : depth[k + n];
    return depth[0];
}

#endif
