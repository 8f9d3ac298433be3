/* config.h: sets the GDAL configuration options of --config. */
#ifndef GIS_CONFIG_H
#define GIS_CONFIG_H

#include "options/options.h"

/* Sets each K=V of --config as a configuration option of GDAL. It must be called before the drivers are registered,
 * since GDAL reads most of these options then. */
void gis_configure(const gis_options *options);

#endif
