/* sink_features.c: writes one feature with GDAL. What is sent is remembered until it has been read back: as hashes if
 * the format keeps every value, else as it is. */
#include "write/sink/sink_internal.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "read/fields.h"

#include <cpl_conv.h>
#include <inttypes.h>
#include <stdlib.h>

/* ---- Attributes -------------------------------------------------------------------------------------------------- */

/* Sets the FID of a feature that is written like it was read. */
static void set_fid(const gis_sink_layer *layer, OGRFeatureH to, GIntBig fid)
{
    if (layer->fid_field >= 0 && fid != OGRNullFID) OGR_F_SetFieldInteger64(to, layer->fid_field, fid);
    OGR_F_SetFID(to, layer->request.like_source && layer->sink->fids_kept ? fid : OGRNullFID);
}

/* Sets the fields that the program adds. */
static void set_values(const gis_sink_layer *layer, OGRFeatureH to, const gis_value *values)
{
    for (size_t i = 0; i < layer->request.n_fields; i++) {
        int field = layer->own[i];
        if (field < 0) continue;
        switch (values[i].kind) {
        case GIS_NULL: OGR_F_SetFieldNull(to, field); break;
        case GIS_INTEGER: OGR_F_SetFieldInteger64(to, field, values[i].as.integer); break;
        case GIS_REAL: OGR_F_SetFieldDouble(to, field, values[i].as.real); break;
        case GIS_TEXT: OGR_F_SetFieldString(to, field, values[i].as.text); break;
        }
    }
}

/* Writes lists as JSON text if the field of the layer is a string; GDAL's own conversion is meant for readers, and cuts
 * long lists. */
static bool set_lists(const gis_sink_layer *layer, OGRFeatureH to, OGRFeatureH feature, gis_error *error)
{
    bool done = true;
    for (int i = 0; layer->lists && done && i < OGR_F_GetFieldCount(feature); i++) {
        const int field = layer->field_map[i];
        if (field < 0 || !OGR_F_IsFieldSetAndNotNull(feature, i) ||
            !gis_field_type_is_list(OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, i))) ||
            OGR_Fld_GetType(OGR_F_GetFieldDefnRef(to, field)) != OFTString)
            continue;
        gis_json list = {0};
        gis_field_list(feature, i, &list);
        const char *text = gis_json_text(&list);
        if (text) OGR_F_SetFieldString(to, field, text);
        done = text || gis_no_memory(error);
        gis_json_clear(&list);
    }
    return done;
}

static bool set_attributes(gis_sink_layer *layer, OGRFeatureH to, OGRFeatureH feature, const gis_value *values,
                           gis_error *error)
{
    if (feature && (layer->request.like_source || layer->request.copied)) {
        if (OGR_F_SetFromWithMap(to, feature, TRUE, layer->field_map) != OGRERR_NONE)
            return gis_fail(error, "layer %s: the attributes of FID %" PRId64 " cannot be copied", layer->name,
                            (int64_t)OGR_F_GetFID(feature));
        set_fid(layer, to, OGR_F_GetFID(feature));
        if (!set_lists(layer, to, feature, error)) return false;
    }
    set_values(layer, to, values);
    return true;
}

/* ---- Geometry ---------------------------------------------------------------------------------------------------- */

/* Notes losses that GDAL does not report: M values that are dropped, and arcs that are written as chords. */
static void note_losses(gis_sink_layer *layer, OGRFeatureH to)
{
    OGRGeometryH geometry = OGR_F_GetGeometryRef(to);
    if (!geometry || !layer->request.as_source) return;
    if (!layer->can_measure && OGR_G_IsMeasured(geometry) && !layer->sink->format.shapefile)
        gis_sentences_add(&layer->sink->losses, "M values are not written: %s has none", layer->sink->format.name);
    if (!layer->can_curve && OGR_G_HasCurveGeometry(geometry, TRUE))
        gis_sentences_add(&layer->sink->losses, "arcs are written as chords: %s has no arcs", layer->sink->format.name);
}

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

static void hear_warnings(gis_sink_layer *layer, const gis_listener *listener)
{
    if (layer->keep_sent && layer->sink->format.keeps_order)
        return; /* changed values are found when the layer is read back, and reported once for each field */
    for (size_t i = 0; i < listener->warnings.n; i++)
        gis_sentences_add(&layer->sink->warnings, "%s", listener->warnings.items[i]);
}

/* Has GDAL write `to`. *from is the FID that the feature was read with, for messages; NULL: it was not read from the
 * source. */
static bool create_feature(gis_sink_layer *layer, OGRFeatureH to, const GIntBig *from, gis_error *error)
{
    GIntBig fid = OGR_F_GetFID(to);
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    bool done = OGR_L_CreateFeature(layer->layer, to) == OGRERR_NONE && !listener.failures;
    gis_listen_end();
    if (done)
        layer->written++;
    else if (from)
        gis_fail(error, "%s, layer %s: FID %" PRId64 " cannot be written: %s", layer->sink->request.path, layer->name,
                 (int64_t)*from, gis_listener_reason(&listener, "GDAL gives no reason"));
    else
        gis_fail(error, "%s, layer %s: feature %zu cannot be written: %s", layer->sink->request.path, layer->name,
                 layer->written + 1, gis_listener_reason(&listener, "GDAL gives no reason"));
    hear_warnings(layer, &listener);
    gis_listener_clear(&listener);
    return done && gis_rtree_add(&layer->tree, to, error) && gis_digests_add(&layer->digests, to, fid, error);
}

/* Adapts a complete feature to the format, and writes it. */
static bool send_feature(gis_sink_layer *layer, OGRFeatureH to, const GIntBig *from, gis_error *error)
{
    if (layer->promote) gis_sink_promote(layer, to);
    if (layer->request.as_source && !gis_sink_holds(layer, OGR_F_GetGeometryRef(to))) OGR_F_SetGeometry(to, NULL);
    note_losses(layer, to);
    return (!layer->wind || gis_geometry_wind_clockwise(OGR_F_GetGeometryRef(to), error)) &&
           create_feature(layer, to, from, error);
}

static void look_at_digits(const gis_sink_layer *layer, OGRFeatureH written, bool *more)
{
    if (more) *more = layer->can_rewrite && !layer->more_digits && gis_sink_loses_digits(OGR_F_GetGeometryRef(written));
}

bool gis_sink_put(gis_sink_layer *layer, OGRFeatureH feature, OGRGeometryH geometry, const gis_value *values,
                  bool *more, gis_error *error)
{
    OGRFeatureH to = gis_go_on(error) ? OGR_F_Create(OGR_L_GetLayerDefn(layer->layer)) : NULL;
    if (!to) {
        OGR_G_DestroyGeometry(geometry);
        return gis_no_memory(error);
    }
    /* copies the source's geometry too, which is replaced below */
    bool done = set_attributes(layer, to, feature, values, error);
    if (done && layer->keep_sent)
        done = gis_sink_remember(layer, (gis_sent){feature, geometry ? OGR_G_Clone(geometry) : NULL, false, 0, 0},
                                 error) &&
               gis_sink_remember_values(layer, values, error);
    OGR_F_SetGeometryDirectly(to, geometry);
    const GIntBig from = feature ? OGR_F_GetFID(feature) : OGRNullFID;
    done = done && send_feature(layer, to, feature ? &from : NULL, error);
    if (done) look_at_digits(layer, to, more);
    OGR_F_Destroy(to);
    return done;
}

bool gis_sink_put_moved(gis_sink_layer *layer, OGRFeatureH feature, double dx, double dy, const gis_value *values,
                        bool *more, gis_error *error)
{
    OGRFeatureH to = gis_go_on(error) ? OGR_F_Create(OGR_L_GetLayerDefn(layer->layer)) : NULL;
    if (!to) return gis_no_memory(error);
    bool done = set_attributes(layer, to, feature, values, error);
    if (done && layer->keep_sent)
        done = gis_sink_remember(layer, (gis_sent){feature, NULL, true, dx, dy}, error) &&
               gis_sink_remember_values(layer, values, error);
    const GIntBig from = OGR_F_GetFID(feature);
    done = done && gis_geometry_translate(OGR_F_GetGeometryRef(to), dx, dy, error) &&
           send_feature(layer, to, &from, error);
    if (done) look_at_digits(layer, to, more);
    OGR_F_Destroy(to);
    return done;
}

bool gis_sink_put_source(gis_sink_layer *layer, size_t i, double dx, double dy, const gis_value *values,
                         gis_error *error)
{
    const gis_source *source = layer->source;
    OGRFeatureH to = OGR_F_Create(OGR_L_GetLayerDefn(layer->layer));
    if (!to) return gis_no_memory(error);
    const GIntBig from = gis_source_fid(source, i);
    bool done = gis_source_put(source, i, layer->field_map, dx, dy, to, error);
    if (done) set_fid(layer, to, from);
    done = done && (!layer->lists || set_lists(layer, to, gis_source_feature(source, i), error));
    if (done) set_values(layer, to, values);
    done = done && send_feature(layer, to, &from, error);
    OGR_F_Destroy(to);
    return done;
}
