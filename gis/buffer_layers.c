/* buffer_layers.c: the layers that sunder buffer writes. A feature keeps its FID and attributes; one that vanished has an
 * empty geometry, one that had no polygon to begin with a null one. A set of dissolved features has the value of the
 * field, if one was named, and the number of features in it. */
#include "buffer.h"

#include "layer_output.h"
#include "report.h"

#include <string.h>

/* Are all results single polygons, so that the layer may be one of polygons? */
static bool is_multi(const gis_buffer *buffer)
{
    OGRwkbGeometryType type = wkbFlatten(gis_source_type(buffer->input.source));
    if (type == wkbMultiPolygon || type == wkbMultiSurface || buffer->dissolve)
        return true;
    for (size_t k = 0; k < buffer->sets; k++)
        if (buffer->set[k].result.set.polygons > 1)
            return true;
    return false;
}

static OGRGeometryH geometry_of(const gis_buffer_set *set, bool multi)
{
    const gis_polygons *polygons = &set->result.set;
    if (polygons->polygons == 0)
        return OGR_G_CreateGeometry(multi ? wkbMultiPolygon : wkbPolygon);
    return gis_geometry_polygons(polygons->xy, polygons->ring_end, polygons->poly_end, polygons->polygons, multi);
}

/* The field of --dissolve-field, as the kinds of value that the program's own fields can have. */
static gis_field field_of(const gis_buffer *buffer)
{
    OGRFeatureDefnH layer = OGR_L_GetLayerDefn(gis_source_layer(buffer->input.source));
    OGRFieldDefnH field = OGR_FD_GetFieldDefn(layer, buffer->field);
    OGRFieldType type = OGR_Fld_GetType(field);
    bool whole = type == OFTInteger || type == OFTInteger64;
    return (gis_field){OGR_Fld_GetNameRef(field), whole ? OFTInteger64 : type == OFTReal ? OFTReal : OFTString, 0};
}

static gis_value value_of(const gis_buffer *buffer, const gis_buffer_set *set, OGRFieldType type)
{
    OGRFeatureH feature = gis_source_feature(buffer->input.source, set->member[0]);
    if (!OGR_F_IsFieldSetAndNotNull(feature, buffer->field))
        return (gis_value){.kind = GIS_NULL};
    if (type == OFTInteger64)
        return (gis_value){GIS_INTEGER, {.integer = OGR_F_GetFieldAsInteger64(feature, buffer->field)}};
    if (type == OFTReal)
        return (gis_value){GIS_REAL, {.real = OGR_F_GetFieldAsDouble(feature, buffer->field)}};
    return (gis_value){GIS_TEXT, {.text = OGR_F_GetFieldAsString(feature, buffer->field)}};
}

static bool write_main(gis_sink *sink, const gis_buffer *buffer, gis_error *error)
{
    bool multi = is_multi(buffer);
    gis_field fields[2] = {{"features", OFTInteger64, 0}};
    gis_layer_request request = {.suffix = "", .type = multi ? wkbMultiPolygon : wkbPolygon,
                                 .crs = gis_source_crs(buffer->input.source), .style = GIS_STYLE_RESULT};
    request.like_source = !buffer->dissolve;
    if (buffer->dissolve) {
        request.fields = fields;
        request.n_fields = buffer->field >= 0 ? 2 : 1;
        if (buffer->field >= 0)
            fields[1] = field_of(buffer);
    }
    gis_sink_layer *layer;
    if (!gis_sink_add(sink, &request, &layer, error))
        return false;
    for (size_t k = 0; k < buffer->sets; k++) {
        const gis_buffer_set *set = &buffer->set[k];
        if (gis_interrupted())
            return gis_fail(error, "interrupted");
        OGRGeometryH geometry = set->none ? NULL : geometry_of(set, multi);
        if (!geometry && !set->none)
            return gis_no_memory(error);
        gis_value values[2] = {{GIS_INTEGER, {.integer = (GIntBig)set->members}}};
        if (request.n_fields == 2)
            values[1] = value_of(buffer, set, fields[1].type);
        OGRFeatureH feature =
            buffer->dissolve ? NULL : gis_source_feature(buffer->input.source, set->member[0]);
        if (!gis_sink_write(layer, feature, geometry, request.n_fields ? values : NULL, error))
            return false;
    }
    return true;
}

/* Which feature a degenerate part is of: its FID and the user's key; null where features are dissolved. */
typedef struct owner {
    gis_value values[2];
    gis_conflict_texts texts;
} owner;

static bool owner_of(const gis_buffer *buffer, const gis_buffer_set *set, owner *out, gis_error *error)
{
    *out = (owner){.values = {{.kind = GIS_NULL}, {.kind = GIS_NULL}}};
    if (buffer->dissolve)
        return true;
    out->values[0] = gis_fid_value(&buffer->input, set->member[0]);
    return gis_id_value(&buffer->input, set->member[0], &out->texts.id[0], &out->values[1], error);
}

static bool write_parts(gis_sink_layer *layer, const gis_buffer *buffer, bool points, gis_error *error)
{
    for (size_t k = 0; k < buffer->sets; k++) {
        const gis_buffer_set *set = &buffer->set[k];
        size_t n = points ? set->points : set->segments;
        owner whose;
        bool ok = n == 0 || owner_of(buffer, set, &whose, error);
        for (size_t i = 0; ok && i < n; i++) {
            OGRGeometryH geometry = points ? gis_geometry_point(set->point + 2 * i)
                                           : gis_geometry_line(set->segment + 4 * i, set->segment + 4 * i + 2);
            ok = geometry ? gis_sink_write(layer, NULL, geometry, whose.values, error) : gis_no_memory(error);
        }
        if (n > 0)
            gis_conflict_texts_clear(&whose.texts);
        if (!ok)
            return false;
    }
    return true;
}

static bool write_degenerate(gis_sink *sink, const gis_buffer *buffer, bool points, gis_error *error)
{
    const gis_field fields[] = {{"fid", OFTInteger64, 0}, {"id", gis_id_type(&buffer->input), 0}};
    const gis_layer_request request = {.suffix = points ? "degenerate_points" : "degenerate_segments",
                                       .type = points ? wkbPoint : wkbLineString,
                                       .crs = gis_source_crs(buffer->input.source),
                                       .fields = fields,
                                       .n_fields = sizeof fields / sizeof *fields,
                                       .style = GIS_STYLE_RESULT};
    gis_sink_layer *layer;
    return gis_sink_add(sink, &request, &layer, error) && write_parts(layer, buffer, points, error);
}

bool gis_write_buffer(gis_sink *sink, const gis_buffer *buffer, gis_error *error)
{
    if (!write_main(sink, buffer, error))
        return false;
    if (!buffer->options->given[OPT_DEGENERATE] || !gis_sink_takes_more(sink))
        return true;
    return write_degenerate(sink, buffer, false, error) && write_degenerate(sink, buffer, true, error);
}
