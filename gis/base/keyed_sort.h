/* keyed_sort.h: sorts large arrays by an integer key. */
#ifndef GIS_KEYED_SORT_H
#define GIS_KEYED_SORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A key, and a number that is sorted along with it. */
typedef struct gis_keyed {
    uint64_t key, with;
} gis_keyed;

/* Sorts by ascending keys; elements with equal keys keep their order. Returns false if out of memory; then the list is
 * unchanged. */
bool gis_keyed_sort(gis_keyed *list, size_t n);

#endif
