/* ball.c: operations on balls. u = 2^-53 is the unit roundoff. The computation of a radius has a few roundings, each
 * with a relative error of u, for which MORE compensates. Products of a middle below 2^-900 lose bits, but such a
 * middle has a radius of at least 1/2, and the loss, 2^-1074, is less than MORE adds to that. */
#include "number/ball.h"

#include "number/lattice.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define U 0x1p-53
#define MORE (1 + 0x1p-50)
#define FAR 200 /* a term that is smaller by this number of bits is only added to the radius */

static const sunder_i_ball ANYTHING = {0, INFINITY, 0};

/* Returns the ball in canonical form: both numbers are scaled by a power of two, exactly. */
static sunder_i_ball canonical_ball(double middle, double radius, long exponent)
{
    const double size = fabs(middle) > radius ? fabs(middle) : radius;
    if (!(size < INFINITY && radius < INFINITY)) return ANYTHING;
    if (size == 0) return (sunder_i_ball){0, 0, 0};
    uint64_t bits;
    memcpy(&bits, &size, sizeof bits);
    const int k = (int)(bits >> 52) - 1022; /* as the exponent of frexp(); size is not subnormal */
    const double scale = sunder_i_power_of_two(-k);
    return (sunder_i_ball){middle * scale, radius * scale, exponent + k};
}

/* The leading 64 bits, as a fraction in [1/2, 1]: the error is 2^-64 for the bits below, and u / 2 for the rounding. */
sunder_i_ball sunder_i_ball_big(sunder_i_big v)
{
    if (v.size == 0) return (sunder_i_ball){0, 0, 0};
    const long n = labs(v.size);
    const int shift = __builtin_clzl(v.limb[n - 1]);
    const mp_limb_t below = shift && n > 1 ? v.limb[n - 2] >> (64 - shift) : 0, top = v.limb[n - 1] << shift | below;
    const double middle = (double)top * 0x1p-64;
    const bool exact = n == 1 && (top & 0x7ff) == 0;
    return canonical_ball(v.size < 0 ? -middle : middle, exact ? 0 : U, 64 * n - shift);
}

sunder_i_ball sunder_i_ball_add(sunder_i_ball a, sunder_i_ball b)
{
    if (a.middle == 0 && a.radius == 0) return b;
    if (b.middle == 0 && b.radius == 0) return a;
    const sunder_i_ball large = a.exponent < b.exponent ? b : a, small = a.exponent < b.exponent ? a : b;
    const long down = large.exponent - small.exponent;
    if (!(a.radius + b.radius < INFINITY)) return ANYTHING;
    /* |small| < 2 times its power of two, including its radius. */
    const double scale = sunder_i_power_of_two(down > FAR ? -FAR + 1 : -down);
    const double middle = down > FAR ? large.middle : large.middle + small.middle * scale;
    const double radius = large.radius + (down > FAR ? scale : small.radius * scale) + fabs(middle) * U;
    return canonical_ball(middle, radius * MORE, large.exponent);
}

sunder_i_ball sunder_i_ball_sub(sunder_i_ball a, sunder_i_ball b)
{
    b.middle = -b.middle;
    return sunder_i_ball_add(a, b);
}

sunder_i_ball sunder_i_ball_mul(sunder_i_ball a, sunder_i_ball b)
{
    const double middle = a.middle * b.middle;
    const double radius =
        fabs(a.middle) * b.radius + fabs(b.middle) * a.radius + a.radius * b.radius + fabs(middle) * U;
    return canonical_ball(middle, radius * MORE, a.exponent + b.exponent);
}

/* With q = a / b of the middles: (a + s) / (b + t) - q = (s - q t) / (b + t). */
sunder_i_ball sunder_i_ball_div(sunder_i_ball a, sunder_i_ball b)
{
    const double least = fabs(b.middle) - b.radius;
    if (!(least > 0.25)) return ANYTHING;
    const double q = a.middle / b.middle, radius = (a.radius + fabs(q) * b.radius) / least + fabs(q) * U;
    return canonical_ball(q, radius * MORE, a.exponent - b.exponent);
}

/* |sqrt(m + s) - sqrt(m)| <= |s| / sqrt(m). If the radius is at least the middle: from zero to the largest root. */
sunder_i_ball sunder_i_ball_sqrt(sunder_i_ball a)
{
    const int odd = (int)(a.exponent & 1);
    const double m = odd ? 2 * a.middle : a.middle, r = odd ? 2 * a.radius : a.radius;
    const long half = (a.exponent - odd) / 2;
    if (m == 0 && r == 0) return a;
    if (!(m > r)) return canonical_ball(0, sqrt(sunder_i_max(m + r, 0) * MORE) * MORE, half);
    const double root = sqrt(m);
    return canonical_ball(root, (r / root + root * U) * MORE, half);
}
