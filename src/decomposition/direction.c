/* direction.c: a short lattice vector near the bisector of a cone.
 *
 * The bisector of two lattice vectors is irrational. Any direction inside the cone resolves a reflex vertex, so that it
 * is approximated in doubles by vectors of growing integers. The first vector that is in the middle half of the cone
 * according to doubles, and inside the cone exactly, is used. Only the form of the pieces depends on the doubles. A
 * cone that is too narrow for integers of 20 bits is cut along its own boundary: the extension of an edge resolves the
 * vertex, too. */
#include "decomposition/maker.h"

#include "predicate/rational_point.h"

#include "base/extremes.h"

#include <math.h>

#define MOST 0x1p20 /* the largest coordinate: v + d stays on a narrow lattice, and crossings stay short */

double sunder_i_direction_unit(sunder_i_lattice *lattice, sunder_i_point u, double unit[2], long *exponent)
{
    double x = 0, y = 0;
    *exponent = 0;
    if (sunder_i_point_is_plain(u)) {
        x = (double)u.x;
        y = (double)u.y;
    } else if (!lattice->arena.failed) {
        const sunder_i_mark mark = sunder_i_lattice_begin(lattice);
        const sunder_i_rational_point v = sunder_i_rational_get(&lattice->scratch, lattice, u);
        const unsigned long nx = sunder_i_big_bits(v.x), ny = sunder_i_big_bits(v.y), nw = sunder_i_big_bits(v.w);
        *exponent = (long)(nx > ny ? nx : ny) - (long)nw;
        x = sunder_i_big_ratio(&lattice->scratch, v.x, v.w, -*exponent);
        y = sunder_i_big_ratio(&lattice->scratch, v.y, v.w, -*exponent);
        sunder_i_lattice_end(lattice, mark);
    }
    const double length = hypot(x, y);
    unit[0] = length > 0 ? x / length : 0;
    unit[1] = length > 0 ? y / length : 0;
    return length;
}

/* *out becomes the unit vector of the bisector of two unit vectors, from a counterclockwise to b by at most pi. */
static void halve_angle(const double a[2], const double b[2], double out[2])
{
    const double x = a[0] + b[0], y = a[1] + b[1], length = hypot(x, y);
    const bool straight = length < 0x1p-20;
    out[0] = straight ? -a[1] : x / length;
    out[1] = straight ? a[0] : y / length;
}

sunder_i_point sunder_i_direction_within(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b)
{
    double ua[2], ub[2], middle[2], low[2], high[2];
    long exponent;
    sunder_i_direction_unit(lattice, a, ua, &exponent);
    sunder_i_direction_unit(lattice, b, ub, &exponent);
    halve_angle(ua, ub, middle);
    halve_angle(ua, middle, low);
    halve_angle(middle, ub, high);
    const double top = sunder_i_max(fabs(middle[0]), fabs(middle[1]));
    for (double k = 1; top > 0 && k <= MOST && !lattice->arena.failed; k *= 2) {
        const double x = round(middle[0] / top * k), y = round(middle[1] / top * k);
        if (low[0] * y - low[1] * x < 0 || x * high[1] - y * high[0] < 0) continue;
        const sunder_i_point d = {(int64_t)x, (int64_t)y};
        if (sunder_i_cross_sign(lattice, a, d) > 0 && sunder_i_cross_sign(lattice, d, b) > 0) return d;
    }
    return a;
}
