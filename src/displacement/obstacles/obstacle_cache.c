/* Obstacles kept at hand. Bodies do not turn, so the obstacle that two pieces are to each other is the same wherever
 * they stand, and a descent asks for it in every round. */
#include "displacement/obstacles/obstacle_cache.h"

#include "base/memory.h"

#include <string.h>

/* Beyond so many edges all are thrown away: some megabytes. */
#define MOST_EDGES 131072u
#define FEWEST_SLOTS 64u

typedef struct sunder_i_shelved {
    uint64_t key; /* 0: nobody's */
    uint32_t first, n;
} shelved;

void sunder_i_shelf_free(sunder_i_shelf *shelf)
{
    sunder_i_free(shelf->slot);
    sunder_i_free(shelf->edge);
    memset(shelf, 0, sizeof *shelf);
}

/* Where that key is, or would be. */
static size_t slot_of(const sunder_i_shelf *shelf, uint64_t key)
{
    size_t k = (size_t)((key * UINT64_C(0x9e3779b97f4a7c15)) >> 32) & (shelf->slots - 1);
    while (shelf->slot[k].key && shelf->slot[k].key != key) k = (k + 1) & (shelf->slots - 1);
    return k;
}

const sunder_i_edge *sunder_i_shelf_find(const sunder_i_shelf *shelf, uint64_t key, size_t *n)
{
    if (shelf->slots == 0) return NULL;
    const shelved *s = &shelf->slot[slot_of(shelf, key)];
    *n = s->n;
    return s->key ? shelf->edge + s->first : NULL;
}

/* Room for one more key, no more than half of the slots in use. */
static bool make_room(sunder_i_shelf *shelf)
{
    if (2 * (shelf->used + 1) <= shelf->slots) return true;
    sunder_i_shelf larger = *shelf;
    larger.slots = shelf->slots ? 2 * shelf->slots : FEWEST_SLOTS;
    larger.slot = sunder_i_calloc(larger.slots, sizeof *larger.slot);
    if (!larger.slot) return false;
    for (size_t k = 0; k < shelf->slots; k++)
        if (shelf->slot[k].key) larger.slot[slot_of(&larger, shelf->slot[k].key)] = shelf->slot[k];
    sunder_i_free(shelf->slot);
    *shelf = larger;
    return true;
}

const sunder_i_edge *sunder_i_shelf_add(sunder_i_shelf *shelf, uint64_t key, const double *d, size_t *n)
{
    if (shelf->edges + *n > MOST_EDGES && shelf->slots) {
        memset(shelf->slot, 0, shelf->slots * sizeof *shelf->slot);
        shelf->edges = shelf->used = 0;
    }
    if (!make_room(shelf) || !sunder_i_reserve(&shelf->edge, &shelf->capacity, shelf->edges + *n, sizeof *shelf->edge))
        return NULL;
    sunder_i_edge *edge = shelf->edge + shelf->edges;
    *n = sunder_i_edges_of(d, *n, edge);
    shelf->slot[slot_of(shelf, key)] = (shelved){key, (uint32_t)shelf->edges, (uint32_t)*n};
    shelf->edges += *n;
    shelf->used++;
    return edge;
}
