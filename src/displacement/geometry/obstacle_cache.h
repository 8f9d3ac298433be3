/* Obstacles kept at hand; see obstacle_cache.c. */
#ifndef SUNDER_I_OBSTACLE_CACHE_H
#define SUNDER_I_OBSTACLE_CACHE_H

#include "displacement/geometry/obstacle.h"
#include <stdint.h>

/* Obstacles by key, for repeated use; the cache is bounded, so entries may be evicted. */
typedef struct sunder_i_obstacle_cache {
    struct sunder_i_cached_obstacle *slot; /* [slots] open addressing; slots is a power of two, or 0 */
    size_t slots, used;
    sunder_i_obstacle_edge *edge;
    size_t edges, capacity;
} sunder_i_obstacle_cache;

void sunder_i_obstacle_cache_free(sunder_i_obstacle_cache *cache);
/* The edges put there with that key (not 0), *n of them; NULL: none are there. */
const sunder_i_obstacle_edge *sunder_i_obstacle_cache_find(const sunder_i_obstacle_cache *cache, uint64_t key,
                                                           size_t *n);
/* Puts the edges of the polygon d of n corners there, of whose key there are none; NULL: memory is out. They stay until
 * something else is put there. */
const sunder_i_obstacle_edge *sunder_i_obstacle_cache_add(sunder_i_obstacle_cache *cache, uint64_t key, const double *d,
                                                          size_t *n);

#endif
