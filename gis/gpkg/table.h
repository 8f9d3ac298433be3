/* table.h: reads the features of a GeoPackage table as records (packed.h) without GDAL. GDAL allocates a dozen blocks
 * of memory for each feature, of which a record would then be made; a plain row can be turned into a record
 * directly. */
#ifndef GIS_GPKG_TABLE_H
#define GIS_GPKG_TABLE_H

#include "geometry/packed.h"

#include <gdal.h>

/* Gets a record; returning false, with *error, ends reading. */
typedef bool gis_table_take(void *user, const unsigned char *record, gis_error *error);

/* Gives all rows of the layer to `take`, in GDAL's order, as the records that gis_packed_add() would make. `take` is
 * called on the caller's thread; if `threads` > 1, a second thread reads ahead. *all is set to false if a row is not
 * plain or the layer is not a GeoPackage table with a column for the FID and one for the geometry: GDAL has to read the
 * layer then, although some records may have been given. A plain row has a Polygon or MultiPolygon
 * with finite coordinates and no empty part, and values of their fields' types. Fails if memory is out, `take` fails,
 * or a signal has arrived. */
bool gis_table_read(GDALDatasetH dataset, OGRLayerH layer, unsigned threads, gis_packed *packed, gis_table_take *take,
                    void *user, bool *all, gis_error *error);

#endif
