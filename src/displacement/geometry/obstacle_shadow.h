/* The shadow of a convex obstacle from the origin; see obstacle_shadow.c. */
#ifndef SUNDER_I_OBSTACLE_SHADOW_H
#define SUNDER_I_OBSTACLE_SHADOW_H

#include "displacement/geometry/obstacle.h"

/* Computes the edges of the shadow { s k : k in K, s >= 1 } of the convex polygon K of n corners, counter-clockwise; K
 * may be a point or a segment. The first and the last edge are rays that begin at K: seen outward, the shadow lies to
 * the right of the first and to the left of the last. Between them are the sides of K that face the origin. Returns the
 * number of edges, at most n + 1, or 0 if the origin is in K or too near to decide. edge: room for n + 1. */
size_t sunder_i_shadow_edges(const double *k, size_t n, sunder_i_obstacle_edge *edge);
/* Returns the support line of such a shadow whose distance from u is greatest. */
sunder_i_support sunder_i_shadow_support_at(const sunder_i_obstacle_edge *edge, size_t n, const double u[2]);
/* Writes the corners of a polygon that contains the part of the shadow up to the distance `far` from the origin to
 * `out`, which has room for n + 3. Returns their number. */
size_t sunder_i_shadow_corners(const sunder_i_obstacle_edge *edge, size_t n, double far, double *out);

/* Writes to `out` the four corners of a rectangle that contains the part of a half-plane up to the distance `far` from
 * the origin. The half-plane is behind the edge, whose beginning is the point of its line nearest to the origin. */
size_t sunder_i_half_plane_corners(const sunder_i_obstacle_edge *edge, double far, double *out);

/* Sets `path` to the box of the segment from the origin to u, grown by `reach`. A shadow within `reach` of u is cast by
 * an obstacle that meets this box. */
static inline void sunder_i_shadow_path_box(const double u[2], double reach, double path[4])
{
    for (int c = 0; c < 2; c++) {
        path[c] = (u[c] < 0 ? u[c] : 0) - reach;
        path[c + 2] = (u[c] > 0 ? u[c] : 0) + reach;
    }
}

/* May the box `path` meet the obstacle of a set with box a and one with box b, whose origin is at `offset`? */
static inline bool sunder_i_shadow_may_reach(const double a[4], const double b[4], const double offset[2],
                                             const double path[4])
{
    return a[0] - b[2] - offset[0] <= path[2] && a[2] - b[0] - offset[0] >= path[0] &&
           a[1] - b[3] - offset[1] <= path[3] && a[3] - b[1] - offset[1] >= path[1];
}

#endif
