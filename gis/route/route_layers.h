/* route_layers.h: a route as layers. */
#ifndef GIS_ROUTE_LAYERS_H
#define GIS_ROUTE_LAYERS_H

#include "route/route_input.h"
#include "write/sink/sink.h"

/* The layers MAIN (a feature a leg) and MAIN_placements (the robot along it); with --free-space also MAIN_obstacles,
 * MAIN_free_space, MAIN_degenerate_segments and MAIN_degenerate_points. *deviation: the largest distance of anything
 * written from what it is exactly. */
bool gis_write_route(gis_sink *sink, const gis_route_input *input, const sunder_route *route, double *deviation,
                     gis_error *error);

#endif
