/* gpkg_rtree.h: the spatial index of a GeoPackage layer, packed at the end instead of grown row by row.
 *
 * GDAL fills the R-tree with an SQL INSERT for each feature, which takes most of the time for writing a layer. But the
 * tree is stored in ordinary tables, and sorted boxes can be packed into nodes directly. The result is smaller, faster
 * to search, and valid for every reader. */
#ifndef GIS_GPKG_RTREE_H
#define GIS_GPKG_RTREE_H

#include <gdal.h>
#include <ogr_api.h>

#include "gpkg/index_boxes.h"

/* A zeroed struct is empty; boxes.scratch may be set. */
typedef struct gis_rtree {
    gis_index_boxes boxes;
    char *trigger; /* the SQL of the trigger that fills the tree at each INSERT, dropped meanwhile; NULL: GDAL fills the
                    * tree */
} gis_rtree;

/* To be called when the layer and its fields are made and it has no features yet. Makes GDAL create its (empty) index
 * now, and drops the trigger that would fill it. Does nothing if GDAL makes no index, or one of an unknown kind. */
bool gis_rtree_begin(GDALDatasetH dataset, OGRLayerH layer, gis_rtree *tree, gis_error *error);
/* Notes the box of a feature that was written. */
bool gis_rtree_add(gis_rtree *tree, OGRFeatureH feature, gis_error *error);
bool gis_rtree_add_box(gis_rtree *tree, GIntBig fid, const OGREnvelope *box, gis_error *error);
/* Fills the tree, and creates the trigger again. */
bool gis_rtree_end(GDALDatasetH dataset, OGRLayerH layer, gis_rtree *tree, gis_error *error);
void gis_rtree_clear(gis_rtree *tree);

#endif
