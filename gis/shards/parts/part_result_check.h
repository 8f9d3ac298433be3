/* part_result_check.h: do all numbers of a result that name things of it name things that are there? */
#ifndef GIS_PART_RESULT_CHECK_H
#define GIS_PART_RESULT_CHECK_H

#include "shards/parts/part_result.h"

/* A result that was read from a file of somebody's making. places: features of the layer and its barriers; 0: how many
 * there are is not asked. */
bool gis_part_result_is_sound(const gis_part_result *result, uint64_t places);

#endif
