/* buffer_layers.c: the layers that sunder buffer writes. Without --dissolve a feature keeps its FID and attributes; its
 * geometry is empty if the result or the feature's geometry is empty, and null if the feature had no polygons. A set of
 * dissolved features has the value of --dissolve-field, if given, and the number of its features. With --explode each
 * polygon of a set is a feature with the attributes of the set, except the number of features, which does not apply to
 * one polygon; sets without polygons are not written. */
#include "buffer/buffer.h"

#include "base/interrupt.h"
#include "layer/output.h"

#include <string.h>

/* Is the output layer one of MultiPolygons? It is if the layer of the source is one, if features are dissolved, or if a
 * result has more than one polygon; never with --explode. */
static bool is_multi(const gis_buffer *buffer)
{
    if (buffer->request->explode) return false;
    OGRwkbGeometryType type = wkbFlatten(gis_source_type(buffer->input.source));
    if (type == wkbMultiPolygon || type == wkbMultiSurface || buffer->request->dissolve) return true;
    for (size_t k = 0; k < buffer->sets; k++)
        if (buffer->set[k].result.set.polygons > 1) return true;
    return false;
}

static OGRGeometryH geometry_of(const gis_buffer_set *set, bool multi)
{
    const gis_polygons *polygons = &set->result.set;
    if (polygons->polygons == 0) return OGR_G_CreateGeometry(multi ? wkbMultiPolygon : wkbPolygon);
    return gis_geometry_polygons(polygons, multi);
}

/* The definition of the field of --dissolve-field in the source; owned by its layer. */
static OGRFieldDefnH field_of(const gis_buffer *buffer)
{
    OGRFeatureDefnH layer = OGR_L_GetLayerDefn(gis_source_layer(buffer->input.source));
    return OGR_FD_GetFieldDefn(layer, buffer->field);
}

static bool write_set(gis_sink_layer *layer, const gis_buffer_set *set, OGRFeatureH feature, bool multi,
                      gis_error *error)
{
    if (!gis_go_on(error)) return false;
    OGRGeometryH geometry = set->none ? NULL : geometry_of(set, multi);
    if (!geometry && !set->none) return gis_no_memory(error);
    const gis_value members = {GIS_INTEGER, {.integer = (GIntBig)set->members}};
    return gis_sink_write(layer, feature, geometry, &members, error);
}

static bool write_each(gis_sink_layer *layer, const gis_buffer_set *set, OGRFeatureH feature, gis_error *error)
{
    const gis_polygons *polygons = &set->result.set;
    for (size_t p = 0; !set->none && p < polygons->polygons; p++) {
        if (!gis_go_on(error)) return false;
        OGRGeometryH geometry = gis_geometry_polygon(polygons, p);
        if (!geometry) return gis_no_memory(error);
        if (!gis_sink_write(layer, feature, geometry, NULL, error)) return false;
    }
    return true;
}

static bool write_main(gis_sink *sink, const gis_buffer *buffer, gis_error *error)
{
    bool multi = is_multi(buffer);
    gis_field number = {"features", OFTInteger64, 0};
    gis_sink_layer_request request = {.suffix = "",
                                      .type = multi ? wkbMultiPolygon : wkbPolygon,
                                      .crs = gis_source_crs(buffer->input.source),
                                      .style = GIS_STYLE_RESULT};
    request.like_source = !buffer->request->dissolve;
    const bool dissolve = buffer->request->dissolve, counted = dissolve && !buffer->request->explode;
    if (counted) {
        request.fields = &number;
        request.n_fields = 1;
    }
    if (dissolve) {
        if (buffer->field >= 0) request.copied = field_of(buffer);
        if (request.copied && EQUAL(OGR_Fld_GetNameRef(request.copied), number.name)) number.name = "n_features";
    }
    gis_sink_layer *layer;
    if (!gis_sink_add(sink, &request, &layer, error)) return false;
    for (size_t k = 0; k < buffer->sets; k++) {
        const gis_buffer_set *set = &buffer->set[k];
        bool of_feature = !dissolve || request.copied;
        OGRFeatureH feature = of_feature ? gis_source_feature(buffer->input.source, set->member[0]) : NULL;
        if (!(buffer->request->explode ? write_each(layer, set, feature, error)
                                       : write_set(layer, set, feature, multi, error)))
            return false;
    }
    return true;
}

/* The feature that a degenerate segment or point belongs to: its FID and the value of --id-field; both are null where
 * features are dissolved. */
typedef struct owner {
    gis_value values[2];
    gis_conflict_texts texts;
} owner;

static bool owner_of(const gis_buffer *buffer, const gis_buffer_set *set, owner *out, gis_error *error)
{
    *out = (owner){.values = {{.kind = GIS_NULL}, {.kind = GIS_NULL}}};
    if (buffer->request->dissolve) return true;
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
        if (n > 0) gis_conflict_texts_clear(&whose.texts);
        if (!ok) return false;
    }
    return true;
}

static bool write_degenerate(gis_sink *sink, const gis_buffer *buffer, bool points, gis_error *error)
{
    const gis_field fields[] = {{"fid", OFTInteger64, 0}, {"id", gis_id_type(&buffer->input), 0}};
    const gis_sink_layer_request request = {.suffix = points ? "degenerate_points" : "degenerate_segments",
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
    if (!write_main(sink, buffer, error)) return false;
    if (!buffer->request->degenerate || !gis_sink_takes_more(sink)) return true;
    return write_degenerate(sink, buffer, false, error) && write_degenerate(sink, buffer, true, error);
}
