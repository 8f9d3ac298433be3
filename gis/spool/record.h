/* record.h: a feature as bytes. A record begins with its head, at a multiple of 8, and takes a multiple of 8 bytes:
 * then come the coordinates, the ends of rings and of polygons, and the text of the id. */
#ifndef GIS_SPOOL_RECORD_H
#define GIS_SPOOL_RECORD_H

#include "base/polygons.h"
#include "spool/spool.h"

typedef struct gis_spool_head {
    uint64_t bytes; /* of the whole record */
    uint64_t along; /* where its box is on the curve, once that is known */
    uint64_t index;
    int64_t fid, block;
    double weight, max_shift, area, start[2];
    double box[4];                                /* of an empty shape box[0] > box[2] */
    uint32_t polygons, rings, vertices, id_bytes; /* with the NUL; 0: there is none */
    uint32_t fixed, repaired;
} gis_spool_head;

/* A record in room that grows; *bytes of it. */
typedef struct gis_spool_room {
    unsigned char *at;
    size_t used, capacity;
} gis_spool_room;

bool gis_spool_record_make(gis_spool_room *room, const gis_spool_feature *feature, gis_error *error);
gis_spool_head *gis_spool_record_head(unsigned char *record);
/* The feature of a record that is whole: `left` bytes are there from it on; its shape stays NULL. False: it is no
 * record. */
bool gis_spool_record_feature(unsigned char *record, size_t left, gis_spool_feature *feature);
/* Its shape; rings is room. */
bool gis_spool_record_shape(const unsigned char *record, gis_polygons *rings, sunder_shape **out, sunder_error *why);

#endif
