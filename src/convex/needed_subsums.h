/* Which subsums the outline of their union needs, found before any is made. */
#ifndef SUNDER_I_NEEDED_SUBSUMS_H
#define SUNDER_I_NEEDED_SUBSUMS_H

#include "convex/pieces.h"

/* Subsums as pairs of pieces: that of p above, of q in the lower 32 bits. */
typedef struct sunder_i_subsum_list {
    uint64_t *pair;
    size_t n, capacity;
    bool all; /* it does not pay to leave any out: the list says nothing */
} sunder_i_subsum_list;

/* Of ranked pieces of three corners or more: subsums whose union is that of all, ascending. Time and memory go by what
 * there is to be found along the outline of the union, not by how many subsums there are. False if memory is out. */
bool sunder_i_needed_subsums(const sunder_i_convex_pieces *p, const sunder_i_convex_pieces *q,
                             sunder_i_subsum_list *out);
void sunder_i_subsum_list_free(sunder_i_subsum_list *list);

#endif
