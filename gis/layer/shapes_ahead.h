/* shapes_ahead.h: makes the shapes of plain polygons on several threads. */
#ifndef GIS_SHAPES_AHEAD_H
#define GIS_SHAPES_AHEAD_H

#include "layer/layer_input.h"

/* Makes the shape of feature i if it has no arcs and is valid; returns false, without an error, otherwise. */
bool gis_layer_plain_shape(const gis_layer_input *input, const gis_polygonal_part *part, size_t i);
/* Makes such shapes for a large layer of polygons whose features are packed, if two threads are allowed. Features that
 * fail, or come after a signal, are left without a shape. */
void gis_layer_shapes_ahead(gis_layer_input *input);

#endif
