/* packed.c: see packed.h. A record holds the FID; the number of bytes of the geometry, and these, as ISO well-known
 * binary in the machine's byte order; and for each field a byte with its state, and its value. Nothing in it is
 * aligned. A record that borrows its vertices has no geometry: the number of bytes is replaced by the number of the
 * shape, with the highest bit set, and the next bit if it is a MultiPolygon. */
#include "geometry/packed.h"

#include "base/array.h"
#include "geometry/shape_wkb.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { UNSET, EMPTY, VALUE }; /* states of a field: not set, null, or a value follows */

/* Sizes of chunks of memory: each chunk is twice as large as the one before; the first is enough for most small
 * layers. */
enum { FIRST_CHUNK = 1 << 16, LARGEST_CHUNK = 4 << 20 };

#define BORROWS UINT32_C(0x80000000) /* cannot occur in a number of bytes, which is an int */
#define BORROWS_MULTI UINT32_C(0x40000000)
#define MOST_BORROWED BORROWS_MULTI /* the largest number of shapes that fits into the remaining bits */

/* ---- Memory ------------------------------------------------------------------------------------------------------ */

bool gis_packed_begin(gis_packed *packed, OGRLayerH layer, gis_error *error)
{
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(layer);
    const int n = OGR_FD_GetFieldCount(definition);
    *packed = (gis_packed){.fields = n};
    if (OGR_FD_GetGeomFieldCount(definition) != 1) return true;
    packed->type = malloc(((size_t)n + 1) * sizeof *packed->type);
    if (!packed->type) return gis_no_memory(error);
    for (int i = 0; i < n; i++) {
        OGRFieldDefnH field = OGR_FD_GetFieldDefn(definition, i);
        const OGRFieldType type = packed->type[i] = OGR_Fld_GetType(field);
        if (OGR_Fld_GetSubType(field) != OFSTNone ||
            (type != OFTInteger && type != OFTInteger64 && type != OFTReal && type != OFTString))
            return true;
    }
    packed->definition = definition;
    packed->crs = OGR_L_GetSpatialRef(layer);
    return true;
}

void gis_packed_clear(gis_packed *packed)
{
    if (packed->made) OGR_F_Destroy(packed->made);
    for (size_t k = 0; k < packed->chunks; k++) free(packed->chunk[k]);
    free(packed->chunk);
    free(packed->type);
    free(packed->moved);
    *packed = (gis_packed){0};
}

/* The unused rest of the last chunk is lost. */
bool gis_packed_join(gis_packed *packed, gis_packed *from)
{
    const size_t chunks = packed->chunks + from->chunks;
    if (!gis_array_reserve(&packed->chunk, &packed->capacity, chunks, sizeof *packed->chunk)) return false;
    if (from->chunks) {
        memcpy(packed->chunk + packed->chunks, from->chunk, from->chunks * sizeof *from->chunk);
        packed->used = from->used;
        packed->room = from->room;
    }
    packed->chunks = chunks;
    from->chunks = 0;
    gis_packed_clear(from);
    return true;
}

static size_t next_chunk(const gis_packed *packed)
{
    size_t chunk = FIRST_CHUNK;
    for (size_t k = 0; k < packed->chunks && chunk < LARGEST_CHUNK; k++) chunk *= 2;
    return chunk;
}

/* Reserves `size` bytes behind the last record. Returns NULL if out of memory. */
static unsigned char *reserve_record(gis_packed *packed, size_t size)
{
    if (packed->room - packed->used < size) {
        const size_t usual = next_chunk(packed), room = size > usual / 16 ? size : usual;
        if (!gis_array_reserve(&packed->chunk, &packed->capacity, packed->chunks + 1, sizeof *packed->chunk))
            return NULL;
        unsigned char *chunk = malloc(room);
        if (!chunk) return NULL;
        packed->chunk[packed->chunks++] = chunk;
        packed->room = room;
        packed->used = 0;
    }
    unsigned char *at = packed->chunk[packed->chunks - 1] + packed->used;
    packed->used += size;
    return at;
}

/* ---- Packing ----------------------------------------------------------------------------------------------------- */

static bool has_points(OGRGeometryH polygon)
{
    const int rings = OGR_G_GetGeometryCount(polygon);
    for (int r = 0; r < rings; r++)
        if (OGR_G_GetPointCount(OGR_G_GetGeometryRef(polygon, r)) == 0) return false;
    return rings > 0;
}

/* Returns true if the geometry is a Polygon or MultiPolygon in two dimensions, without empty rings, in the layer's
 * CRS. */
static bool is_plain(const gis_packed *packed, OGRGeometryH geometry)
{
    if (!geometry || OGR_G_GetSpatialReference(geometry) != packed->crs) return false;
    const OGRwkbGeometryType type = OGR_G_GetGeometryType(geometry);
    if (type == wkbPolygon) return has_points(geometry);
    const int parts = OGR_G_GetGeometryCount(geometry);
    for (int k = 0; k < parts && type == wkbMultiPolygon; k++)
        if (!has_points(OGR_G_GetGeometryRef(geometry, k))) return false;
    return parts > 0 && type == wkbMultiPolygon;
}

static int state_of(const OGRField *value)
{
    return OGR_RawField_IsUnset(value) ? UNSET : OGR_RawField_IsNull(value) ? EMPTY : VALUE;
}

static size_t size_of_values(const gis_packed *packed, OGRFeatureH feature)
{
    size_t size = (size_t)packed->fields;
    for (int i = 0; i < packed->fields; i++) {
        const OGRField *value = OGR_F_GetRawFieldRef(feature, i);
        if (state_of(value) == VALUE)
            size += packed->type[i] == OFTString ? strlen(value->String) + 1 : sizeof(int64_t);
    }
    return size;
}

static unsigned char *put_bytes(unsigned char *to, const void *from, size_t n)
{
    memcpy(to, from, n);
    return to + n;
}

static unsigned char *put_value(unsigned char *to, OGRFieldType type, const OGRField *value)
{
    *to = (unsigned char)state_of(value);
    if (*to++ != VALUE) return to;
    if (type == OFTString) return put_bytes(to, value->String, strlen(value->String) + 1);
    if (type == OFTReal) return put_bytes(to, &value->Real, sizeof value->Real);
    const int64_t number = type == OFTInteger ? value->Integer : value->Integer64;
    return put_bytes(to, &number, sizeof number);
}

bool gis_packed_add(gis_packed *packed, OGRFeatureH feature, const unsigned char **record, gis_error *error)
{
    OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
    *record = NULL;
    if (!packed->definition || !is_plain(packed, geometry) || OGR_F_GetStyleString(feature) ||
        OGR_F_GetNativeData(feature) || OGR_F_GetNativeMediaType(feature))
        return true;
    const GIntBig fid = OGR_F_GetFID(feature);
    const int bytes = OGR_G_WkbSize(geometry);
    if (bytes <= 0) return true; /* the size does not fit an int */
    unsigned char *to =
        reserve_record(packed, sizeof fid + sizeof bytes + (size_t)bytes + size_of_values(packed, feature));
    if (!to) return gis_no_memory(error);
    const unsigned char *const at = to;
    to = put_bytes(to, &fid, sizeof fid);
    to = put_bytes(to, &bytes, sizeof bytes);
    if (OGR_G_ExportToIsoWkb(geometry, GIS_WKB_ORDER, to) != OGRERR_NONE) return gis_no_memory(error);
    to += bytes;
    for (int i = 0; i < packed->fields; i++) to = put_value(to, packed->type[i], OGR_F_GetRawFieldRef(feature, i));
    *record = at;
    return true;
}

static size_t size_of(const gis_value *value)
{
    return value->kind == GIS_TEXT ? strlen(value->as.text) + 1 : value->kind == GIS_NULL ? 0 : sizeof(int64_t);
}

const unsigned char *gis_packed_add_row(gis_packed *packed, GIntBig fid, const unsigned char *geometry, size_t bytes,
                                        const gis_value *values)
{
    const int geometry_bytes = (int)bytes;
    size_t size = (size_t)packed->fields;
    for (int i = 0; i < packed->fields; i++) size += size_of(&values[i]);
    unsigned char *const at = reserve_record(packed, sizeof fid + sizeof geometry_bytes + bytes + size), *to = at;
    if (!at) return NULL;
    to = put_bytes(to, &fid, sizeof fid);
    to = put_bytes(to, &geometry_bytes, sizeof geometry_bytes);
    to = put_bytes(to, geometry, bytes);
    for (int i = 0; i < packed->fields; i++) {
        const gis_value *value = &values[i];
        *to++ = value->kind == GIS_NULL ? EMPTY : VALUE;
        to = put_bytes(to, value->kind == GIS_TEXT ? (const void *)value->as.text : &value->as, size_of(value));
    }
    return at;
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

GIntBig gis_packed_fid(const unsigned char *record)
{
    GIntBig fid;
    memcpy(&fid, record, sizeof fid);
    return fid;
}

static uint32_t number_at(const unsigned char **at)
{
    uint32_t number;
    memcpy(&number, *at, sizeof number);
    *at += sizeof number;
    return number;
}

/* The parts of a record after the FID. */
typedef struct place {
    const unsigned char *geometry; /* well-known binary; NULL: the vertices are borrowed */
    const unsigned char *values;   /* the values of the fields */
    size_t bytes;                  /* size of `geometry` */
    bool multi;                    /* if borrowed: it is a MultiPolygon */
    uint32_t shape;                /* if borrowed: number of the shape */
} place;

static place place_of(const unsigned char *record)
{
    place p = {0};
    record += sizeof(GIntBig);
    const uint32_t number = number_at(&record);
    if (number & BORROWS) {
        p.multi = number & BORROWS_MULTI;
        p.shape = number & ~(BORROWS | BORROWS_MULTI);
        p.values = record;
    } else {
        p.bytes = number;
        p.geometry = record;
        p.values = record + number;
    }
    return p;
}

/* Skips the byte order and the type of a geometry, and returns the type. */
static uint32_t begin_geometry(const unsigned char **at)
{
    ++*at;
    return number_at(at);
}

bool gis_packed_is_multi(const unsigned char *record)
{
    place p = place_of(record);
    return p.geometry ? begin_geometry(&p.geometry) == wkbMultiPolygon : p.multi;
}

static bool visit_polygon(const unsigned char **at, gis_packed_ring *visit, void *user)
{
    begin_geometry(at);
    for (uint32_t rings = number_at(at); rings > 0; rings--) {
        const size_t n = number_at(at);
        if (!visit(user, *at, n, rings == 1)) return false;
        *at += 2 * n * sizeof(double);
    }
    return true;
}

bool gis_packed_visit(const unsigned char *geometry, gis_packed_ring *visit, void *user)
{
    const unsigned char *inside = geometry;
    if (begin_geometry(&inside) == wkbPolygon) return visit_polygon(&geometry, visit, user);
    for (uint32_t polygons = number_at(&inside); polygons > 0; polygons--)
        if (!visit_polygon(&inside, visit, user)) return false;
    return true;
}

static bool visit_finite(void *user, const unsigned char *points, size_t n, bool last)
{
    (void)user;
    (void)last;
    for (size_t k = 0; k < 2 * n; k++) {
        double x;
        memcpy(&x, points + k * sizeof x, sizeof x);
        if (!isfinite(x)) return false;
    }
    return true;
}

bool gis_packed_is_finite(const unsigned char *record)
{
    const place p = place_of(record);
    return !p.geometry || gis_packed_visit(p.geometry, visit_finite, NULL); /* shapes have only finite coordinates */
}

static const unsigned char *pass_value(OGRFieldType type, const unsigned char *from)
{
    if (*from++ != VALUE) return from;
    return from + (type == OFTString ? strlen((const char *)from) + 1 : sizeof(int64_t));
}

/* ---- Vertices of shapes ------------------------------------------------------------------------------------------ */

/* Returns the geometry of a record as well-known binary. If its vertices are borrowed, the result is valid until the
 * next call. Returns NULL if out of memory. */
static const unsigned char *geometry_of(gis_packed *packed, const unsigned char *record, size_t *bytes)
{
    const place p = place_of(record);
    *bytes = p.bytes;
    if (p.geometry) return p.geometry;
    const sunder_shape *shape = packed->shape[p.shape];
    *bytes = gis_shape_wkb_bytes(shape, p.multi);
    if (!gis_array_reserve(&packed->moved, &packed->moved_room, *bytes, 1)) return NULL;
    gis_shape_wkb_write(shape, p.multi, packed->moved);
    return packed->moved;
}

typedef struct appending {
    gis_polygons *set;
    gis_error *error;
} appending;

static bool visit_appending(void *user, const unsigned char *points, size_t n, bool last)
{
    const appending *to = user;
    gis_polygons *set = to->set;
    if (!gis_polygons_reserve(set, n, to->error)) return false;
    memcpy(set->xy + 2 * set->vertices, points, 2 * n * sizeof(double));
    set->vertices += n;
    return gis_polygons_end_closed_ring(set, to->error) && (!last || gis_polygons_end_polygon(set, to->error));
}

bool gis_packed_polygons(gis_packed *packed, const unsigned char *record, gis_polygonal_part *part, gis_error *error)
{
    appending to = {&part->set, error};
    size_t bytes;
    const unsigned char *geometry = geometry_of(packed, record, &bytes);
    part->set.vertices = part->set.rings = part->set.polygons = 0;
    part->linearised = 0;
    return geometry ? gis_packed_visit(geometry, visit_appending, &to) : gis_no_memory(error);
}

/* Sets *same to whether the shape was made from exactly this geometry. Returns false if out of memory. */
static bool is_given(gis_packed *packed, const place *p, bool multi, const sunder_shape *shape, bool *same)
{
    *same = gis_shape_wkb_bytes(shape, multi) == p->bytes;
    if (!*same) return true;
    if (!gis_array_reserve(&packed->moved, &packed->moved_room, p->bytes, 1)) return false;
    gis_shape_wkb_write(shape, multi, packed->moved);
    *same = memcmp(packed->moved, p->geometry, p->bytes) == 0;
    return true;
}

const unsigned char *gis_packed_add_borrowing(gis_packed *packed, const unsigned char *record, size_t i)
{
    const place p = place_of(record);
    const sunder_shape *shape = i < MOST_BORROWED ? packed->shape[i] : NULL;
    const bool multi = gis_packed_is_multi(record);
    const unsigned char *end = p.values;
    for (int k = 0; k < packed->fields; k++) end = pass_value(packed->type[k], end);
    const size_t values = (size_t)(end - p.values), size = (size_t)(end - record);
    bool same = false;
    if (shape && !is_given(packed, &p, multi, shape, &same)) return NULL;
    unsigned char *const at = reserve_record(packed, same ? sizeof(GIntBig) + sizeof(uint32_t) + values : size);
    if (!at || !same) return at ? put_bytes(at, record, size) - size : NULL;
    const uint32_t number = (uint32_t)i | BORROWS | (multi ? BORROWS_MULTI : 0);
    put_bytes(put_bytes(put_bytes(at, record, sizeof(GIntBig)), &number, sizeof number), p.values, values);
    return at;
}

/* ---- GDAL features ----------------------------------------------------------------------------------------------- */

static const unsigned char *set_value(OGRFeatureH feature, int i, OGRFieldType type, const unsigned char *from)
{
    const int state = *from++;
    double real;
    int64_t number;
    if (state == UNSET) OGR_F_UnsetField(feature, i);
    if (state == EMPTY) OGR_F_SetFieldNull(feature, i);
    if (state != VALUE) return from;
    switch (type) {
    case OFTString: OGR_F_SetFieldString(feature, i, (const char *)from); return from + strlen((const char *)from) + 1;
    case OFTReal:
        memcpy(&real, from, sizeof real);
        OGR_F_SetFieldDouble(feature, i, real);
        return from + sizeof real;
    default:
        memcpy(&number, from, sizeof number);
        OGR_F_SetFieldInteger64(feature, i, number);
        return from + sizeof number;
    }
}

/* Sets the geometry of a feature from the record. Returns false if out of memory. */
static bool set_geometry(gis_packed *packed, const unsigned char *record, OGRFeatureH feature)
{
    size_t bytes;
    const unsigned char *wkb = geometry_of(packed, record, &bytes);
    OGRGeometryH geometry = NULL;
    if (!wkb || OGR_G_CreateFromWkb(wkb, packed->crs, &geometry, (int)bytes) != OGRERR_NONE) return false;
    OGR_F_SetGeometryDirectly(feature, geometry);
    return true;
}

/* Sets the FID and the fields of a feature from the record. */
static void set_attributes(const gis_packed *packed, const unsigned char *record, OGRFeatureH feature)
{
    const unsigned char *at = place_of(record).values;
    OGR_F_SetFID(feature, gis_packed_fid(record));
    for (int i = 0; i < packed->fields; i++) at = set_value(feature, i, packed->type[i], at);
}

OGRFeatureH gis_packed_attributes(gis_packed *packed, const unsigned char *record)
{
    if (packed->made_of == record) return packed->made;
    if (!packed->made) packed->made = OGR_F_Create(packed->definition);
    if (!packed->made) return NULL;
    if (packed->made_whole) OGR_F_SetGeometryDirectly(packed->made, NULL);
    packed->made_whole = false;
    packed->made_of = record;
    set_attributes(packed, record, packed->made);
    return packed->made;
}

OGRFeatureH gis_packed_feature(gis_packed *packed, const unsigned char *record)
{
    if (!gis_packed_attributes(packed, record)) return NULL;
    packed->made_whole = packed->made_whole || set_geometry(packed, record, packed->made);
    return packed->made_whole ? packed->made : NULL;
}

OGRFeatureH gis_packed_copy(gis_packed *packed, const unsigned char *record)
{
    OGRFeatureH feature = OGR_F_Create(packed->definition);
    if (!feature) return NULL;
    set_attributes(packed, record, feature);
    if (set_geometry(packed, record, feature)) return feature;
    OGR_F_Destroy(feature);
    return NULL;
}

/* ---- Moved geometries -------------------------------------------------------------------------------------------- */

/* Adds a move to n points in place; `points` must be in a buffer of this file. */
static bool visit_moving(void *user, const unsigned char *points, size_t n, bool last)
{
    const double *move = user;
    unsigned char *at = (unsigned char *)points;
    (void)last;
    for (size_t k = 0; k < 2 * n; k++, at += sizeof(double)) {
        double x;
        memcpy(&x, at, sizeof x);
        x += move[k & 1];
        memcpy(at, &x, sizeof x);
    }
    return true;
}

const unsigned char *gis_packed_moved(gis_packed *packed, const unsigned char *record, double dx, double dy,
                                      size_t *bytes)
{
    double move[2] = {dx, dy};
    const unsigned char *at = geometry_of(packed, record, bytes);
    if (!at || !gis_array_reserve(&packed->moved, &packed->moved_room, *bytes, 1)) return NULL;
    if (at != packed->moved) memcpy(packed->moved, at, *bytes);
    if (dx != 0 || dy != 0) gis_packed_visit(packed->moved, visit_moving, move);
    return packed->moved;
}

bool gis_packed_put(gis_packed *packed, const unsigned char *record, const int *map, double dx, double dy,
                    OGRFeatureH to, gis_error *error)
{
    size_t bytes;
    OGRGeometryH geometry = NULL;
    const unsigned char *moved = gis_packed_moved(packed, record, dx, dy, &bytes);
    if (!moved || OGR_G_CreateFromWkb(moved, packed->crs, &geometry, (int)bytes) != OGRERR_NONE)
        return gis_no_memory(error);
    OGR_F_SetGeometryDirectly(to, geometry);
    const unsigned char *at = place_of(record).values;
    for (int i = 0; i < packed->fields; i++)
        at = map[i] < 0 ? pass_value(packed->type[i], at) : set_value(to, map[i], packed->type[i], at);
    return true;
}

void gis_packed_values(const gis_packed *packed, const unsigned char *record, const int *map, gis_value *to)
{
    const unsigned char *at = place_of(record).values;
    for (int i = 0; i < packed->fields; i++) {
        const unsigned char *const from = at + 1;
        const bool there = *at == VALUE;
        at = pass_value(packed->type[i], at);
        if (map[i] < 0) continue;
        gis_value *value = &to[map[i]];
        *value = (gis_value){.kind = GIS_NULL};
        if (!there) continue;
        value->kind = packed->type[i] == OFTString ? GIS_TEXT : packed->type[i] == OFTReal ? GIS_REAL : GIS_INTEGER;
        if (value->kind == GIS_TEXT) value->as.text = (const char *)from;
        if (value->kind == GIS_REAL) memcpy(&value->as.real, from, sizeof value->as.real);
        if (value->kind == GIS_INTEGER) memcpy(&value->as.integer, from, sizeof value->as.integer);
    }
}
