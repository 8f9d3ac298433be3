/* source_features.c: reads the features of a source, all at once or in batches, and gives them out. */
#include "read/source_features.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "base/resources.h"
#include "geometry/packed_borrowing.h"
#include "gpkg/table.h"
#include "read/where.h"

#include <cpl_conv.h>
#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* A feature that was read: a GDAL feature, or (if that is NULL) its record. */
typedef struct gis_read_feature {
    OGRFeatureH feature;
    const unsigned char *record;
} gis_read_feature;

enum { RECORD = 0x80 }; /* flag in `contents` */

static gis_read_feature read_of(const gis_source *source, size_t i)
{
    const void *held = source->held[i];
    return source->contents[i] & RECORD ? (gis_read_feature){.record = held}
                                        : (gis_read_feature){.feature = (OGRFeatureH)held};
}

void gis_source_keep_warnings(gis_source *source, const gis_listener *listener)
{
    for (size_t i = 0; i < listener->warnings.n; i++)
        gis_sentences_add(&source->warnings, "%s", listener->warnings.items[i]);
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

/* A batch ends when its geometries reach this size. */
enum { BATCH_BYTES = 32 << 20 };

/* Updates the facts about the layer. feature == NULL: there is only its record. */
static void note_facts(gis_source *source, OGRFeatureH feature, const unsigned char *record, gis_content content)
{
    gis_source_facts *facts = &source->facts;
    const GIntBig fid = feature ? OGR_F_GetFID(feature) : gis_packed_fid(record);
    source->fids_missing = source->fids_missing || fid == OGRNullFID;
    source->fids_rising = source->fids_rising && (facts->features == 0 || source->last_fid < fid);
    source->last_fid = fid;
    facts->fids_negative = facts->fids_negative || (fid < 0 && fid != OGRNullFID);
    facts->features++;
    facts->content[content]++;
    if (facts->multipolygons) return;
    const OGRGeometryH geometry = feature ? OGR_F_GetGeometryRef(feature) : NULL;
    facts->multipolygons = record ? gis_packed_is_multi(record)
                                  : geometry && wkbFlatten(OGR_G_GetGeometryType(geometry)) == wkbMultiPolygon;
}

static size_t bytes_of(OGRGeometryH geometry) { return geometry ? (size_t)OGR_G_WkbSize(geometry) : 0; }

/* Adds a feature, and takes it over; if there is a record, the record is kept and the feature is destroyed. */
static bool keep_feature(gis_source *source, OGRFeatureH feature, const unsigned char *record, bool finite)
{
    const gis_content content = !finite  ? GIS_BROKEN
                                : record ? GIS_POLYGONS
                                         : gis_geometry_content(OGR_F_GetGeometryRef(feature));
    if (!gis_array_reserve(&source->held, &source->capacity, source->n + 1, sizeof *source->held) ||
        !gis_array_reserve(&source->contents, &source->contents_capacity, source->n + 1, sizeof *source->contents))
        return false;
    if (!source->facts_given) note_facts(source, feature, record, content);
    if (source->batch) source->bytes += bytes_of(OGR_F_GetGeometryRef(feature));
    source->contents[source->n] = (unsigned char)(record ? content | RECORD : content);
    source->held[source->n++] = record ? (const void *)record : feature;
    if (record && feature) OGR_F_Destroy(feature);
    return true;
}

static bool keep_record(void *user, const unsigned char *record, gis_error *error)
{
    return keep_feature(user, NULL, record, true) || gis_no_memory(error);
}

/* Warns or fails, as the request says, because a coordinate of the feature is not finite. */
static bool judge_not_finite(const gis_source *source, OGRFeatureH feature, gis_error *error)
{
    char who[GIS_WHO_SIZE];
    if (source->not_finite == GIS_NOT_FINITE_KEPT) return true;
    gis_name_subject(&(gis_subject){NULL, source->name, true, OGR_F_GetFID(feature), 0, NULL}, who, sizeof who);
    if (source->not_finite == GIS_NOT_FINITE_REFUSED)
        return gis_fail(error, "%s: a coordinate is not a finite number; --invalid skip leaves such features out", who);
    gis_say_warning(GIS_MESSAGE_INVALID, "%s: a coordinate is not a finite number; skipped", who);
    return true;
}

/* Reads one feature. *kept is set if the source has taken it over. */
static bool take_feature(gis_source *source, OGRFeatureH feature, bool *kept, gis_error *error)
{
    const unsigned char *record = NULL;
    if (source->wants && !source->wants(source->user, source->crs, feature)) return true;
    if (source->may_pack && !source->wants && !gis_packed_add(source->packed, feature, &record, error)) return false;
    const bool finite = record ? gis_packed_is_finite(record) : gis_geometry_is_finite(OGR_F_GetGeometryRef(feature));
    if (!finite && !judge_not_finite(source, feature, error)) return false;
    if (!finite && source->not_finite == GIS_NOT_FINITE_LEFT_OUT) return true;
    *kept = keep_feature(source, feature, finite ? record : NULL, finite);
    return *kept || gis_no_memory(error);
}

static bool is_full(const gis_source *source)
{
    return source->batch && (source->n >= source->batch || source->bytes >= BATCH_BYTES);
}

static bool begin_packing(gis_source *source, gis_error *error)
{
    if (!source->packed) source->packed = calloc(1, sizeof *source->packed);
    return source->packed ? gis_packed_begin(source->packed, source->layer, error) : gis_no_memory(error);
}

void gis_source_drop_features(gis_source *source)
{
    for (size_t i = 0; i < source->n; i++)
        if (!(source->contents[i] & RECORD)) OGR_F_Destroy(read_of(source, i).feature);
    if (source->packed) gis_packed_clear(source->packed);
    source->n = source->bytes = 0;
}

static void forget_facts(gis_source *source)
{
    source->fids_rising = true;
    source->fids_missing = false;
    if (!source->facts_given) source->facts = (gis_source_facts){0};
}

/* Reads the whole layer without GDAL if it is a table without selection, and all its rows are plain; otherwise leaves
 * the source empty. */
static bool read_table(gis_source *source, const gis_source_request *request, gis_error *error)
{
    const bool whole = request && !source->batch && !request->sql && !request->bbox && !request->within &&
                       !request->where && !request->wants;
    if (!whole || !source->may_pack) return true;
    if (!gis_table_read(source->dataset, source->layer, gis_threads(request->threads), source->packed, keep_record,
                        source, &source->ended, error))
        return false;
    if (source->ended) return true;
    gis_source_drop_features(source);
    forget_facts(source);
    return begin_packing(source, error);
}

/* Reads a batch, or all features. request == NULL: no feature is filtered. */
static bool read_features(gis_source *source, const gis_source_request *request, gis_error *error)
{
    if (!read_table(source, request, error)) return false;
    while (!source->ended && !is_full(source)) {
        OGRFeatureH feature = OGR_L_GetNextFeature(source->layer);
        source->ended = feature == NULL;
        if (source->ended) break;
        bool kept = false;
        const bool taken = take_feature(source, feature, &kept, error);
        if (!kept) OGR_F_Destroy(feature);
        if (!taken || !gis_go_on(error)) return false;
    }
    return gis_go_on(error); /* a statement that a signal ended looks like the end of the layer */
}

/* Writes the name of the first feature that GDAL cannot compare with the box of the source's filter to `who`. Returns
 * false if there is none. The filter is removed. */
static bool name_incomparable(gis_source *source, char *who, size_t size)
{
    OGRGeometryH box = OGR_G_Clone(OGR_L_GetSpatialFilter(source->layer));
    gis_listener listener = {0};
    OGR_L_SetSpatialFilter(source->layer, NULL);
    gis_listen_begin(&listener);
    for (OGRFeatureH feature; !listener.failures && (feature = OGR_L_GetNextFeature(source->layer));) {
        OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
        if (geometry) OGR_G_Intersects(box, geometry);
        gis_name_subject(&(gis_subject){NULL, source->name, true, OGR_F_GetFID(feature), 0, NULL}, who, size);
        OGR_F_Destroy(feature);
    }
    gis_listen_end();
    OGR_G_DestroyGeometry(box);
    const bool found = listener.failures > 0;
    gis_listener_clear(&listener);
    return found;
}

/* GDAL drops a feature that it cannot compare with a box, such as a polygon with an open ring, and reports the reason
 * without the feature. If the box came from the caller's `within`, reading without it
 * may succeed. */
static bool fail_in_a_box(gis_source *source, const char *reason, gis_error *error)
{
    char who[GIS_WHO_SIZE];
    if (!source->within && name_incomparable(source, who, sizeof who))
        return gis_fail(error,
                        "%s: GDAL cannot compare it with the box of --bbox: a ring is not closed, or a ring or line "
                        "has too few vertices",
                        who);
    gis_fail(error, "%s, layer %s: reading failed: %s", source->path, source->name, reason);
    error->in_a_box = source->within;
    return false;
}

/* Reads a batch, or all features, and reports errors of the driver. */
static bool read_batch(gis_source *source, const gis_source_request *request, gis_error *error)
{
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    bool done = read_features(source, request, error);
    gis_listen_end();
    const size_t read = source->first + source->n;
    if (done && listener.failures && source->where && read == 0)
        done = gis_fail_where(source->dataset, source->layer, source->where_option, source->where,
                              gis_listener_reason(&listener, "not understood"), error);
    else if (done && listener.failures && OGR_L_GetSpatialFilter(source->layer))
        done = fail_in_a_box(source, gis_listener_reason(&listener, "no reason given"), error);
    else if (done && listener.failures)
        done = gis_fail(error, "%s, layer %s: reading failed after %zu features: %s", source->path, source->name, read,
                        gis_listener_reason(&listener, "no reason given"));
    gis_source_keep_warnings(source, &listener);
    gis_listener_clear(&listener);
    return done;
}

/* At the end of the layer: fails if the number of features differs from that of an earlier reading. */
static bool ends_as_known(const gis_source *source, gis_error *error)
{
    const size_t read = source->first + source->n;
    return !source->facts_given || read == source->facts.features ||
           gis_fail(error, "%s, layer %s: it has %zu features, and had %zu when it was read before", source->path,
                    source->name, read, source->facts.features);
}

bool gis_source_next(gis_source *source, bool *any, gis_error *error)
{
    source->first += source->n;
    gis_source_drop_features(source);
    *any = false;
    if (source->ended) return ends_as_known(source, error);
    if ((source->may_pack && !begin_packing(source, error)) || !read_batch(source, NULL, error)) return false;
    *any = source->n > 0;
    return *any || ends_as_known(source, error);
}

bool gis_source_again(gis_source *source, bool *any, gis_error *error)
{
    gis_source_drop_features(source);
    source->first = 0;
    source->ended = false;
    forget_facts(source);
    OGR_L_ResetReading(source->layer);
    return gis_source_next(source, any, error);
}

/* ---- FIDs -------------------------------------------------------------------------------------------------------- */

static int compare_fids(const void *a, const void *b)
{
    GIntBig p = *(const GIntBig *)a, q = *(const GIntBig *)b;
    return (p > q) - (p < q);
}

/* Lists the FIDs of all features again: of those in memory or, if they are read in batches, by reading the layer
 * again. */
static bool list_fids(gis_source *source, GIntBig *fids, size_t *n)
{
    *n = source->facts.features;
    for (size_t i = 0; !source->batch && i < source->n; i++) fids[i] = gis_source_fid(source, i);
    if (!source->batch) return true;
    size_t k = 0;
    OGR_L_ResetReading(source->layer);
    for (OGRFeatureH feature; k < *n && (feature = OGR_L_GetNextFeature(source->layer)); OGR_F_Destroy(feature))
        fids[k++] = OGR_F_GetFID(feature);
    return k == *n;
}

/* Determines whether all FIDs are set and different. They are compared only if they are not ascending. */
static bool look_at_fids(gis_source *source, gis_error *error)
{
    bool *unique = &source->facts.fids_unique;
    *unique = !source->fids_missing && source->fids_rising;
    if (source->fids_missing || source->fids_rising) return true;
    GIntBig *fids = malloc((source->facts.features + 1) * sizeof *fids);
    size_t n;
    if (!fids) return gis_no_memory(error);
    bool done =
        list_fids(source, fids, &n) ||
        gis_fail(error, "%s, layer %s: it has fewer features when it is read again", source->path, source->name);
    if (done) qsort(fids, n, sizeof *fids, compare_fids);
    *unique = done;
    for (size_t i = 1; *unique && i < n; i++) *unique = fids[i - 1] != fids[i];
    free(fids);
    return done;
}

bool gis_source_find_facts(gis_source *source, gis_source_facts *facts, gis_error *error)
{
    if (source->batch && !source->facts_given && !look_at_fids(source, error)) return false;
    *facts = source->facts;
    return true;
}

/* Makes the features behind the current batch come next again, after source_mark.c has read the layer from its
 * beginning. */
bool gis_source_resume(gis_source *source, gis_error *error)
{
    OGR_L_ResetReading(source->layer);
    for (size_t k = source->ended ? SIZE_MAX : 0; k < source->first + source->n; k++) {
        OGRFeatureH feature = OGR_L_GetNextFeature(source->layer);
        if (!feature)
            return gis_fail(error, "%s, layer %s: it has fewer features when it is read again", source->path,
                            source->name);
        OGR_F_Destroy(feature);
        if (!gis_go_on(error)) return false;
    }
    return true;
}

gis_source_marks *gis_source_marks_of(gis_source *source) { return source->batch ? &source->marks : NULL; }

bool gis_source_goes_by_fids(const gis_source *source)
{
    if (source->is_result || source->fids_mean_nothing) return false;
    return source->batch && !source->facts_given ? !source->fids_missing : source->facts.fids_unique;
}

/* Gets the extent before features are read, since that may disturb reading. */
static void find_extent(gis_source *source)
{
    OGREnvelope box;
    CPLPushErrorHandler(CPLQuietErrorHandler);
    if (OGR_L_TestCapability(source->layer, OLCFastGetExtent) &&
        OGR_L_GetExtent(source->layer, &box, FALSE) == OGRERR_NONE) {
        const double extent[4] = {box.MinX, box.MinY, box.MaxX, box.MaxY};
        memcpy(source->extent, extent, sizeof extent);
        source->extent_known = extent[0] <= extent[2] && extent[1] <= extent[3] && isfinite(extent[2] - extent[0]) &&
                               isfinite(extent[3] - extent[1]);
    }
    CPLPopErrorHandler();
    CPLErrorReset();
}

bool gis_source_begin_reading(gis_source *source, const gis_source_request *request, gis_error *error)
{
    if (request->batch) find_extent(source);
    source->batch = request->batch;
    source->may_pack = request->packed;
    source->wants = request->wants;
    source->user = request->user;
    source->not_finite = request->not_finite;
    source->fids_mean_nothing = request->fids_mean_nothing;
    source->fids_rising = true;
    source->facts_given = request->facts != NULL;
    if (source->facts_given) source->facts = *request->facts;
    if (source->may_pack && !begin_packing(source, error)) return false;
    OGR_L_ResetReading(source->layer);
    return read_batch(source, request, error) && (source->batch || source->facts_given || look_at_fids(source, error));
}

/* ---- Getters ----------------------------------------------------------------------------------------------------- */

size_t gis_source_count(const gis_source *source) { return source->n; }

OGRFeatureH gis_source_feature(const gis_source *source, size_t i)
{
    const gis_read_feature read = read_of(source, i);
    return read.feature ? read.feature : gis_packed_feature(source->packed, read.record);
}

OGRFeatureH gis_source_attributes(const gis_source *source, size_t i)
{
    const gis_read_feature read = read_of(source, i);
    return read.feature ? read.feature : gis_packed_attributes(source->packed, read.record);
}

OGRGeometryH gis_source_geometry(const gis_source *source, size_t i)
{
    return OGR_F_GetGeometryRef(gis_source_feature(source, i));
}

bool gis_source_is_packed(const gis_source *source, size_t i) { return source->contents[i] & RECORD; }

bool gis_source_polygons(const gis_source *source, size_t i, gis_polygonal_part *part, gis_error *error)
{
    const gis_read_feature read = read_of(source, i);
    return read.feature ? gis_geometry_polygonal_part(OGR_F_GetGeometryRef(read.feature), part, error)
                        : gis_packed_polygons(source->packed, read.record, part, error);
}

GIntBig gis_source_fid(const gis_source *source, size_t i)
{
    const gis_read_feature read = read_of(source, i);
    return read.feature ? OGR_F_GetFID(read.feature) : gis_packed_fid(read.record);
}

bool gis_source_plain(const gis_source *source, size_t i, double dx, double dy, const int *map, gis_value *values,
                      const unsigned char **geometry, size_t *bytes)
{
    const gis_read_feature read = read_of(source, i);
    if (read.feature) return false;
    *geometry = gis_packed_moved(source->packed, read.record, dx, dy, bytes);
    gis_packed_values(source->packed, read.record, map, values);
    return true;
}

bool gis_source_put(const gis_source *source, size_t i, const int *map, double dx, double dy, OGRFeatureH to,
                    gis_error *error)
{
    const gis_read_feature read = read_of(source, i);
    if (!read.feature) return gis_packed_put(source->packed, read.record, map, dx, dy, to, error);
    if (OGR_F_SetFromWithMap(to, read.feature, TRUE, map) != OGRERR_NONE)
        return gis_fail(error, "layer %s: the attributes of FID %" PRId64 " cannot be copied", source->name,
                        (int64_t)OGR_F_GetFID(read.feature));
    return gis_geometry_translate(OGR_F_GetGeometryRef(to), dx, dy, error);
}

bool gis_source_borrow(gis_source *source, sunder_shape *const *shape, unsigned threads, gis_error *error)
{
    gis_packed lean;
    if (!source->may_pack || !gis_packed_begin(&lean, source->layer, error)) return !source->may_pack;
    lean.shape = shape;
    /* The records are replaced only if all copies succeed. */
    const unsigned char **record = malloc((source->n + 1) * sizeof *record);
    for (size_t i = 0; i < source->n && record; i++) record[i] = read_of(source, i).record;
    const bool ok = record ? gis_packed_borrow_all(&lean, source->layer, record, source->n, gis_threads(threads), error)
                           : gis_no_memory(error);
    for (size_t i = 0; i < source->n && ok; i++)
        if (record[i]) source->held[i] = record[i];
    free(record);
    gis_packed_clear(ok ? source->packed : &lean);
    if (ok) *source->packed = lean;
    return ok;
}

bool gis_source_unpack(gis_source *source, gis_error *error)
{
    for (size_t i = 0; i < source->n; i++) {
        if (!(source->contents[i] & RECORD)) continue;
        OGRFeatureH feature = gis_packed_copy(source->packed, source->held[i]);
        if (!feature) return gis_no_memory(error);
        source->held[i] = feature;
        source->contents[i] &= (unsigned char)~RECORD;
    }
    if (source->packed) gis_packed_clear(source->packed);
    return true;
}

size_t gis_source_first(const gis_source *source) { return source->first; }

bool gis_source_fids_unique(const gis_source *source) { return source->facts.fids_unique; }
gis_content gis_source_content(const gis_source *source, size_t i)
{
    return (gis_content)(source->contents[i] & ~RECORD);
}

size_t gis_source_content_count(const gis_source *source, gis_content content)
{
    return source->facts.content[content];
}

bool gis_source_fids_negative(const gis_source *source) { return source->facts.fids_negative; }
bool gis_source_has_multipolygons(const gis_source *source) { return source->facts.multipolygons; }
