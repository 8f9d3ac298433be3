/* Order along a space-filling curve. */
#ifndef SUNDER_I_SPATIAL_CURVE_H
#define SUNDER_I_SPATIAL_CURVE_H

#include "base/memory.h"

/* Sorts a list of n numbers along a space-filling curve; number i stands at vertex[i]. The arena says if memory is
 * out. */
void sunder_i_curve_sort(const double *xy, const uint32_t *vertex, uint32_t *list, size_t n, sunder_i_arena *arena);

#endif
