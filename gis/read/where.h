/* where.h: explains why a condition was not understood. */
#ifndef GIS_WHERE_H
#define GIS_WHERE_H

#include <gdal.h>
#include <ogr_api.h>

#include "base/gis_error.h"

/* Fails (wrong usage) with the option and the condition, the reason that GDAL gives, and a hint: how the layer's format
 * names areas, if the condition uses another format's word, and which fields the layer has. dataset: that of the layer;
 * NULL: GDAL evaluates the condition. Returns false. */
bool gis_fail_where(GDALDatasetH dataset, OGRLayerH layer, const char *option, const char *where, const char *reason,
                    gis_error *error);

#endif
