/* gpkg_rtree.h: the spatial index of a GeoPackage layer, packed at the end instead of grown row by row.
 *
 * GDAL fills the R-tree by SQLite's own INSERT, one feature at a time, which takes most of the time of writing a layer.
 * The tree is an ordinary table of nodes, though, and sorted boxes can be laid into it directly: the result is smaller
 * and quicker to search, and every reader takes it for what it is. */
#ifndef GIS_GPKG_RTREE_H
#define GIS_GPKG_RTREE_H

#include <gdal.h>
#include <ogr_api.h>

#include "gpkg/index_boxes.h"

/* Zeroed, but for boxes.scratch: none. */
typedef struct gis_rtree {
    gis_index_boxes boxes;
    char *trigger; /* which fills the tree at each INSERT, taken away meanwhile; NULL: the tree is GDAL's */
} gis_rtree;

/* To be called when the layer and its fields are made and it has no features yet: makes GDAL create its (empty) index
 * now, and takes away the trigger that would fill it. Does nothing where GDAL makes no index, or another than known. */
bool gis_rtree_begin(GDALDatasetH dataset, OGRLayerH layer, gis_rtree *tree, gis_error *error);
/* Notes a feature that was written. */
bool gis_rtree_add(gis_rtree *tree, OGRFeatureH feature, gis_error *error);
bool gis_rtree_add_box(gis_rtree *tree, GIntBig fid, const OGREnvelope *box, gis_error *error);
/* Fills the tree and puts the trigger back. */
bool gis_rtree_end(GDALDatasetH dataset, OGRLayerH layer, gis_rtree *tree, gis_error *error);
void gis_rtree_clear(gis_rtree *tree);

#endif
