/* shapes_ahead.h: shapes of plain polygons, made by several threads at once. */
#ifndef GIS_SHAPES_AHEAD_H
#define GIS_SHAPES_AHEAD_H

#include "layer/layer_input.h"

/* The shape of feature i, if nothing is to be said of it: it has no arcs, and is valid. Else it has none, and nothing
 * is said. */
bool gis_layer_plain_shape(const gis_layer_input *input, const gis_polygonal_part *part, size_t i);
/* Makes such shapes of a large layer of polygons, as far as its features are packed, if there may be two threads.
 * What fails, or is interrupted, is left without a shape. */
void gis_layer_shapes_ahead(gis_layer_input *input);

#endif
