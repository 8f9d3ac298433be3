/* output.c: the layers of separate but the conflicts, of a report. */
#include "layer/output.h"

#include "base/interrupt.h"

#include <cpl_conv.h>
#include <string.h>

static gis_value block_value(const gis_sink_layer *layer, const gis_layer_input *input, const sunder_report *report,
                             size_t feature)
{
    int64_t first = sunder_report_block(report, feature);
    if (first < 0 && !gis_sink_has_null(layer)) first = (int64_t)feature;
    return gis_block_as_value(gis_source_fids_unique(input->source), first,
                              first < 0 ? OGRNullFID : gis_source_fid(input->source, (size_t)first));
}

bool gis_write_main(gis_sink *sink, const gis_layer_input *input, const sunder_report *report, gis_error *error)
{
    gis_sink_layer *layer;
    if (!gis_main_begin(sink, &layer, error)) return false;
    for (size_t i = 0; i < input->n; i++) {
        gis_feature_row row = {.status = sunder_report_status(report, i),
                               .block = block_value(layer, input, report, i)};
        sunder_report_move(report, i, &row.dx, &row.dy);
        if (!gis_main_row(layer, i, &row, error)) return false;
    }
    return true;
}

bool gis_arrow_start(const gis_layer_input *input, size_t i, double from[2], gis_error *error)
{
    bool any = false;
    if (input->points && !gis_layer_point(input, i, from, &any, error)) return false;
    if (!any) sunder_shape_anchor(input->shape[i], from);
    return true;
}

static bool write_arrow(gis_sink_layer *layer, const gis_layer_input *input, const sunder_report *report, size_t i,
                        const double move[2], gis_error *error)
{
    gis_arrow_row row = {
        .fid = gis_fid_value(input, i), .block = block_value(layer, input, report, i), .move = {move[0], move[1]}};
    gis_conflict_texts scratch = {0};
    const bool ok = gis_arrow_start(input, i, row.from, error) &&
                    gis_id_value(input, i, &scratch.id[0], &row.id, error) && gis_displacement_row(layer, &row, error);
    gis_conflict_texts_clear(&scratch);
    return ok;
}

bool gis_write_displacement(gis_sink *sink, const gis_layer_input *input, const sunder_report *report, gis_error *error)
{
    gis_sink_layer *layer;
    if (!gis_displacement_begin(sink, gis_id_type(input), gis_source_crs(input->source), &layer, error)) return false;
    for (size_t i = 0; i < input->n; i++) {
        double move[2];
        sunder_report_move(report, i, &move[0], &move[1]);
        if ((move[0] != 0 || move[1] != 0) && !write_arrow(layer, input, report, i, move, error)) return false;
    }
    return true;
}

bool gis_write_symbols(gis_sink *sink, const gis_layer_input *input, const sunder_report *report, gis_error *error)
{
    bool multi = false;
    for (size_t i = 0; i < input->n; i++)
        multi = multi || (input->shape[i] && sunder_shape_polygons(input->shape[i]) > 1);
    gis_sink_layer *layer;
    if (!gis_symbols_begin(sink, multi, gis_source_crs(input->source), &layer, error)) return false;
    for (size_t i = 0; i < input->n; i++) {
        double dx, dy;
        sunder_report_move(report, i, &dx, &dy);
        if (!gis_symbols_row(layer, gis_source_feature(input->source, i), input->shape[i], dx, dy, multi, error))
            return false;
    }
    return true;
}
