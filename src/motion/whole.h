/* A robot of several members as one that has no seams. */
#ifndef SUNDER_I_WHOLE_H
#define SUNDER_I_WHOLE_H

#include "sunder.h"

/* The union of the members of a shape, as a shape of which the members have disjoint interiors and share no wall. *out
 * stays NULL where there is one member only, or where members cross in places that no doubles hold. */
sunder_status sunder_i_whole(const sunder_shape *shape, sunder_shape **out, sunder_error *err);

#endif
