/* digest_list.h: the hashes of features (digest.h) in the order in which they were sent. They are kept in memory or, if
 * `scratch` names a directory, in a file there that is read in order, a block at a time. */
#ifndef GIS_DIGEST_LIST_H
#define GIS_DIGEST_LIST_H

#include "disk/file.h"

typedef struct gis_digest {
    uint64_t place, values;
} gis_digest;

/* A zeroed list is empty; `scratch` may be set. */
typedef struct gis_digest_list {
    const char *scratch; /* directory for the file, borrowed; NULL: in memory */
    gis_digest *at;      /* the hashes with numbers from ... held - 1; if scratch is NULL, all of them */
    size_t n, from, held, capacity;
    gis_disk_file file;
} gis_digest_list;

bool gis_digest_list_add(gis_digest_list *list, gis_digest one, gis_error *error);
/* Gets the hash with number k. After the first call nothing may be added. Reading in ascending order is fast, since
 * blocks are loaded. */
bool gis_digest_list_get(gis_digest_list *list, size_t k, gis_digest *out, gis_error *error);
/* Makes the first n hashes available in memory as at[0] ... at[n - 1]. */
bool gis_digest_list_hold(gis_digest_list *list, size_t n, gis_error *error);
void gis_digest_list_clear(gis_digest_list *list);

#endif
