/* shortest_path.h: the shortest path through the nodes. */
#ifndef SUNDER_I_SHORTEST_PATH_H
#define SUNDER_I_SHORTEST_PATH_H

#include "motion/corners.h"

/* *path becomes the shortest path from start to goal, which must be connected: *n position numbers, an array that the
 * caller frees. Of several shortest paths it is the lexicographically smallest. Fails with SUNDER_ENOMEM or
 * SUNDER_ECANCEL. */
sunder_status sunder_i_shortest_path(const sunder_i_free_space *space, sunder_i_corners *corners,
                                     const sunder_sum_options *options, uint32_t **path, size_t *n, sunder_error *err);

#endif
