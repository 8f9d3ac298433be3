/* sum_layers.h: a sum, rounded to doubles, as layers. */
#ifndef GIS_SUM_LAYERS_H
#define GIS_SUM_LAYERS_H

#include "sink.h"
#include "sunder.h"
#include "wkt.h"

/* The polygons of a sum in doubles, each valid as SUNDER_STRICT asks. deviation: no point of their boundaries is
 * farther than this from the exact boundary. (The other way round that does not hold: a needle or a hole thinner than
 * an ulp may be gone.) */
typedef struct gis_rounded {
    gis_polygons set;
    double deviation;
} gis_rounded;

/* Fails where a vertex leaves the range of doubles, or a polygon cannot be mended. */
bool gis_round_sum(const sunder_sum *sum, gis_rounded *out, gis_error *error);
void gis_rounded_clear(gis_rounded *rounded);

/* Steps of it (sum_mend.c). Ends the ring that began at vertex `first`, unless it has no area: then it is taken back.
 */
bool gis_end_ring_with_area(gis_polygons *set, size_t first, bool *kept, gis_error *error);
/* Are rings [first, last) a valid polygon? False only where the question cannot be answered. */
bool gis_polygon_is_valid(const gis_polygons *set, size_t first, size_t last, gis_error *error, bool *valid);
/* Replaces rings [first, set->rings) by valid polygons, and raises *moved to how far that moves a boundary. */
bool gis_mend_polygon(gis_polygons *set, size_t first, double *moved, gis_error *error);
/* The unit in the last place of a double. */
double gis_ulp(double x);

/* A bound of |exact - x| where x is the double nearest to exact, which is "num" or "num/den" as the core writes it. */
double gis_text_deviation(const char *exact, double x);
/* A bound of the distance from a vertex of the sum to its nearest doubles; infinite beyond their range. */
bool gis_vertex_deviation(const sunder_sum *sum, uint32_t vertex, double *deviation, gis_error *error);

/* The layers MAIN, MAIN_degenerate_segments and MAIN_degenerate_points; the largest deviation of all. */
bool gis_write_sum(gis_sink *sink, const sunder_sum *sum, OGRSpatialReferenceH crs, double *deviation,
                   gis_error *error);

/* Degenerate holes into a layer, n of them; raises *deviation. */
bool gis_write_sum_segments(gis_sink_layer *layer, const sunder_sum *sum, size_t n, double *deviation,
                            gis_error *error);
bool gis_write_sum_points(gis_sink_layer *layer, const sunder_sum *sum, size_t n, double *deviation, gis_error *error);

/* The layers MAIN_faces (all but the outermost), MAIN_edges and MAIN_vertices of the planar map beneath a sum, with the
 * field covered_by (sum_map.c). Rounded to doubles; a face that falls together so is left out, one that falls apart is
 * several features. */
bool gis_write_map(gis_sink *sink, const sunder_map *map, OGRSpatialReferenceH crs, gis_error *error);

#endif
