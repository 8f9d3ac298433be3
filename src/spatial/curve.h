/* Order along a space-filling curve. */
#ifndef SUNDER_I_SPATIAL_CURVE_H
#define SUNDER_I_SPATIAL_CURVE_H

#include "base/memory.h"

/* Sorts a list of n numbers along a space-filling curve; number i stands at vertex[i]. The arena says if memory is
 * out. */
void sunder_i_curve_sort(const double *xy, const uint32_t *vertex, uint32_t *list, size_t n, sunder_i_arena *arena);
/* Sorts n records of so many bytes by the middles of their boxes (four doubles), which are so far into each. False if
 * memory is out; the records are as they were then. */
bool sunder_i_curve_sort_records(void *record, size_t n, size_t bytes, size_t box);

#endif
