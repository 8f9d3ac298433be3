/* keyed_sort.h: many things sorted by a number. */
#ifndef GIS_KEYED_SORT_H
#define GIS_KEYED_SORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A number, and what goes along with it. */
typedef struct gis_keyed {
    uint64_t key, with;
} gis_keyed;

/* By rising keys; alike ones keep their order. False if memory is out, and the list as it was. */
bool gis_keyed_sort(gis_keyed *list, size_t n);

#endif
