/* array.h: arrays that grow. */
#ifndef GIS_ARRAY_H
#define GIS_ARRAY_H

#include <stdbool.h>
#include <stddef.h>

/* The part of gis_array_reserve() that is seldom needed: there is too little room. */
bool gis_array_grow(void *array, size_t *capacity, size_t needed, size_t size);

/* Room for so many elements of this size in an array, given by the address of the pointer to it; it at least doubles,
 * so that appending costs the same each time, on the whole. False: memory is out, and the array as it was. */
static inline bool gis_array_reserve(void *array, size_t *capacity, size_t needed, size_t size)
{
    return needed <= *capacity || gis_array_grow(array, capacity, needed, size);
}

#endif
