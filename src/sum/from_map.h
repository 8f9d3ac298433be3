/* from_map.h: makes the canonical sum from a marked planar map. */
#ifndef SUNDER_I_FROM_MAP_H
#define SUNDER_I_FROM_MAP_H

#include "planar_map/planar_map.h"
#include "sum/sum_value.h"
#include "sunder_sum.h"

/* Sets the vertices, rings, polygons, segments and points of the sum from a marked map. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_sum_from_map(sunder_i_planar_map *map, sunder_sum *sum, sunder_error *err);

/* A set other than the union of the covered faces, as flags by the numbers of the map. face: the faces of the set, not
 * face 0. edge, vertex: which of the degenerate holes of the map (edges and vertices that no region covers, between
 * covered faces) become segments and points of the sum; NULL: none. An edge with the set on both sides does not bound
 * it. */
typedef struct sunder_i_inside {
    const bool *face, *edge, *vertex;
} sunder_i_inside;

/* Does the same as sunder_i_sum_from_map() for the set `inside`. The faces of the map must be valid, that is,
 * sunder_i_planar_map_faces() was called after the last change. */
sunder_status sunder_i_sum_from_cells(sunder_i_planar_map *map, const sunder_i_inside *inside, sunder_sum *sum,
                                      sunder_error *err);

#endif
