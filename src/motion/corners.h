/* corners.h: the points at which shortest paths can bend, and the components of free space that they are in.
 *
 * In a closed polygonal set a shortest path bends only at the corners of the obstacles (convex corners of O), at ends,
 * bends and branches of degenerate segments, and where several corners touch. These points are the *nodes*. Positions
 * are numbered: first the vertices of the outline, then the start and the goal. */
#ifndef SUNDER_I_CORNERS_H
#define SUNDER_I_CORNERS_H

#include "motion/free_space.h"

#define SUNDER_I_NO_PLACE UINT32_MAX

typedef struct sunder_i_corners {
    uint32_t vertices;              /* the vertices of the outline; the start has the number `vertices`, the goal the
                                     * next one */
    sunder_i_filtered_point *place; /* [vertices + 2] the points of all positions */
    uint32_t (*beside)[2]; /* [vertices + 2] for a plain corner the vertices before and after it, in the direction that
                            * has O on the left; else SUNDER_I_NO_PLACE */
    uint32_t *node;        /* the numbers of the positions at which a path from the start can bend, then the start, then
                            * the goal */
    uint32_t nodes;
    uint32_t *parent; /* [vertices + 3] the components of free space as a union-find forest; the last element represents
                       * the outer face */
} sunder_i_corners;

/* Finds the nodes and components of `space` with the given start and goal, which must be free. The caller frees *out.
 * Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_corners_find(const sunder_i_free_space *space, const sunder_i_filtered_point *start,
                                    const sunder_i_filtered_point *goal, sunder_i_corners *out, sunder_error *err);
void sunder_i_corners_free(sunder_i_corners *corners);

/* ---- Components (components.c) ---- */

/* Joins in corners->parent all positions that are in the same component of `space`. Returns false if out of memory. */
bool sunder_i_components_find(const sunder_i_free_space *space, sunder_i_corners *corners);
/* Returns true if the positions a and b are in the same component of free space. */
bool sunder_i_corners_connected(sunder_i_corners *corners, uint32_t a, uint32_t b);

#endif
