/* index_boxes.h: the boxes of the features of a layer, for its spatial index: noted as the features are written, then
 * given back along a Hilbert curve [KF93]. They stay in memory; where a directory is named, they lie in a file there
 * and are sorted on the disk, to the same order. */
#ifndef GIS_INDEX_BOXES_H
#define GIS_INDEX_BOXES_H

#include <ogr_api.h>

#include "disk/file.h"

typedef struct gis_index_box {
    GIntBig fid;
    float side[4]; /* min x, max x, min y, max y, rounded outward */
} gis_index_box;

/* Zeroed, but for scratch: none. */
typedef struct gis_index_boxes {
    const char *scratch; /* the directory, borrowed; NULL: memory */
    gis_index_box *at;   /* [n], in memory */
    size_t n, capacity;
    gis_disk_file file;
    float around[4]; /* all of them, if n > 0 */
} gis_index_boxes;

bool gis_index_boxes_add(gis_index_boxes *boxes, GIntBig fid, const OGREnvelope *box, gis_error *error);

/* Takes each box in order; false ends it all. */
typedef bool gis_index_boxes_take(void *user, const gis_index_box *box, gis_error *error);
/* Once only: they are gone as they are taken. */
bool gis_index_boxes_in_order(gis_index_boxes *boxes, gis_index_boxes_take *take, void *user, gis_error *error);
void gis_index_boxes_clear(gis_index_boxes *boxes);

#endif
