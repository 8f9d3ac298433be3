/* sum_layers.h: writes a sum, rounded to doubles, as layers. */
#ifndef GIS_SUM_LAYERS_H
#define GIS_SUM_LAYERS_H

#include "geometry/round/round.h"
#include "sunder.h"
#include "write/sink/sink.h"

/* Writes the layers MAIN, MAIN_degenerate_segments and MAIN_degenerate_points; *deviation becomes the largest deviation
 * of a written vertex from its exact position. */
bool gis_write_sum(gis_sink *sink, const sunder_sum *sum, OGRSpatialReferenceH crs, double *deviation,
                   gis_error *error);

/* Writes each polygon of the set as a feature; all have the same `values` of the layer's fields. */
bool gis_write_polygons(gis_sink_layer *layer, const gis_polygons *set, const gis_value *values, gis_error *error);

/* Write the n degenerate segments, or points, of the sum to a layer; *deviation is raised to the largest deviation of a
 * vertex. */
bool gis_write_sum_segments(gis_sink_layer *layer, const sunder_sum *sum, size_t n, double *deviation,
                            gis_error *error);
bool gis_write_sum_points(gis_sink_layer *layer, const sunder_sum *sum, size_t n, double *deviation, gis_error *error);

/* Writes the layers MAIN_faces (without the outermost face), MAIN_edges and MAIN_vertices of the planar map of a sum,
 * with the field covered_by (planar_map_layers.c). Coordinates are rounded to doubles: a face that rounding leaves
 * without area is omitted, and one that it divides becomes several features. */
bool gis_write_map(gis_sink *sink, const sunder_map *map, OGRSpatialReferenceH crs, gis_error *error);

#endif
