/* Which parts matter to which candidate sides: a hierarchy of cells that follows the output.
 *
 * A cell is a box. It carries, for each part that reaches into it, the sides whose lines pass through it. A part none
 * of whose sides passes holds the whole cell in its interior (or two parts do together); nothing in the cell can then
 * be boundary or degenerate, so the cell is closed, whatever else crosses it. Otherwise the cell is split until few
 * candidates are left. So whatever lies deep inside some part is discarded before anything is intersected, and the cost
 * follows the boundary of the sum rather than the arrangement beneath it.
 *
 * In a leaf that only one part reaches into, its candidates are boundary. A candidate that passes through such leaves
 * only is settled here.
 *
 * The tests are floating point with error bounds, and one-sided: a part is taken to hold a cell, or to miss it, only
 * when that is proved. The result is, for each line with live candidates (sides that pass through an open leaf), a list
 * of parts that decides exactly which stretches of those sides are covered: every part of the open leaves that they
 * pass, and for each closed cell the one or two parts that hold it. The decision itself is made elsewhere, exactly
 * (coverage.h). */
#ifndef SUNDER_I_CULLING_H
#define SUNDER_I_CULLING_H

#include "outline/lines.h"
#include "outline/pairs.h"

typedef struct sunder_i_culled {
    sunder_i_pairs pairs;
    uint8_t *fate;   /* [sides] of each candidate: SUNDER_I_COVERED ... */
    bool *live_line; /* [lines] lines that hold an open candidate */
    size_t whole;    /* how many sides have that fate */
    double most;     /* the largest approximate coordinate */
} sunder_i_culled;

/* The verdict of the cells on a candidate. No other part meets a whole one, not even in its ends: all of it is
 * boundary. */
enum { SUNDER_I_COVERED = 0, SUNDER_I_OPEN = 1, SUNDER_I_WHOLE = 2 };

/* Fails with SUNDER_ENOMEM, or SUNDER_ECANCEL. */
sunder_status sunder_i_cull(const sunder_i_convex_pieces *parts, const sunder_i_lines *lines,
                            const sunder_sum_options *options, sunder_i_culled *out, sunder_error *err);
void sunder_i_culled_free(sunder_i_culled *culled);

#endif
