/* Moves for which the moved coordinates are doubles. */
#ifndef SUNDER_I_ROUNDING_H
#define SUNDER_I_ROUNDING_H

#include "displacement/layer/model.h"

/* Sets `out` to a move near `move` for which the coordinates of the body's members plus the move are doubles. Returns
 * false if no such move is found; then `out` is a rounded move all the same. It is never longer than the body's limit.
 * *unit is set to the coarsest unit of a coordinate, unless it is NULL. */
bool sunder_i_round_move(const sunder_i_model *model, uint32_t b, const double move[2], double out[2], double *unit);

/* The same, whatever the body's limit is. */
void sunder_i_round_to_units(const sunder_i_model *model, uint32_t b, const double move[2], double out[2]);

/* Are the coordinates of the body's members plus the move doubles, or those plus the move that sunder_i_round_move()
 * makes of it? */
bool sunder_i_is_exact_move(const sunder_i_model *model, uint32_t body, const double move[2]);

/* ---- move_between.c ---------------------------------------------------------------------------------------------- */

/* Finds a move t in doubles such that every coordinate of `after`, as given, is the double nearest to that of `before`
 * plus t. If some move makes every sum exact and is a candidate (move_between.c), it is found; else nearly the
 * shortest. Returns false if none is found. */
bool sunder_i_move_between(const sunder_shape *before, const sunder_shape *after, double t[2]);
/* The same for the sets alone, whatever the order of their rings and vertices was; the corners are doubles. */
bool sunder_i_move_between_sets(const sunder_shape *before, const sunder_shape *after, double t[2]);

#endif
