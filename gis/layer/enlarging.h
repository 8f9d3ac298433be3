/* enlarging.h: features made larger, up to the least size, before anything else: their levels 0. */
#ifndef GIS_LAYER_ENLARGING_H
#define GIS_LAYER_ENLARGING_H

#include "layer/layer_input.h"

/* Makes the features of `input` larger that are too small, in place: they get their larger shapes in input->shape, and
 * as given[] the ones that they had. Sets feature[], the demands on all of them, to these shapes and to the blocks that
 * they form by the rules. Does nothing if the rules do not ask for it. */
bool gis_enlarge(gis_layer_input *input, sunder_feature *feature, gis_error *error);
/* Tells a layer of the features matched[n] of `input` (NULL: all n features) the shapes that they had. */
bool gis_enlarge_tell(const gis_layer_input *input, const size_t *matched, size_t n, sunder_layer *layer,
                      gis_error *error);

#endif
