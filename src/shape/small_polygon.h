/* A shape of one small polygon that is sound as it was given: the usual building. */
#ifndef SUNDER_I_SMALL_POLYGON_H
#define SUNDER_I_SMALL_POLYGON_H

#include "shape/from_rings.h"

/* False: this input goes the general way. True: *out is its shape, the same as on that way, or NULL if memory is out.
 * Of the input it is known that it can be read, and that all coordinates are finite. */
bool sunder_i_small_polygon(const sunder_i_input *in, sunder_shape **out);

#endif
