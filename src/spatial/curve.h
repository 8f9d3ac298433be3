/* Order along a space-filling curve. */
#ifndef SUNDER_I_SPATIAL_CURVE_H
#define SUNDER_I_SPATIAL_CURVE_H

#include "base/memory.h"

/* Sorts a list of n numbers along a space-filling curve; number i stands at vertex[i]. On failure arena->failed is
 * set. */
void sunder_i_curve_sort(const double *xy, const uint32_t *vertex, uint32_t *list, size_t n, sunder_i_arena *arena);
/* Sorts n records of `bytes` bytes along the curve, by the centres of their boxes (four doubles at byte `box` of each
 * record). False if memory is out; the records are unchanged then. */
bool sunder_i_curve_sort_records(void *record, size_t n, size_t bytes, size_t box);

#endif
