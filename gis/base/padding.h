/* padding.h: clears the padding bytes of structures. Structures that are written to disk as they are in memory get
 * their padding zeroed, so that equal values have equal bytes, and no old memory contents get into a file. */
#ifndef GIS_PADDING_H
#define GIS_PADDING_H

#include <stddef.h>

/* Padding from one byte offset of a structure up to another. */
typedef struct gis_padding {
    size_t from, to;
} gis_padding;

/* The padding between a member and the next one, or behind the last one. `member` may be a member of a member, such as
 * a.b. */
#define GIS_PADDING_START(type, member) (offsetof(type, member) + sizeof((type *)0)->member)
#define GIS_PADDING_BETWEEN(type, member, next)                                                                        \
    {                                                                                                                  \
        GIS_PADDING_START(type, member), offsetof(type, next)                                                          \
    }
#define GIS_PADDING_BEHIND(type, member)                                                                               \
    {                                                                                                                  \
        GIS_PADDING_START(type, member), sizeof(type)                                                                  \
    }

/* Clears the padding of `count` structures of `size` bytes, each with the same `holes` stretches of padding. */
void gis_clear_padding(void *things, size_t count, size_t size, const gis_padding *hole, size_t holes);

#endif
