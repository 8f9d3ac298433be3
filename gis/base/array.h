/* array.h: growing arrays. */
#ifndef GIS_ARRAY_H
#define GIS_ARRAY_H

#include <stdbool.h>
#include <stddef.h>

/* Called by gis_array_reserve() if the capacity is too small. */
bool gis_array_grow(void *array, size_t *capacity, size_t needed, size_t size);

/* Reserves room for `needed` elements of `size` bytes in an array, given by the address of the pointer to it. The
 * capacity at least doubles, so that appending takes constant time on average. Returns false if out of memory; then the
 * array is unchanged. */
static inline bool gis_array_reserve(void *array, size_t *capacity, size_t needed, size_t size)
{
    return needed <= *capacity || gis_array_grow(array, capacity, needed, size);
}

#endif
