/* source_layer.h: which layer of a dataset is meant. */
#ifndef GIS_SOURCE_LAYER_H
#define GIS_SOURCE_LAYER_H

#include <gdal.h>
#include <ogr_api.h>

#include "base/gis_error.h"
#include "read/source.h"

/* The layer that the request names; if it names none, the only layer of an accepted kind; else NULL, and a sentence
 * that lists the layers. Borrowed from the dataset. */
OGRLayerH gis_choose_layer(GDALDatasetH dataset, const gis_source_request *request, gis_error *error);

/* May a layer of this declared type hold the required geometries? If not, the sentence tells its type and the required
 * one. */
bool gis_layer_fits(OGRLayerH layer, const char *name, unsigned takes, gis_error *error);

#endif
