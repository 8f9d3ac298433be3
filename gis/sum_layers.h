/* sum_layers.h: a sum, rounded to doubles, as layers. */
#ifndef GIS_SUM_LAYERS_H
#define GIS_SUM_LAYERS_H

#include "sink.h"
#include "sunder.h"
#include "wkt.h"

/* The polygons of a sum in doubles. Every ring is what STRICT validity asks, checked by the core; where rounding broke
 * a ring it has been mended. deviation: no point of the exact boundary is farther than this from the rounded one. */
typedef struct gis_rounded {
    gis_polygons set;
    double deviation;
    size_t vanished; /* rings that rounding left without area */
} gis_rounded;

/* Fails where a vertex leaves the range of doubles, or a ring cannot be mended. */
bool gis_round_sum(const sunder_sum *sum, gis_rounded *out, gis_error *error);
void gis_rounded_clear(gis_rounded *rounded);

/* A bound of the distance from a vertex of the sum to its nearest doubles; infinite beyond their range. */
bool gis_vertex_deviation(const sunder_sum *sum, uint32_t vertex, double *deviation, gis_error *error);

/* The layers MAIN, MAIN_degenerate_segments and MAIN_degenerate_points; the largest deviation of all. */
bool gis_write_sum(gis_sink *sink, const sunder_sum *sum, OGRSpatialReferenceH crs, double *deviation,
                   gis_error *error);

#endif
