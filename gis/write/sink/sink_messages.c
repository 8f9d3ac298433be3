/* sink_messages.c: messages about features that do not read back. */
#include "write/sink/abilities.h"
#include "write/sink/sink_internal.h"

bool gis_sink_fail_count(const gis_sink_layer *layer, size_t read_back, gis_error *error)
{
    const gis_sink *sink = layer->sink;
    bool some_empty =
        layer->request.like_source && layer->source &&
        gis_source_content_count(layer->source, GIS_NOTHING) + gis_source_content_count(layer->source, GIS_BROKEN) > 0;
    return gis_fail(error, "%s, layer %s: %zu features were written, but %zu read back%s", sink->request.path,
                    layer->name, layer->written, read_back,
                    sink->format.abilities & GIS_NEEDS_GEOMETRY ? "; the format drops features without geometry"
                    : some_empty ? "; the format may have no place for features without geometry"
                                 : "");
}

bool gis_sink_fail_reading(const gis_sink_layer *layer, size_t after, const char *reason, gis_error *error)
{
    return gis_fail(error, "%s, layer %s: reading it back failed after %zu features: %s; is the disk full?",
                    layer->sink->request.path, layer->name, after, reason);
}
