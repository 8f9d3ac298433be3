/* blob.h: geometries as a GeoPackage stores them ("GeoPackageBinary"): "GP", version, flags, SRS; a box whose size
 * depends on the flags; well-known binary. */
#ifndef GIS_GPKG_BLOB_H
#define GIS_GPKG_BLOB_H

#include <stdbool.h>
#include <stddef.h>

/* The well-known binary in a blob, and its size in *bytes; NULL if the header has another version or extensions, or the
 * blob ends too soon. */
const unsigned char *gis_blob_geometry(const unsigned char *blob, size_t size, size_t *bytes);
/* Is this well-known binary exactly one Polygon or MultiPolygon in two dimensions, in the machine's byte order, without
 * empty polygons or rings? */
bool gis_blob_is_polygonal(const unsigned char *geometry, size_t bytes);

#endif
