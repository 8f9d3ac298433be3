/* small_polygon.h: makes a shape of one small polygon that is valid as given: the usual building. */
#ifndef SUNDER_I_SMALL_POLYGON_H
#define SUNDER_I_SMALL_POLYGON_H

#include "shape/from_rings.h"

/* Returns false if the input needs the general path. Else *out becomes its shape, the same as on that path, or NULL if
 * out of memory. The input must have been checked: its arrays, and that all coordinates are finite. */
bool sunder_i_small_polygon(const sunder_i_input *in, sunder_shape **out);

#endif
