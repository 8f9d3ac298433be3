/* sink_fields.c: makes the fields of a layer: those of the source, as far as the driver has their types and can
 * distinguish their names, and the fields that the program adds. losses.c checks the result afterwards. */
#include "read/fields.h"
#include "write/sink/abilities.h"
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <stdio.h>
#include <string.h>

#define FID_FIELD "sunder_fid"

OGRFeatureDefnH gis_sink_source_fields(const gis_sink_layer *layer)
{
    return layer->request.like_source && layer->source ? OGR_L_GetLayerDefn(gis_source_layer(layer->source)) : NULL;
}

bool gis_sink_makes_field(const gis_sink_layer *layer, const char *name)
{
    for (size_t i = 0; i < layer->request.n_fields; i++)
        if (EQUAL(layer->request.fields[i].name, name)) return true;
    if (layer->request.copied && EQUAL(OGR_Fld_GetNameRef(layer->request.copied), name)) return true;
    return !layer->sink->fids_kept && EQUAL(name, FID_FIELD);
}

/* ---- Types ------------------------------------------------------------------------------------------------------- */

/* Does the driver's metadata item `item` list `name`? */
static bool driver_lists(const gis_sink_layer *layer, const char *item, const char *name)
{
    const char *list = GDALGetMetadataItem(layer->sink->format.driver, item, NULL);
    char **each = CSLTokenizeString2(list ? list : "", " ", 0);
    const bool found = CSLFindString(each, name) >= 0;
    CSLDestroy(each);
    return found;
}

/* May a field of this type be created? A driver may accept a field of a type that it lacks, and then refuse the
 * features or drop the field; for such types its list of types is consulted. Dates are not checked, since drivers
 * convert them. A driver without a list is tried. */
static bool has_type(const gis_sink_layer *layer, OGRFieldType type)
{
    const bool asks = gis_field_type_is_list(type) || type == OFTInteger64 || type == OFTTime || type == OFTBinary;
    return !asks || !GDALGetMetadataItem(layer->sink->format.driver, GDAL_DMD_CREATIONFIELDDATATYPES, NULL) ||
           driver_lists(layer, GDAL_DMD_CREATIONFIELDDATATYPES, OGR_GetFieldTypeName(type));
}

/* The type to try if the driver lacks `type`; `type` itself if there is no other. A list becomes JSON text. */
static OGRFieldType next_type(OGRFieldType type)
{
    switch (type) {
    case OFTInteger64: return OFTReal;
    case OFTInteger:
    case OFTReal:
    case OFTDate:
    case OFTTime:
    case OFTDateTime:
    case OFTIntegerList:
    case OFTInteger64List:
    case OFTRealList:
    case OFTStringList: return OFTString;
    default: return type;
    }
}

/* ---- Names ------------------------------------------------------------------------------------------------------- */

static bool has_name(OGRFeatureDefnH definition, const char *name) /* ignoring case */
{
    for (int i = 0; i < OGR_FD_GetFieldCount(definition); i++)
        if (EQUAL(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i)), name)) return true;
    return false;
}

/* The name for field i of the source: its own or, if the driver ignores case and the layer has that name already (or
 * the driver uses it itself), the name with a number appended, as ogr2ogr does, that no other field has or will get.
 * CPLFree(). */
static char *name_for(const gis_sink_layer *layer, OGRFeatureDefnH source, int i)
{
    enum { DIGITS = 12 };
    OGRFeatureDefnH made = OGR_L_GetLayerDefn(layer->layer);
    const char *name = OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(source, i)), *own = layer->sink->format.own_field;
    const bool is_own = own && EQUAL(own, name);
    if (!is_own && ((layer->sink->format.abilities & GIS_KEEPS_CASE) || !has_name(made, name))) return CPLStrdup(name);
    const size_t size = strlen(name) + DIGITS;
    char *numbered = CPLMalloc(size);
    int k = 2;
    do snprintf(numbered, size, "%s%d", name, k++);
    while (has_name(made, numbered) || has_name(source, numbered) || gis_sink_makes_field(layer, numbered));
    return numbered;
}

/* ---- Making a field ---------------------------------------------------------------------------------------------- */

static void copy_domain(gis_sink_layer *layer, OGRFieldDefnH field)
{
    const char *name = OGR_Fld_GetDomainName(field);
    if (!name || !name[0] || GDALDatasetGetFieldDomain(layer->dataset, name)) return;
    OGRFieldDomainH domain = GDALDatasetGetFieldDomain(gis_source_dataset(layer->source), name);
    if (domain) /* if this fails the field is made without its domain, which is found when the layer is read back */
        GDALDatasetAddFieldDomain(layer->dataset, domain, NULL);
}

static int create_field(gis_sink_layer *layer, OGRFieldDefnH field)
{
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(layer->layer);
    int before = OGR_FD_GetFieldCount(definition);
    bool created = OGR_L_CreateField(layer->layer, field, TRUE) == OGRERR_NONE;
    return created && OGR_FD_GetFieldCount(definition) > before ? before : -1;
}

/* A field definition like `like` with this name and type but without constraints, which hold within the source only.
 * NULL: no memory. */
static OGRFieldDefnH unconstrained_copy(const gis_sink_layer *layer, OGRFieldDefnH like, const char *name,
                                        OGRFieldType type)
{
    OGRFieldDefnH field = OGR_Fld_Create(name, type);
    if (!field) return NULL;
    OGR_Fld_SetAlternativeName(field, OGR_Fld_GetAlternativeNameRef(like));
    if (type == OGR_Fld_GetType(like)) {
        OGR_Fld_SetSubType(field, OGR_Fld_GetSubType(like));
        OGR_Fld_SetWidth(field, OGR_Fld_GetWidth(like));
        OGR_Fld_SetPrecision(field, OGR_Fld_GetPrecision(like));
        OGR_Fld_SetDomainName(field, OGR_Fld_GetDomainName(like));
    } else if (gis_field_type_is_list(OGR_Fld_GetType(like)) &&
               driver_lists(layer, GDAL_DMD_CREATIONFIELDDATASUBTYPES, "JSON")) {
        OGR_Fld_SetSubType(field, OFSTJSON);
    }
    return field;
}

/* Creates a field like `like` but with this name and type. If features are written more than once (new_fids), values
 * are no longer unique, and the constraint is dropped. Returns its index, or -1. */
static int create_like(gis_sink_layer *layer, OGRFieldDefnH like, const char *name, OGRFieldType type)
{
    const bool unique = OGR_Fld_IsUnique(like) && !layer->sink->request.new_fids, same = type == OGR_Fld_GetType(like);
    if (same && strcmp(name, OGR_Fld_GetNameRef(like)) == 0 && unique == (bool)OGR_Fld_IsUnique(like))
        return create_field(layer, like);
    OGRFieldDefnH field = unconstrained_copy(layer, like, name, type);
    if (!field) return -1;
    OGR_Fld_SetNullable(field, OGR_Fld_IsNullable(like));
    OGR_Fld_SetUnique(field, unique);
    if (same) OGR_Fld_SetDefault(field, OGR_Fld_GetDefault(like));
    int index = create_field(layer, field);
    OGR_Fld_Destroy(field);
    return index;
}

/* Creates the field with the first type that the driver has and accepts, beginning with the field's own. Returns its
 * index; -1: there is none. */
static int create_fitting(gis_sink_layer *layer, OGRFieldDefnH like, const char *name)
{
    for (OGRFieldType type = OGR_Fld_GetType(like);; type = next_type(type)) {
        const int index = has_type(layer, type) ? create_like(layer, like, name, type) : -1;
        if (index >= 0 || next_type(type) == type) return index;
    }
}

static void note_not_written(gis_sink_layer *layer, OGRFieldDefnH like)
{
    gis_sentences_add(&layer->sink->losses, "field %s: not written, %s cannot hold the type %s",
                      OGR_Fld_GetNameRef(like), layer->sink->format.name, OGR_GetFieldTypeName(OGR_Fld_GetType(like)));
}

/* ---- The fields of the source ------------------------------------------------------------------------------------ */

static void create_source_field(gis_sink_layer *layer, OGRFeatureDefnH source, int i)
{
    OGRFieldDefnH field = OGR_FD_GetFieldDefn(source, i);
    layer->field_map[i] = -1;
    if (gis_sink_makes_field(layer, OGR_Fld_GetNameRef(field))) {
        if (gis_sink_tells(layer))
            gis_sentences_add(&layer->sink->warnings, "field %s of the input is replaced", OGR_Fld_GetNameRef(field));
        return;
    }
    copy_domain(layer, field);
    char *name = name_for(layer, source, i);
    layer->field_map[i] = create_fitting(layer, field, name);
    CPLFree(name);
    if (layer->field_map[i] < 0 && gis_sink_tells(layer)) note_not_written(layer, field);
}

/* Is the list in field i of the source written as text? */
static bool is_list_as_text(const gis_sink_layer *layer, OGRFeatureDefnH source, int i)
{
    const int to = layer->field_map[i];
    return to >= 0 && gis_field_type_is_list(OGR_Fld_GetType(OGR_FD_GetFieldDefn(source, i))) &&
           OGR_Fld_GetType(OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(layer->layer), to)) == OFTString;
}

static void create_source_fields(gis_sink_layer *layer)
{
    OGRFeatureDefnH source = gis_sink_source_fields(layer), definition = OGR_L_GetLayerDefn(layer->layer);
    const int n = source ? OGR_FD_GetFieldCount(source) : 0;
    layer->field_map = CPLMalloc(((size_t)n + 1) * sizeof *layer->field_map);
    for (int i = 0; i < n; i++) {
        create_source_field(layer, source, i);
        const int to = layer->field_map[i];
        layer->lists = layer->lists || is_list_as_text(layer, source, i);
        layer->created =
            CSLAddString(layer->created, to < 0 ? "" : OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, to)));
    }
}

/* ---- The program's own ------------------------------------------------------------------------------------------- */

static int create_field_of(gis_sink_layer *layer, const char *name, OGRFieldType type, int width)
{
    OGRFieldDefnH field = OGR_Fld_Create(name, type);
    if (!field) return -1;
    OGR_Fld_SetWidth(field, width);
    int index = create_field(layer, field);
    OGR_Fld_Destroy(field);
    return index;
}

/* Creates a field that the program adds. A driver without 64-bit integers gets a real, one without numbers a text; if
 * the driver accepts neither, the field is lost. Returns its index, or -1. */
static int create_own_field(gis_sink_layer *layer, const char *name, OGRFieldType type, int width)
{
    for (OGRFieldType as = type;; as = next_type(as)) {
        const int index = has_type(layer, as) ? create_field_of(layer, name, as, as == type ? width : 0) : -1;
        if (index >= 0) return index;
        if (next_type(as) == as) break;
    }
    gis_sentences_add(&layer->sink->losses, "layer %s: field %s is not written: %s cannot hold it", layer->name, name,
                      layer->sink->format.name);
    return -1;
}

/* Creates the single field that is copied from the source; field_map maps it alone. */
static void create_copy(gis_sink_layer *layer)
{
    OGRFieldDefnH like = layer->request.copied;
    OGRFeatureDefnH source = OGR_L_GetLayerDefn(gis_source_layer(layer->source));
    const int n = OGR_FD_GetFieldCount(source);
    OGRFieldDefnH field = unconstrained_copy(layer, like, OGR_Fld_GetNameRef(like), OGR_Fld_GetType(like));
    if (!field) return;
    copy_domain(layer, field);
    const int index = create_fitting(layer, field, OGR_Fld_GetNameRef(like));
    OGR_Fld_Destroy(field);
    if (index < 0) note_not_written(layer, like);
    OGRFieldDefnH made = index < 0 ? NULL : OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(layer->layer), index);
    if (made && strcmp(OGR_Fld_GetNameRef(made), OGR_Fld_GetNameRef(like)) != 0)
        gis_sentences_add(&layer->sink->losses, "field %s: called %s", OGR_Fld_GetNameRef(like),
                          OGR_Fld_GetNameRef(made));
    CPLFree(layer->field_map);
    layer->field_map = CPLMalloc(((size_t)n + 1) * sizeof *layer->field_map);
    for (int i = 0; i < n; i++) {
        bool is_it = strcmp(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(source, i)), OGR_Fld_GetNameRef(like)) == 0;
        layer->field_map[i] = is_it ? index : -1;
        layer->lists = layer->lists || is_list_as_text(layer, source, i);
    }
}

static void keep_own_name(gis_sink_layer *layer, int index)
{
    OGRFieldDefnH field = index < 0 ? NULL : OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(layer->layer), index);
    layer->own_created = CSLAddString(layer->own_created, field ? OGR_Fld_GetNameRef(field) : "");
}

void gis_sink_create_fields(gis_sink_layer *layer)
{
    const size_t n = layer->request.n_fields;
    create_source_fields(layer);
    layer->own = CPLMalloc((n + 1) * sizeof *layer->own);
    for (size_t i = 0; i < n; i++) {
        const gis_field *field = &layer->request.fields[i];
        layer->own[i] = create_own_field(layer, field->name, field->type, field->width);
        keep_own_name(layer, layer->own[i]);
    }
    if (layer->request.copied) create_copy(layer);
    if (gis_sink_source_fields(layer) && !layer->sink->fids_kept)
        layer->fid_field = create_own_field(layer, FID_FIELD, OFTInteger64, 0);
    if (layer->fid_field >= 0 && gis_sink_tells(layer) && (layer->sink->format.abilities & GIS_NEEDS_POSITIVE_FIDS) &&
        gis_source_fids_negative(layer->source))
        gis_sentences_add(&layer->sink->warnings, "FIDs less than 0 do not read back from %s: all stand in %s",
                          layer->sink->format.name, FID_FIELD);
    keep_own_name(layer, layer->fid_field);
}
