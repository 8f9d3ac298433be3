/* packed.h: features in few bytes each, for layers with a million features.
 *
 * A GDAL feature consists of a dozen allocations, with some hundred bytes of overhead. Most layers have two-dimensional
 * polygons with numbers and texts as fields. A record of such a feature holds the FID, the values and the geometry as
 * well-known binary, contiguously, and a GDAL feature is made from it on demand. */
#ifndef GIS_PACKED_H
#define GIS_PACKED_H

#include <ogr_api.h>

#include "base/gis_error.h"
#include "base/value.h"
#include "geometry/geometry.h"
#include "sunder.h"

/* The memory of records, and the feature that was made last. A zeroed struct is empty. */
typedef struct gis_packed {
    OGRFeatureDefnH definition; /* NULL: features of the layer cannot be packed */
    OGRSpatialReferenceH crs;   /* the CRS that all geometries must have */
    OGRFieldType *type;         /* [fields] */
    int fields;
    unsigned char **chunk;
    size_t chunks, capacity, used, room; /* used, room: bytes of the last chunk */
    OGRFeatureH made;
    const unsigned char *made_of;
    bool made_whole;            /* with its geometry */
    sunder_shape *const *shape; /* borrowed: the shapes from which records take their vertices */
    unsigned char *moved;       /* buffer for a geometry */
    size_t moved_room;
} gis_packed;

/* Prepares packing for a layer. Features can be packed if all fields are integers, reals or texts without subtypes, and
 * there is one geometry column; otherwise packed->definition is NULL. Fails if out of memory. */
bool gis_packed_begin(gis_packed *packed, OGRLayerH layer, gis_error *error);
/* Makes the record of a feature. *record becomes NULL if the feature must be stored in another way: its geometry is
 * null, empty, curved or three-dimensional, or it has a style or format-specific data. Fails if out of memory. */
bool gis_packed_add(gis_packed *packed, OGRFeatureH feature, const unsigned char **record, gis_error *error);
/* Makes the record of a feature that is given as a Polygon or MultiPolygon in well-known binary, in the machine's byte
 * order (as gis_packed_add() accepts it), and a value for each field, of its type or null. Returns NULL if out of
 * memory. */
const unsigned char *gis_packed_add_row(gis_packed *packed, GIntBig fid, const unsigned char *geometry, size_t bytes,
                                        const gis_value *values);
/* Copies a record of the same layer that contains its geometry. If packed->shape[i] (which may be NULL) was made from
 * exactly this geometry, the copy contains no vertices, and takes them from the shape, which must outlive it: vertices
 * are most of a layer's memory. Returns NULL if out of memory. */
const unsigned char *gis_packed_add_borrowing(gis_packed *packed, const unsigned char *record, size_t i);
/* Moves the records of `from`, which are of the same layer, to `packed`, without changing their addresses; `from` is
 * cleared. Returns false if out of memory; then nothing has changed. */
bool gis_packed_join(gis_packed *packed, gis_packed *from);
void gis_packed_clear(gis_packed *packed);

GIntBig gis_packed_fid(const unsigned char *record);
/* Returns true if the geometry is a MultiPolygon, false if it is a Polygon. */
bool gis_packed_is_multi(const unsigned char *record);
/* Returns true if all coordinates of the record's geometry are finite. */
bool gis_packed_is_finite(const unsigned char *record);
/* Gets the polygons of a record, as gis_geometry_polygonal_part() does. */
bool gis_packed_polygons(gis_packed *packed, const unsigned char *record, gis_polygonal_part *part, gis_error *error);
/* Returns the GDAL feature of a record, valid until the next call; NULL if out of memory. */
OGRFeatureH gis_packed_feature(gis_packed *packed, const unsigned char *record);
/* The same, but the feature may be without its geometry, which takes most of the time. */
OGRFeatureH gis_packed_attributes(gis_packed *packed, const unsigned char *record);
/* Returns a new GDAL feature of a record, which the caller owns; NULL if out of memory. */
OGRFeatureH gis_packed_copy(gis_packed *packed, const unsigned char *record);
/* Returns the geometry as well-known binary, translated as by gis_geometry_translate(); valid until the next call. NULL
 * if out of memory. */
const unsigned char *gis_packed_moved(gis_packed *packed, const unsigned char *record, double dx, double dy,
                                      size_t *bytes);
/* Sets to[map[i]] to the value of field i, unless map[i] is -1; texts point into the record. */
void gis_packed_values(const gis_packed *packed, const unsigned char *record, const int *map, gis_value *to);
/* The type of a function that is called for a ring of n points (not aligned); last: it is the polygon's last ring. If
 * the function returns false, the loop ends. */
typedef bool gis_packed_ring(void *user, const unsigned char *points, size_t n, bool last);
/* Visits all rings of a geometry that is given as well-known binary. */
bool gis_packed_visit(const unsigned char *geometry, gis_packed_ring *visit, void *user);
/* Sets the geometry of a feature of another layer, translated as by gis_geometry_translate(), and its fields: field
 * map[i] from field i, unless map[i] is -1. */
bool gis_packed_put(gis_packed *packed, const unsigned char *record, const int *map, double dx, double dy,
                    OGRFeatureH to, gis_error *error);

#endif
