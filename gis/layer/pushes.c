/* pushes.c: the contact forces in the result, as lines between the anchors after the moves. A barrier has no anchor, so
 * the line ends at its vertex nearest to the feature's anchor. */
#include "layer/output.h"

#include <string.h>

void gis_things_push(const gis_things *things, const sunder_push *push, gis_value values[N_PUSH_COLUMNS])
{
    const char *layer = NULL;
    const bool barrier = gis_things_is_barrier(things, push->b);
    const GIntBig barrier_fid = barrier ? things->barrier(things->of, push->b, &layer) : OGRNullFID;
    const gis_value none = {.kind = GIS_NULL};
    const gis_value row[N_PUSH_COLUMNS] = {
        gis_fid_as_value(things->fid(things->of, push->a)),
        barrier ? none : gis_fid_as_value(things->fid(things->of, push->b)),
        barrier ? (gis_value){GIS_TEXT, {.text = layer}} : none,
        barrier ? gis_fid_as_value(barrier_fid) : none,
        {GIS_REAL, {.real = push->force}},
        {GIS_REAL, {.real = push->n[0]}},
        {GIS_REAL, {.real = push->n[1]}},
        gis_things_layer(things, push->a),
        gis_things_layer(things, push->b),
    };
    memcpy(values, row, sizeof row);
}

bool gis_pushes_begin(gis_sink *sink, OGRSpatialReferenceH crs, bool layers, gis_sink_layer **layer, gis_error *error)
{
    static const gis_field fields[N_PUSH_COLUMNS] = {{"fid_a", OFTInteger64, 0}, {"fid_b", OFTInteger64, 0},
                                                     {"barrier", OFTString, 0},  {"barr_fid", OFTInteger64, 0},
                                                     {"force", OFTReal, 0},      {"nx", OFTReal, 0},
                                                     {"ny", OFTReal, 0},         {"layer_a", OFTString, 0},
                                                     {"layer_b", OFTString, 0}};
    const gis_sink_layer_request request = {.suffix = "pushes",
                                            .type = wkbLineString,
                                            .crs = crs,
                                            .fields = fields,
                                            .n_fields = layers ? N_PUSH_COLUMNS : N_PUSH_COLUMNS - 2,
                                            .style = GIS_STYLE_PUSHES};
    return gis_sink_add(sink, &request, layer, error);
}
