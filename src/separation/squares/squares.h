/* The plane of translations in squares, nearest to the origin first: those that are covered whole are closed at once,
 * and what is open is cut up until few pairs of pieces come near it. For operands so large that all their pairs would
 * be too many to be listed. */
#ifndef SUNDER_I_SQUARES_H
#define SUNDER_I_SQUARES_H

#include "separation/obstacle/pair_convolution.h"

typedef struct sunder_i_squares sunder_i_squares;

typedef enum sunder_i_squares_next {
    SUNDER_I_SQUARES_OPEN,
    SUNDER_I_SQUARES_END,      /* no open square is left within the limit */
    SUNDER_I_SQUARES_TOO_MANY, /* this is not the way to search these operands */
    SUNDER_I_SQUARES_NO_MEMORY
} sunder_i_squares_next;

/* Do the operands' pieces, those with many corners cut up, make at least `pairs` pairs? */
bool sunder_i_squares_worth(const sunder_i_operands *operands, uint64_t pairs);

/* Of all translations with coordinates up to `reach`, with subsums grown by a disc of radius `gap`. NULL if memory is
 * out. */
sunder_i_squares *sunder_i_squares_new(sunder_i_operands *operands, double reach, double gap);
void sunder_i_squares_free(sunder_i_squares *squares);

/* Finds the next open square within `limit` units of the origin and copies it to `box`. The operands' subsums become
 * those whose boxes come near the square. *candidates receives the segments that pass through it. Both lie in the
 * lattice's arena, above *mark. */
sunder_i_squares_next sunder_i_squares_pop(sunder_i_squares *squares, double limit, double box[4], sunder_i_mark *mark,
                                           sunder_i_candidates *candidates);
/* The operands' subsums become those that may cover the origin, unless *covered says that one does. False if memory is
 * out. */
bool sunder_i_squares_take_origin(sunder_i_squares *squares, bool *covered);

#endif
