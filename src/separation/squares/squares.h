/* squares.h: the plane of translations in squares, nearest to the origin first. Squares that are covered completely are
 * closed at once, and others are divided until few pairs of pieces are near them. It is meant for operands so large
 * that all their pairs would be too many to list. */
#ifndef SUNDER_I_SQUARES_H
#define SUNDER_I_SQUARES_H

#include "separation/obstacle/pair_convolution.h"

typedef struct sunder_i_squares sunder_i_squares;

typedef enum sunder_i_squares_next {
    SUNDER_I_SQUARES_OPEN,
    SUNDER_I_SQUARES_END,      /* no open square is left within the limit */
    SUNDER_I_SQUARES_TOO_MANY, /* this method does not suit the operands */
    SUNDER_I_SQUARES_NO_MEMORY
} sunder_i_squares_next;

/* Returns whether a search by squares is worth its cost: P has an area, there are at least SUNDER_I_SQUARES_WHOLE pairs
 * of pieces (tuning.h) and, after pieces with many vertices are divided, about `pairs` pairs or more. */
bool sunder_i_squares_worth(const sunder_i_operands *operands, uint64_t pairs);

/* Starts a search of all translations with coordinates up to `reach`, with subsums grown by a disc of radius `gap`.
 * Returns NULL if out of memory. */
sunder_i_squares *sunder_i_squares_new(sunder_i_operands *operands, double reach, double gap);
void sunder_i_squares_free(sunder_i_squares *squares);

/* Finds the next open square within `limit` units of the origin and copies it to `box`. The operands' subsums become
 * those whose boxes are near the square; *candidates becomes the segments through it. Both are in the lattice's arena,
 * allocated after *mark. */
sunder_i_squares_next sunder_i_squares_pop(sunder_i_squares *squares, double limit, double box[4], sunder_i_mark *mark,
                                           sunder_i_candidates *candidates);
/* The operands' subsums become those that may cover the origin, unless *covered becomes true since one certainly does.
 * Returns false if out of memory. */
bool sunder_i_squares_take_origin(sunder_i_squares *squares, bool *covered);

#endif
