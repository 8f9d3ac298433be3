/* Edges of shapes, and what lies beside or around them, in doubles. An edge is the four coordinates of its ends. */
#ifndef SUNDER_I_EDGES_H
#define SUNDER_I_EDGES_H

#include "displacement/layer/model.h"

#include "base/extremes.h"

#include <string.h>

/* Sets `edge` to the edge of a shape that begins at vertex v. */
static inline void sunder_i_edge_of(const sunder_shape *shape, uint32_t v, double edge[4])
{
    memcpy(edge, shape->xy + 2 * (size_t)v, 2 * sizeof *edge);
    memcpy(edge + 2, shape->xy + 2 * (size_t)shape->form->cleaned.next[v], 2 * sizeof *edge);
}

/* Sets `off` to the vector from the nearest point of an edge to p, in doubles. */
static inline void sunder_i_off_edge(const double edge[4], const double p[2], double off[2])
{
    const double u[2] = {edge[2] - edge[0], edge[3] - edge[1]}, w[2] = {p[0] - edge[0], p[1] - edge[1]};
    const double at = (u[0] * w[0] + u[1] * w[1]) / (u[0] * u[0] + u[1] * u[1]);
    const double t = sunder_i_max(0, sunder_i_min(1, at));
    for (int c = 0; c < 2; c++) off[c] = w[c] - t * u[c];
}

/* Does the ray from p in the direction of x cross the edge, in doubles? It crosses those of a polygon around p an odd
 * number of times. */
static inline bool sunder_i_ray_crosses(const double p[2], const double edge[4])
{
    return (edge[1] > p[1]) != (edge[3] > p[1]) &&
           p[0] < edge[0] + (edge[2] - edge[0]) * ((p[1] - edge[1]) / (edge[3] - edge[1]));
}

#endif
