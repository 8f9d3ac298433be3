/* visibility.h: the nodes to which a path can continue from a node: those that may be visible from it, without those at
 * which a bend would be useless.
 *
 * The computation is in doubles, and never omits a node that is visible; whether a leg is free is decided elsewhere,
 * exactly. Coordinates are relative to the start, so that they are precise near a path, however far away other objects
 * are. */
#ifndef SUNDER_I_VISIBILITY_H
#define SUNDER_I_VISIBILITY_H

#include "motion/corners.h"
#include "motion/shadow.h"

#define SUNDER_I_NO_NODE UINT32_MAX

typedef struct sunder_i_visibility {
    const sunder_i_free_space *space;
    const sunder_i_corners *corners;
    double (*at)[2];     /* [vertices + 2] all positions relative to the start, with a relative error of at most 2^-51
                          * in each coordinate */
    double (*corner)[2]; /* [corners of parts] all corners of parts, in the same form */
    double from[2];      /* the origin of these coordinates, in the coordinates of the tree of parts */
    uint32_t *order;     /* [nodes] the nodes in the order of a space-filling curve */
    size_t nodes;
    sunder_i_box_tree tree; /* over the nodes in that order */
    sunder_i_shadow shadow;
    uint32_t *seen; /* [nodes] the nodes that the last call of sunder_i_visibility_look() found */
    size_t seen_n;
} sunder_i_visibility;

/* Prepares the tests. Returns false if out of memory; *view must be freed in either case. */
bool sunder_i_visibility_init(sunder_i_visibility *view, const sunder_i_free_space *space,
                              const sunder_i_corners *corners);
void sunder_i_visibility_free(sunder_i_visibility *view);

/* Returns the distance of two nodes; its error is at most 2^-49 of the sum of their distances from the start. */
double sunder_i_visibility_distance(const sunder_i_visibility *view, uint32_t a, uint32_t b);

/* Finds the nodes that may follow node v on a shortest path that comes from node `before` (SUNDER_I_NO_NODE: any
 * direction) and whose length from v to the goal is at most `room`. They are in view->seen. */
void sunder_i_visibility_look(sunder_i_visibility *view, uint32_t v, uint32_t before, double room);

#endif
