/* house_rows.c: the rows of neighbours in the result, as lines through the anchors after the moves. */
#include "layer/output.h"

bool gis_house_rows_begin(gis_sink *sink, OGRSpatialReferenceH crs, gis_sink_layer **layer, gis_error *error)
{
    static const gis_field fields[] = {
        {"row", OFTInteger64, 0}, {"houses", OFTInteger64, 0}, {"kink_bef", OFTReal, 0}, {"kink_aft", OFTReal, 0}};
    const gis_sink_layer_request request = {.suffix = "rows",
                                            .type = wkbLineString,
                                            .crs = crs,
                                            .fields = fields,
                                            .n_fields = sizeof fields / sizeof *fields,
                                            .style = GIS_STYLE_ROWS};
    return gis_sink_add(sink, &request, layer, error);
}

bool gis_house_row(gis_sink_layer *layer, const sunder_row *row, GIntBig least_fid, const double *xy, gis_error *error)
{
    const gis_value values[] = {
        gis_fid_as_value(least_fid),
        {GIS_INTEGER, {.integer = (GIntBig)row->bodies}},
        {GIS_REAL, {.real = row->kink_before}},
        {GIS_REAL, {.real = row->kink_after}},
    };
    OGRGeometryH line = OGR_G_CreateGeometry(wkbLineString);
    if (!line) return gis_no_memory(error);
    for (size_t k = 0; k < row->features; k++) OGR_G_AddPoint_2D(line, xy[2 * k], xy[2 * k + 1]);
    if (row->ring) OGR_G_AddPoint_2D(line, xy[0], xy[1]);
    return gis_sink_write(layer, NULL, line, values, error);
}
