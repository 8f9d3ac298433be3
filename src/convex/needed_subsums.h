/* Which subsums does the outline of their union need? Found before any is made. */
#ifndef SUNDER_I_NEEDED_SUBSUMS_H
#define SUNDER_I_NEEDED_SUBSUMS_H

#include "convex/pieces.h"
#include "convex/subsum_list.h"

/* The operands are ranked pieces of three corners or more. *out: subsums whose union is that of all, ascending. Time
 * and memory depend on what lies along the outline of the union, not on the number of subsums. `worth`: what leaving
 * one subsum out saves, in looks at two groups of pieces, about a hundred instructions each; it decides how much is
 * spent on leaving subsums out; 0: no more than the credit of each. False if memory is out. */
bool sunder_i_needed_subsums(const sunder_i_convex_pieces *p, const sunder_i_convex_pieces *q, double worth,
                             sunder_i_subsum_list *out);

#endif
