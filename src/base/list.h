/* list.h: growing lists of numbers, and sorted sets of numbers. */
#ifndef SUNDER_I_LIST_H
#define SUNDER_I_LIST_H

#include "base/memory.h"

typedef struct sunder_i_list {
    uint32_t *item;
    size_t n, capacity;
} sunder_i_list;

/* Appends `item`. Returns false if out of memory. */
static inline bool sunder_i_list_push(sunder_i_list *list, uint32_t item)
{
    if (list->n == list->capacity && !sunder_i_reserve(&list->item, &list->capacity, list->n + 1, sizeof item))
        return false;
    list->item[list->n++] = item;
    return true;
}

/* Copies `from` to an empty list, without spare capacity: of a million lists most have few numbers, or none. Returns
 * false if out of memory. */
bool sunder_i_list_copy(sunder_i_list *list, const sunder_i_list *from);

/* Compares two uint32_t numbers, for qsort() and bsearch(). */
int sunder_i_by_number(const void *a, const void *b);
/* Sorts n numbers and removes repeated ones. Returns the number of those left. */
size_t sunder_i_set_make(uint32_t *number, size_t n);
bool sunder_i_set_has(const uint32_t *set, size_t n, uint32_t number);

/* Two numbers of features or bodies. */
typedef struct sunder_i_id_pair {
    uint32_t a, b;
} sunder_i_id_pair;

/* Compares items that begin with two uint32_t numbers by these, or with three, or four; for qsort() and bsearch(). */
int sunder_i_by_id_pair(const void *a, const void *b);
int sunder_i_by_id_triple(const void *a, const void *b);
int sunder_i_by_id_quadruple(const void *a, const void *b);
/* Returns the index of the first of n items, sorted by `order`, that does not come before the key; n if all come before
 * it. */
size_t sunder_i_lower_bound(const void *key, const void *item, size_t n, size_t size,
                            int (*order)(const void *, const void *));

#endif
