/* from_map.h: makes the canonical sum from a marked planar map. */
#ifndef SUNDER_I_FROM_MAP_H
#define SUNDER_I_FROM_MAP_H

#include "planar_map/planar_map.h"
#include "sum/sum_value.h"

/* Sets the vertices, rings, polygons, segments and points of the sum from a marked map. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_sum_from_map(sunder_i_planar_map *map, sunder_sum *sum, sunder_error *err);

/* A set other than the covered faces: face: [faces] the faces of the set (not face 0); edge, vertex: which of the edges
 * and vertices that no region covers, between covered faces, are parts of the set without area (NULL: none). An edge
 * with the set on both sides is inside. */
typedef struct sunder_i_inside {
    const bool *face, *edge, *vertex;
} sunder_i_inside;

/* The same for the set `inside`; the faces of the map must be valid. */
sunder_status sunder_i_sum_from_cells(sunder_i_planar_map *map, const sunder_i_inside *inside, sunder_sum *sum,
                                      sunder_error *err);

#endif
