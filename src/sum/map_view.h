/* The map beneath a sum, as users see it. */
#ifndef SUNDER_I_MAP_VIEW_H
#define SUNDER_I_MAP_VIEW_H

#include "planar_map/planar_map.h"
#include "sum/sum_value.h"

/* Takes a marked map over for users to look at, also on failure. */
sunder_status sunder_i_map_view_take(sunder_i_planar_map *map, const sunder_sum *sum, sunder_map **out,
                                     sunder_error *err);
void sunder_i_map_view_free(sunder_map *map);

#endif
