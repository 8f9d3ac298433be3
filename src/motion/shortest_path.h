/* The shortest path among the nodes. */
#ifndef SUNDER_I_SHORTEST_PATH_H
#define SUNDER_I_SHORTEST_PATH_H

#include "motion/corners.h"

/* A shortest path from start to goal, which are connected: place numbers, *n of them, to be freed. Of several the
 * lexicographically smallest. Fails with SUNDER_ENOMEM or SUNDER_ECANCEL. */
sunder_status sunder_i_shortest_path(const sunder_i_free_space *space, sunder_i_corners *corners,
                                     const sunder_sum_options *options, uint32_t **path, size_t *n, sunder_error *err);

#endif
