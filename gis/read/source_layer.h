/* source_layer.h: chooses a layer of a dataset. */
#ifndef GIS_SOURCE_LAYER_H
#define GIS_SOURCE_LAYER_H

#include <gdal.h>
#include <ogr_api.h>

#include "base/gis_error.h"
#include "read/source.h"

/* The layer that the request names; if it names none, the only layer of an accepted kind; otherwise NULL, with an error
 * that lists the layers. Borrowed from the dataset. */
OGRLayerH gis_choose_layer(GDALDatasetH dataset, const gis_source_request *request, gis_error *error);

/* Fails if a layer of this declared type cannot hold the required geometries; the error names both types. */
bool gis_layer_fits(OGRLayerH layer, const char *name, unsigned takes, gis_error *error);

#endif
