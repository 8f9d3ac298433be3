/* The obstacle A + (-B) of two convex pieces, and its support lines; see obstacle.c. */
#ifndef SUNDER_I_OBSTACLE_H
#define SUNDER_I_OBSTACLE_H

#include <stdbool.h>
#include <stddef.h>

/* Scratch memory of one thread; grows, and remembers a failure. */
typedef struct sunder_i_scratch {
    double *xy;
    size_t capacity;
    bool failed;
} sunder_i_scratch;

/* Room for n corners; NULL: memory is out. What was there is kept. */
double *sunder_i_scratch_reserve(sunder_i_scratch *scratch, size_t n);
/* Least (sign +1) or greatest (sign -1) of n corners by y, then x: from there edges turn from direction 0 to 2 pi. */
size_t sunder_i_extreme_corner(const double *corner, size_t n, double sign);
/* Does edge u come before v, so turning? Upper half-plane first; within a half the cross product tells, as doubles
 * do. */
static inline bool sunder_i_turns_first(const double u[2], const double v[2])
{
    const bool a = u[1] > 0 || (u[1] == 0 && u[0] > 0), b = v[1] > 0 || (v[1] == 0 && v[0] > 0);
    return a != b ? a : u[0] * v[1] - u[1] * v[0] >= 0;
}

/* The obstacle A + (-B) of two convex polygons: corners counter-clockwise in scratch->xy. Returns how many, 0 if memory
 * is out. */
size_t sunder_i_obstacle_corners(const double *a, size_t na, const double *b, size_t nb, const double offset[2],
                                 sunder_i_scratch *scratch);

/* A support constraint n.u >= support + gap, valid for every u outside the obstacle on that side. */
typedef struct sunder_i_support {
    double n[2], support;
    double distance; /* of u to the obstacle: negative inside, then of the shallowest side */
} sunder_i_support;

/* An edge of an obstacle: where it begins, its outer normal, its length. */
typedef struct sunder_i_obstacle_edge {
    double from[2], n[2], length;
} sunder_i_obstacle_edge;

/* The edges of the convex polygon d of n corners, those without length left out, in edge[n]; returns how many. */
size_t sunder_i_obstacle_edges(const double *d, size_t n, sunder_i_obstacle_edge *edge);
/* The support line of the convex polygon of these edges that is farthest below u. */
sunder_i_support sunder_i_support_at(const sunder_i_obstacle_edge *edge, size_t n, const double u[2]);

#endif
