/* Candidates that lie inside one subsum, found before anything else is asked about them. */
#ifndef SUNDER_I_BURIED_H
#define SUNDER_I_BURIED_H

#include "convex/pieces.h"

/* Takes the mark of a candidate from sides that are inside one subsum, ends included: nothing on them is boundary or
 * degenerate. Not all such are found. Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_bury_candidates(sunder_i_pieces *subsums, sunder_error *err);

#endif
