/* array.c: see array.h. The pointer is read and written as bytes: it is one to any type, and C does not let it be taken
 * for a `void *` in its place. */
#include "base/array.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Least capacity of an array after its first growth: most arrays hold a few elements, or very many. */
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
