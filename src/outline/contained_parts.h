/* Parts and sides that lie inside one part, found before anything else is asked about them. */
#ifndef SUNDER_I_CONTAINED_PARTS_H
#define SUNDER_I_CONTAINED_PARTS_H

#include "convex/pieces.h"

/* Unmarks candidates that lie inside one part, ends included: nothing on them is boundary or degenerate. Not all such
 * candidates are found. Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_drop_contained_sides(sunder_i_convex_pieces *parts, sunder_error *err);
/* Removes parts that lie inside another, borders included. The remaining parts keep their order, not their numbers. */
sunder_status sunder_i_drop_contained(sunder_i_convex_pieces *parts, sunder_error *err);

#endif
