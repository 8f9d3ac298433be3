/* from_rings.h: the raw input of a shape. */
#ifndef SUNDER_I_FROM_RINGS_H
#define SUNDER_I_FROM_RINGS_H

#include "shape/build.h"

typedef struct sunder_i_input {
    const double *xy;
    const size_t *ring_end, *poly_end;
    size_t polygons, rings, vertices;
} sunder_i_input;

#endif
