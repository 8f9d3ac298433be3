/* turn.h: directions as numbers that grow with the angle, computed without roots or angles. */
#ifndef SUNDER_I_TURN_H
#define SUNDER_I_TURN_H

#include <math.h>

/* Returns the direction of (dx, dy), not both 0, as a number in [0, 4), where 4 is a full turn; it grows with the
 * angle, at most as fast as it. The error is a few 2^-52. */
static inline double sunder_i_turn(double dx, double dy)
{
    const double t = dy / (fabs(dx) + fabs(dy));
    return dx < 0 ? 2 - t : t < 0 ? 4 + t : t;
}

#endif
