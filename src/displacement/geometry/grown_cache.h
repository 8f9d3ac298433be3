/* A cache of grown obstacles (free_places.h). While bodies are moved one after the other, all others stay where they
 * are, and each pair of pieces gives the same obstacle again. */
#ifndef SUNDER_I_GROWN_CACHE_H
#define SUNDER_I_GROWN_CACHE_H

#include "displacement/geometry/free_places.h"

/* Identifies two pieces, their relative position, and the distance by which their obstacle is grown. */
typedef struct sunder_i_grown_key {
    uint64_t pieces;
    double offset[2], gap;
} sunder_i_grown_key;

struct sunder_i_grown;

/* Zeroed: an empty cache. */
typedef struct sunder_i_grown_cache {
    struct sunder_i_grown *slot;
    size_t slots, used;           /* slots: 0 or a power of two */
    sunder_i_obstacle_side *wall; /* the walls of all entries, one entry after the other */
    size_t walls, capacity;
} sunder_i_grown_cache;

void sunder_i_grown_cache_free(sunder_i_grown_cache *cache);
/* Appends the obstacle with this key to `o`. Returns false if it is not in the cache. Sets o->failed if memory is
 * out. */
bool sunder_i_grown_cache_add(const sunder_i_grown_cache *cache, const sunder_i_grown_key *key, sunder_i_obstacles *o);
/* Stores the last obstacle of `o` under this key. Returns false if memory is out. */
bool sunder_i_grown_cache_keep(sunder_i_grown_cache *cache, const sunder_i_grown_key *key, const sunder_i_obstacles *o);

#endif
