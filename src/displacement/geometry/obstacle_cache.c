/* A cache of obstacles. Bodies do not turn, so the obstacle of two pieces is the same wherever they are, and the search
 * needs it again in each round. */
#include "displacement/geometry/obstacle_cache.h"
#include "displacement/geometry/tuning.h"

#include "base/invariant.h"
#include "base/list.h"
#include "base/stage_switch.h"

#include <string.h>

typedef struct sunder_i_cached_obstacle {
    uint64_t key; /* 0: a free slot */
    uint32_t first, n;
} cached_obstacle;

void sunder_i_obstacle_cache_free(sunder_i_obstacle_cache *cache)
{
    sunder_i_free_all(cache->slot, cache->edge);
    memset(cache, 0, sizeof *cache);
}

/* Returns the slot that has the key, or the free slot where it would be stored. */
static size_t slot_of(const sunder_i_obstacle_cache *cache, uint64_t key)
{
    size_t k = (size_t)((key * UINT64_C(0x9e3779b97f4a7c15)) >> 32) & (cache->slots - 1);
    while (cache->slot[k].key && cache->slot[k].key != key) k = (k + 1) & (cache->slots - 1);
    return k;
}

const sunder_i_obstacle_edge *sunder_i_obstacle_cache_find(const sunder_i_obstacle_cache *cache, uint64_t key,
                                                           size_t *n)
{
    if (cache->slots == 0 || !sunder_i_stage_is_on("memo", "obstacles")) return NULL;
    const cached_obstacle *s = &cache->slot[slot_of(cache, key)];
    *n = s->n;
    return s->key ? cache->edge + s->first : NULL;
}

/* Makes room for one more key; at most half of the slots are in use. Returns false if memory is out. */
static bool reserve_slot(sunder_i_obstacle_cache *cache)
{
    if (2 * (cache->used + 1) <= cache->slots) return true;
    sunder_i_obstacle_cache larger = *cache;
    larger.slots = cache->slots ? 2 * cache->slots : FEWEST_SLOTS;
    larger.slot = sunder_i_calloc(larger.slots, sizeof *larger.slot);
    if (!larger.slot) return false;
    for (size_t k = 0; k < cache->slots; k++)
        if (cache->slot[k].key) larger.slot[slot_of(&larger, cache->slot[k].key)] = cache->slot[k];
    sunder_i_free(cache->slot);
    *cache = larger;
    return true;
}

const sunder_i_obstacle_edge *sunder_i_obstacle_cache_add(sunder_i_obstacle_cache *cache, uint64_t key, const double *d,
                                                          size_t *n)
{
    if (cache->edges + *n > MOST_EDGES && cache->slots) {
        memset(cache->slot, 0, cache->slots * sizeof *cache->slot);
        cache->edges = cache->used = 0;
    }
    if (!reserve_slot(cache) ||
        !sunder_i_reserve(&cache->edge, &cache->capacity, cache->edges + *n, sizeof *cache->edge))
        return NULL;
    sunder_i_obstacle_edge *edge = cache->edge + cache->edges;
    *n = sunder_i_obstacle_edges(d, *n, edge);
    cache->slot[slot_of(cache, key)] = (cached_obstacle){key, (uint32_t)cache->edges, (uint32_t)*n};
    cache->edges += *n;
    cache->used++;
    SUNDER_I_ASSERT(2 * cache->used <= cache->slots && cache->edges <= cache->capacity);
    return edge;
}
