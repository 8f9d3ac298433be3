/* barrier_corner.c: see barrier.h. */
#include "layer/barriers/barrier.h"

#include <math.h>
#include <string.h>

static void take_nearer(const double *xy, size_t n, const double at[2], double *square, double nearest[2])
{
    for (size_t k = 0; k < n; k++) {
        double dx = xy[2 * k] - at[0], dy = xy[2 * k + 1] - at[1], s = dx * dx + dy * dy;
        if (s >= *square) continue;
        *square = s;
        memcpy(nearest, xy + 2 * k, 2 * sizeof *xy);
    }
}

void gis_barrier_corner(const sunder_obstacle *barrier, const double at[2], double nearest[2])
{
    double square = INFINITY;
    memcpy(nearest, at, 2 * sizeof *nearest);
    take_nearer(barrier->xy, barrier->lines ? barrier->line_end[barrier->lines - 1] : 0, at, &square, nearest);
    for (size_t p = 0; barrier->shape && p < sunder_shape_polygons(barrier->shape); p++)
        for (size_t r = 0; r < sunder_shape_rings(barrier->shape, p); r++) {
            size_t n;
            const double *xy = sunder_shape_ring(barrier->shape, p, r, &n);
            take_nearer(xy, n, at, &square, nearest);
        }
}
