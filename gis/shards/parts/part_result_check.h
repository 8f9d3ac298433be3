/* part_result_check.h: checks that all indices in a result refer to existing items. */
#ifndef GIS_PART_RESULT_CHECK_H
#define GIS_PART_RESULT_CHECK_H

#include "shards/parts/part_result.h"

/* Checks a result read from a file that may be forged. `places` is the number of features and barriers of the layer; 0:
 * indices of features are not checked. */
bool gis_part_result_is_sound(const gis_part_result *result, uint64_t places);

#endif
