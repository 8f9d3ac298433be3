/* from_rings.h: the raw input of a shape, and positions in it for error messages. */
#ifndef SUNDER_I_FROM_RINGS_H
#define SUNDER_I_FROM_RINGS_H

#include "shape/build.h"

typedef struct sunder_i_input {
    const double *xy;
    const size_t *ring_end, *poly_end;
    size_t polygons, rings, vertices;
} sunder_i_input;

/* Numbers from 0 on: of the polygon, of the ring in it, and of the vertex in the ring. */
typedef struct sunder_i_place_name {
    size_t polygon, ring, vertex;
} sunder_i_place_name;

sunder_i_place_name sunder_i_name_vertex(const sunder_i_input *in, uint32_t vertex);
/* Sets *err to the message for a problem whose vertices are raw numbers; returns its status. */
sunder_status sunder_i_fail_problem(const sunder_i_input *in, const sunder_i_problem *problem, sunder_error *err);

#endif
