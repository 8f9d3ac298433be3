/* where.h: why a condition on features was not understood. */
#ifndef GIS_WHERE_H
#define GIS_WHERE_H

#include <gdal.h>
#include <ogr_api.h>

#include "base/gis_error.h"

/* GIS_USAGE: the option and the condition, the reason that GDAL gives, and what helps: which words the layer's format
 * has for sizes, where the condition has another format's, and which fields the layer has. dataset: of the layer; NULL:
 * GDAL itself is to understand the condition. Always false. */
bool gis_fail_where(GDALDatasetH dataset, OGRLayerH layer, const char *option, const char *where, const char *reason,
                    gis_error *error);

#endif
