/* external_sort.h: records put in order by keys, in bounded memory. A record begins at a multiple of 8 with its head,
 * and takes a multiple of 8 bytes. Of those with the same keys the order is that in which they came. */
#ifndef GIS_EXTERNAL_SORT_H
#define GIS_EXTERNAL_SORT_H

#include "disk/file.h"

/* At most this many bytes of records are sorted at a time, and held while parts are merged; a single larger record is
 * held as well. */
#define GIS_SORT_BYTES ((size_t)16 << 20)

typedef struct gis_sort_head {
    uint64_t bytes; /* of the whole record */
    uint64_t first, second;
} gis_sort_head;

/* Takes each record in order; false ends it all. */
typedef bool gis_sort_take(void *user, const unsigned char *record, gis_error *error);

typedef struct gis_sorter gis_sorter;

/* parts: name of a file in the directory, made when there is more than `most` bytes (GIS_SORT_BYTES, where there is
 * nothing else). */
bool gis_sorter_new(const char *directory, const char *parts, size_t most, gis_sorter **out, gis_error *error);
bool gis_sorter_add(gis_sorter *sorter, const void *record, gis_error *error);
/* Once, when all are there. */
bool gis_sorter_take(gis_sorter *sorter, gis_sort_take *take, void *user, gis_error *error);
void gis_sorter_free(gis_sorter *sorter);

#endif
