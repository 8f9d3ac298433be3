/* source_layer.h: which layer of a dataset is meant. */
#ifndef GIS_SOURCE_LAYER_H
#define GIS_SOURCE_LAYER_H

#include <gdal.h>
#include <ogr_api.h>

#include "base/error.h"
#include "read/source.h"

/* The layer that the request names, or, where it names none, the only one of a kind that it takes; else NULL and a
 * sentence that lists what there is. Borrowed from the dataset. */
OGRLayerH gis_choose_layer(GDALDatasetH dataset, const gis_source_request *request, gis_error *error);

/* May a layer of this declared type hold what is needed? Else the sentence says what it is and what is needed. */
bool gis_layer_fits(OGRLayerH layer, const char *name, unsigned takes, gis_error *error);

#endif
