/* digest_list.h: the hashes of features (digest.h) in the order in which they were sent: in memory, or, where a
 * directory is named, in a file there, which is read in that order, a stretch at a time. */
#ifndef GIS_DIGEST_LIST_H
#define GIS_DIGEST_LIST_H

#include "disk/file.h"

typedef struct gis_digest {
    uint64_t place, values;
} gis_digest;

/* Zeroed, but for scratch: empty. */
typedef struct gis_digest_list {
    const char *scratch; /* the directory, borrowed; NULL: memory */
    gis_digest *at;      /* held - from of them, from number `from` on; in memory: all */
    size_t n, from, held, capacity;
    gis_disk_file file;
} gis_digest_list;

bool gis_digest_list_add(gis_digest_list *list, gis_digest one, gis_error *error);
/* Number k; after the first call nothing is added. Those that follow each other are read at once. */
bool gis_digest_list_get(gis_digest_list *list, size_t k, gis_digest *out, gis_error *error);
/* The first n are in memory: at[0] to at[n - 1]. */
bool gis_digest_list_hold(gis_digest_list *list, size_t n, gis_error *error);
void gis_digest_list_clear(gis_digest_list *list);

#endif
