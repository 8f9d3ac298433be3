/* part_result_check.h: do all numbers of a result that name things of it name things that are there? */
#ifndef GIS_PART_RESULT_CHECK_H
#define GIS_PART_RESULT_CHECK_H

#include "shards/parts/part_result.h"

/* Checks a result read from a file that may be forged. places: features of the layer and its barriers; 0: their number
 * is not checked. */
bool gis_part_result_is_sound(const gis_part_result *result, uint64_t places);

#endif
