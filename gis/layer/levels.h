/* levels.h: the smaller shapes that features may have, made by the rules: the rungs of a run, from the largest on.
 *
 * A feature has a rung only if its shape meets the conditions and lies in that of the rung before. The core numbers the
 * levels of a feature without the rungs that it does not have. */
#ifndef GIS_LEVELS_H
#define GIS_LEVELS_H

#include "layer/layer_input.h"

/* Do the rules allow smaller shapes? */
bool gis_levels_asked(const gis_layer_rules *rules);
/* Sets *rigid to an array [n] of the features that --rigid-where selects, NULL if it is not given; the caller frees it,
 * also after a failure. */
bool gis_levels_rigid(const gis_layer_input *input, bool **rigid, gis_error *error);

/* Makes the smaller shapes of the features of `input`; `layer` has all of them. Clear *out also after a failure. */
bool gis_levels_make(const gis_layer_input *input, const sunder_layer *layer, gis_levels *out, gis_error *error);
/* Sets the smaller shapes, and the least that they keep, for a layer of the features matched[n] of `input` (NULL: all n
 * features). They must outlive the layer. Does nothing if the rules do not allow any. */
bool gis_levels_set(const gis_layer_input *input, const gis_levels *levels, const size_t *matched, size_t n,
                    sunder_layer *layer, gis_error *error);
void gis_levels_clear(gis_levels *levels);

/* Returns the rung of level k >= 1 of feature i, counted from 0. */
size_t gis_levels_rung(const gis_levels *levels, size_t i, size_t k);
/* Returns the shape of feature i on a rung that it has. */
static inline const sunder_shape *gis_levels_shape(const gis_levels *levels, size_t i, size_t rung)
{
    return levels->shape[i * levels->rungs + rung];
}
/* Returns the shape that feature i has in the result; that as read if it is hidden. */
const sunder_shape *gis_levels_shape_now(const gis_layer_input *input, const sunder_report *report, size_t i);

#endif
