/* Lists of numbers that grow, and sorted sets of them. */
#ifndef SUNDER_I_LIST_H
#define SUNDER_I_LIST_H

#include "base/memory.h"

typedef struct sunder_i_list {
    uint32_t *item;
    size_t n, capacity;
} sunder_i_list;

/* False if memory is out. */
static inline bool sunder_i_list_push(sunder_i_list *list, uint32_t item)
{
    if (list->n == list->capacity && !sunder_i_reserve(&list->item, &list->capacity, list->n + 1, sizeof item))
        return false;
    list->item[list->n++] = item;
    return true;
}

/* An empty list becomes a copy, without spare capacity: in a million lists most hold few numbers, or none. False if
 * memory is out. */
bool sunder_i_list_copy(sunder_i_list *list, const sunder_i_list *from);

/* For qsort() and bsearch(). */
int sunder_i_by_number(const void *a, const void *b);
/* Sorts n numbers and drops repeats; returns how many are left. */
size_t sunder_i_set_make(uint32_t *number, size_t n);
bool sunder_i_set_has(const uint32_t *set, size_t n, uint32_t number);

/* Two numbers, of features or bodies. */
typedef struct sunder_i_id_pair {
    uint32_t a, b;
} sunder_i_id_pair;

/* For qsort() and bsearch(): of any items that begin with two numbers, by these. */
int sunder_i_by_id_pair(const void *a, const void *b);
/* The first of n items, in this order, that does not come before the key; n if all do. */
size_t sunder_i_lower_bound(const void *key, const void *item, size_t n, size_t size,
                            int (*order)(const void *, const void *));

#endif
