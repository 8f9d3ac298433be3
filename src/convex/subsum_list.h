/* Subsums as pairs of pieces, each once. */
#ifndef SUNDER_I_SUBSUM_LIST_H
#define SUNDER_I_SUBSUM_LIST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The piece of p above, of q in the lower 32 bits of a pair. */
typedef struct sunder_i_subsum_list {
    uint64_t *pair;
    size_t n, capacity;
    uint32_t *slot; /* [slots] index in the list, plus one; 0: free */
    size_t slots;   /* a power of two, or 0 */
    bool all;       /* leaving some out does not pay: the list is empty and means all subsums */
} sunder_i_subsum_list;

/* Appends one that is not in the list yet. False if memory is out. */
bool sunder_i_subsum_list_add(sunder_i_subsum_list *list, uint64_t subsum);
bool sunder_i_subsum_list_has(const sunder_i_subsum_list *list, uint64_t subsum);
/* Sorts the list once it is complete. False if memory is out. */
bool sunder_i_subsum_list_finish(sunder_i_subsum_list *list);
void sunder_i_subsum_list_free(sunder_i_subsum_list *list);

#endif
