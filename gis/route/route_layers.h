/* route_layers.h: writes a route as layers. */
#ifndef GIS_ROUTE_LAYERS_H
#define GIS_ROUTE_LAYERS_H

#include "route/route_input.h"
#include "write/sink/sink.h"

/* Writes the layers MAIN (a feature for each leg) and MAIN_placements (the robot along the route); with --free-space
 * also MAIN_obstacles, MAIN_free_space, MAIN_degenerate_segments and MAIN_degenerate_points. *deviation becomes the
 * largest distance of a written coordinate from its exact value. */
bool gis_write_route(gis_sink *sink, const gis_route_input *input, const sunder_route *route, double *deviation,
                     gis_error *error);

#endif
