/* heap.h: a binary heap in an array: the item that comes before all others is the first, and item i never comes before
 * item (i - 1) / 2.
 *
 * The order in which equal items are removed is part of the contract, since a search may depend on it: a new item moves
 * up past items that it comes before, but not past equal ones. An item that moves down goes below the right child if
 * that child comes before the left one, else below the left child, and stops above its equals. If no two items are
 * equal, this makes no difference.
 *
 * Items may have any size; the functions are inlined with a known size and order, so that they are as fast as a heap
 * written for one type. */
#ifndef SUNDER_I_HEAP_H
#define SUNDER_I_HEAP_H

#include "base/invariant.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* Returns true if a comes before b; a strict weak order. */
typedef bool (*sunder_i_before)(const void *a, const void *b);

#define SUNDER_I_INLINE static inline __attribute__((always_inline))

/* Moves v, an item outside the array, up from position i. */
SUNDER_I_INLINE void sunder_i_heap_climb(void *heap, size_t i, size_t size, const void *v, sunder_i_before before)
{
    unsigned char *at = heap;
    for (; i > 0 && before(v, at + (i - 1) / 2 * size); i = (i - 1) / 2)
        memcpy(at + i * size, at + (i - 1) / 2 * size, size);
    memcpy(at + i * size, v, size);
}

/* Moves v, an item outside the array, down from position i of n. */
SUNDER_I_INLINE void sunder_i_heap_sink(void *heap, size_t n, size_t i, size_t size, const void *v,
                                        sunder_i_before before)
{
    unsigned char *at = heap;
    for (size_t k = 2 * i + 1; k < n; i = k, k = 2 * k + 1) {
        /* Without a branch, since neither child is more likely than the other. A single child does not come before
         * itself. */
        const size_t right = k + 1 < n ? k + 1 : k;
        k += (size_t)before(at + right * size, at + k * size);
        if (!before(at + k * size, v)) break;
        memcpy(at + i * size, at + k * size, size);
    }
    memcpy(at + i * size, v, size);
}

/* Adds v to the n items; the array must have room. */
SUNDER_I_INLINE void sunder_i_heap_push(void *heap, size_t *n, size_t size, const void *v, sunder_i_before before)
{
    sunder_i_heap_climb(heap, (*n)++, size, v, before);
}

/* Removes the first of n > 0 items and stores it in *first. */
SUNDER_I_INLINE void sunder_i_heap_pop(void *heap, size_t *n, size_t size, void *first, sunder_i_before before)
{
    SUNDER_I_ASSERT(*n > 0);
    memcpy(first, heap, size);
    if (--*n) sunder_i_heap_sink(heap, *n, 0, size, (unsigned char *)heap + *n * size, before);
}

/* Converts an array of n items in any order to a heap. scratch: memory for one item. */
SUNDER_I_INLINE void sunder_i_heap_make(void *heap, size_t n, size_t size, void *scratch, sunder_i_before before)
{
    for (size_t i = n / 2; i-- > 0;) {
        memcpy(scratch, (unsigned char *)heap + i * size, size);
        sunder_i_heap_sink(heap, n, i, size, scratch, before);
    }
}

#endif
