/* Lists of numbers that grow, and sorted sets of them. */
#ifndef SUNDER_I_LIST_H
#define SUNDER_I_LIST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sunder_i_list {
    uint32_t *item;
    size_t n, capacity;
} sunder_i_list;

/* For qsort() and bsearch(). */
int sunder_i_by_number(const void *a, const void *b);
/* Sorts n numbers and drops repeats; returns how many are left. */
size_t sunder_i_set_make(uint32_t *number, size_t n);
bool sunder_i_set_has(const uint32_t *set, size_t n, uint32_t number);

/* Two numbers, of features or bodies. */
typedef struct sunder_i_couple {
    uint32_t a, b;
} sunder_i_couple;

/* For qsort(). */
int sunder_i_by_couple(const void *a, const void *b);
/* Where the pair, in either order, is in a sorted list of pairs with the lesser first; n if it is not. */
size_t sunder_i_couple_at(const sunder_i_couple *list, size_t n, uint32_t x, uint32_t y);

#endif
