/* Which subsums matter to which candidate sides: a hierarchy of cells that follows the output.
 *
 * A cell is a box. It carries, for each subsum that reaches into it, the sides whose lines pass through it; a subsum none of
 * whose sides passes holds the whole cell in its interior, and then nothing in the cell can be boundary or degenerate: the cell is
 * closed, whatever else crosses it. Else the cell is split until few candidates are left. So whatever lies deep inside some
 * subsum is discarded before anything is intersected, and the cost follows the boundary of the sum rather than the arrangement
 * beneath it.
 *
 * The tests are floating point with error bounds, and one-sided: a subsum is taken to hold a cell, or to miss it, only when that is
 * proved. What comes out is for each live candidate side (one that passes through an open leaf) a list of subsums that decides
 * exactly what part of it is covered: every subsum of the open leaves that it passes, and for each closed cell one subsum that
 * holds that cell. The decision itself is taken elsewhere, exactly (coverage.h). */
#ifndef SUNDER_I_CELLS_H
#define SUNDER_I_CELLS_H

#include "minkowski/subsums.h"

typedef struct sunder_i_pairing {
    uint64_t *pair; /* candidate side << 32 | subsum; with repeats, in no order */
    size_t n, capacity;
    bool *live;     /* [sides] passes through an open leaf */
} sunder_i_pairing;

/* Fails with SUNDER_ENOMEM, or SUNDER_ECANCEL. */
sunder_status sunder_i_cells_pair(const sunder_i_subsums *subsums, const sunder_sum_options *options,
                                  sunder_i_pairing *out, sunder_error *err);
void sunder_i_pairing_free(sunder_i_pairing *pairing);

#endif
