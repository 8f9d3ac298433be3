/* Sums of parts that are apart as one sum. */
#ifndef SUNDER_I_SUM_OF_PARTS_H
#define SUNDER_I_SUM_OF_PARTS_H

#include "sum/sum_value.h"

/* Appends n sums to an empty one in canonical order. Their polygons, segments and points are disjoint or touch in
 * points; their lattices have one unit, and the same origins. False if memory is out. */
bool sunder_i_gather(sunder_sum *const *part, size_t n, sunder_sum *out);

#endif
