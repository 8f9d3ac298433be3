/* output.c: see output.h. */
#include "layer/output.h"

bool gis_arrow_start(const gis_layer_input *input, size_t i, double from[2], gis_error *error)
{
    bool any = false;
    input = gis_layer_own(input, &i);
    if (input->points && !gis_layer_point(input, i, from, &any, error)) return false;
    if (!any) sunder_shape_anchor(input->shape[i], from);
    return true;
}

/* main: the number of the main layer of these points. */
static bool write_symbols_of(gis_sink *sink, const gis_layer_input *input, size_t main, const sunder_report *report,
                             gis_error *error)
{
    bool multi = false;
    for (size_t i = 0; i < input->n; i++)
        multi = multi || (input->shape[i] && sunder_shape_polygons(input->shape[i]) > 1);
    gis_sink_layer *layer;
    if (!gis_symbols_begin(sink, main, multi, gis_source_crs(input->source), &layer, error)) return false;
    for (size_t i = 0; i < input->n; i++) {
        double dx, dy;
        sunder_report_move(report, input->first + i, &dx, &dy);
        if (!gis_symbols_row(layer, gis_source_feature(input->source, i), input->shape[i], dx, dy, multi, error))
            return false;
    }
    return true;
}

bool gis_write_symbols(gis_sink *sink, const gis_layer_input *input, const sunder_report *report, gis_error *error)
{
    if (!input->parts) return write_symbols_of(sink, input, 0, report, error);
    for (size_t k = 0; k < input->parts; k++)
        if (input->part[k].points && !write_symbols_of(sink, &input->part[k], k, report, error)) return false;
    return true;
}
