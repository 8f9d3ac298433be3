/* Where shortest paths can bend, and which places hang together.
 *
 * In a closed polygonal set a shortest path bends only at corners of the obstacles (convex corners of O), at ends,
 * bends and branches of degenerate segments, and where several corners touch. Those are the *nodes*; the places of
 * start and goal stand behind the vertices of the outline. */
#ifndef SUNDER_I_CORNERS_H
#define SUNDER_I_CORNERS_H

#include "motion/free_space.h"

#define SUNDER_I_NO_PLACE UINT32_MAX

typedef struct sunder_i_corners {
    uint32_t vertices;              /* of the outline; start is place `vertices`, goal the next */
    sunder_i_filtered_point *place; /* [vertices + 2] */
    uint32_t (*beside)[2]; /* [vertices + 2] of a plain corner, the vertices before and after it with O on the left;
                              else NO_PLACE */
    uint32_t *node;        /* places where a path from the start can bend, then start, then goal */
    uint32_t nodes;
    uint32_t *parent; /* [vertices + 3] free space's components, as a forest; the last is what lies outside */
} sunder_i_corners;

/* Takes start and goal, which are free, into account. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_corners_find(const sunder_i_free_space *space, const sunder_i_filtered_point *start,
                                    const sunder_i_filtered_point *goal, sunder_i_corners *out, sunder_error *err);
void sunder_i_corners_free(sunder_i_corners *corners);

/* ---- Components (components.c) ---- */

/* Joins what hangs together, into `parent`. False if memory is out. */
bool sunder_i_components_find(const sunder_i_free_space *space, sunder_i_corners *corners);
/* Do two places lie in one component of free space? */
bool sunder_i_corners_connected(sunder_i_corners *corners, uint32_t a, uint32_t b);

#endif
