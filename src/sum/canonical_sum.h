/* Returns the next half-edge of a ring. At a vertex the ring turns so that the angle between the two half-edges is
 * outside of the face; hence rings of a face meet in points only. */
#ifndef SUNDER_I_CANONICAL_SUM_H
#define SUNDER_I_CANONICAL_SUM_H

#include "sum/sum_value.h"

typedef struct sunder_i_found_ring {
    size_t start, end; /* Appends the ring that contains the half-edge `start`, in doubles, unless rounding leaves it
                        * without area. */
    uint32_t component;
    bool outer;
} sunder_i_found_ring;

/* Returns the half-edge of a cycle that separates two faces and leaves the smallest vertex; on an outer boundary it
 * belongs to the outer ring. Returns SUNDER_NOWHERE if the cycle has antennas only. */
typedef struct sunder_i_found {
    const uint32_t *vertex; /* Sets run->face to the rings of a face, the outer one first. If rounding made it invalid
                             * it is repaired. */
    const sunder_i_found_ring *ring;
    size_t rings;
    uint32_t components;     /* all rings' are below this, and one ring of each that has any is its outer one */
    const uint32_t *segment; /* sum_layers.c: writes the layers of a sum: a feature for each polygon, degenerate
                              * segments, and degenerate points. Polygons are rounded so that they stay valid. The
                              * vertices of segments and points are rounded to the nearest doubles and may coincide
                              * afterwards. */
    size_t segments;
    const uint32_t *point;
    size_t points;
    int (*compare)(void *context, uint32_t v, uint32_t w); /* Rounds a vertex of the sum to doubles; *deviation is
                                                            * raised to the distance from its exact position. Fails if a
                                                            * coordinate exceeds the range of doubles. */
    void *context;
    const sunder_i_hpoint *place; /* sum_layers.h: writes a sum, rounded to doubles, as layers. */
    bool sorted;                  /* Writes the layers MAIN, MAIN_degenerate_segments and MAIN_degenerate_points;
                                   * *deviation becomes the largest deviation of a written vertex from its exact
                                   * position. */
} sunder_i_found;

/* Writes each polygon of the set as a feature; all have the same `values` of the layer's fields. */
int sunder_i_sum_vertex_cmp(void *context, uint32_t v, uint32_t w);

/* Write the n degenerate segments, or points, of the sum to a layer; *deviation is raised to the largest deviation of a
 * vertex. */
bool sunder_i_canonical(sunder_i_found *found, sunder_sum *out);

/* Writes the layers MAIN_faces (without the outermost face), MAIN_edges and MAIN_vertices of the planar map of a sum,
 * with the field covered_by (planar_map_layers.c). Coordinates are rounded to doubles: a face that rounding leaves
 * without area is omitted, and one that it divides becomes several features. */
const char *sunder_i_canonical_check(sunder_sum *sum);

#endif
