/* symbols_anew.c: writes the layer of symbols of a source whose shapes were not kept; they are made again, in the same
 * way. */
#include "layer/output.h"

#include "base/interrupt.h"

static bool write_batch(gis_sink_layer *layer, gis_layer_input *input, bool multi, gis_move_of *move, void *user,
                        gis_error *error)
{
    if (!gis_layer_make_room(input, false, error) || !gis_layer_shapes(input, error)) return false;
    for (size_t i = 0; i < input->n; i++) {
        double t[2];
        if (!gis_go_on(error) || !move(user, gis_source_first(input->source) + i, t, error) ||
            !gis_symbols_row(layer, gis_source_feature(input->source, i), input->shape[i], t[0], t[1], multi, error))
            return false;
    }
    return true;
}

bool gis_write_symbols_anew(gis_sink *sink, const gis_layer_input *input, bool multi, bool batches, gis_move_of *move,
                            void *user, gis_error *error)
{
    gis_layer_input anew = *input; /* it has its own counts, shapes and state */
    gis_sink_layer *layer;
    bool any = true;
    anew.shape = NULL;
    anew.feature = NULL;
    anew.shaping = NULL;
    anew.n = 0;
    bool done = gis_symbols_begin(sink, 0, multi, gis_source_crs(input->source), &layer, error) &&
                (!batches || gis_source_again(input->source, &any, error));
    while (done && any) {
        done = write_batch(layer, &anew, multi, move, user, error);
        any = batches;
        if (done && any) done = gis_source_next(input->source, &any, error);
    }
    gis_layer_drop_features(&anew);
    gis_layer_shaping_free(anew.shaping);
    return done;
}
