/* Lines without rounding errors. Two things in exact contact leave a seam between their lines, which is a line or a
 * point. Whether a third thing covers it can only be told from lines that are known exactly (plane.c).
 *
 * A product p q of doubles is a double if fma(p, q, -(p q)) is 0, unless it underflows; so tiny products are
 * refused. */
#include "displacement/prove/proofs/exact_line.h"

#define LEAST 0x1p-900 /* products of nonzero factors below it might underflow */

bool sunder_i_multiply_exactly(double p, double q, double *out)
{
    *out = p * q;
    return p == 0 || q == 0 || (isfinite(*out) && fabs(*out) > LEAST && fma(p, q, -*out) == 0);
}

bool sunder_i_dot_exactly(const double n[2], const double p[2], double *out)
{
    double x, y;
    return sunder_i_multiply_exactly(n[0], p[0], &x) && sunder_i_multiply_exactly(n[1], p[1], &y) &&
           sunder_i_subtract_exactly(x, -y, out);
}

bool sunder_i_exact_normal(const double e[2], double n[2])
{
    const double length = hypot(e[0], e[1]);
    if (!(length > LEAST) || !isfinite(length)) return false;
    if (e[0] == 0 || e[1] == 0) {
        n[0] = e[1] == 0 ? 0 : copysign(1, e[1]);
        n[1] = e[0] == 0 ? 0 : -copysign(1, e[0]);
        return true;
    }
    const int scale = -ilogb(length) - 1;
    n[0] = ldexp(e[1], scale);
    n[1] = -ldexp(e[0], scale);
    return fabs(n[0]) > LEAST && fabs(n[1]) > LEAST;
}

bool sunder_i_exact_line(const double p[2], const double q[2], double clearance, sunder_i_half_plane *out)
{
    double e[2], d, moved;
    if (!sunder_i_subtract_exactly(q[0], p[0], &e[0]) || !sunder_i_subtract_exactly(q[1], p[1], &e[1]) ||
        !sunder_i_exact_normal(e, out->n) || !sunder_i_dot_exactly(out->n, p, &d))
        return false;
    if (clearance != 0 && e[0] != 0 && e[1] != 0) return false;
    if (!sunder_i_subtract_exactly(d, -clearance, &moved)) moved = nextafter(moved, -INFINITY);
    out->base = d;
    out->by = 1;
    out->d = moved;
    return isfinite(moved);
}
