/* Parts and sides that lie inside one part, found before anything else is asked about them. */
#ifndef SUNDER_I_CONTAINED_H
#define SUNDER_I_CONTAINED_H

#include "convex/pieces.h"

/* Takes the mark of a candidate from sides that are inside one part, ends included: nothing on them is boundary or
 * degenerate. Not all such are found. Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_drop_contained_sides(sunder_i_convex_pieces *parts, sunder_error *err);
/* And removes parts that are inside another, borders included. The others keep their order, not their numbers. */
sunder_status sunder_i_drop_contained(sunder_i_convex_pieces *parts, sunder_error *err);

#endif
