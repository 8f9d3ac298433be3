/* rotated_copies.h: copies of a shape that are rotated about the origin. */
#ifndef SUNDER_I_ROTATED_COPIES_H
#define SUNDER_I_ROTATED_COPIES_H

#include "sunder_sum.h"

/* Is the rotation rational: three integers, so small that their squares are exact, with the identity of a rotation? */
bool sunder_i_rotation_is_rational(const sunder_rotation *rotation);

/* Makes the copy (cosine * x - sine * y, sine * x + cosine * y) of a shape; *exact is set to whether each coordinate is
 * the exact value, else it is a double next to it. If rounding makes a polygon invalid, it is taken by the even-odd
 * rule. SUNDER_ERANGE if a coordinate leaves the range of doubles. */
sunder_status sunder_i_rotated_copy(const sunder_shape *shape, double cosine, double sine, sunder_shape **out,
                                    bool *exact, sunder_error *err);

#endif
