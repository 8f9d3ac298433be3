/* levels.h: the smaller shapes (rungs.h) of the features of a layer that is held in memory. */
#ifndef GIS_LEVELS_H
#define GIS_LEVELS_H

#include "layer/layer_input.h"

/* Sets *rigid to an array [n] of the features that --rigid-where selects, NULL if it is not given; the caller frees it,
 * also after a failure. */
bool gis_levels_rigid(const gis_layer_input *input, bool **rigid, gis_error *error);

/* Makes the smaller shapes of the features of `input`; `layer` has all of them. Clear *out also after a failure. */
bool gis_levels_make(const gis_layer_input *input, const sunder_layer *layer, gis_levels *out, gis_error *error);
/* Sets them for a layer of the features matched[n] of `input`: gis_rungs_set(). */
bool gis_levels_set(const gis_layer_input *input, const gis_levels *levels, const size_t *matched, size_t n,
                    sunder_layer *layer, gis_error *error);

/* Returns the shape that feature i has in the result; that as read if it is hidden. */
const sunder_shape *gis_levels_shape_now(const gis_layer_input *input, const sunder_report *report, size_t i);

#endif
