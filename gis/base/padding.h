/* padding.h: padding bytes of structures. Structures that are written to disk as they lie in memory have their padding
 * zeroed: equal values then have equal bytes, and no stale memory gets into a file. */
#ifndef GIS_PADDING_H
#define GIS_PADDING_H

#include <stddef.h>

/* From one byte of a structure up to another. */
typedef struct gis_padding {
    size_t from, to;
} gis_padding;

/* Between a member and the next one; behind the last one. `type` is a name, a member may be one of a member's: a.b. */
#define GIS_PADDING_START(type, member) (offsetof(type, member) + sizeof((type *)0)->member)
#define GIS_PADDING_BETWEEN(type, member, next)                                                                        \
    {                                                                                                                  \
        GIS_PADDING_START(type, member), offsetof(type, next)                                                          \
    }
#define GIS_PADDING_BEHIND(type, member)                                                                               \
    {                                                                                                                  \
        GIS_PADDING_START(type, member), sizeof(type)                                                                  \
    }

/* [count] things of `size` bytes, each with these holes. */
void gis_clear_padding(void *things, size_t count, size_t size, const gis_padding *hole, size_t holes);

#endif
