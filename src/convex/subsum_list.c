/* subsum_list.c: a list of subsums, and a hash table of their indices with open addressing, at most half full. */
#include "convex/subsum_list.h"

#include "base/memory.h"
#include "base/mix.h"
#include "base/sort.h"

#include <string.h>

#define LEAST_SLOTS 1024

/* Returns the slot of a subsum in the hash table, or the free slot for it. */
static size_t slot_of(const sunder_i_subsum_list *l, uint64_t subsum)
{
    size_t at = (size_t)((subsum * SUNDER_I_MIXER) >> 32) & (l->slots - 1);
    while (l->slot[at] && l->pair[l->slot[at] - 1] != subsum) at = (at + 1) & (l->slots - 1);
    return at;
}

static bool reserve_slot(sunder_i_subsum_list *l)
{
    if (2 * (l->n + 1) <= l->slots) return true;
    sunder_i_free(l->slot);
    l->slots = l->slots ? 2 * l->slots : LEAST_SLOTS;
    l->slot = sunder_i_calloc(l->slots, sizeof *l->slot);
    if (!l->slot) return false;
    for (size_t i = 0; i < l->n; i++) l->slot[slot_of(l, l->pair[i])] = (uint32_t)(i + 1);
    return true;
}

bool sunder_i_subsum_list_add(sunder_i_subsum_list *list, uint64_t subsum)
{
    if (!reserve_slot(list) || !sunder_i_reserve(&list->pair, &list->capacity, list->n + 1, sizeof *list->pair))
        return false;
    const size_t at = slot_of(list, subsum);
    if (list->slot[at]) return true;
    list->pair[list->n++] = subsum;
    list->slot[at] = (uint32_t)list->n;
    return true;
}

bool sunder_i_subsum_list_has(const sunder_i_subsum_list *list, uint64_t subsum)
{
    return list->n > 0 && list->slot[slot_of(list, subsum)];
}

bool sunder_i_subsum_list_finish(sunder_i_subsum_list *list)
{
    sunder_i_free(list->slot);
    list->slot = NULL;
    list->slots = 0;
    return sunder_i_sort_keys(list->pair, list->n);
}

void sunder_i_subsum_list_free(sunder_i_subsum_list *list)
{
    sunder_i_free_all(list->pair, list->slot);
    memset(list, 0, sizeof *list);
}
