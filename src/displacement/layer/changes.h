/* Which features have moved since the last query: as flags, and as a list, so that the cost of an update depends on the
 * number that moved, not on the size of the layer. */
#ifndef SUNDER_I_CHANGES_H
#define SUNDER_I_CHANGES_H

#include "base/list.h"

#include <string.h>

typedef struct sunder_i_changes {
    bool *is;           /* [things] */
    sunder_i_list list; /* the things that are set in `is`, each once; unordered until sunder_i_changes_sort() */
    size_t things;
    bool failed; /* memory was out: the list is incomplete */
} sunder_i_changes;

/* An empty set over `things` things. On failure the caller still frees it. */
static inline bool sunder_i_changes_init(sunder_i_changes *changes, size_t things)
{
    *changes = (sunder_i_changes){.is = sunder_i_calloc(things, sizeof *changes->is), .things = things};
    return changes->is != NULL;
}

static inline void sunder_i_changes_free(sunder_i_changes *changes)
{
    sunder_i_free(changes->is);
    sunder_i_free(changes->list.item);
    *changes = (sunder_i_changes){0};
}

/* Empties the set, and forgets a failure. */
static inline void sunder_i_changes_clear(sunder_i_changes *changes)
{
    for (size_t k = 0; k < changes->list.n && !changes->failed; k++) changes->is[changes->list.item[k]] = false;
    if (changes->failed && changes->things) memset(changes->is, 0, changes->things * sizeof *changes->is);
    changes->list.n = 0;
    changes->failed = false;
}

/* Adds thing f. If memory is out changes->failed is set. */
static inline void sunder_i_changes_add(sunder_i_changes *changes, uint32_t f)
{
    if (changes->is[f]) return;
    changes->is[f] = true;
    if (!sunder_i_list_push(&changes->list, f)) changes->failed = true;
}

/* Sorts the list in ascending order. Returns false if memory was out when a thing was added. */
static inline bool sunder_i_changes_sort(sunder_i_changes *changes)
{
    if (!changes->failed) changes->list.n = sunder_i_set_make(changes->list.item, changes->list.n);
    return !changes->failed;
}

#endif
