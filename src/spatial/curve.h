/* curve.h: sorts along a space-filling curve. */
#ifndef SUNDER_I_SPATIAL_CURVE_H
#define SUNDER_I_SPATIAL_CURVE_H

#include "base/memory.h"

/* Sorts a list of n numbers along a space-filling curve; number i has the position of vertex[i] in xy. On failure
 * arena->failed is set. */
void sunder_i_curve_sort(const double *xy, const uint32_t *vertex, uint32_t *list, size_t n, sunder_i_arena *arena);
/* Sorts n records of `bytes` bytes along the curve, by the centres of their boxes (four doubles at byte `box` of each
 * record). Returns false if out of memory; then the records are unchanged. */
bool sunder_i_curve_sort_records(void *record, size_t n, size_t bytes, size_t box);

#endif
