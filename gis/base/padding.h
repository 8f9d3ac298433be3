/* padding.h: padding bytes of structures. Structures that are written to disk as they lie in memory have their padding
 * zeroed: equal values then have equal bytes, and no stale memory gets into a file. */
#ifndef GIS_PADDING_H
#define GIS_PADDING_H

#include <stddef.h>

/* From one byte of a structure up to another. */
typedef struct gis_hole {
    size_t from, to;
} gis_hole;

/* Between a member and the next one; behind the last one. `type` is a name, a member may be one of a member's: a.b. */
#define GIS_HOLE_END(type, member) (offsetof(type, member) + sizeof((type *)0)->member)
#define GIS_HOLE_BETWEEN(type, member, next)                                                                           \
    {                                                                                                                  \
        GIS_HOLE_END(type, member), offsetof(type, next)                                                               \
    }
#define GIS_HOLE_BEHIND(type, member)                                                                                  \
    {                                                                                                                  \
        GIS_HOLE_END(type, member), sizeof(type)                                                                       \
    }

/* [count] things of `size` bytes, each with these holes. */
void gis_fill_holes(void *things, size_t count, size_t size, const gis_hole *hole, size_t holes);

#endif
