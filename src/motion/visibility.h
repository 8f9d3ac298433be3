/* Which nodes a path can go on to from a node: those that may be seen from it, and where it does not bend in vain.
 *
 * Doubles, and never a node too few; whether a leg is free is asked elsewhere, exactly. Coordinates are taken from the
 * start, so that they are precise where a path is, however far away other things are. */
#ifndef SUNDER_I_VISIBILITY_H
#define SUNDER_I_VISIBILITY_H

#include "motion/corners.h"
#include "motion/shadow.h"

#define SUNDER_I_NO_NODE UINT32_MAX

typedef struct sunder_i_visibility {
    const sunder_i_free_space *space;
    const sunder_i_corners *corners;
    double (*at)[2];     /* [vertices + 2] places, from the start; each coordinate is within 2^-51 of itself */
    double (*corner)[2]; /* [corners of parts] likewise */
    double from[2];      /* where that start is in the boxes of the parts' tree */
    uint32_t *order;     /* [nodes] along a space-filling curve */
    size_t nodes;
    sunder_i_box_tree tree; /* over the nodes in that order */
    sunder_i_shadow shadow;
    uint32_t *seen; /* [nodes] what the last look found */
    size_t seen_n;
} sunder_i_visibility;

/* False if memory is out; the view can be freed all the same. */
bool sunder_i_visibility_init(sunder_i_visibility *view, const sunder_i_free_space *space,
                              const sunder_i_corners *corners);
void sunder_i_visibility_free(sunder_i_visibility *view);

/* Between two nodes; within 2^-49 of the sum of their distances from the start. */
double sunder_i_visibility_distance(const sunder_i_visibility *view, uint32_t a, uint32_t b);

/* Finds what may come after the node v on a shortest path that reaches v from `before`, or from anywhere with NO_NODE,
 * and is no longer than `room` from v to the goal. */
void sunder_i_visibility_look(sunder_i_visibility *view, uint32_t v, uint32_t before, double room);

#endif
