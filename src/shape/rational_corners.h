/* Corners that are no pairs of doubles. */
#ifndef SUNDER_I_RATIONAL_CORNERS_H
#define SUNDER_I_RATIONAL_CORNERS_H

#include "predicate/rational_point.h"
#include "shape/shape.h"

/* u * 2^exponent + (add[0], add[1]), in lowest terms. */
sunder_i_exact sunder_i_exact_make(sunder_i_arena *arena, sunder_i_rational_point u, long exponent,
                                   const double add[2]);
/* Is it a pair of doubles after all? */
bool sunder_i_exact_is_double(sunder_i_arena *arena, const sunder_i_exact *corner);
/* Copies the numbers of all vertices into the shape. False if memory is out. */
bool sunder_i_shape_set_rational(sunder_shape *s, const sunder_i_exact *exact);
/* xy of corners that are no doubles as the nearest ones, the box outward, the extent, area and anchor. False if memory
 * is out. */
bool sunder_i_shape_measure_rational(sunder_shape *s);

#endif
