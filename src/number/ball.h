/* Numbers of any magnitude, known to within a radius: middle and radius are doubles, and share an exponent of their
 * own. A filter in front of big integers where doubles do not serve: on a lattice that spans the range of doubles the
 * products of a few coordinates lie beyond it, or differences below it. [Joh17] computes with such balls of any length.
 *
 * The value is within `radius` of `middle`, both times 2^exponent. Canonical form: the greater of |middle| and radius
 * is in [1/2, 1), or all is zero; the radius is 0 or at least 2^-60. Where nothing is known it is infinite. Every
 * operation holds what its operands may be, roundings included; none asks for memory. */
#ifndef SUNDER_I_BALL_H
#define SUNDER_I_BALL_H

#include "number/big.h"

typedef struct sunder_i_ball {
    double middle, radius;
    long exponent;
} sunder_i_ball;

/* From the topmost bits; exact up to 53 of them. */
sunder_i_ball sunder_i_ball_big(sunder_i_big v);

sunder_i_ball sunder_i_ball_add(sunder_i_ball a, sunder_i_ball b);
sunder_i_ball sunder_i_ball_sub(sunder_i_ball a, sunder_i_ball b);
sunder_i_ball sunder_i_ball_mul(sunder_i_ball a, sunder_i_ball b);
/* Nothing is known where b may be zero, or nearly. */
sunder_i_ball sunder_i_ball_div(sunder_i_ball a, sunder_i_ball b);
/* For a value that is known not to be negative. */
sunder_i_ball sunder_i_ball_sqrt(sunder_i_ball a);

/* a times 2^shift. */
static inline sunder_i_ball sunder_i_ball_shift(sunder_i_ball a, long shift)
{
    if (a.middle != 0 || a.radius > 0) a.exponent += shift;
    return a;
}

/* 1 or -1 where the sign is known; 0 where it is not, and of zero. */
static inline int sunder_i_ball_sign(sunder_i_ball a)
{
    return a.middle > a.radius ? 1 : -a.middle > a.radius ? -1 : 0;
}

#endif
