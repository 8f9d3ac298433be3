/* layer_styles.h: layer_styles, the table in which a GeoPackage carries its looks for QGIS. */
#ifndef GIS_LAYER_STYLES_H
#define GIS_LAYER_STYLES_H

#include <gdal.h>
#include <ogr_api.h>

#include "base/gis_error.h"
#include "base/text.h"

/* Styles that a GeoPackage layer can carry. */
typedef enum gis_style {
    GIS_STYLE_NONE,
    GIS_STYLE_STATUS,       /* by sunder_st; polygons or points, by the layer's type */
    GIS_STYLE_DISPLACEMENT, /* arrows */
    GIS_STYLE_CONFLICTS,    /* thick lines */
    GIS_STYLE_PUSHES,       /* lines, the wider the greater their force */
    GIS_STYLE_SYMBOLS,      /* polygons around points */
    GIS_STYLE_RESULT        /* sums: polygons, lines or points by the layer's type */
} gis_style;

/* Writes our style for `layer` as its default, and copies the styles that the source's GeoPackage has for the source's
 * layer (source may be NULL: there is none) as non-default ones. Makes the table where it is missing. GIS_STYLE_NONE
 * writes none of our own. The dataset is an open GeoPackage. */
bool gis_styles_write(GDALDatasetH dataset, OGRLayerH layer, gis_style style, GDALDatasetH source,
                      OGRLayerH source_layer, gis_error *error);

/* Takes away the styles of a layer that is about to be replaced, if there are any. */
bool gis_styles_forget(GDALDatasetH dataset, const char *layer, gis_error *error);

/* Adds the QGIS style document for a layer of this geometry type; nothing for GIS_STYLE_NONE. */
void gis_style_qml(gis_text *to, gis_style style, OGRwkbGeometryType type);

#endif
