/* blob.h: geometries as a GeoPackage stores them ("GeoPackageBinary"): "GP", version, flags, SRS; as much of a box as
 * the flags say; well-known binary. */
#ifndef GIS_GPKG_BLOB_H
#define GIS_GPKG_BLOB_H

#include <stdbool.h>
#include <stddef.h>

/* The well-known binary in a blob; NULL if its header is of another version, or has extensions, or ends too soon. */
const unsigned char *gis_blob_geometry(const unsigned char *blob, size_t size, size_t *bytes);
/* Is this well-known binary, to its last byte, a Polygon or MultiPolygon in the plane, in the machine's byte order,
 * with no empty part and no empty ring? */
bool gis_blob_is_polygonal(const unsigned char *geometry, size_t bytes);

#endif
