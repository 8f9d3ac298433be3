/* rtree.h: the spatial index of a GeoPackage layer, packed at the end instead of grown row by row.
 *
 * GDAL fills the R-tree by SQLite's own INSERT, one feature at a time, which takes most of the time of writing a layer.
 * The tree is an ordinary table of nodes, though, and sorted boxes can be laid into it directly: the result is smaller
 * and quicker to search, and every reader takes it for what it is. */
#ifndef GIS_RTREE_H
#define GIS_RTREE_H

#include <gdal.h>
#include <ogr_api.h>

#include "base/error.h"

/* The boxes of the features of one layer. A zeroed struct is empty. */
typedef struct gis_boxes {
    struct gis_box {
        GIntBig fid;
        float side[4]; /* min x, max x, min y, max y, rounded outward */
    } * at;
    size_t n, capacity;
    char *trigger; /* the trigger that fills the tree at each INSERT, taken away meanwhile; NULL: the tree is GDAL's */
} gis_boxes;

/* To be called when the layer and its fields are made and it has no features yet: makes GDAL create its (empty) index
 * now, and takes away the trigger that would fill it. Does nothing where GDAL makes no index, or another than known. */
bool gis_rtree_begin(GDALDatasetH dataset, OGRLayerH layer, gis_boxes *boxes, gis_error *error);
/* Notes a feature that was written. */
bool gis_rtree_add(gis_boxes *boxes, OGRFeatureH feature, gis_error *error);
bool gis_rtree_add_box(gis_boxes *boxes, GIntBig fid, const OGREnvelope *box, gis_error *error);
/* Fills the tree and puts the trigger back. */
bool gis_rtree_end(GDALDatasetH dataset, OGRLayerH layer, gis_boxes *boxes, gis_error *error);
void gis_boxes_clear(gis_boxes *boxes);

#endif
