/* losses.c: reports what the format could not hold of fields, geometry type and CRS. Losses are found by inspecting the
 * written layer, not from knowledge about formats, so that they are true for every driver and version. */
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Phrases that are joined by commas to one sentence. */
typedef struct parts {
    char text[600];
} parts;

static void add_phrase(parts *all, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void add_phrase(parts *all, const char *format, ...)
{
    size_t used = strlen(all->text);
    if (used) used += (size_t)snprintf(all->text + used, sizeof all->text - used, ", ");
    if (used >= sizeof all->text) return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(all->text + used, sizeof all->text - used, format, arguments);
    va_end(arguments);
}

static const char *type_name(OGRFieldDefnH field)
{
    OGRFieldSubType subtype = OGR_Fld_GetSubType(field);
    return subtype == OFSTNone ? OGR_GetFieldTypeName(OGR_Fld_GetType(field)) : OGR_GetFieldSubTypeName(subtype);
}

static bool same_text(const char *a, const char *b) { return (!a || !a[0]) ? !b || !b[0] : b && strcmp(a, b) == 0; }

/* Does the field have a domain? A layer that is still open for writing returns the name it was given, so with a
 * `dataset` a domain counts only if the dataset holds it. */
static bool has_domain(GDALDatasetH dataset, OGRFieldDefnH field)
{
    const char *name = OGR_Fld_GetDomainName(field);
    return name && name[0] && (!dataset || GDALDatasetGetFieldDomain(dataset, name));
}

static void compare_field(const gis_sink_layer *layer, OGRFieldDefnH sent, OGRFieldDefnH kept,
                          const gis_field_change *change)
{
    parts lost = {""};
    const char *name = OGR_Fld_GetNameRef(sent);
    if (strcmp(name, OGR_Fld_GetNameRef(kept)) != 0) add_phrase(&lost, "called %s", OGR_Fld_GetNameRef(kept));
    if (OGR_Fld_GetType(sent) != OGR_Fld_GetType(kept) || OGR_Fld_GetSubType(sent) != OGR_Fld_GetSubType(kept))
        add_phrase(&lost, "%s instead of %s", type_name(kept), type_name(sent));
    int width = OGR_Fld_GetWidth(sent), width_kept = OGR_Fld_GetWidth(kept);
    if (width_kept != 0 && width > width_kept) add_phrase(&lost, "width %d instead of %d", width_kept, width);
    if (!OGR_Fld_IsNullable(sent) && OGR_Fld_IsNullable(kept)) add_phrase(&lost, "may be null");
    if (OGR_Fld_IsUnique(sent) && !OGR_Fld_IsUnique(kept) && !layer->sink->request.new_fids)
        add_phrase(&lost, "need not be unique");
    if (!same_text(OGR_Fld_GetDefault(sent), OGR_Fld_GetDefault(kept)))
        add_phrase(&lost, "no default %s", OGR_Fld_GetDefault(sent) ? OGR_Fld_GetDefault(sent) : "");
    if (has_domain(NULL, sent) &&
        !(same_text(OGR_Fld_GetDomainName(sent), OGR_Fld_GetDomainName(kept)) && has_domain(layer->dataset, kept)))
        add_phrase(&lost, "no domain %s", OGR_Fld_GetDomainName(sent));
    if (change && change->count)
        add_phrase(&lost, "%zu value%s cannot be held as %s (first: FID %" PRId64 ")", change->count,
                   change->count == 1 ? "" : "s", change->count == 1 ? "it is" : "they are", (int64_t)change->first);
    if (lost.text[0]) gis_sentences_add(&layer->sink->losses, "field %s: %s", name, lost.text);
}

static void compare_fields(gis_sink_layer *layer, OGRFeatureDefnH as_written)
{
    gis_sink *sink = layer->sink;
    OGRFeatureDefnH source = OGR_L_GetLayerDefn(gis_source_layer(layer->source));
    for (int i = 0; i < OGR_FD_GetFieldCount(source); i++) {
        const char *name = CSLGetField(layer->created, i);
        if (!name[0]) continue; /* the field was replaced, or its loss was reported when the layer was made */
        OGRFieldDefnH sent = OGR_FD_GetFieldDefn(source, i);
        int index = gis_sink_field_index(as_written, name);
        if (index < 0)
            gis_sentences_add(&sink->losses, "field %s: not written", OGR_Fld_GetNameRef(sent));
        else
            compare_field(layer, sent, OGR_FD_GetFieldDefn(as_written, index),
                          layer->changes ? &layer->changes[i] : NULL);
    }
    for (int i = 1; i < OGR_FD_GetGeomFieldCount(source); i++)
        gis_sentences_add(&sink->losses, "geometry column %s is not written: only the first one is",
                          OGR_GFld_GetNameRef(OGR_FD_GetGeomFieldDefn(source, i)));
}

static void compare_type(gis_sink_layer *layer, OGRLayerH as_written)
{
    OGRwkbGeometryType kept = OGR_L_GetGeomType(as_written), sent = layer->type;
    if (kept == sent || layer->sink->format.shapefile ||
        (kept == wkbUnknown && layer->written == 0)) /* such formats derive the layer's type from its features */
        return;
    gis_sentences_add(&layer->sink->losses, "the layer is declared as %s instead of %s", OGRGeometryTypeToName(kept),
                      OGRGeometryTypeToName(sent));
}

static const char *crs_name(OGRSpatialReferenceH crs)
{
    const char *name = crs ? OSRGetName(crs) : NULL;
    return name ? name : "none";
}

static void compare_crs(gis_sink_layer *layer, OGRLayerH as_written)
{
    OGRSpatialReferenceH sent = gis_source_crs(layer->source), kept = OGR_L_GetSpatialRef(as_written);
    static const char *const options[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", "CRITERION=EQUIVALENT", NULL};
    if (!sent && !kept) return;
    if (!sent || !kept || !OSRIsSameEx(sent, kept, options)) {
        /* a GeoPackage has named entries for an undefined CRS */
        if (!sent && strstr(crs_name(kept), "ndefined")) return;
        gis_sentences_add(&layer->sink->losses, "the CRS is %s instead of %s", crs_name(kept), crs_name(sent));
    }
}

/* Reports which values of the program's own fields, and which FIDs, read back differently. */
static void tell_values(gis_sink_layer *layer)
{
    gis_sentences *losses = &layer->sink->losses;
    parts nulls = {""};
    for (size_t i = 0; layer->own_changes && i < layer->request.n_fields; i++) {
        const gis_field_change *change = &layer->own_changes[i];
        const char *name = layer->request.fields[i].name;
        if (layer->written && change->index < 0 && CSLGetField(layer->own_created, (int)i)[0])
            gis_sentences_add(losses, "layer %s: field %s is missing when it is read", layer->name, name);
        if (change->nulls) add_phrase(&nulls, "%s", name);
        if (change->count)
            gis_sentences_add(losses, "layer %s, field %s: %zu value%s back as written", layer->name, name,
                              change->count, change->count == 1 ? " does not read" : "s do not read");
    }
    if (nulls.text[0]) gis_sentences_add(losses, "layer %s: null reads back as a value in %s", layer->name, nulls.text);
    if (layer->fid_change.count && gis_sink_tells(layer))
        gis_sentences_add(losses, "%zu FID%s back as written (first: FID %" PRId64 ")", layer->fid_change.count,
                          layer->fid_change.count == 1 ? " does not read" : "s do not read",
                          (int64_t)layer->fid_change.first);
}

void gis_sink_find_losses(gis_sink_layer *layer, OGRLayerH as_written)
{
    tell_values(layer);
    if (!gis_sink_tells(layer) || !layer->source) return;
    gis_listener listener = {0}; /* PROJ may report errors when CRSs are compared; they are ignored */
    gis_listen_begin(&listener);
    compare_fields(layer, OGR_L_GetLayerDefn(as_written));
    compare_type(layer, as_written);
    compare_crs(layer, as_written);
    gis_listen_end();
    gis_listener_clear(&listener);
}

/* ---- Beside a Shapefile ------------------------------------------------------------------------------------------ */

static bool esri_knows(OGRSpatialReferenceH crs)
{
    static const char *const options[] = {"FORMAT=WKT1_ESRI", NULL};
    char *text = NULL;
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    bool known = crs && OSRExportToWktEx(crs, &text, options) == OGRERR_NONE && text && text[0];
    gis_listen_end();
    gis_listener_clear(&listener);
    CPLFree(text);
    return known;
}

bool gis_sink_check_companions(const gis_sink_layer *layer, OGRLayerH as_written, gis_error *error)
{
    const gis_sink *sink = layer->sink;
    if (!sink->format.shapefile) return true;
    bool crs = OGR_L_GetSpatialRef(as_written) != NULL || !esri_knows(gis_sink_crs(layer));
    bool encoding = GDALGetMetadataItem(as_written, "ENCODING_FROM_CPG", "SHAPEFILE") != NULL || !layer->has_encoding;
    return (crs && encoding) || gis_fail(error, "%s, layer %s: the file of its %s was not written; is the disk full?",
                                         sink->request.path, layer->name, crs ? "encoding" : "CRS");
}
