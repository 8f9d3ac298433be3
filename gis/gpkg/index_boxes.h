/* index_boxes.h: the boxes of a layer's features, for its spatial index: added as features are written, then returned
 * in the order of a Hilbert curve [KF93]. They are kept in memory; if `scratch` names a directory, they are in a file
 * there and are sorted on disk, to the same order. */
#ifndef GIS_INDEX_BOXES_H
#define GIS_INDEX_BOXES_H

#include <ogr_api.h>

#include "disk/file.h"

typedef struct gis_index_box {
    GIntBig fid;
    float side[4]; /* min x, max x, min y, max y, rounded outward */
} gis_index_box;

/* A zeroed struct is empty; `scratch` may be set. */
typedef struct gis_index_boxes {
    const char *scratch; /* directory for the file, borrowed; NULL: in memory */
    gis_index_box *at;   /* [n], if in memory */
    size_t n, capacity;
    gis_disk_file file;
    float around[4]; /* box of all boxes, if n > 0 */
} gis_index_boxes;

bool gis_index_boxes_add(gis_index_boxes *boxes, GIntBig fid, const OGREnvelope *box, gis_error *error);

/* Gets each box in order; returning false ends the loop. */
typedef bool gis_index_boxes_take(void *user, const gis_index_box *box, gis_error *error);
/* Calls `take` for all boxes in order. Only once: the boxes are dropped. */
bool gis_index_boxes_in_order(gis_index_boxes *boxes, gis_index_boxes_take *take, void *user, gis_error *error);
void gis_index_boxes_clear(gis_index_boxes *boxes);

#endif
