/* Squares around the origin that one subsum holds in its interior: for operands so large that candidates and subsums
 * are better dismissed by the thousand. */
#ifndef SUNDER_I_BOARD_H
#define SUNDER_I_BOARD_H

#include "separation/operands/pair_operands.h"

/* A board of n x n squares over [-reach, reach] in both coordinates. */
typedef struct sunder_i_board {
    double reach, per_unit; /* squares for each unit */
    uint32_t n;
    uint32_t *holder;     /* [n * n] row by row: number of a subsum + 1, or 0: an open square */
    uint32_t *open_below; /* [(n + 1) * (n + 1)] how many open squares have a smaller column and a smaller row */
    uint32_t *list_end;   /* [n * n] past the last of the subsums near an open square, in the order of the operands */
    uint32_t *list;
    size_t list_n, list_capacity;
} sunder_i_board;

/* From this many subsums on a board pays: with fewer, testing them all takes less than making it. */
#define SUNDER_I_BOARD_FROM 512

/* Of the subsums listed; those that are tried are made. Sets operands->held. False if memory is out. */
bool sunder_i_board_build(sunder_i_operands *operands, double reach);
void sunder_i_board_free(sunder_i_operands *operands);

/* Is all of the segment from (ax, ay) to (ax + dx, ay + dy), each coordinate within the operands' error, in held
 * squares, but for what is out of reach? */
bool sunder_i_board_segment(const sunder_i_board *held, double error, double ax, double ay, double dx, double dy);

/* The number of the square of a point, n * n if it is on none. */
static inline uint32_t sunder_i_board_square(const sunder_i_board *held, double x, double y)
{
    const double r = held->reach;
    if (!(x > -r && x < r && y > -r && y < r)) return held->n * held->n;
    const uint32_t column = (uint32_t)((x + r) * held->per_unit), row = (uint32_t)((y + r) * held->per_unit);
    return column < held->n && row < held->n ? row * held->n + column : held->n * held->n;
}

#endif
