/* A shape of one small ring that is sound as it was given: the usual building. */
#ifndef SUNDER_I_SMALL_RING_H
#define SUNDER_I_SMALL_RING_H

#include "shape/build.h"

/* False: this ring goes the general way. True: *out is its shape, the same as on that way, or NULL if memory is out.
 * raw: how many vertices, the closing one too; all are finite. */
bool sunder_i_small_ring(const double *xy, size_t raw, sunder_shape **out);

#endif
