/* layer_styles.h: the table layer_styles, in which a GeoPackage stores styles for QGIS. */
#ifndef GIS_LAYER_STYLES_H
#define GIS_LAYER_STYLES_H

#include <gdal.h>
#include <ogr_api.h>

#include "base/gis_error.h"
#include "base/text.h"

/* Styles that a GeoPackage layer can carry. */
typedef enum gis_style {
    GIS_STYLE_NONE,
    GIS_STYLE_STATUS,       /* by the values of sunder_st; for polygons or points, by the layer's type */
    GIS_STYLE_WITH_HIDDEN,  /* the same, with the value hidden */
    GIS_STYLE_WITH_RUNGS,   /* the same, and hatching for features with a smaller shape */
    GIS_STYLE_DISPLACEMENT, /* arrows */
    GIS_STYLE_CONFLICTS,    /* thick lines */
    GIS_STYLE_WITH_TIGHT,   /* the same, and thin lines for tight pairs */
    GIS_STYLE_PUSHES,       /* lines whose width grows with the force */
    GIS_STYLE_ROWS,         /* lines whose width grows with the kink */
    GIS_STYLE_HIDDEN,       /* outlines */
    GIS_STYLE_SYMBOLS,      /* polygons around points */
    GIS_STYLE_RESULT        /* sums: polygons, lines or points by the layer's type */
} gis_style;

/* Writes this program's style for `layer` as its default, and copies the styles that the source's GeoPackage has for
 * source_layer (source == NULL: there is no source) as further styles. Creates the table if it is missing. With
 * GIS_STYLE_NONE only the copies are written. `dataset` is an open GeoPackage. */
bool gis_styles_write(GDALDatasetH dataset, OGRLayerH layer, gis_style style, GDALDatasetH source,
                      OGRLayerH source_layer, gis_error *error);

/* Deletes the styles of a layer that will be replaced, if there are any. */
bool gis_styles_forget(GDALDatasetH dataset, const char *layer, gis_error *error);

/* Appends the QGIS style document for a layer of this geometry type; nothing for GIS_STYLE_NONE. */
void gis_style_qml(gis_text *to, gis_style style, OGRwkbGeometryType type);

#endif
