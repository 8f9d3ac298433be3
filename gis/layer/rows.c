/* rows.c: rows of the layers of separate, except those of conflicts.c and pushes.c. Moves and new places are exactly
 * the doubles that the core verified. */
#include "layer/rows.h"

#include "base/interrupt.h"

#include <math.h>

gis_value gis_fid_as_value(GIntBig fid)
{
    return fid == OGRNullFID ? (gis_value){.kind = GIS_NULL} : (gis_value){GIS_INTEGER, {.integer = fid}};
}

gis_value gis_block_as_value(bool fids_unique, int64_t first, GIntBig fid)
{
    if (first < 0) return (gis_value){.kind = GIS_NULL};
    return fids_unique ? gis_fid_as_value(fid) : (gis_value){GIS_INTEGER, {.integer = first}};
}

bool gis_main_begin(gis_sink *sink, size_t main, bool hide, bool smaller, gis_sink_layer **layer, gis_error *error)
{
    static const gis_field fields[] = {
        {"sunder_dx", OFTReal, 0},     {"sunder_dy", OFTReal, 0},       {"sunder_len", OFTReal, 0},
        {"sunder_st", OFTString, 7},   {"sunder_blk", OFTInteger64, 0}, {"sunder_inv", OFTInteger, 0},
        {"sunder_lvl", OFTInteger, 0}, {"sunder_cut", OFTReal, 0},      {"sunder_siz", OFTReal, 0}};
    const size_t columns = sizeof fields / sizeof *fields;
    const gis_sink_layer_request request = {.suffix = "",
                                            .main = main,
                                            .like_source = true,
                                            .as_source = true,
                                            .fields = fields,
                                            .n_fields = smaller ? columns : columns - (hide ? 3 : 4),
                                            .style = smaller ? GIS_STYLE_WITH_RUNGS
                                                     : hide  ? GIS_STYLE_WITH_HIDDEN
                                                             : GIS_STYLE_STATUS};
    if (!gis_sink_add(sink, &request, layer, error)) return false;
    if (!gis_sink_has_null(*layer))
        gis_sink_tell_loss(*layer,
                           "the format has no null: a feature in no block has its own FID in sunder_blk and block");
    return true;
}

static OGRGeometryH geometry_of(const sunder_shape *shape, double dx, double dy, bool multi, gis_error *error)
{
    gis_polygons all = {0};
    bool ok = gis_polygons_append_shape(&all, shape, dx, dy, error);
    OGRGeometryH geometry = ok ? gis_geometry_polygons(&all, multi) : NULL;
    if (ok && !geometry) gis_no_memory(error);
    gis_polygons_clear(&all);
    return geometry;
}

bool gis_main_row(gis_sink_layer *layer, size_t i, const gis_feature_row *row, gis_error *error)
{
    const gis_value values[] = {
        {GIS_REAL, {.real = row->dx}},
        {GIS_REAL, {.real = row->dy}},
        {GIS_REAL, {.real = hypot(row->dx, row->dy)}},
        {GIS_TEXT, {.text = sunder_feature_status_string(row->status)}},
        row->block,
        {GIS_INTEGER, {.integer = row->status == SUNDER_FEATURE_HIDDEN}},
        {GIS_INTEGER, {.integer = (GIntBig)row->rung}},
        {GIS_REAL, {.real = row->lost}},
        {row->size > 0 ? GIS_REAL : GIS_NULL, {.real = row->size}},
    };
    if (!gis_go_on(error)) return false;
    if (!row->other) return gis_sink_write_source(layer, i, row->dx, row->dy, values, error);
    OGRGeometryH geometry = geometry_of(row->other, row->dx, row->dy, row->multi, error);
    return geometry && gis_sink_write_shaped(layer, i, geometry, values, error);
}

bool gis_displacement_begin(gis_sink *sink, OGRFieldType id, OGRSpatialReferenceH crs, bool layers,
                            gis_sink_layer **layer, gis_error *error)
{
    const gis_field fields[] = {{"fid", OFTInteger64, 0}, {"id", id, 0},       {"dx", OFTReal, 0},
                                {"dy", OFTReal, 0},       {"len", OFTReal, 0}, {"block", OFTInteger64, 0},
                                {"layer_a", OFTString, 0}};
    const gis_sink_layer_request request = {.suffix = "displacement",
                                            .type = wkbLineString,
                                            .crs = crs,
                                            .fields = fields,
                                            .n_fields = sizeof fields / sizeof *fields - (layers ? 0 : 1),
                                            .style = GIS_STYLE_DISPLACEMENT};
    return gis_sink_add(sink, &request, layer, error);
}

bool gis_displacement_row(gis_sink_layer *layer, const gis_arrow_row *row, gis_error *error)
{
    const gis_value values[] = {row->fid,
                                row->id,
                                {GIS_REAL, {.real = row->move[0]}},
                                {GIS_REAL, {.real = row->move[1]}},
                                {GIS_REAL, {.real = hypot(row->move[0], row->move[1])}},
                                row->block,
                                row->layer};
    const double to[2] = {row->from[0] + row->move[0], row->from[1] + row->move[1]};
    return gis_line_row(layer, values, row->from, to, error);
}

bool gis_line_row(gis_sink_layer *layer, const gis_value *values, const double from[2], const double to[2],
                  gis_error *error)
{
    return gis_sink_write_line(layer, from, to, values, error);
}

bool gis_symbols_begin(gis_sink *sink, size_t main, bool multi, OGRSpatialReferenceH crs, gis_sink_layer **layer,
                       gis_error *error)
{
    const gis_sink_layer_request request = {.suffix = "symbols",
                                            .main = main,
                                            .like_source = true,
                                            .type = multi ? wkbMultiPolygon : wkbPolygon,
                                            .crs = crs,
                                            .style = GIS_STYLE_SYMBOLS};
    return gis_sink_add(sink, &request, layer, error);
}

bool gis_symbols_row(gis_sink_layer *layer, OGRFeatureH feature, const sunder_shape *shape, double dx, double dy,
                     bool multi, gis_error *error)
{
    OGRGeometryH symbol = NULL;
    if (shape && !sunder_shape_is_empty(shape)) {
        symbol = geometry_of(shape, dx, dy, multi, error);
        if (!symbol) return false;
    }
    return gis_sink_write(layer, feature, symbol, NULL, error);
}
