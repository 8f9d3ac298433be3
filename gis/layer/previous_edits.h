/* previous_edits.h: which features were edited since an earlier result (--previous)? */
#ifndef GIS_PREVIOUS_EDITS_H
#define GIS_PREVIOUS_EDITS_H

#include "layer/layer_input.h"

/* Sets edited[i] for the features of the layer whose geometry is another one than when the result `before` was made;
 * now->previous has their numbers in it and their former moves. A feature whose shape the earlier run changed counts as
 * not edited, since the result does not have its former shape. */
bool gis_previous_find_edits(const gis_layer_input *now, const gis_layer_input *before, bool *edited, gis_error *error);

#endif
