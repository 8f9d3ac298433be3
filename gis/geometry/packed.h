/* packed.h: features in few bytes each, for layers of a million.
 *
 * A GDAL feature is a dozen allocations, with some hundred bytes of overhead. Most layers have plane polygons, with
 * numbers and texts as fields: a record of such a feature holds the FID, the values and the geometry as well-known
 * binary, one after the other, and a GDAL feature is made from it on demand. */
#ifndef GIS_PACKED_H
#define GIS_PACKED_H

#include <ogr_api.h>

#include "base/gis_error.h"
#include "base/value.h"
#include "geometry/geometry.h"
#include "sunder.h"

/* Where records stand, chunk behind chunk; and the feature that was made last. Zeroed: nothing is packed. */
typedef struct gis_packed {
    OGRFeatureDefnH definition; /* NULL: no feature of the layer can be packed */
    OGRSpatialReferenceH crs;   /* of all geometries */
    OGRFieldType *type;         /* [fields] */
    int fields;
    unsigned char **chunk;
    size_t chunks, capacity, used, room; /* of the last chunk */
    OGRFeatureH made;
    const unsigned char *made_of;
    sunder_shape *const *shape; /* lent: the shapes from which records borrow their vertices */
    unsigned char *moved;       /* room for a geometry */
    size_t moved_room;
} gis_packed;

/* Can features of the layer be packed? Its fields are all integers, reals or texts, and it has one geometry. */
bool gis_packed_begin(gis_packed *packed, OGRLayerH layer, gis_error *error);
/* The record of a feature; *record = NULL where it is one that has to be kept as it is: null, empty or curved, with a
 * third coordinate, a style or data of its format's own. False if memory is out. */
bool gis_packed_add(gis_packed *packed, OGRFeatureH feature, const unsigned char **record, gis_error *error);
/* The same of a feature that is not one of GDAL's yet: a Polygon or MultiPolygon as that function takes it, as
 * well-known binary in the machine's own order, and a value of each field, of its type or null. NULL if memory is
 * out. */
const unsigned char *gis_packed_add_row(gis_packed *packed, GIntBig fid, const unsigned char *geometry, size_t bytes,
                                        const gis_value *values);
/* The same of a record of the same layer that has its geometry. Where packed->shape[i] (NULL: there is none) was given
 * just that, the new record has no vertices of its own, and takes them from that shape, which has to outlive it: most
 * of what a layer takes is these. */
const unsigned char *gis_packed_add_borrowing(gis_packed *packed, const unsigned char *record, size_t i);
/* Records of `from`, of the same layer, are the other's from now on, and stay where they are; it is cleared. False if
 * memory is out: then nothing has changed. */
bool gis_packed_join(gis_packed *packed, gis_packed *from);
void gis_packed_clear(gis_packed *packed);

GIntBig gis_packed_fid(const unsigned char *record);
/* Is it a MultiPolygon? Else it is a Polygon. */
bool gis_packed_is_multi(const unsigned char *record);
/* Is every coordinate finite? */
bool gis_packed_is_finite(const unsigned char *record);
/* As gis_geometry_polygonal_part(): a packed geometry is a Polygon or a MultiPolygon. */
bool gis_packed_polygons(gis_packed *packed, const unsigned char *record, gis_polygonal_part *part, gis_error *error);
/* The feature as it was; it lives until another is asked for. NULL if memory is out. */
OGRFeatureH gis_packed_feature(gis_packed *packed, const unsigned char *record);
/* The same, the caller's own. */
OGRFeatureH gis_packed_copy(gis_packed *packed, const unsigned char *record);
/* The geometry as well-known binary, moved as gis_geometry_translate() does; it lives until another is asked for. NULL
 * if memory is out. */
const unsigned char *gis_packed_moved(gis_packed *packed, const unsigned char *record, double dx, double dy,
                                      size_t *bytes);
/* The value of field i into to[map[i]], unless that is -1; texts are the record's. */
void gis_packed_values(const gis_packed *packed, const unsigned char *record, const int *map, gis_value *to);
/* A visit of one ring of n points, of the last one of a polygon or not; false ends it all. */
typedef bool gis_packed_ring(void *user, const unsigned char *points, size_t n, bool last);
/* Of all rings of a geometry, given as its well-known binary. */
bool gis_packed_visit(const unsigned char *geometry, gis_packed_ring *visit, void *user);
/* Puts the geometry, moved as gis_geometry_translate() does, and the values into a feature of another layer: of field i
 * into its field map[i], unless that is -1. */
bool gis_packed_put(gis_packed *packed, const unsigned char *record, const int *map, double dx, double dy,
                    OGRFeatureH to, gis_error *error);

#endif
