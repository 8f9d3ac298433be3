/* spool_index.h: the list of cells: the file `cells`. */
#ifndef GIS_SPOOL_INDEX_H
#define GIS_SPOOL_INDEX_H

#include "disk/file.h"
#include "shards/spool/spool.h"

/* Both files of a spool begin with this: the file type, the version, and a number that shows the byte order. */
typedef struct gis_spool_mark {
    char what[8];
    uint32_t version, order;
} gis_spool_mark;

gis_spool_mark gis_spool_mark_of(const char what[8]);
/* Fails, with a message that says why, if the mark is not one of file type `what`, this version and this byte order. */
bool gis_spool_mark_check(const gis_spool_mark *mark, const char what[8], const char *path, gis_error *error);

#define GIS_SPOOL_FEATURES "sundrFEA"
#define GIS_SPOOL_CELLS "sundrCEL"

/* A cell, and where its records are in `features`. */
typedef struct gis_spool_entry {
    gis_spool_cell cell;
    uint64_t from, bytes, checksum;
} gis_spool_entry;

/* [n] cells in the order of the curve. A zeroed index is empty. */
typedef struct gis_spool_index {
    gis_spool_entry *entry;
    size_t n, capacity;
    unsigned parts;
    uint64_t checksum; /* of the whole content */
} gis_spool_index;

/* Assigns the cells to `parts` parts. */
void gis_spool_index_deal(gis_spool_index *index, unsigned parts);
bool gis_spool_index_write(const gis_spool_index *index, const char *directory, gis_error *error);
bool gis_spool_index_read(gis_spool_index *index, const char *directory, gis_error *error);
void gis_spool_index_clear(gis_spool_index *index);

#endif
