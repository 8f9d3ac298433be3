/* boundary.h: from stretches of the boundary to the canonical sum: rings are traced, assigned to components, and
 * sorted.
 *
 * Stretches become directed edges with the sum on their left. At a vertex where more than two edges meet, two different
 * ways of pairing them are needed. Pairing across *covered* wedges follows one component of the interior from inside:
 * it finds the edges that belong to one component C. Pairing across *free* wedges, among the edges of one C only, then
 * results in one simple ring for each component of the plane minus the closure of C. (With free wedges alone,
 * components that touch in two points would be mixed; with covered wedges alone, rings would visit a vertex twice.) */
#ifndef SUNDER_I_BOUNDARY_H
#define SUNDER_I_BOUNDARY_H

#include "outline/coverage.h"
#include "sum/sum_value.h"
#include "sunder_sum.h"

/* Sets the vertices, rings, polygons, segments and points of *out from the coverage, whose vertices are on `lattice`
 * and are moved to the sum. `lines` are the lines of the stretches, `classes` is the number of classes of directions.
 * Fails with SUNDER_ENOMEM; the caller then frees the sum. */
sunder_status sunder_i_boundary_build(sunder_i_lattice *lattice, uint32_t classes, const sunder_i_lines *lines,
                                      sunder_i_coverage *coverage, sunder_sum *out, sunder_error *err);

#endif
