/* See grown_cache.h. A cached value equals the computed one to the last bit, so the cache changes no result. */
#include "displacement/geometry/grown_cache.h"
#include "displacement/geometry/tuning.h"

#include "base/invariant.h"
#include "base/list.h"
#include "base/mix.h"
#include "base/stage_switch.h"

#include <string.h>

typedef struct sunder_i_grown {
    sunder_i_grown_key key;
    double box[4];
    uint32_t first, n; /* its walls; n is 0 in a free slot */
} grown;

void sunder_i_grown_cache_free(sunder_i_grown_cache *cache)
{
    sunder_i_free_all(cache->slot, cache->wall);
    memset(cache, 0, sizeof *cache);
}

/* Returns the slot that has the key, or the free slot where it would be stored. */
static grown *slot_of(const sunder_i_grown_cache *cache, const sunder_i_grown_key *key)
{
    const uint64_t h = sunder_i_mix(sunder_i_mix(sunder_i_mix(key->pieces, key->offset[0]), key->offset[1]), key->gap);
    size_t k = (size_t)(h >> 16) & (cache->slots - 1);
    while (cache->slot[k].n && memcmp(&cache->slot[k].key, key, sizeof *key)) k = (k + 1) & (cache->slots - 1);
    return &cache->slot[k];
}

bool sunder_i_grown_cache_add(const sunder_i_grown_cache *cache, const sunder_i_grown_key *key, sunder_i_obstacles *o)
{
    if (cache->slots == 0 || !sunder_i_stage_is_on("memo", "grown obstacles")) return false;
    const grown *known = slot_of(cache, key);
    if (known->n) sunder_i_obstacles_add_known(o, cache->wall + known->first, known->n, known->box);
    return known->n > 0;
}

/* Makes room for one more entry; at most half of the slots are in use. Returns false if memory is out. */
static bool reserve_slot(sunder_i_grown_cache *cache)
{
    if (2 * (cache->used + 1) <= cache->slots) return true;
    sunder_i_grown_cache larger = *cache;
    larger.slots = cache->slots ? 2 * cache->slots : FEWEST_GROWN;
    larger.slot = sunder_i_calloc(larger.slots, sizeof *larger.slot);
    if (!larger.slot) return false;
    for (size_t k = 0; k < cache->slots; k++)
        if (cache->slot[k].n) *slot_of(&larger, &cache->slot[k].key) = cache->slot[k];
    sunder_i_free(cache->slot);
    *cache = larger;
    return true;
}

bool sunder_i_grown_cache_keep(sunder_i_grown_cache *cache, const sunder_i_grown_key *key, const sunder_i_obstacles *o)
{
    const sunder_i_obstacle *last = &o->obstacle[o->n - 1];
    if (cache->walls + last->walls > MOST_GROWN && cache->used) {
        memset(cache->slot, 0, cache->slots * sizeof *cache->slot);
        cache->walls = cache->used = 0;
    }
    const size_t need = cache->walls + last->walls, first = need > FEWEST_GROWN_WALLS ? need : FEWEST_GROWN_WALLS;
    if (!reserve_slot(cache) ||
        !sunder_i_reserve(&cache->wall, &cache->capacity, cache->wall ? need : first, sizeof *cache->wall))
        return false;
    grown *slot = slot_of(cache, key);
    SUNDER_I_ASSERT(slot->n == 0);
    *slot = (grown){.key = *key, .first = (uint32_t)cache->walls, .n = last->walls};
    memcpy(slot->box, last->box, sizeof slot->box);
    memcpy(cache->wall + cache->walls, o->wall + last->wall, last->walls * sizeof *cache->wall);
    cache->walls += last->walls;
    cache->used++;
    return true;
}
