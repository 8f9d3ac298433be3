/* Two convex pieces: their obstacle A + (-B), and the support line of it that serves best as a constraint.
 *
 * B + u misses the interior of A exactly when u lies outside the interior of A + (-B). For every unit vector n,
 *     n.u >= h_A(n) + h_B(-n) + gap
 * keeps B + u at least the gap from A, wherever u is [Li and Milenkovic 1995]: it is a *global* constraint, and the
 * only choice is that of n. Chosen where u stands now, as the direction of the nearest point, it is tight there, so
 * that a feasible u stays feasible. */
#include "displacement/displacement.h"

#include <math.h>

static double *reserve(sunder_i_scratch *scratch, size_t n)
{
    if (scratch->failed || !sunder_i_reserve(&scratch->xy, &scratch->capacity, 2 * n, sizeof(double))) {
        scratch->failed = true;
        return NULL;
    }
    return scratch->xy;
}

/* Least (sign +1) or greatest (sign -1) corner by y, then x. */
static size_t extreme(const double *p, size_t n, double sign)
{
    size_t best = 0;
    for (size_t k = 1; k < n; k++) {
        const double dy = sign * (p[2 * k + 1] - p[2 * best + 1]), dx = sign * (p[2 * k] - p[2 * best]);
        if (dy < 0 || (dy == 0 && dx < 0)) best = k;
    }
    return best;
}

size_t sunder_i_difference(const double *a, size_t na, const double *b, size_t nb, const double offset[2],
                           sunder_i_scratch *scratch)
{
    double *d = reserve(scratch, na + nb);
    if (!d) return 0;
    const size_t a0 = extreme(a, na, 1), b0 = extreme(b, nb, -1);
    double x = a[2 * a0] - b[2 * b0] - offset[0], y = a[2 * a0 + 1] - b[2 * b0 + 1] - offset[1];
    size_t i = 0, j = 0, n = 0;
    /* Both start at the lowest corner, so both sequences of edges turn from direction 0 to 2 pi, and merge by turning.
     */
    while (i < na || j < nb) {
        const size_t p = (a0 + i) % na, p1 = (p + 1) % na, q = (b0 + j) % nb, q1 = (q + 1) % nb;
        const double ux = a[2 * p1] - a[2 * p], uy = a[2 * p1 + 1] - a[2 * p + 1];
        const double vx = b[2 * q] - b[2 * q1], vy = b[2 * q + 1] - b[2 * q1 + 1];
        bool take_a = j == nb;
        if (!take_a && i < na) {
            /* Upper half-plane first; within a half the cross product tells. */
            const bool ua = uy > 0 || (uy == 0 && ux > 0), va = vy > 0 || (vy == 0 && vx > 0);
            take_a = ua != va ? ua : ux * vy - uy * vx >= 0;
        }
        d[2 * n] = x;
        d[2 * n++ + 1] = y;
        if (take_a) {
            x += ux;
            y += uy;
            i++;
        } else {
            x += vx;
            y += vy;
            j++;
        }
    }
    return n;
}

sunder_i_support sunder_i_support_at(const double *d, size_t n, const double u[2])
{
    sunder_i_support best = {{1, 0}, 0, -INFINITY}, corner = {{1, 0}, 0, INFINITY};
    double nearest = INFINITY, perimeter = 0;
    for (size_t k = 0; k < n; k++) {
        const double *p = d + 2 * k, *q = d + 2 * (k + 1 < n ? k + 1 : 0);
        const double ex = q[0] - p[0], ey = q[1] - p[1], length = sqrt(ex * ex + ey * ey);
        if (!(length > 0)) continue;
        perimeter += length;
        const double nx = ey / length, ny = -ex / length, wx = u[0] - p[0], wy = u[1] - p[1];
        const double s = nx * wx + ny * wy;
        if (s > best.distance) best = (sunder_i_support){{nx, ny}, nx * p[0] + ny * p[1], s};
        if (s < 0) continue;
        /* In front of this edge: either its inside or one of its ends is nearest. */
        const double along = (wx * ex + wy * ey) / length;
        if (along >= 0 && along <= length) {
            if (s < nearest) {
                nearest = s;
                corner = (sunder_i_support){{nx, ny}, nx * p[0] + ny * p[1], s};
            }
            continue;
        }
        const double *c = along < 0 ? p : q, cx = u[0] - c[0], cy = u[1] - c[1], far = sqrt(cx * cx + cy * cy);
        if (far < nearest) {
            nearest = far;
            corner = (sunder_i_support){{cx / far, cy / far}, (cx * c[0] + cy * c[1]) / far, far};
        }
    }
    /* Very near a corner the direction to it is noise; an edge's normal serves as well there. */
    if (best.distance <= 0 || !(nearest < INFINITY) || nearest < 1e-9 * perimeter) return best;
    return corner;
}
