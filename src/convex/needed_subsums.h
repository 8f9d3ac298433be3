/* needed_subsums.h: which subsums does the outline of their union need? They are found before any subsum is
 * computed. */
#ifndef SUNDER_I_NEEDED_SUBSUMS_H
#define SUNDER_I_NEEDED_SUBSUMS_H

#include "convex/pieces.h"
#include "convex/subsum_list.h"

/* The operands p and q are ranked pieces with at least three corners. *out becomes a list of subsums in ascending order
 * whose union is that of all. Time and memory depend on the pieces along the outline of the union, not on the number of
 * subsums. worth: what leaving one subsum out saves, in tests of a pair of groups, about a hundred instructions each;
 * it determines how much is spent on leaving subsums out; 0: no more than the credit of each. Returns false if out of
 * memory. */
bool sunder_i_needed_subsums(const sunder_i_convex_pieces *p, const sunder_i_convex_pieces *q, double worth,
                             sunder_i_subsum_list *out);

#endif
