/* map_view.h: the map of a sum, for users. */
#ifndef SUNDER_I_MAP_VIEW_H
#define SUNDER_I_MAP_VIEW_H

#include "planar_map/planar_map.h"
#include "sum/sum_value.h"
#include "sunder_sum.h"

/* Makes a view of a marked map, which it owns from then on, also on failure. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_map_view_take(sunder_i_planar_map *map, const sunder_sum *sum, sunder_map **out,
                                     sunder_error *err);
void sunder_i_map_view_free(sunder_map *map);

#endif
