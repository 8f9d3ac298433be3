/* rational_corners.h: vertices that are not pairs of doubles. */
#ifndef SUNDER_I_RATIONAL_CORNERS_H
#define SUNDER_I_RATIONAL_CORNERS_H

#include "predicate/rational_point.h"
#include "shape/shape.h"

/* Returns v in units of 2^unit; unit must not be above v's lowest bit. */
static inline sunder_i_big sunder_i_big_in_units(sunder_i_arena *arena, double v, long unit)
{
    int e;
    const sunder_i_big m = sunder_i_big_double(arena, v, &e);
    return m.size ? sunder_i_big_shl(arena, m, (unsigned long)(e - unit)) : m;
}

/* Returns u * 2^exponent + (add[0], add[1]) in lowest terms. */
sunder_i_exact sunder_i_exact_make(sunder_i_arena *arena, sunder_i_rational_point u, long exponent,
                                   const double add[2]);
/* Returns whether the vertex is a pair of doubles. */
bool sunder_i_exact_is_double(sunder_i_arena *arena, const sunder_i_exact *corner);
/* Copies the numbers of all vertices to the shape. Returns false if out of memory. */
bool sunder_i_shape_set_rational(sunder_shape *s, const sunder_i_exact *exact);
/* Sets xy of vertices that are not doubles to the nearest ones, the box rounded outwards, the lowest bit, area and
 * anchor. Returns false if out of memory. */
bool sunder_i_shape_measure_rational(sunder_shape *s);

#endif
