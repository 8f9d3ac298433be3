/* Which stretches of the candidate sides no open part covers, found line by line.
 *
 * All candidates on one supporting line are treated together. Each part paired with the line (culling.h) either crosses
 * it, and then covers an open interval of it; or rests on it with a side, and then covers one bank of the line along
 * that side (closed interval); or touches it in a corner, or not at all. Sorting the ends along the line and counting
 * gives, exactly:
 *
 *   uncovered, one bank covered    a stretch of the boundary of the sum
 *   uncovered, both banks covered  a stretch of a degenerate segment
 *   an uncovered point alone       a degenerate point, unless some stretch of another line ends or passes there
 *
 * Stretches are cut at every point where anything happens on the line, so stretches of different lines meet in ends
 * only. No face is classified and no winding number counted; holes of the operands, touching members and exact fits
 * need no special case. */
#ifndef SUNDER_I_COVERAGE_H
#define SUNDER_I_COVERAGE_H

#include "outline/culling.h"
#include "outline/vertex_table.h"
#include "predicate/predicate.h"

enum { SUNDER_I_BANK_LEFT = 1, SUNDER_I_BANK_RIGHT = 2 }; /* covered banks of a stretch */

typedef struct sunder_i_outline_stretch {
    uint32_t line;
    uint32_t from, to; /* vertices, in the direction of the line's class */
    uint8_t banks;
} sunder_i_outline_stretch;

typedef struct sunder_i_coverage {
    sunder_i_vertex_table vertices;
    sunder_i_outline_stretch *stretch; /* consecutive along each line */
    size_t stretches, stretches_capacity;
    bool sorted; /* vertices where stretches end are numbered lexicographically */
} sunder_i_coverage;

/* Takes over the pairs of `culled`. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_coverage_find(const sunder_i_convex_pieces *parts, const sunder_i_lines *lines,
                                     sunder_i_culled *culled, sunder_i_coverage *out, sunder_error *err);
void sunder_i_coverage_free(sunder_i_coverage *coverage);

#endif
