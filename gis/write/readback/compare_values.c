/* compare_values.c: compares values read back with those sent, in formats that may change them: the source's fields,
 * the fields that the program adds, and FIDs. Changes are counted here and reported by losses.c. */
#include "read/fields.h"
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int gis_sink_field_index(OGRFeatureDefnH definition, const char *name)
{
    for (int i = 0; name && name[0] && i < OGR_FD_GetFieldCount(definition); i++)
        if (strcmp(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i)), name) == 0) return i;
    return name && name[0] ? OGR_FD_GetFieldIndex(definition, name) : -1;
}

bool gis_sink_begin_values(gis_sink_layer *layer, OGRLayerH as_written, gis_error *error)
{
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(as_written);
    const size_t n = layer->request.n_fields;
    const bool source = gis_sink_tells(layer) && layer->created;
    const size_t fields = source ? (size_t)CSLCount(layer->created) : 0;
    free(layer->changes);
    free(layer->own_changes);
    layer->changes = source ? calloc(fields + 1, sizeof *layer->changes) : NULL;
    layer->own_changes = calloc(n + 1, sizeof *layer->own_changes);
    if (!layer->own_changes || (source && !layer->changes)) return gis_no_memory(error);
    for (size_t i = 0; i < fields; i++)
        layer->changes[i].index = gis_sink_field_index(definition, layer->created[i]);
    for (size_t i = 0; i < n; i++)
        layer->own_changes[i].index = gis_sink_field_index(definition, CSLGetField(layer->own_created, (int)i));
    layer->fid_change = (gis_field_change){
        .index = gis_sink_field_index(definition, CSLGetField(layer->own_created, (int)n))};
    return true;
}

static void count_change(gis_field_change *change, bool same, GIntBig fid)
{
    if (!same && change->count++ == 0) change->first = fid;
}

/* ---- The source's ------------------------------------------------------------------------------------------------ */

static bool is_integer(OGRFieldType type) { return type == OFTInteger || type == OFTInteger64; }

/* Does field k of `kept` hold the integer `sent`, in whatever type the format stores it? */
static bool is_the_integer(GIntBig sent, OGRFeatureH kept, int k)
{
    char text[32];
    switch (OGR_Fld_GetType(OGR_F_GetFieldDefnRef(kept, k))) {
    case OFTInteger:
    case OFTInteger64: return OGR_F_GetFieldAsInteger64(kept, k) == sent;
    case OFTReal: { /* above 2^53 the nearest double may stand for another integer, and 2^63 does not fit into the
                     * cast */
        const double x = OGR_F_GetFieldAsDouble(kept, k);
        return x == (double)sent && fabs(x) < 0x1p63 && (GIntBig)x == sent;
    }
    default:
        snprintf(text, sizeof text, "%" PRId64, (int64_t)sent);
        return strcmp(OGR_F_GetFieldAsString(kept, k), text) == 0;
    }
}

/* Does field k of `kept` hold the list in field i of `sent` as JSON text? */
static bool is_the_list(OGRFeatureH sent, int i, OGRFeatureH kept, int k)
{
    gis_json list = {0};
    gis_field_list(sent, i, &list);
    const char *text = gis_json_text(&list);
    const bool same = text && strcmp(text, OGR_F_GetFieldAsString(kept, k)) == 0;
    gis_json_clear(&list);
    return same;
}

static bool same_value(OGRFeatureH sent, int i, OGRFeatureH kept, int k)
{
    bool has = OGR_F_IsFieldSetAndNotNull(sent, i);
    if (has != OGR_F_IsFieldSetAndNotNull(kept, k)) return false;
    if (!has) return true;
    OGRFieldType type = OGR_Fld_GetType(OGR_F_GetFieldDefnRef(sent, i));
    OGRFieldType as = OGR_Fld_GetType(OGR_F_GetFieldDefnRef(kept, k));
    if (type == OFTReal && as == OFTReal)
        return OGR_F_GetFieldAsDouble(sent, i) == OGR_F_GetFieldAsDouble(kept, k) ||
               (isnan(OGR_F_GetFieldAsDouble(sent, i)) && isnan(OGR_F_GetFieldAsDouble(kept, k)));
    if (is_integer(type)) return is_the_integer(OGR_F_GetFieldAsInteger64(sent, i), kept, k);
    if (gis_field_type_is_list(type) && as == OFTString) return is_the_list(sent, i, kept, k);
    char *text = CPLStrdup(OGR_F_GetFieldAsString(sent, i)); /* copied, since GDAL reuses the string at the next call */
    bool same = strcmp(text, OGR_F_GetFieldAsString(kept, k)) == 0;
    CPLFree(text);
    return same;
}

/* ---- The program's own ------------------------------------------------------------------------------------------- */

/* Does field k hold `sent`? Real numbers of the program's own fields are meant for readers, so nine equal digits are
 * enough. */
static bool is_the_real(double sent, OGRFeatureH kept, int k)
{
    const double as = OGR_F_GetFieldAsDouble(kept, k);
    return sent == as || fabs(sent - as) <= 1e-9 * fabs(sent) || (isnan(sent) && isnan(as));
}

static void compare_own(const gis_value *sent, OGRFeatureH kept, gis_field_change *change, GIntBig fid)
{
    const int k = change->index;
    const bool blank = gis_field_is_blank(kept, k);
    if (sent->kind == GIS_NULL)
        change->nulls += !blank;
    else if (blank)
        count_change(change, sent->kind == GIS_TEXT && !sent->as.text[0], fid);
    else if (sent->kind == GIS_INTEGER)
        count_change(change, is_the_integer(sent->as.integer, kept, k), fid);
    else if (sent->kind == GIS_REAL)
        count_change(change, is_the_real(sent->as.real, kept, k), fid);
    else
        count_change(change, strcmp(OGR_F_GetFieldAsString(kept, k), sent->as.text) == 0, fid);
}

/* If the format keeps FIDs they are compared as the FIDs of features; else as the values of the field sunder_fid. */
static void compare_fid(gis_sink_layer *layer, GIntBig fid, OGRFeatureH kept)
{
    gis_field_change *change = &layer->fid_change;
    if (!layer->request.like_source || fid == OGRNullFID) return;
    if (layer->sink->fids_kept)
        count_change(change, OGR_F_GetFID(kept) == fid, fid);
    else if (change->index >= 0)
        count_change(change, !gis_field_is_blank(kept, change->index) && is_the_integer(fid, kept, change->index), fid);
}

bool gis_sink_compare_values(gis_sink_layer *layer, size_t i, OGRFeatureH kept, gis_error *error)
{
    OGRFeatureH feature = layer->sent[i].feature;
    const gis_value *values = gis_sink_sent_values(layer, i);
    const GIntBig fid = feature ? OGR_F_GetFID(feature) : (GIntBig)i;
    if (!layer->own_changes) return true;
    const int fields = layer->changes && feature ? OGR_F_GetFieldCount(feature) : 0;
    for (int f = 0; f < fields; f++)
        if (layer->changes[f].index >= 0)
            count_change(&layer->changes[f], same_value(feature, f, kept, layer->changes[f].index), fid);
    for (size_t f = 0; values && f < layer->request.n_fields; f++)
        if (layer->own_changes[f].index >= 0) compare_own(&values[f], kept, &layer->own_changes[f], fid);
    if (feature) compare_fid(layer, fid, kept);
    return gis_go_on(error);
}
