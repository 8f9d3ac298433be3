/* digests.c: written layers read back, for formats that keep every value exactly.
 *
 * In such formats a feature that reads back equals the one that was sent, double for double, but their order may
 * differ. So a feature becomes two 64-bit hashes when it is sent (geometry and FID; values), and two when it is read,
 * and both lists are sorted and compared. No count in a header is trusted, and no copy of the geometries is kept. The
 * hashes are not cryptographic, since there is no adversary: a damaged feature has the hash of another with probability
 * 2^-64 for each pair. */
#include "write/sink/digest.h"

#include "base/array.h"
#include "base/interrupt.h"
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

/* X and Y, ring by ring. A polygon and a multipolygon of that one polygon are the same to a format that has but one of
 * both; null and empty are the same to one that has no empty ones. */
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
    return isnan(x) ? gis_mix(so_far, GIS_MIX_NO_VALUE) : gis_mix_double(so_far, x); /* databases store a NaN as null */
}

static bool digest(gis_digests *all, OGRFeatureH feature, GIntBig fid, bool as_written, gis_digest *out)
{
    *out = (gis_digest){GIS_MIX_START, GIS_MIX_START};
    if (all->with_fid) out->place = gis_mix(out->place, (uint64_t)fid);
    for (size_t i = 0; i < all->n_fields; i++)
        out->values =
            mix_value(out->values, feature, as_written ? all->fields[i].read : all->fields[i].sent, &all->fields[i]);
    /* What value stood where is told, too: the values of two features that changed places are not as they were. */
    bool done = mix_geometry(OGR_F_GetGeometryRef(feature), all, &out->place);
    out->values = gis_mix(out->values, out->place);
    return done;
}

/* ---- Fields whose values must come back -------------------------------------------------------------------------- */

/* Of the other types, of a subtype, and of a field with a default of its own, a format may make something
 * equivalent. */
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

/* Where the fields are in the layer as it reads; one that has another type there cannot be compared (and is told as a
 * loss). */
static void find_fields(gis_digests *all, OGRLayerH as_written)
{
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(as_written);
    for (size_t i = 0; i < all->n_fields; i++) {
        gis_plain_field *field = &all->fields[i];
        field->read = gis_sink_field_index(definition, field->name);
        if (field->read < 0 || OGR_Fld_GetType(OGR_FD_GetFieldDefn(definition, field->read)) != field->type)
            all->values_comparable = false;
    }
}

/* ---- Both lists -------------------------------------------------------------------------------------------------- */

bool gis_digests_add(gis_digests *all, OGRFeatureH feature, GIntBig fid, gis_error *error)
{
    gis_digest one;
    if (!all->wanted) return true;
    OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
    all->with_z += geometry && OGR_G_Is3D(geometry) && !OGR_G_IsEmpty(geometry);
    return digest(all, feature, fid, false, &one) ? gis_digest_list_add(&all->sent, one, error) : gis_no_memory(error);
}

typedef struct mixing {
    uint64_t so_far;
    bool inside; /* a polygon, after its first ring */
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

/* As digest(); of polygons, or a line. */
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

static int order(const void *a, const void *b)
{
    const gis_digest *p = a, *q = b;
    if (p->place != q->place) return p->place < q->place ? -1 : 1;
    return (p->values > q->values) - (p->values < q->values);
}

/* How many of `sent` are not in `read`; both sorted, with repeats. */
static size_t missing(const gis_digest *sent, const gis_digest *read, size_t n, bool values)
{
    size_t count = 0;
    for (size_t i = 0, k = 0; i < n;) {
        int way = k == n                           ? -1
                  : sent[i].place != read[k].place ? (sent[i].place < read[k].place ? -1 : 1)
                  : values                         ? order(&sent[i], &read[k])
                                                   : 0;
        count += way < 0;
        i += way <= 0;
        k += way >= 0;
    }
    return count;
}

static bool is_next(const gis_digests_read *read, gis_digests *all, gis_digest one, bool *same, gis_error *error)
{
    gis_digest sent;
    *same = read->n < all->sent.n;
    if (!*same) return true;
    if (!gis_digest_list_get(&all->sent, read->n, &sent, error)) return false;
    *same = sent.place == one.place && (!all->values_comparable || sent.values == one.values);
    return true;
}

/* What was read so far is what was sent first. */
static bool part_ways(gis_digests_read *read, gis_digests *all, gis_error *error)
{
    if (!gis_digest_list_hold(&all->sent, read->n, error)) return false;
    if (!gis_array_reserve(&read->at, &read->capacity, read->n + 1, sizeof *read->at)) return gis_no_memory(error);
    if (read->n) memcpy(read->at, all->sent.at, read->n * sizeof *read->at);
    read->differ = true;
    return true;
}

/* The features usually come back in the order in which they were sent; then nothing has to be kept or sorted. */
bool gis_digests_read_add(gis_digests_read *read, gis_digests *all, gis_digest one, gis_error *error)
{
    bool same = false;
    if (!read->differ && !is_next(read, all, one, &same, error)) return false;
    if (!read->differ && !same && !part_ways(read, all, error)) return false;
    if (read->differ) {
        if (!gis_array_reserve(&read->at, &read->capacity, read->n + 1, sizeof *read->at)) return gis_no_memory(error);
        read->at[read->n] = one;
    }
    read->n++;
    return true;
}

static bool compare(gis_sink_layer *layer, const gis_digests_read *as_read, gis_error *error)
{
    gis_sink *sink = layer->sink;
    gis_digests *all = &layer->digests;
    if (!all->wanted) /* a format that keeps nothing as it is: all features were there to be read */
        return true;
    if (!as_read->differ) return true;
    const size_t n = all->sent.n;
    gis_digest *read = as_read->at;
    if (!gis_digest_list_hold(&all->sent, n, error)) return false;
    if (n) { /* else there are no lists */
        qsort(all->sent.at, n, sizeof *read, order);
        qsort(read, n, sizeof *read, order);
    }
    size_t lost = missing(all->sent.at, read, n, false);
    size_t changed = lost || !all->values_comparable ? 0 : missing(all->sent.at, read, n, true);
    if (!lost && changed && !sink->format.keeps_values) {
        gis_sentences_add(&sink->losses, "layer %s: the values of %zu features do not read back as they were written",
                          layer->name, changed);
        return true;
    }
    return !(lost || changed) ||
           gis_fail(error, "%s, layer %s: %zu of %zu features do not read back as they were written; is the disk full?",
                    sink->request.path, layer->name, lost ? lost : changed, n);
}

/* Every feature of the layer, decoded; what the driver reports meanwhile is a failure. */
static bool read_back(gis_sink_layer *layer, OGRLayerH as_written, gis_digests_read *read, gis_error *error)
{
    gis_digests *all = &layer->digests;
    size_t with_z = 0;
    bool done = true;
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    OGR_L_ResetReading(as_written);
    for (OGRFeatureH feature; done && (feature = OGR_L_GetNextFeature(as_written)) != NULL; OGR_F_Destroy(feature)) {
        gis_digest one;
        OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
        with_z += geometry && OGR_G_Is3D(geometry);
        done = gis_go_on(error) && (digest(all, feature, OGR_F_GetFID(feature), true, &one) || gis_no_memory(error)) &&
               gis_digests_read_add(read, all, one, error);
    }
    OGR_L_ResetReading(as_written); /* a database would keep the table open */
    gis_listen_end();
    if (done && listener.failures)
        done = gis_sink_fail_reading(layer, read->n, gis_listener_reason(&listener, "no reason given"), error);
    else if (done && read->n != layer->written)
        done = gis_sink_fail_count(layer, read->n, error);
    if (done && with_z < all->with_z && gis_sink_tells(layer))
        gis_sentences_add(&layer->sink->losses, "Z values are not written: %s has none", layer->sink->format.name);
    gis_listener_clear(&listener);
    return done;
}

bool gis_digests_agree(gis_sink_layer *layer, GDALDatasetH dataset, OGRLayerH as_written, gis_error *error)
{
    gis_digests_read read = {0};
    layer->digests.values_comparable = true;
    find_fields(&layer->digests, as_written);
    bool done = (gis_read_rows(layer, dataset, as_written, &read) || read_back(layer, as_written, &read, error)) &&
                (layer->written == 0 || compare(layer, &read, error));
    free(read.at);
    return done;
}
