/* array.h: arrays that grow. */
#ifndef GIS_ARRAY_H
#define GIS_ARRAY_H

#include <stdbool.h>
#include <stddef.h>

/* The part of gis_array_reserve() that is seldom needed: there is too little room. */
bool gis_array_grow(void *array, size_t *capacity, size_t needed, size_t size);

/* Reserves room for `needed` elements of this size in an array, given by the address of the pointer to it. Capacity at
 * least doubles, so appending takes constant time on average. False if memory is out; the array is unchanged then. */
static inline bool gis_array_reserve(void *array, size_t *capacity, size_t needed, size_t size)
{
    return needed <= *capacity || gis_array_grow(array, capacity, needed, size);
}

#endif
