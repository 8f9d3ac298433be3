/* Which parts matter to which candidate sides: a hierarchy of cells that follows the output.
 *
 * A cell is a box. It carries, for each part that reaches into it, the sides whose lines pass through it; a
 * part none of whose sides passes holds the whole cell in its interior (or two do together), and then nothing in
 * the cell can be boundary or degenerate: the cell is closed, whatever else crosses it. Else the cell is split
 * until few candidates are left. So whatever lies deep inside some part is discarded before anything is
 * intersected, and the cost follows the boundary of the sum rather than the arrangement beneath it.
 *
 * A leaf that one part alone reaches into leaves nothing to ask: what passes of its candidates is boundary. A
 * candidate that passes through such leaves only is settled here.
 *
 * The tests are floating point with error bounds, and one-sided: a part is taken to hold a cell, or to miss it,
 * only when that is proved. What comes out is for each line with live candidates (sides that pass through an open
 * leaf) a list of parts that decides exactly what part of those sides is covered: every part of the open leaves
 * that they pass, and for each closed cell the one or two parts that hold it. The decision itself is taken
 * elsewhere, exactly (coverage.h). */
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

/* What the cells tell of a candidate. A whole one is met by no other part, not even in its ends: all of it is
 * boundary. */
enum { SUNDER_I_COVERED = 0, SUNDER_I_OPEN = 1, SUNDER_I_WHOLE = 2 };

/* Fails with SUNDER_ENOMEM, or SUNDER_ECANCEL. */
sunder_status sunder_i_cull(const sunder_i_convex_pieces *parts, const sunder_i_lines *lines,
                            const sunder_sum_options *options, sunder_i_culled *out, sunder_error *err);
void sunder_i_culled_free(sunder_i_culled *culled);

#endif
