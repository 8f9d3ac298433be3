/* The raw input of a shape, and how its errors name places in it. */
#ifndef SUNDER_I_FROM_RINGS_H
#define SUNDER_I_FROM_RINGS_H

#include "shape/build.h"

typedef struct sunder_i_input {
    const double *xy;
    const size_t *ring_end, *poly_end;
    size_t polygons, rings, vertices;
} sunder_i_input;

/* Zero-based numbers: of the polygon, of the ring in it, of the vertex in that. */
typedef struct sunder_i_place_name {
    size_t polygon, ring, vertex;
} sunder_i_place_name;

sunder_i_place_name sunder_i_name_vertex(const sunder_i_input *in, uint32_t vertex);
/* The sentence for a problem; vertices are raw numbers. */
sunder_status sunder_i_fail_problem(const sunder_i_input *in, const sunder_i_problem *problem, sunder_error *err);

#endif
