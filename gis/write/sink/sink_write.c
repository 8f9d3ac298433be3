/* sink_write.c: writes features: as rows through SQLite if everything is plain, else with GDAL. A layer is begun again,
 * with more digits, at the first coordinate that would lose digits. */
#include "base/interrupt.h"
#include "write/sink/sink_internal.h"

#include <stdlib.h>

/* Begins the layer again with more digits, if `more` says that they are needed. */
static bool begin_again_if(bool more, gis_sink_layer *layer, gis_error *error)
{
    return !more || (gis_sink_close(layer->sink, layer, error) && gis_sink_send_again(layer, error));
}

bool gis_sink_write(gis_sink_layer *layer, OGRFeatureH feature, OGRGeometryH geometry, const gis_value *values,
                    gis_error *error)
{
    bool more = false;
    return gis_sink_put(layer, feature, geometry, values, &more, error) && begin_again_if(more, layer, error);
}

bool gis_sink_write_line(gis_sink_layer *layer, const double from[2], const double to[2], const gis_value *values,
                         gis_error *error)
{
    if (!gis_go_on(error)) return false;
    const gis_row row = layer->keep_sent ? GIS_ROW_GDAL : gis_sink_line(layer, from, to, values, error);
    if (row != GIS_ROW_GDAL) return row == GIS_ROW_DONE;
    OGRGeometryH line = gis_geometry_line(from, to);
    if (!line) return gis_no_memory(error);
    const bool done = gis_sink_write(layer, NULL, line, values, error);
    if (done) gis_sink_row_by_gdal(layer, (GIntBig)layer->written);
    return done;
}

bool gis_sink_write_moved(gis_sink_layer *layer, OGRFeatureH feature, double dx, double dy, const gis_value *values,
                          gis_error *error)
{
    bool more = false;
    return gis_sink_put_moved(layer, feature, dx, dy, values, &more, error) && begin_again_if(more, layer, error);
}

bool gis_sink_write_source(gis_sink_layer *layer, size_t i, double dx, double dy, const gis_value *values,
                           gis_error *error)
{
    const gis_source *source = layer->source;
    if (layer->keep_sent) return gis_sink_write_moved(layer, gis_source_feature(source, i), dx, dy, values, error);
    if (!gis_go_on(error)) return false;
    const gis_row row = gis_sink_row(layer, i, dx, dy, values, error);
    if (row != GIS_ROW_GDAL) return row == GIS_ROW_DONE;
    const bool done = gis_sink_put_source(layer, i, dx, dy, values, error);
    if (done) gis_sink_row_by_gdal(layer, gis_source_fid(source, i));
    return done;
}

bool gis_sink_write_shaped(gis_sink_layer *layer, size_t i, OGRGeometryH geometry, const gis_value *values,
                           gis_error *error)
{
    const gis_source *source = layer->source;
    if (!layer->keep_sent && !gis_sink_rows_flush(layer, error)) {
        OGR_G_DestroyGeometry(geometry);
        return false;
    }
    const bool done = gis_sink_write(layer, gis_source_feature(source, i), geometry, values, error);
    if (done && !layer->keep_sent) gis_sink_row_by_gdal(layer, gis_source_fid(source, i));
    return done;
}
