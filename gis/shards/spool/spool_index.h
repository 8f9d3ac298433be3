/* spool_index.h: what cells there are: the file `cells`. */
#ifndef GIS_SPOOL_INDEX_H
#define GIS_SPOOL_INDEX_H

#include "disk/file.h"
#include "shards/spool/spool.h"

/* Both files begin with these: what they are, their version, and a number by which the order of bytes shows. */
typedef struct gis_spool_mark {
    char what[8];
    uint32_t version, order;
} gis_spool_mark;

gis_spool_mark gis_spool_mark_of(const char what[8]);
/* The first of them, if it is a mark for this; else the sentence says what is wrong. */
bool gis_spool_mark_check(const gis_spool_mark *mark, const char what[8], const char *path, gis_error *error);

#define GIS_SPOOL_FEATURES "sundrFEA"
#define GIS_SPOOL_CELLS "sundrCEL"

/* A cell, and where its records are. */
typedef struct gis_spool_entry {
    gis_spool_cell cell;
    uint64_t from, bytes, checksum;
} gis_spool_entry;

/* [n] in the order of the curve. Zeroed: empty. */
typedef struct gis_spool_index {
    gis_spool_entry *entry;
    size_t n, capacity;
    unsigned parts;
    uint64_t checksum; /* of all that it says */
} gis_spool_index;

/* Deals the cells to that many parts. */
void gis_spool_index_deal(gis_spool_index *index, unsigned parts);
bool gis_spool_index_write(const gis_spool_index *index, const char *directory, gis_error *error);
bool gis_spool_index_read(gis_spool_index *index, const char *directory, gis_error *error);
void gis_spool_index_clear(gis_spool_index *index);

#endif
