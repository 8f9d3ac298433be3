/* Which subsums the outline of their union needs, found before any is made. */
#ifndef SUNDER_I_NEEDED_SUBSUMS_H
#define SUNDER_I_NEEDED_SUBSUMS_H

#include "convex/pieces.h"
#include "convex/subsum_list.h"

/* Of ranked pieces of three corners or more: subsums whose union is that of all, ascending. Time and memory go by what
 * there is to be found along the outline of the union, not by how many subsums there are. `worth`: what is saved by
 * each that is left out, in looks at two groups of pieces, which take about a hundred instructions; it decides how far
 * is looked where they are many; 0: no further than the credit of each goes. False if memory is out. */
bool sunder_i_needed_subsums(const sunder_i_convex_pieces *p, const sunder_i_convex_pieces *q, double worth,
                             sunder_i_subsum_list *out);

#endif
