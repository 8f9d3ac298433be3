/* Sorting on memory of our own: stable merge sort of indices by an exact comparison, radix sort of keys. */
#ifndef SUNDER_I_SORT_H
#define SUNDER_I_SORT_H

#include "base/memory.h"

/* Sorts n indices so that compare(context, index[i], index[i + 1]) <= 0; stable. False if memory is out. */
bool sunder_i_sort_indices(uint32_t *index, size_t n, int (*compare)(void *context, uint32_t a, uint32_t b),
                           void *context);

/* For that: the greater of two doubles, of an array that is the context, comes first. */
int sunder_i_descending(void *doubles, uint32_t a, uint32_t b);

/* Sorts n keys ascending. False if memory is out. */
bool sunder_i_sort_keys(uint64_t *key, size_t n);

#endif
