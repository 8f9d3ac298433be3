/* contained_parts.h: finds parts and sides that are inside one part before anything else is computed of them. */
#ifndef SUNDER_I_CONTAINED_PARTS_H
#define SUNDER_I_CONTAINED_PARTS_H

#include "convex/pieces.h"

/* Unmarks candidates that are inside one part, with their ends: nothing on them is boundary or degenerate. Not all such
 * candidates are found. Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_drop_contained_sides(sunder_i_convex_pieces *parts, sunder_error *err);
/* Removes parts that are inside another one, with their boundaries. The remaining parts keep their order, not their
 * numbers. */
sunder_status sunder_i_drop_contained(sunder_i_convex_pieces *parts, sunder_error *err);

#endif
