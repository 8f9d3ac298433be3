/* A cache of obstacles; see obstacle_cache.c. */
#ifndef SUNDER_I_OBSTACLE_CACHE_H
#define SUNDER_I_OBSTACLE_CACHE_H

#include "displacement/geometry/obstacle.h"
#include <stdint.h>

/* Obstacles by key. The size of the cache is bounded: when it is full all entries are removed. */
typedef struct sunder_i_obstacle_cache {
    struct sunder_i_cached_obstacle *slot; /* [slots] open addressing; slots is a power of two, or 0 */
    size_t slots, used;
    sunder_i_obstacle_edge *edge;
    size_t edges, capacity;
} sunder_i_obstacle_cache;

void sunder_i_obstacle_cache_free(sunder_i_obstacle_cache *cache);
/* Returns the edges stored under this key (not 0) and sets *n to their number; NULL if there are none. */
const sunder_i_obstacle_edge *sunder_i_obstacle_cache_find(const sunder_i_obstacle_cache *cache, uint64_t key,
                                                           size_t *n);
/* Stores the edges of a convex polygon under a key that is not in the cache, and returns them. *n is the number of
 * corners in d, and is set to the number of edges, which may be smaller. Returns NULL if memory is out. The pointer is
 * valid until the next call. */
const sunder_i_obstacle_edge *sunder_i_obstacle_cache_add(sunder_i_obstacle_cache *cache, uint64_t key, const double *d,
                                                          size_t *n);

#endif
