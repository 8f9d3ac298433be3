/* small_walk.h: a closed walk with few vertices, as sunder_i_walk, with node numbers in bytes, so that sets of them are
 * the bits of a word; and its convex pieces. */
#ifndef SUNDER_I_SMALL_WALK_H
#define SUNDER_I_SMALL_WALK_H

#include "shape/build.h"

#define SUNDER_I_SMALL_NODES 32
#define SUNDER_I_SMALL_BRIDGES 8
#define SUNDER_I_SMALL_HALVES (3 * (SUNDER_I_SMALL_NODES - 2)) /* half-edges of a triangulation */
#define SUNDER_I_SMALL_NONE 0xff
#define SUNDER_I_SMALL_BRIDGE 0x80 /* greater than all numbers of half-edges */

typedef struct sunder_i_small_walk {
    uint32_t nodes, bridges;
    bool brief;                              /* no two coordinates differ by 2^31 or more, so that a turn fits 64
                                              * bits */
    sunder_i_point at[SUNDER_I_SMALL_NODES]; /* below 2^60 */
    uint32_t convex;                         /* the set of nodes at which the walk turns left */
    const uint8_t *vertex;                   /* the vertex of each node; both ends of a bridge have two nodes */
    uint8_t next[SUNDER_I_SMALL_NODES], prev[SUNDER_I_SMALL_NODES];
    uint8_t beyond[SUNDER_I_SMALL_NODES]; /* what is on the right of node -> next: NONE, or SUNDER_I_SMALL_BRIDGE + the
                                           * number of a bridge */
} sunder_i_small_walk;

/* Return whether v is on the left of u, and whether it is not on the right of u. */
static inline bool sunder_i_small_left(bool brief, sunder_i_point u, sunder_i_point v)
{
    return brief ? u.x * v.y - u.y * v.x > 0 : sunder_i_narrow_cross(u, v) > 0;
}

static inline bool sunder_i_small_not_right(bool brief, sunder_i_point u, sunder_i_point v)
{
    return brief ? u.x * v.y - u.y * v.x >= 0 : sunder_i_narrow_cross(u, v) >= 0;
}

/* Returns whether the nodes a, b, c turn left. */
static inline bool sunder_i_small_turns_left(const sunder_i_small_walk *w, uint32_t a, uint32_t b, uint32_t c)
{
    return sunder_i_small_left(w->brief, sunder_i_narrow_sub(w->at[b], w->at[a]),
                               sunder_i_narrow_sub(w->at[c], w->at[b]));
}

/* Finds the pieces that the general path finds, in the same order. The walk is consumed. *out has room for as many
 * pieces and vertices as a triangulation has. */
void sunder_i_small_pieces(sunder_i_small_walk *walk, sunder_i_pieces *out);

#endif
