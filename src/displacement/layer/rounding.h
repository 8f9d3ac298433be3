/* Moves that doubles can hold. */
#ifndef SUNDER_I_ROUNDING_H
#define SUNDER_I_ROUNDING_H

#include "displacement/layer/model.h"

/* Rounds the move of a body so that the coordinates of its members plus the move are doubles, if any near move does;
 * false if none. Never longer than the body's limit. The coarsest unit of a coordinate goes to *unit. */
bool sunder_i_round_move(const sunder_i_model *model, uint32_t b, const double move[2], double out[2], double *unit);

/* Are the coordinates of its members plus the move doubles, or those plus what sunder_i_round_move() makes of it? */
bool sunder_i_is_exact_move(const sunder_i_model *model, uint32_t body, const double move[2]);

/* ---- move_between.c ---------------------------------------------------------------------------------------------- */

/* A move t, of those that doubles hold, by which every coordinate of `after`, as given, is the double nearest to that
 * of `before` plus t. Of several nearly the shortest. False if none is found; where one moves every coordinate exactly,
 * or the middle of what all vertices allow is one, it is. */
bool sunder_i_move_between(const sunder_shape *before, const sunder_shape *after, double t[2]);

#endif
