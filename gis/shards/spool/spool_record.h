/* spool_record.h: a feature as bytes. A record begins at a multiple of 8 and has a multiple of 8 bytes: its head, the
 * optional members, the coordinates of rings and of lines, the ends of rings, polygons and lines, and the text of the
 * id. A layer is written and read twice before it is separated, so members with default values are left out. */
#ifndef GIS_SPOOL_RECORD_H
#define GIS_SPOOL_RECORD_H

#include "geometry/polygons.h"
#include "shards/spool/spool.h"

typedef struct gis_spool_head {
    /* The first members are those of a gis_sort_head: */
    uint64_t bytes; /* size of the whole record */
    uint64_t along; /* position of the centre of its box on the curve, once that is known */
    uint64_t index;
    int64_t fid;
    double weight, max_shift;
    uint32_t polygons, rings, vertices; /* a single polygon with a single ring is stored without ends */
    uint32_t has;                       /* bits of the optional members (spool_record.c) */
} gis_spool_head;

/* A growing buffer for records. */
typedef struct gis_spool_room {
    unsigned char *at;
    size_t used, capacity;
} gis_spool_room;

bool gis_spool_record_make(gis_spool_room *room, const gis_spool_feature *feature, gis_error *error);
gis_spool_head *gis_spool_record_head(unsigned char *record);
/* The box of a valid record's geometry, enlarged by its reach; box[0] > box[2] if it is empty. */
void gis_spool_record_box(const unsigned char *record, double box[4]);
/* The number of vertices, including those of lines. */
size_t gis_spool_record_vertices(const unsigned char *record);
/* Writes the weight, the limit and (if the record has one) the block into the record. */
void gis_spool_record_settle(unsigned char *record, const sunder_feature *demands);
/* The position of a box's centre on a curve through the box `all`; 0 if one of the boxes is empty (spool_writer.c). */
uint64_t gis_spool_along(const double all[4], const double box[4]);
/* Parses a record for which `left` bytes are available; the feature gets no shape (NULL) and no lines. False: it is not
 * a valid record. */
bool gis_spool_record_feature(unsigned char *record, size_t left, gis_spool_feature *feature);
/* The lines of a record. They point into the record and into *end, a buffer that grows to `capacity`. */
bool gis_spool_record_lines(const unsigned char *record, size_t **end, size_t *capacity, sunder_obstacle *out,
                            gis_error *error);
/* The rings of the shape that the feature had before it became larger; they point into the record and into `rings`, a
 * reusable buffer. */
bool gis_spool_record_given(const unsigned char *record, gis_polygons *rings, gis_spool_rings *out, gis_error *error);
/* Makes the shape of a record; `rings` is a reusable buffer. */
bool gis_spool_record_shape(const unsigned char *record, gis_polygons *rings, sunder_shape **out, sunder_error *why);

#endif
