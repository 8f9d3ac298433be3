/* coverage.h: finds, line by line, the stretches of the candidate sides that no open part covers.
 *
 * All candidates on one supporting line are processed together. Each part that is paired with the line (culling.h)
 * either crosses it, and then covers an open interval of it; or rests on it with a side, and then covers one side of
 * the line along it (a closed interval); or touches it in a corner, or not at all. Sorting the ends along the line and
 * counting them shows exactly:
 *
 *   uncovered, one side covered    a stretch of the boundary of the sum
 *   uncovered, both sides covered  a stretch of a degenerate segment
 *   an isolated uncovered point    a degenerate point, unless a stretch of another line ends or passes there
 *
 * Stretches are divided at every point where an event of the line occurs, so that stretches of different lines meet at
 * ends only. No face is classified and no winding number counted; holes of the operands, touching polygons and exact
 * fits are no special cases. */
#ifndef SUNDER_I_COVERAGE_H
#define SUNDER_I_COVERAGE_H

#include "outline/culling.h"
#include "outline/vertex_table.h"
#include "predicate/predicate.h"

enum { SUNDER_I_BANK_LEFT = 1, SUNDER_I_BANK_RIGHT = 2 }; /* the covered sides of a stretch */

typedef struct sunder_i_outline_stretch {
    uint32_t line;
    uint32_t from, to; /* vertices, in the direction of the line's class */
    uint8_t banks;
} sunder_i_outline_stretch;

typedef struct sunder_i_coverage {
    sunder_i_vertex_table vertices;
    sunder_i_outline_stretch *stretch; /* in the order of the lines, and consecutive along each line */
    size_t stretches, stretches_capacity;
    bool sorted; /* vertices with stretches are numbered lexicographically */
} sunder_i_coverage;

/* Finds the coverage. The pairs of `culled` are freed. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_coverage_find(const sunder_i_convex_pieces *parts, const sunder_i_lines *lines,
                                     sunder_i_culled *culled, sunder_i_coverage *out, sunder_error *err);
void sunder_i_coverage_free(sunder_i_coverage *coverage);

#endif
