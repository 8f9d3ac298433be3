/* ball.h: numbers of any magnitude with an error bound (balls): middle and radius are doubles with a common exponent of
 * their own. They are used before big integers if doubles are not sufficient: on a lattice that spans the range of
 * doubles the products of a few coordinates are above it, or differences below it. [Joh17] computes with such balls of
 * any length.
 *
 * The value differs from `middle` by at most `radius`, both times 2^exponent. Canonical form: the greater of |middle|
 * and radius is in [1/2, 1), or all is zero; the radius is 0 or at least 2^-60. If nothing is known, the radius is
 * infinite. The result of every operation contains all possible values for its operands, including rounding errors; no
 * operation allocates memory. */
#ifndef SUNDER_I_BALL_H
#define SUNDER_I_BALL_H

#include "number/big.h"

typedef struct sunder_i_ball {
    double middle, radius;
    long exponent;
} sunder_i_ball;

/* Returns the ball of a big integer, from its leading bits; exact up to 53 bits. */
sunder_i_ball sunder_i_ball_big(sunder_i_big v);

sunder_i_ball sunder_i_ball_add(sunder_i_ball a, sunder_i_ball b);
sunder_i_ball sunder_i_ball_sub(sunder_i_ball a, sunder_i_ball b);
sunder_i_ball sunder_i_ball_mul(sunder_i_ball a, sunder_i_ball b);
/* The radius is infinite if b may be zero, or nearly. */
sunder_i_ball sunder_i_ball_div(sunder_i_ball a, sunder_i_ball b);
/* The value must not be negative (the ball may extend below 0). */
sunder_i_ball sunder_i_ball_sqrt(sunder_i_ball a);

/* Returns a times 2^shift. */
static inline sunder_i_ball sunder_i_ball_shift(sunder_i_ball a, long shift)
{
    if (a.middle != 0 || a.radius > 0) a.exponent += shift;
    return a;
}

/* Returns 1 or -1 if the sign is known; 0 if it is not, and for zero. */
static inline int sunder_i_ball_sign(sunder_i_ball a)
{
    return a.middle > a.radius ? 1 : -a.middle > a.radius ? -1 : 0;
}

#endif
