/* From stretches of boundary to the canonical sum: rings traced, components told apart, everything in order.
 *
 * Stretches become directed edges with the sum on their left. At a vertex where more than two edges meet, two
 * different pairings are needed. Pairing across *covered* wedges walks round one component of the interior from inside:
 * it tells which edges belong to one component C. Pairing across *free* wedges, among the edges of one C only, then
 * gives one simple ring for each component of the plane minus the closure of C. (Free wedges alone would mix components
 * that touch in two points; covered wedges alone would give rings that visit a vertex twice.) */
#ifndef SUNDER_I_BOUNDARY_H
#define SUNDER_I_BOUNDARY_H

#include "outline/coverage.h"
#include "sum/sum_value.h"

/* Takes over the vertices of `coverage`, which stand on that lattice, as the sum's vertices; `lines` tells the classes
 * of directions. Fills every member but lattice, origin and seconds. Fails with SUNDER_ENOMEM; the caller then frees
 * the sum. */
sunder_status sunder_i_boundary_build(sunder_i_lattice *lattice, uint32_t classes, const sunder_i_lines *lines,
                                      sunder_i_coverage *coverage, sunder_sum *out, sunder_error *err);

#endif
