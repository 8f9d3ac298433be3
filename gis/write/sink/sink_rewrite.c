/* sink_rewrite.c: writes a layer with decimal numbers once more, with more digits.
 *
 * SIGNIFICANT_FIGURES=17 would be enough for every double, but GDAL tries to print nicer numbers: if the digits after
 * the point contain 999999 or 000000, it tries up to three digits fewer and takes the first result without them, so
 * that 999999.4999999995 becomes 999999.5. With 20 digits every number keeps at least 17 of them, but most numbers get
 * digits without meaning. So a layer is begun with 17. The first coordinate that would lose makes the program begin
 * again with 20; and if the layer still reads back differently, it is written again then. */
#define _LARGEFILE64_SOURCE /* cpl_vsi.h needs struct stat64 */
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool any_real_changed(const gis_sink_layer *layer)
{
    OGRFeatureDefnH source = layer->changes ? OGR_L_GetLayerDefn(gis_source_layer(layer->source)) : NULL;
    for (int i = 0; source && i < OGR_FD_GetFieldCount(source); i++)
        if (layer->changes[i].count && OGR_Fld_GetType(OGR_FD_GetFieldDefn(source, i)) == OFTReal) return true;
    return false;
}

bool gis_sink_may_rewrite(const gis_sink_layer *layer, const gis_sink_result *seen)
{
    return layer->can_rewrite && !layer->more_digits && (!seen->exact || any_real_changed(layer));
}

/* Resets the layer to the state before it was made, and makes it with more digits. */
static bool start_again(gis_sink_layer *layer, gis_error *error)
{
    char *path = gis_sink_inside(layer->sink, layer->file);
    VSIUnlink(path);
    CPLFree(path);
    CPLFree(layer->field_map);
    CPLFree(layer->own);
    CSLDestroy(layer->created);
    CSLDestroy(layer->own_created);
    free(layer->changes);
    free(layer->own_changes);
    layer->field_map = layer->own = NULL;
    layer->created = layer->own_created = NULL;
    layer->changes = layer->own_changes = NULL;
    layer->fid_field = -1;
    layer->written = layer->n_sent = layer->capacity = layer->values_room = 0;
    layer->sent = NULL;
    layer->sent_values = NULL;
    layer->more_digits = true;
    return gis_sink_dataset_for(layer->sink, layer, error) && gis_sink_create_layer(layer, error);
}

bool gis_sink_send_again(gis_sink_layer *layer, gis_error *error)
{
    gis_sink_layer before = *layer; /* owns what was sent, until it is sent again */
    bool done = start_again(layer, error);
    for (size_t i = 0; done && i < before.n_sent; i++) {
        gis_sent *sent = &before.sent[i];
        OGRGeometryH made = sent->made;
        sent->made = NULL;
        const gis_value *values = gis_sink_sent_values(&before, i);
        done = sent->moved ? gis_sink_put_moved(layer, sent->feature, sent->dx, sent->dy, values, NULL, error)
                           : gis_sink_put(layer, sent->feature, made, values, NULL, error);
    }
    gis_sink_forget_sent(&before);
    return done;
}

bool gis_sink_rewrite(gis_sink_layer *layer, gis_error *error)
{
    return gis_sink_send_again(layer, error) && gis_sink_close(layer->sink, layer, error);
}
