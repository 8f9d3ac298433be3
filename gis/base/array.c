/* array.c: see array.h. `array` is the address of a pointer to any element type. C does not allow access to such a
 * pointer as a `void *`, so it is copied byte by byte. */
#include "base/array.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* The smallest capacity after the first growth. */
enum { FIRST = 16 };

bool gis_array_grow(void *array, size_t *capacity, size_t needed, size_t size)
{
    size_t larger = *capacity <= SIZE_MAX / 2 - FIRST ? 2 * *capacity + FIRST : needed;
    if (larger < needed) larger = needed;
    void *memory;
    memcpy(&memory, array, sizeof memory);
    void *grown = larger > SIZE_MAX / size ? NULL : realloc(memory, larger * size);
    if (!grown) return false;
    memcpy(array, &grown, sizeof grown);
    *capacity = larger;
    return true;
}
