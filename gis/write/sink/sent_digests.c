/* sent_digests.c: reduces features to two hashes each as they are sent (readback/digests.c explains the purpose). */
#include "write/sink/digest.h"

#include "geometry/packed.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Numbers of a feature ---------------------------------------------------------------------------------------- */

static bool mix_points(OGRGeometryH geometry, gis_digests *all, uint64_t *so_far)
{
    size_t n = (size_t)OGR_G_GetPointCount(geometry);
    if (n > all->room) {
        double *larger = realloc(all->xy, 2 * n * sizeof *larger);
        if (!larger) return false;
        all->xy = larger;
        all->room = n;
    }
    int stride = 2 * sizeof(double);
    if (n) OGR_G_GetPoints(geometry, all->xy, stride, all->xy + 1, stride, NULL, 0);
    *so_far = gis_mix(*so_far, n);
    for (size_t i = 0; i < 2 * n; i++) *so_far = gis_mix_double(*so_far, all->xy[i]);
    return true;
}

/* Hashes X and Y, ring by ring. A polygon and a multipolygon with that one polygon get the same hash, since some
 * formats have only one of the two types; null and empty get the same hash, since some formats have no empty
 * geometries. */
static bool mix_geometry(OGRGeometryH geometry, gis_digests *all, uint64_t *so_far)
{
    if (!geometry || OGR_G_IsEmpty(geometry)) {
        *so_far = gis_mix(*so_far, GIS_MIX_NOTHING);
        return true;
    }
    OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
    if (type == wkbPolygon || type == wkbCurvePolygon) *so_far = gis_mix(*so_far, GIS_MIX_POLYGON);
    int parts = OGR_G_GetGeometryCount(geometry);
    for (int i = 0; i < parts; i++)
        if (!mix_geometry(OGR_G_GetGeometryRef(geometry, i), all, so_far)) return false;
    return parts > 0 || mix_points(geometry, all, so_far);
}

static uint64_t mix_value(uint64_t so_far, OGRFeatureH feature, int field, const gis_plain_field *as)
{
    if (field < 0 || !OGR_F_IsFieldSetAndNotNull(feature, field)) return gis_mix(so_far, GIS_MIX_NO_VALUE);
    if (as->type == OFTString) return gis_mix_text(so_far, OGR_F_GetFieldAsString(feature, field), as->width);
    if (as->type != OFTReal) return gis_mix(so_far, (uint64_t)OGR_F_GetFieldAsInteger64(feature, field));
    double x = OGR_F_GetFieldAsDouble(feature, field);
    return isnan(x) ? gis_mix(so_far, GIS_MIX_NO_VALUE) : gis_mix_double(so_far, x); /* databases store NaN as null */
}

bool gis_digest_of(gis_digests *all, OGRFeatureH feature, GIntBig fid, bool as_written, gis_digest *out)
{
    *out = (gis_digest){GIS_MIX_START, GIS_MIX_START};
    if (all->with_fid) out->place = gis_mix(out->place, (uint64_t)fid);
    for (size_t i = 0; i < all->n_fields; i++)
        out->values =
            mix_value(out->values, feature, as_written ? all->fields[i].read : all->fields[i].sent, &all->fields[i]);
    /* The hash of the values includes the hash of the place: if two features exchange their values, both hashes of
     * values change. */
    bool done = mix_geometry(OGR_F_GetGeometryRef(feature), all, &out->place);
    out->values = gis_mix(out->values, out->place);
    return done;
}

/* ---- Fields whose values must come back -------------------------------------------------------------------------- */

/* Is the field of a plain type, without subtype and default? For other types a format may store an equivalent value. */
static bool is_plain(OGRFieldDefnH field)
{
    OGRFieldType type = OGR_Fld_GetType(field);
    return OGR_Fld_GetSubType(field) == OFSTNone && !OGR_Fld_GetDefault(field) &&
           (type == OFTInteger || type == OFTInteger64 || type == OFTReal || type == OFTString);
}

void gis_digests_begin(gis_sink_layer *layer)
{
    gis_digests *all = &layer->digests;
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(layer->layer);
    int n = OGR_FD_GetFieldCount(definition);
    all->wanted = true;
    all->with_fid = layer->request.like_source && layer->sink->fids_kept;
    all->fields = CPLCalloc((size_t)n + 1, sizeof *all->fields);
    for (int i = 0; i < n; i++) {
        OGRFieldDefnH field = OGR_FD_GetFieldDefn(definition, i);
        if (is_plain(field))
            all->fields[all->n_fields++] = (gis_plain_field){CPLStrdup(OGR_Fld_GetNameRef(field)), i, i,
                                                             OGR_Fld_GetType(field), OGR_Fld_GetWidth(field)};
    }
}

/* ---- Features that are sent -------------------------------------------------------------------------------------- */

bool gis_digests_add(gis_digests *all, OGRFeatureH feature, GIntBig fid, gis_error *error)
{
    gis_digest one;
    if (!all->wanted) return true;
    OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
    all->with_z += geometry && OGR_G_Is3D(geometry) && !OGR_G_IsEmpty(geometry);
    return gis_digest_of(all, feature, fid, false, &one) ? gis_digest_list_add(&all->sent, one, error)
                                                         : gis_no_memory(error);
}

typedef struct mixing {
    uint64_t so_far;
    bool inside; /* between two rings of one polygon */
} mixing;

static bool mix_ring(void *user, const unsigned char *points, size_t n, bool last)
{
    mixing *all = user;
    if (!all->inside) all->so_far = gis_mix(all->so_far, GIS_MIX_POLYGON);
    all->inside = !last;
    all->so_far = gis_mix(all->so_far, n);
    for (size_t k = 0; k < 2 * n; k++) {
        double x;
        memcpy(&x, points + k * sizeof x, sizeof x);
        all->so_far = gis_mix_double(all->so_far, x);
    }
    return true;
}

/* Adds the hashes of a feature that is given as well-known binary (polygons, or one line) and values; they equal those
 * of gis_digest_of(). */
bool gis_digests_add_plain(gis_digests *all, GIntBig fid, const unsigned char *geometry, const gis_value *values,
                           gis_error *error)
{
    if (!all->wanted) return true;
    mixing place = {all->with_fid ? gis_mix(GIS_MIX_START, (uint64_t)fid) : GIS_MIX_START, false};
    uint64_t so_far = GIS_MIX_START;
    for (size_t i = 0; i < all->n_fields; i++)
        so_far = gis_mix_plain(so_far, &values[all->fields[i].sent], &all->fields[i]);
    uint32_t type, points;
    memcpy(&type, geometry + 1, sizeof type);
    memcpy(&points, geometry + 1 + sizeof type, sizeof points);
    place.inside = type == wkbLineString;
    if (place.inside)
        mix_ring(&place, geometry + 1 + sizeof type + sizeof points, points, true);
    else
        gis_packed_visit(geometry, mix_ring, &place);
    const gis_digest one = {place.so_far, gis_mix(so_far, place.so_far)};
    return gis_digest_list_add(&all->sent, one, error);
}

void gis_digests_clear(gis_digests *all)
{
    for (size_t i = 0; i < all->n_fields; i++) CPLFree(all->fields[i].name);
    CPLFree(all->fields);
    gis_digest_list_clear(&all->sent);
    free(all->xy);
    *all = (gis_digests){.sent.scratch = all->sent.scratch};
}
