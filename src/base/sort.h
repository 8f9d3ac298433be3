/* sort.h: sorting with memory from the allocation hooks: stable merge sort of indices by an exact comparison, radix
 * sort of keys, and insertion sort for short lists that are sorted often. */
#ifndef SUNDER_I_SORT_H
#define SUNDER_I_SORT_H

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* Sorts n indices so that compare(context, index[i], index[i + 1]) <= 0; stable. Returns false if out of memory. */
bool sunder_i_sort_indices(uint32_t *index, size_t n, int (*compare)(void *context, uint32_t a, uint32_t b),
                           void *context);

/* A comparison for sunder_i_sort_indices(): the context is an array of doubles, and the index of the greater one comes
 * first. */
int sunder_i_descending(void *doubles, uint32_t a, uint32_t b);

/* Sorts n keys in ascending order. Returns false if out of memory. */
bool sunder_i_sort_keys(uint64_t *key, size_t n);

/* Shorter lists are sorted by insertion: the vertices of most features, the bodies of most clusters. */
#define SUNDER_I_FEW_TO_SORT 25
/* The largest size of an item, in bytes. */
#define SUNDER_I_MOST_ITEM 64

/* Sorts n items like qsort(). The comparison is inlined; items that it calls equal must be interchangeable. */
static inline void sunder_i_sort_few(void *list, size_t n, size_t size, int (*compare)(const void *, const void *))
{
    char *item = list;
    _Alignas(double) char held[SUNDER_I_MOST_ITEM];
    if (n >= SUNDER_I_FEW_TO_SORT) {
        qsort(list, n, size, compare);
        return;
    }
    for (size_t k = 1; k < n; k++) {
        size_t at = k;
        memcpy(held, item + k * size, size);
        for (; at > 0 && compare(item + (at - 1) * size, held) > 0; at--)
            memcpy(item + at * size, item + (at - 1) * size, size);
        memcpy(item + at * size, held, size);
    }
}

/* An item with a double, for lists that are first sorted by doubles; `mark` is moved with the item. */
typedef struct sunder_i_valued {
    double value;
    uint32_t item, mark;
} sunder_i_valued;

/* Sorts n elements by value, ascending and stable. The array must have room for 2 n elements; the contents of its
 * second half are lost. Returns false if cancelled. */
bool sunder_i_sort_valued(sunder_i_valued *valued, size_t n);

#endif
