/* subsum_list.h: a list of subsums as pairs of pieces, each once. */
#ifndef SUNDER_I_SUBSUM_LIST_H
#define SUNDER_I_SUBSUM_LIST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A pair has the number of the piece of p in its upper 32 bits and that of the piece of q in its lower ones. */
typedef struct sunder_i_subsum_list {
    uint64_t *pair;
    size_t n, capacity;
    uint32_t *slot; /* [slots] an index in the list, plus one; 0: free */
    size_t slots;   /* a power of two, or 0 */
    bool all;       /* leaving subsums out is not worth its cost: the list is empty and represents all subsums */
} sunder_i_subsum_list;

/* Appends `subsum` if it is not in the list yet. Returns false if out of memory. */
bool sunder_i_subsum_list_add(sunder_i_subsum_list *list, uint64_t subsum);
bool sunder_i_subsum_list_has(const sunder_i_subsum_list *list, uint64_t subsum);
/* Sorts the list when it is complete, and frees its hash table. Returns false if out of memory. */
bool sunder_i_subsum_list_finish(sunder_i_subsum_list *list);
void sunder_i_subsum_list_free(sunder_i_subsum_list *list);

#endif
