/* levels_again.h: check --before makes the shapes again that the features of the original layer may have. */
#ifndef GIS_LAYER_LEVELS_AGAIN_H
#define GIS_LAYER_LEVELS_AGAIN_H

#include "layer/layer_input.h"

/* Makes the larger shapes of the features of `original`, in place, and *levels, their smaller ones. Features that the
 * result has are in the blocks of the result; each of the others, lost[n], joins the block of one that it touches.
 * Does nothing if the rules allow neither. */
bool gis_levels_again(gis_layer_input *original, const size_t *lost, size_t n, gis_levels *levels, gis_error *error);

#endif
