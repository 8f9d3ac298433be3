/* A closed walk of few corners, as sunder_i_walk, with numbers of corners in bytes, so that sets of them are the bits
 * of a word; and its convex pieces. */
#ifndef SUNDER_I_SMALL_WALK_H
#define SUNDER_I_SMALL_WALK_H

#include "shape/build.h"

#define SUNDER_I_SMALL_NODES 32
#define SUNDER_I_SMALL_BRIDGES 8
#define SUNDER_I_SMALL_HALVES (3 * (SUNDER_I_SMALL_NODES - 2)) /* half-edges of a triangulation */
#define SUNDER_I_SMALL_NONE 0xff
#define SUNDER_I_SMALL_BRIDGE 0x80 /* above all half-edges */

typedef struct sunder_i_small_walk {
    uint32_t nodes, bridges;
    bool brief;                              /* no two coordinates are 2^31 apart: a turn fits 64 bits */
    sunder_i_point at[SUNDER_I_SMALL_NODES]; /* below 2^60 */
    uint32_t convex;                         /* the set of nodes at which it turns left */
    const uint8_t *vertex;                   /* of the polygon, of each node: both ends of a bridge have two */
    uint8_t next[SUNDER_I_SMALL_NODES], prev[SUNDER_I_SMALL_NODES];
    uint8_t beyond[SUNDER_I_SMALL_NODES]; /* right of node -> next: NONE, or BRIDGE + number */
} sunder_i_small_walk;

/* Do u and v turn left, or at least not right? */
static inline bool sunder_i_small_left(bool brief, sunder_i_point u, sunder_i_point v)
{
    return brief ? u.x * v.y - u.y * v.x > 0 : sunder_i_narrow_cross(u, v) > 0;
}

static inline bool sunder_i_small_not_right(bool brief, sunder_i_point u, sunder_i_point v)
{
    return brief ? u.x * v.y - u.y * v.x >= 0 : sunder_i_narrow_cross(u, v) >= 0;
}

/* Do nodes a, b, c turn left? */
static inline bool sunder_i_small_turns_left(const sunder_i_small_walk *w, uint32_t a, uint32_t b, uint32_t c)
{
    return sunder_i_small_left(w->brief, sunder_i_narrow_sub(w->at[b], w->at[a]),
                               sunder_i_narrow_sub(w->at[c], w->at[b]));
}

/* The pieces that the general way has, in the same order. The walk is used up. Room in *out for as many pieces, and
 * corners, as a triangulation has. */
void sunder_i_small_pieces(sunder_i_small_walk *walk, sunder_i_pieces *out);

#endif
