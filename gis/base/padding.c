/* padding.c: see padding.h. */
#include "base/padding.h"

#include <string.h>

void gis_clear_padding(void *things, size_t count, size_t size, const gis_padding *hole, size_t holes)
{
    unsigned char *thing = things;
    if (holes == 0) return;
    for (size_t k = 0; k < count; k++, thing += size)
        for (size_t h = 0; h < holes; h++) memset(thing + hole[h].from, 0, hole[h].to - hole[h].from);
}
