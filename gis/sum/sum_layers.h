/* sum_layers.h: a sum, rounded to doubles, as layers. */
#ifndef GIS_SUM_LAYERS_H
#define GIS_SUM_LAYERS_H

#include "geometry/round/round.h"
#include "sunder.h"
#include "write/sink/sink.h"

/* Writes the layers MAIN, MAIN_degenerate_segments and MAIN_degenerate_points; *deviation is the largest of all. */
bool gis_write_sum(gis_sink *sink, const sunder_sum *sum, OGRSpatialReferenceH crs, double *deviation,
                   gis_error *error);

/* Each polygon of a set as a feature, all with these values of the layer's fields. */
bool gis_write_polygons(gis_sink_layer *layer, const gis_polygons *set, const gis_value *values, gis_error *error);

/* Degenerate holes into a layer, n of them; raises *deviation. */
bool gis_write_sum_segments(gis_sink_layer *layer, const sunder_sum *sum, size_t n, double *deviation,
                            gis_error *error);
bool gis_write_sum_points(gis_sink_layer *layer, const sunder_sum *sum, size_t n, double *deviation, gis_error *error);

/* The layers MAIN_faces (all but the outermost), MAIN_edges and MAIN_vertices of the planar map beneath a sum, with
 * the field covered_by (planar_map_layers.c). Rounded to doubles; a face that falls together so is left out, one
 * that falls apart is several features. */
bool gis_write_map(gis_sink *sink, const sunder_map *map, OGRSpatialReferenceH crs, gis_error *error);

#endif
