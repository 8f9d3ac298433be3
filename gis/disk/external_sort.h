/* external_sort.h: sorts records by two keys in bounded memory. A record begins with a gis_sort_head and has a multiple
 * of 8 bytes. Records with equal keys keep the order in which they were added. */
#ifndef GIS_EXTERNAL_SORT_H
#define GIS_EXTERNAL_SORT_H

#include "disk/file.h"

/* The usual bound: at most this number of bytes of records is sorted at once, and held while runs are merged; a single
 * larger record is held as well. */
#define GIS_SORT_BYTES ((size_t)16 << 20)

typedef struct gis_sort_head {
    uint64_t bytes; /* of the whole record */
    uint64_t first, second;
} gis_sort_head;

/* Gets each record in order; returning false ends the loop. */
typedef bool gis_sort_take(void *user, const unsigned char *record, gis_error *error);

typedef struct gis_sorter gis_sorter;

/* parts: the name of a file in the directory, which is made if there are more than `most` bytes of records (usually
 * GIS_SORT_BYTES). */
bool gis_sorter_new(const char *directory, const char *parts, size_t most, gis_sorter **out, gis_error *error);
bool gis_sorter_add(gis_sorter *sorter, const void *record, gis_error *error);
/* Calls `take` for all records in order. Only once, after all were added. */
bool gis_sorter_take(gis_sorter *sorter, gis_sort_take *take, void *user, gis_error *error);
void gis_sorter_free(gis_sorter *sorter);

#endif
