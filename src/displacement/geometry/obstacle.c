/* The obstacle A + (-B) of two convex pieces, and the support line of it that serves best as a constraint.
 *
 * B + u misses the interior of A exactly if u lies outside the interior of A + (-B). For every unit vector n,
 *
 *     n.u >= h_A(n) + h_B(-n) + gap
 *
 * keeps B + u at least the gap from A, wherever u is [LM95]: it is a *global* constraint, and the only choice is that
 * of n. If n is the direction from the nearest point of the obstacle to the present u, the constraint is tight there,
 * so a feasible u remains feasible. */
#include "displacement/geometry/obstacle.h"
#include "displacement/geometry/tuning.h"

#include "base/list.h"
#include "convex/merge.h"

#include <math.h>

double *sunder_i_scratch_reserve(sunder_i_scratch *scratch, size_t n)
{
    if (scratch->failed || !sunder_i_reserve(&scratch->xy, &scratch->capacity, 2 * n, sizeof(double))) {
        scratch->failed = true;
        return NULL;
    }
    return scratch->xy;
}

size_t sunder_i_extreme_corner(const double *corner, size_t n, double sign)
{
    size_t best = 0;
    for (size_t k = 1; k < n; k++) {
        const double dy = sign * (corner[2 * k + 1] - corner[2 * best + 1]),
                     dx = sign * (corner[2 * k] - corner[2 * best]);
        if (dy < 0 || (dy == 0 && dx < 0)) best = k;
    }
    return best;
}

/* Sets out to the edge that begins at corner k of p, times `sign`. Returns the number of the next corner. */
static size_t edge_at(const double *p, size_t n, size_t k, double sign, double out[2])
{
    const size_t next = k + 1 < n ? k + 1 : 0;
    out[0] = sign * (p[2 * next] - p[2 * k]);
    out[1] = sign * (p[2 * next + 1] - p[2 * k + 1]);
    return next;
}

/* Each corner is the difference of two vertices, independent of the edges before it. Summing up edges would accumulate
 * rounding errors, and the last corner would miss the first by a tiny edge of arbitrary direction. */
size_t sunder_i_obstacle_corners(const double *a, size_t na, const double *b, size_t nb, const double offset[2],
                                 sunder_i_scratch *scratch)
{
    double *d = sunder_i_scratch_reserve(scratch, na + nb);
    if (!d) return 0;
    size_t i = sunder_i_extreme_corner(a, na, 1), j = sunder_i_extreme_corner(b, nb, -1), n = 0;
    double u[2], v[2];
    size_t next_i = edge_at(a, na, i, 1, u), next_j = edge_at(b, nb, j, -1, v);
    /* Both sequences of edges start at the lowest corner, so their directions increase from 0 to 2 pi, and they are
     * merged by direction. */
    sunder_i_merge m = sunder_i_merge_of((uint32_t)na, (uint32_t)nb);
    while (SUNDER_I_MERGE_NEXT(&m, sunder_i_turns_first(u, v) ? -1 : 1)) {
        d[2 * n] = a[2 * i] - b[2 * j] - offset[0];
        d[2 * n++ + 1] = a[2 * i + 1] - b[2 * j + 1] - offset[1];
        if (m.of_a) {
            i = next_i;
            next_i = edge_at(a, na, i, 1, u);
        } else {
            j = next_j;
            next_j = edge_at(b, nb, j, -1, v);
        }
    }
    return n;
}

size_t sunder_i_obstacle_edges(const double *d, size_t n, sunder_i_obstacle_edge *edge)
{
    size_t edges = 0;
    for (size_t k = 0; k < n; k++) {
        const double *p = d + 2 * k, *q = d + 2 * (k + 1 < n ? k + 1 : 0);
        const double ex = q[0] - p[0], ey = q[1] - p[1], length = sqrt(ex * ex + ey * ey);
        if (length > 0) edge[edges++] = (sunder_i_obstacle_edge){{p[0], p[1]}, {ey / length, -ex / length}, length};
    }
    return edges;
}

/* Returns the support line along an edge. */
static sunder_i_support line_of(const sunder_i_obstacle_edge *e, double distance)
{
    return (sunder_i_support){{e->n[0], e->n[1]}, e->n[0] * e->from[0] + e->n[1] * e->from[1], distance};
}

/* Returns the support line through corner c that is perpendicular to the direction from c to u; `far` is their
 * distance. */
static sunder_i_support line_at(const double c[2], const double u[2], double far)
{
    const double cx = u[0] - c[0], cy = u[1] - c[1];
    return (sunder_i_support){{cx / far, cy / far}, (cx * c[0] + cy * c[1]) / far, far};
}

sunder_i_support sunder_i_support_at(const sunder_i_obstacle_edge *edge, size_t n, const double u[2])
{
    const sunder_i_obstacle_edge *best = NULL, *facing = NULL;
    const double *corner = NULL;
    double most = -INFINITY, nearest = INFINITY, perimeter = 0;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_obstacle_edge *e = &edge[k];
        const double wx = u[0] - e->from[0], wy = u[1] - e->from[1], s = e->n[0] * wx + e->n[1] * wy;
        perimeter += e->length;
        if (s > most) {
            most = s;
            best = e;
        }
        if (s < 0) continue;
        /* u is in front of this edge: the nearest point is inside the edge or one of its ends. */
        const double along = wy * e->n[0] - wx * e->n[1];
        if (along >= 0 && along <= e->length) {
            if (s < nearest) {
                nearest = s;
                facing = e;
            }
            continue;
        }
        const double *c = along < 0 ? e->from : edge[k + 1 < n ? k + 1 : 0].from;
        const double cx = u[0] - c[0], cy = u[1] - c[1], far = sqrt(cx * cx + cy * cy);
        if (far < nearest) {
            nearest = far;
            facing = NULL;
            corner = c;
        }
    }
    /* Very near to a corner the direction from it to u is dominated by rounding, and the normal of an edge serves as
     * well. */
    if (most <= 0 || !(nearest < INFINITY) || nearest < AT_A_CORNER * perimeter)
        return best ? line_of(best, most) : (sunder_i_support){{1, 0}, 0, -INFINITY};
    return facing ? line_of(facing, nearest) : line_at(corner, u, nearest);
}
