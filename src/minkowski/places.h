/* One vertex for each place: points found on different lines are compared exactly. */
#ifndef SUNDER_I_PLACES_H
#define SUNDER_I_PLACES_H

#include "predicate/predicate.h"

/* vertex_of[i] becomes the number of the place of point i; point[] is compacted to one of each place, in order of first
 * appearance. Returns how many, or SIZE_MAX if memory is out. */
size_t sunder_i_places_unify(sunder_i_lattice *lattice, sunder_i_hpoint *point, size_t n, uint32_t *vertex_of);

#endif
