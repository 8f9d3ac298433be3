/* The obstacle A + (-B) of two convex pieces, and its support lines; see obstacle.c. */
#ifndef SUNDER_I_OBSTACLE_H
#define SUNDER_I_OBSTACLE_H

#include <stdbool.h>
#include <stddef.h>

/* Scratch memory of one thread. It grows, and remembers a failure. */
typedef struct sunder_i_scratch {
    double *xy;
    size_t capacity;
    bool failed;
} sunder_i_scratch;

/* Makes room for n corners and returns them; the contents are kept. Returns NULL if memory is out. */
double *sunder_i_scratch_reserve(sunder_i_scratch *scratch, size_t n);
/* Returns the least (sign +1) or greatest (sign -1) of n corners by y, then by x. Beginning there, the directions of
 * edges increase from 0 to 2 pi. */
size_t sunder_i_extreme_corner(const double *corner, size_t n, double sign);
/* Is the direction of edge u less than, or equal to, that of v? Directions are compared by half-plane, the upper one
 * first, and within a half by the cross product in doubles. */
static inline bool sunder_i_turns_first(const double u[2], const double v[2])
{
    const bool a = u[1] > 0 || (u[1] == 0 && u[0] > 0), b = v[1] > 0 || (v[1] == 0 && v[0] > 0);
    return a != b ? a : u[0] * v[1] - u[1] * v[0] >= 0;
}

/* Computes the obstacle A + (-B) of two convex polygons: its corners, counter-clockwise, in scratch->xy. `offset` is
 * the origin of B relative to that of A. Returns the number of corners, 0 if memory is out. */
size_t sunder_i_obstacle_corners(const double *a, size_t na, const double *b, size_t nb, const double offset[2],
                                 sunder_i_scratch *scratch);

/* A support constraint n.u >= support + gap, which keeps u outside the obstacle. */
typedef struct sunder_i_support {
    double n[2], support;
    double distance; /* from u to the obstacle; inside, minus the distance to the nearest side */
} sunder_i_support;

/* An edge of an obstacle: its beginning, its outer normal, its length. */
typedef struct sunder_i_obstacle_edge {
    double from[2], n[2], length;
} sunder_i_obstacle_edge;

/* Writes the edges of the convex polygon d of n corners to edge[n], without those of length 0. Returns their number. */
size_t sunder_i_obstacle_edges(const double *d, size_t n, sunder_i_obstacle_edge *edge);
/* Returns the support line of a convex polygon, given by its n edges, whose distance from u is greatest. */
sunder_i_support sunder_i_support_at(const sunder_i_obstacle_edge *edge, size_t n, const double u[2]);

#endif
