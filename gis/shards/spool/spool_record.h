/* spool_record.h: a feature as bytes. A record begins with its head, at a multiple of 8, and takes a multiple of 8
 * bytes: then come what only some have, the coordinates, those of lines behind them, the ends of rings, of polygons and
 * of lines, and the text of the id. A layer is written twice and read as often before it is separated: so what says
 * nothing is left out. */
#ifndef GIS_SPOOL_RECORD_H
#define GIS_SPOOL_RECORD_H

#include "geometry/polygons.h"
#include "shards/spool/spool.h"

typedef struct gis_spool_head {
    /* As a gis_sort_head: */
    uint64_t bytes; /* of the whole record */
    uint64_t along; /* where its box is on the curve, once that is known */
    uint64_t index;
    int64_t fid;
    double weight, max_shift;
    uint32_t polygons, rings, vertices; /* one ring of one polygon has no ends */
    uint32_t has;                       /* spool_record.c */
} gis_spool_head;

/* A record in room that grows; *bytes of it. */
typedef struct gis_spool_room {
    unsigned char *at;
    size_t used, capacity;
} gis_spool_room;

bool gis_spool_record_make(gis_spool_room *room, const gis_spool_feature *feature, gis_error *error);
gis_spool_head *gis_spool_record_head(unsigned char *record);
/* Box of all that it covers, grown by its reach; of nothing box[0] > box[2]. The record is one. */
void gis_spool_record_box(const unsigned char *record, double box[4]);
/* How many vertices it has, lines' with them. */
size_t gis_spool_record_vertices(const unsigned char *record);
/* Into the record: the weight, the limit and the block, which has one if it had. */
void gis_spool_record_settle(unsigned char *record, const sunder_feature *demands);
/* Where the middle of a box is on a curve through `all`; 0 where it is empty (spool_writer.c). */
uint64_t gis_spool_along(const double all[4], const double box[4]);
/* The feature of a record that is whole: `left` bytes are there from it on; its shape stays NULL, and it has no lines.
 * False: it is no record. */
bool gis_spool_record_feature(unsigned char *record, size_t left, gis_spool_feature *feature);
/* Its lines, which live as long as the record and *end, which is room. */
bool gis_spool_record_lines(const unsigned char *record, size_t **end, size_t *capacity, sunder_obstacle *out,
                            gis_error *error);
/* Its shape; rings is room. */
bool gis_spool_record_shape(const unsigned char *record, gis_polygons *rings, sunder_shape **out, sunder_error *why);

#endif
