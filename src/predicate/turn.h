/* Directions as numbers that grow with the angle, without roots or angles. */
#ifndef SUNDER_I_TURN_H
#define SUNDER_I_TURN_H

#include <math.h>

/* The direction of (dx, dy), not both 0, in [0, 4), a whole turn being 4; it grows with the angle, no faster than it.
 * In doubles, within a few 2^-52. */
static inline double sunder_i_turn(double dx, double dy)
{
    const double t = dy / (fabs(dx) + fabs(dy));
    return dx < 0 ? 2 - t : t < 0 ? 4 + t : t;
}

#endif
