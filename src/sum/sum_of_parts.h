/* sum_of_parts.h: joins disjoint sums to one sum. */
#ifndef SUNDER_I_SUM_OF_PARTS_H
#define SUNDER_I_SUM_OF_PARTS_H

#include "sum/sum_value.h"
#include "sunder_sum.h"

/* Joins n sums to an empty one in canonical order. Their polygons, segments and points must be disjoint or touch in
 * points; their lattices must have the same unit and the same origins. Returns false if out of memory. */
bool sunder_i_gather(sunder_sum *const *part, size_t n, sunder_sum *out);

#endif
