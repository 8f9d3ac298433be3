/* sink_sent.c: keeps features as they were sent, to compare them or to send them again; for formats that change
 * values. */
#include "base/array.h"
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <stdlib.h>
#include <string.h>

bool gis_sink_remembers(const gis_sink *sink)
{
    return !sink->format.keeps_doubles && sink->place != GIS_PLACE_DATABASE;
}

static gis_value *values_of(const gis_sink_layer *layer, size_t i)
{
    return layer->sent_values ? layer->sent_values + i * layer->request.n_fields : NULL;
}

const gis_value *gis_sink_sent_values(const gis_sink_layer *layer, size_t i) { return values_of(layer, i); }

/* Keeps a copy of the values of the feature that was remembered last. */
bool gis_sink_remember_values(gis_sink_layer *layer, const gis_value *values, gis_error *error)
{
    size_t n = layer->request.n_fields;
    if (n == 0 || !values) return true;
    if (layer->values_room < layer->capacity) {
        gis_value *larger = realloc(layer->sent_values, layer->capacity * n * sizeof *larger);
        if (!larger) return gis_no_memory(error);
        layer->sent_values = larger;
        layer->values_room = layer->capacity;
    }
    gis_value *to = values_of(layer, layer->n_sent - 1);
    memcpy(to, values, n * sizeof *to);
    for (size_t k = 0; k < n; k++)
        if (to[k].kind == GIS_TEXT) to[k].as.text = CPLStrdup(to[k].as.text);
    return true;
}

void gis_sink_forget_values(gis_sink_layer *layer)
{
    for (size_t i = 0; layer->sent_values && i < layer->n_sent * layer->request.n_fields; i++)
        if (layer->sent_values[i].kind == GIS_TEXT) CPLFree((void *)layer->sent_values[i].as.text);
    free(layer->sent_values);
    layer->sent_values = NULL;
    layer->values_room = 0;
}

bool gis_sink_remember(gis_sink_layer *layer, gis_sent sent, gis_error *error)
{
    if (!gis_array_reserve(&layer->sent, &layer->capacity, layer->n_sent + 1, sizeof *layer->sent)) {
        OGR_G_DestroyGeometry(sent.made);
        return gis_no_memory(error);
    }
    layer->sent[layer->n_sent++] = sent;
    return true;
}

void gis_sink_forget_sent(gis_sink_layer *layer)
{
    gis_sink_forget_values(layer);
    for (size_t i = 0; i < layer->n_sent; i++) OGR_G_DestroyGeometry(layer->sent[i].made);
    free(layer->sent);
    layer->sent = NULL;
    layer->n_sent = layer->capacity = 0;
}
