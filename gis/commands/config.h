/* config.h: --config. */
#ifndef GIS_CONFIG_H
#define GIS_CONFIG_H

#include "options/options.h"

/* Tells GDAL the K=V of --config; it must know most of them before drivers are registered. */
void gis_configure(const gis_options *options);

#endif
