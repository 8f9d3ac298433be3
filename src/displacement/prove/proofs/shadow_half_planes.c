/* Half-planes such that every relative move that jumps over nothing lies in one of them, proved in doubles.
 *
 * The shadow O = { s k : k in K, s >= 1 } of a convex K that does not contain the origin is closed, convex, and bounded
 * by the sides of K that face the origin and by two rays. As in half_planes.c: if half-planes contain every point of
 * that boundary, the set of points in none of them is convex and misses it. So if one of its points is in O, all are,
 * and every point outside O, or on its boundary, is in one of the half-planes.
 *
 * A side that faces the origin, or seems to, gives n.u >= d with d at most n.P and n.Q, whatever n is. A ray from the
 * corner L consists of all s L, s >= 1: so its line goes through the origin (d = 0), and n is tilted towards L until
 * n.C > 0 for every corner C that may be the true tangent corner in place of L, having the same direction up to
 * rounding. The same holds for the sides between the two, which lie between such corners.
 *
 * Rounding: corners of K have an error of less than the slack of half_planes.c in each coordinate. Two corners that
 * count as being in one direction, although their cross product has the other sign, have a cross product of at most 4
 * slack (|C| + |L|). So C is at most 8 slack (1 + |C| / |L|) beside the line of L, which is less than the tilt times
 * |C| if the tilt is 2^6 slack / m, where m is the least distance of a corner. If m is below 2^16 slack, there is no
 * answer. */
#include "displacement/prove/proofs/exact_line.h"
#include "displacement/prove/proofs/half_planes.h"

#include "base/extremes.h"

#include <math.h>

#define UNIT 0x1p-50
#define TILT 64
#define FAR_ENOUGH 0x1p16

static double dot_product(const double p[2], const double q[2]) { return p[0] * q[0] + p[1] * q[1]; }

/* Sets out to corner k of A + (-B), where A or B has only one corner. The corners are counter-clockwise in both
 * cases. Returns whether it has no error. */
static bool corner_of_sum(const sunder_i_parting *p, size_t k, double out[2])
{
    const double *a = p->a + 2 * (p->na > 1 ? k : 0), *b = p->b + 2 * (p->nb > 1 ? k : 0);
    bool exact = p->exact;
    for (int c = 0; c < 2; c++) {
        double d;
        exact = sunder_i_subtract_exactly(a[c], b[c], &d) && exact;
        exact = sunder_i_subtract_exactly(d, p->offset[c], &out[c]) && exact;
    }
    return exact;
}

static double size_of(const sunder_i_parting *p)
{
    double size = p->vague;
    for (size_t c = 0; c < 2; c++) {
        double a = 0, b = 0;
        for (size_t k = 0; k < p->na; k++) a = sunder_i_max(a, fabs(p->a[2 * k + c]));
        for (size_t k = 0; k < p->nb; k++) b = sunder_i_max(b, fabs(p->b[2 * k + c]));
        size += a + b + fabs(p->offset[c]);
    }
    return size;
}

/* Returns the corner that, seen from the origin, has no other corner to its right (sign +1) or left (sign -1). */
static size_t tangent_corner(const sunder_i_parting *p, size_t n, double sign)
{
    size_t best = 0;
    double at[2], u[2];
    corner_of_sum(p, 0, at);
    for (size_t k = 1; k < n; k++) {
        corner_of_sum(p, k, u);
        if (!(sign * (at[0] * u[1] - at[1] * u[0]) < 0)) continue;
        best = k;
        at[0] = u[0];
        at[1] = u[1];
    }
    return best;
}

/* Sets *out to the half-plane beyond the line of the ray through corner l, without tilt. Returns false unless, exactly,
 * no corner is beyond that line. */
static bool is_exactly_beside(const sunder_i_parting *p, size_t n, const double l[2], double sign,
                              sunder_i_half_plane *out)
{
    const double along[2] = {-sign * l[0], -sign * l[1]};
    double u[2], by;
    *out = (sunder_i_half_plane){.d = 0};
    bool exact = sunder_i_exact_normal(along, out->n);
    for (size_t k = 0; k < n && exact; k++)
        exact = corner_of_sum(p, k, u) && sunder_i_dot_exactly(out->n, u, &by) && by <= 0;
    return exact;
}

/* Returns the half-plane beyond the ray through corner l: to its left with sign +1, else to its right. */
static sunder_i_half_plane beside_ray(const double l[2], double sign, double tilt)
{
    const double length = sqrt(dot_product(l, l)), d[2] = {l[0] / length, l[1] / length};
    double n[2] = {-sign * d[1] + tilt * d[0], sign * d[0] + tilt * d[1]};
    const double norm = sqrt(dot_product(n, n));
    return (sunder_i_half_plane){.n = {n[0] / norm, n[1] / norm}, .d = 0};
}

size_t sunder_i_half_planes_past(const sunder_i_parting *parting, sunder_i_half_plane *out)
{
    const size_t n = parting->na > 1 ? parting->na : parting->nb;
    const double slack = UNIT * size_of(parting);
    double middle[2] = {0, 0}, least = INFINITY, u[2], v[2];
    size_t half_planes = 0;
    for (size_t k = 0; k < n; k++) {
        corner_of_sum(parting, k, u);
        least = sunder_i_min(least, sqrt(dot_product(u, u)));
        for (int c = 0; c < 2; c++) middle[c] += 2 * u[c] / (double)n; /* a point well inside the shadow */
    }
    if (!(least >= FAR_ENOUGH * slack)) return 0;
    const double tilt = TILT * slack / least;
    for (int sign = 1; sign >= -1; sign -= 2, half_planes++) {
        corner_of_sum(parting, tangent_corner(parting, n, -sign), u);
        if (!parting->exact || !is_exactly_beside(parting, n, u, sign, &out[half_planes]))
            out[half_planes] = beside_ray(u, sign, tilt);
    }
    for (size_t k = 0; k < n; k++) {
        const bool from = corner_of_sum(parting, k, u), to = corner_of_sum(parting, k + 1 < n ? k + 1 : 0, v);
        const double e[2] = {v[0] - u[0], v[1] - u[1]}, length = sqrt(dot_product(e, e));
        const double m[2] = {e[1] / length, -e[0] / length};
        if (!(length > 0)) continue;
        const double d = sunder_i_min(dot_product(m, u), dot_product(m, v)) - slack;
        /* m is the outer normal: the origin sees the side if it lies beyond it, at d < 0, up to rounding. */
        if (!(d < slack)) continue;
        if (!from || !to || !sunder_i_exact_line(u, v, 0, &out[half_planes]))
            out[half_planes] = (sunder_i_half_plane){.n = {m[0], m[1]}, .d = d};
        half_planes++;
    }
    for (size_t k = 0; k < half_planes; k++)
        if (!(dot_product(out[k].n, middle) < out[k].d - 8 * slack)) return 0;
    return half_planes;
}
