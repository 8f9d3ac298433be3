/* Shapes with rational coordinates. */
#ifndef SUNDER_I_RATIONAL_H
#define SUNDER_I_RATIONAL_H

#include "shape/shape.h"

/* Copies the 2 * vertices numerators and the rest into the shape. False if memory is out. */
bool sunder_i_shape_set_rational(sunder_shape *s, const sunder_i_big *num, sunder_i_big den, long exponent);
/* xy as the nearest doubles, the box outward, the extent, area and anchor. False if memory is out. */
bool sunder_i_shape_measure_rational(sunder_shape *s);

#endif
