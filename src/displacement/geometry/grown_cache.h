/* Grown obstacles kept at hand (free_places.h): while bodies are put elsewhere by turns all others stand as they did,
 * and are in the way of the next as they were of the last. */
#ifndef SUNDER_I_GROWN_CACHE_H
#define SUNDER_I_GROWN_CACHE_H

#include "displacement/geometry/free_places.h"

/* For two pieces in this relative position, grown by this distance. */
typedef struct sunder_i_grown_key {
    uint64_t pieces;
    double offset[2], gap;
} sunder_i_grown_key;

struct sunder_i_grown;

/* A zeroed struct is empty. */
typedef struct sunder_i_grown_cache {
    struct sunder_i_grown *slot;
    size_t slots, used;           /* slots is 0 or a power of two */
    sunder_i_obstacle_side *wall; /* of one after the other */
    size_t walls, capacity;
} sunder_i_grown_cache;

void sunder_i_grown_cache_free(sunder_i_grown_cache *cache);
/* Adds the obstacle, as it was added before, if it is kept. o->failed if memory is out. */
bool sunder_i_grown_cache_add(const sunder_i_grown_cache *cache, const sunder_i_grown_key *key, sunder_i_obstacles *o);
/* Keeps the last one that was added. False if memory is out. */
bool sunder_i_grown_cache_keep(sunder_i_grown_cache *cache, const sunder_i_grown_key *key, const sunder_i_obstacles *o);

#endif
