/* Lines of edges whose coefficients are doubles without any rounding error. */
#ifndef SUNDER_I_EXACT_LINE_H
#define SUNDER_I_EXACT_LINE_H

#include "displacement/prove/proofs/half_planes.h"

#include <math.h>
#include <stdbool.h>

/* Sets *out to q - p. Returns false if that is not a double. The rounding error of a difference is itself a double
 * [Knu97, 4.2.2]. */
static inline bool sunder_i_subtract_exactly(double q, double p, double *out)
{
    const double s = q - p, back = s - q;
    *out = s;
    return isfinite(s) && (q - (s - back)) - (p + back) == 0;
}

/* Is p q - r s = 0, exactly? */
static inline bool sunder_i_are_equal_products(double p, double q, double r, double s)
{
    const double a = p * q, b = r * s;
    return a == b && fma(p, q, -a) == fma(r, s, -b);
}

/* Sets *out to p q. Returns false if that is not a double. */
bool sunder_i_multiply_exactly(double p, double q, double *out);
/* Sets *out to n.p. Returns false if that, or one of the products, is not a double. */
bool sunder_i_dot_exactly(const double n[2], const double p[2], double *out);
/* Sets n to a vector perpendicular to e, to its right, at most 1 long: exactly 1 if e is parallel to an axis, else more
 * than 1/2, in exactly that direction. Returns false if e is 0 or too short. */
bool sunder_i_exact_normal(const double e[2], double n[2]);
/* Sets *out to the half-plane to the right of the line through p and q, moved to the right by the clearance, which is
 * rounded down. Returns false if doubles cannot hold it otherwise without a rounding error; that includes any clearance
 * except 0 if the line is not parallel to an axis. */
bool sunder_i_exact_line(const double p[2], const double q[2], double clearance, sunder_i_half_plane *out);

#endif
