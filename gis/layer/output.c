/* output.c: the layers of separate but the conflicts. What is written of a feature is what the core says of it: its
 * move and the place that this leads to are the doubles that were proved. */
#include "layer/output.h"

#include "base/interrupt.h"

#include <cpl_conv.h>
#include <math.h>
#include <string.h>

/* A block is called by its first member: by the FID, or, where FIDs tell nobody apart, by the place in the input. */
static gis_value block_value(const gis_layer_input *input, const sunder_report *report, size_t feature)
{
    int64_t block = sunder_report_block(report, feature);
    if (block < 0) return (gis_value){.kind = GIS_NULL};
    if (gis_source_fids_unique(input->source)) return gis_fid_value(input, (size_t)block);
    return (gis_value){GIS_INTEGER, {.integer = block}};
}

bool gis_write_main(gis_sink *sink, const gis_layer_input *input, const sunder_report *report, gis_error *error)
{
    static const gis_field fields[] = {{"sunder_dx", OFTReal, 0},
                                       {"sunder_dy", OFTReal, 0},
                                       {"sunder_len", OFTReal, 0},
                                       {"sunder_st", OFTString, 7},
                                       {"sunder_blk", OFTInteger64, 0}};
    const gis_sink_layer_request request = {.suffix = "",
                                            .like_source = true,
                                            .as_source = true,
                                            .fields = fields,
                                            .n_fields = sizeof fields / sizeof *fields,
                                            .style = GIS_STYLE_STATUS};
    gis_sink_layer *layer;
    if (!gis_sink_add(sink, &request, &layer, error)) return false;
    for (size_t i = 0; i < input->n; i++) {
        double dx, dy;
        if (!gis_go_on(error)) return false;
        sunder_report_move(report, i, &dx, &dy);
        const gis_value values[] = {
            {GIS_REAL, {.real = dx}},
            {GIS_REAL, {.real = dy}},
            {GIS_REAL, {.real = hypot(dx, dy)}},
            {GIS_TEXT, {.text = sunder_feature_status_string(sunder_report_status(report, i))}},
            block_value(input, report, i),
        };
        if (!gis_sink_write_source(layer, i, dx, dy, values, error)) return false;
    }
    return true;
}

bool gis_arrow_start(const gis_layer_input *input, size_t i, double from[2], gis_error *error)
{
    sunder_shape_anchor(input->shape[i], from);
    if (!input->points) return true;
    double *xy;
    size_t n;
    if (!gis_geometry_points(gis_source_geometry(input->source, i), &xy, &n, error)) return false;
    if (n > 0) memcpy(from, xy, 2 * sizeof *xy);
    CPLFree(xy);
    return true;
}

static bool write_arrow(gis_sink_layer *layer, const gis_layer_input *input, const sunder_report *report, size_t i,
                        const double move[2], gis_error *error)
{
    double from[2];
    if (!gis_arrow_start(input, i, from, error)) return false;
    gis_conflict_texts scratch = {0};
    gis_value id;
    if (!gis_id_value(input, i, &scratch.id[0], &id, error)) return false;
    const gis_value values[] = {gis_fid_value(input, i),
                                id,
                                {GIS_REAL, {.real = move[0]}},
                                {GIS_REAL, {.real = move[1]}},
                                {GIS_REAL, {.real = hypot(move[0], move[1])}},
                                block_value(input, report, i)};
    const double to[2] = {from[0] + move[0], from[1] + move[1]};
    OGRGeometryH line = gis_geometry_line(from, to);
    bool ok = line ? gis_sink_write(layer, NULL, line, values, error) : gis_no_memory(error);
    gis_conflict_texts_clear(&scratch);
    return ok;
}

bool gis_write_displacement(gis_sink *sink, const gis_layer_input *input, const sunder_report *report, gis_error *error)
{
    const gis_field fields[] = {{"fid", OFTInteger64, 0}, {"id", gis_id_type(input), 0}, {"dx", OFTReal, 0},
                                {"dy", OFTReal, 0},       {"len", OFTReal, 0},           {"block", OFTInteger64, 0}};
    const gis_sink_layer_request request = {.suffix = "displacement",
                                            .type = wkbLineString,
                                            .crs = gis_source_crs(input->source),
                                            .fields = fields,
                                            .n_fields = sizeof fields / sizeof *fields,
                                            .style = GIS_STYLE_DISPLACEMENT};
    gis_sink_layer *layer;
    if (!gis_sink_add(sink, &request, &layer, error)) return false;
    for (size_t i = 0; i < input->n; i++) {
        double move[2];
        sunder_report_move(report, i, &move[0], &move[1]);
        if ((move[0] != 0 || move[1] != 0) && !write_arrow(layer, input, report, i, move, error)) return false;
    }
    return true;
}

/* The shape moved: its corners plus the move, which the core chose so that they are doubles. */
static OGRGeometryH symbol_geometry(const sunder_shape *shape, double dx, double dy, bool multi, gis_error *error)
{
    gis_polygons all = {0};
    bool ok = gis_polygons_append_shape(&all, shape, dx, dy, error);
    OGRGeometryH geometry = ok ? gis_geometry_polygons(&all, multi) : NULL;
    if (ok && !geometry) gis_no_memory(error);
    gis_polygons_clear(&all);
    return geometry;
}

bool gis_write_symbols(gis_sink *sink, const gis_layer_input *input, const sunder_report *report, gis_error *error)
{
    bool multi = false;
    for (size_t i = 0; i < input->n; i++)
        multi = multi || (input->shape[i] && sunder_shape_polygons(input->shape[i]) > 1);
    const gis_sink_layer_request request = {.suffix = "symbols",
                                            .like_source = true,
                                            .type = multi ? wkbMultiPolygon : wkbPolygon,
                                            .crs = gis_source_crs(input->source),
                                            .style = GIS_STYLE_SYMBOLS};
    gis_sink_layer *layer;
    if (!gis_sink_add(sink, &request, &layer, error)) return false;
    for (size_t i = 0; i < input->n; i++) {
        double dx, dy;
        OGRGeometryH symbol = NULL;
        sunder_report_move(report, i, &dx, &dy);
        if (input->shape[i] && !sunder_shape_is_empty(input->shape[i])) {
            symbol = symbol_geometry(input->shape[i], dx, dy, multi, error);
            if (!symbol) return false;
        }
        if (!gis_sink_write(layer, gis_source_feature(input->source, i), symbol, NULL, error)) return false;
    }
    return true;
}
