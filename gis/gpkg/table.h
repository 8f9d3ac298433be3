/* table.h: reads the features of a GeoPackage's table as records (packed.h) without GDAL. GDAL allocates a dozen
 * pieces of memory for each feature, and a record is then made of these. Where rows are plain, the record can be
 * made of the row itself. */
#ifndef GIS_GPKG_TABLE_H
#define GIS_GPKG_TABLE_H

#include "geometry/packed.h"

#include <gdal.h>

/* Takes a record; false, with *error, ends it all. */
typedef bool gis_table_take(void *user, const unsigned char *record, gis_error *error);

/* Gives all rows of the layer, in GDAL's order of features, as gis_packed_add() would make them; on the caller's
 * thread, while with more than one thread a second one reads ahead. *all = false: not all rows are plain, and GDAL has
 * to read the layer, although some records were given. Plain means a Polygon or MultiPolygon with finite coordinates
 * and no empty part, and values of the types of their fields. Fails if memory is out, `take` fails, or a signal
 * came. */
bool gis_table_read(GDALDatasetH dataset, OGRLayerH layer, unsigned threads, gis_packed *packed, gis_table_take *take,
                    void *user, bool *all, gis_error *error);

#endif
