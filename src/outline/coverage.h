/* What of the candidate sides is not covered by any open subsum, found line by line.
 *
 * All candidates on one supporting line are treated together. Each subsum paired with the line (cells.h) either
 * crosses it, and then covers an open interval of it; or rests on it with a side, and then covers one bank of the
 * line along that side (closed interval); or touches it in a corner, or not at all. Sorting the ends along the line
 * and counting gives, exactly:
 *
 *   uncovered, one bank covered    a piece of the boundary of the sum
 *   uncovered, both banks covered  a piece of a degenerate segment
 *   an uncovered point alone       a degenerate point, unless some piece on another line ends or passes there
 *
 * Pieces are cut at every point where anything happens on the line, so that pieces of different lines meet in ends
 * only. No face is classified and no winding number counted; holes of the operands, touching members and exact fits
 * need no special case. */
#ifndef SUNDER_I_COVERAGE_H
#define SUNDER_I_COVERAGE_H

#include "outline/cells.h"
#include "outline/places.h"
#include "predicate/predicate.h"

enum { SUNDER_I_LEFT = 1, SUNDER_I_RIGHT = 2 }; /* covered banks of a piece */

typedef struct sunder_i_piece {
    uint32_t line;
    uint32_t from, to; /* places, in the direction of the line's class */
    uint8_t banks;
} sunder_i_piece;

typedef struct sunder_i_coverage {
    sunder_i_places places;
    sunder_i_piece *piece; /* consecutive along each line */
    size_t pieces, pieces_capacity;
} sunder_i_coverage;

/* Consumes the order of pairing->pair. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_coverage_find(const sunder_i_pieces *subsums, const sunder_i_lines *lines,
                                     sunder_i_cell_pairs *pairing, sunder_i_coverage *out, sunder_error *err);
void sunder_i_coverage_free(sunder_i_coverage *coverage);

#endif
