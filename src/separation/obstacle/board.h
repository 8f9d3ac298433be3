/* board.h: a grid of squares about the origin with the subsums that cover squares completely. For large operands it
 * excludes candidates and subsums by the thousand. */
#ifndef SUNDER_I_BOARD_H
#define SUNDER_I_BOARD_H

#include "separation/operands/pair_operands.h"

/* A grid of n x n squares over [-reach, reach] in both coordinates. */
typedef struct sunder_i_board {
    double reach, per_unit; /* the number of squares for each unit of length */
    uint32_t n;
    uint32_t *holder;     /* [n * n] row by row: the number of a subsum that covers the square, plus 1; 0: an open
                           * square */
    uint32_t *open_below; /* [(n + 1) * (n + 1)] the number of open squares with a smaller column and a smaller row */
    uint32_t *list_end;   /* [n * n] the end in `list` of the subsums near an open square, which are in the order of the
                           * operands */
    uint32_t *list;
    size_t list_n, list_capacity;
} sunder_i_board;

/* A board is used from this number of subsums on; testing fewer takes less time than building it. */
#define SUNDER_I_BOARD_FROM 512

/* Builds operands->board from the listed subsums, making those that it tries. Returns false if out of memory. */
bool sunder_i_board_build(sunder_i_operands *operands, double reach);
void sunder_i_board_free(sunder_i_operands *operands);

/* Returns whether the segment from (ax, ay) to (ax + dx, ay + dy), whose coordinates have an error of at most `error`,
 * lies in closed squares, except for parts beyond the board. */
bool sunder_i_board_segment(const sunder_i_board *held, double error, double ax, double ay, double dx, double dy);

/* Returns the number of the square that contains a point; n * n if the point is not on the board. */
static inline uint32_t sunder_i_board_square(const sunder_i_board *held, double x, double y)
{
    const double r = held->reach;
    if (!(x > -r && x < r && y > -r && y < r)) return held->n * held->n;
    const uint32_t column = (uint32_t)((x + r) * held->per_unit), row = (uint32_t)((y + r) * held->per_unit);
    return column < held->n && row < held->n ? row * held->n + column : held->n * held->n;
}

#endif
