/* From a marked planar map to the canonical sum. */
#ifndef SUNDER_I_FROM_MAP_H
#define SUNDER_I_FROM_MAP_H

#include "planar_map/planar_map.h"
#include "sum/sum_value.h"

/* The canonical sum off a marked map: fills vertices, rings, polygons, segments and points of the sum. */
sunder_status sunder_i_sum_from_map(sunder_i_planar_map *map, sunder_sum *sum, sunder_error *err);

/* Another set than what is covered: its faces (by number; not face 0), and which of the edges and vertices that no
 * region covers, between covered faces, are its parts without area (NULL: none). An edge with the set on both sides is
 * inside. */
typedef struct sunder_i_inside {
    const bool *face, *edge, *vertex;
} sunder_i_inside;

/* The same, off a map whose faces are in force. */
sunder_status sunder_i_sum_from_cells(sunder_i_planar_map *map, const sunder_i_inside *inside, sunder_sum *sum,
                                      sunder_error *err);

#endif
