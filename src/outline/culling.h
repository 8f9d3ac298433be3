/* culling.h: finds which parts matter to which candidate sides, by a hierarchy of cells whose size depends on the
 * output.
 *
 * A cell is a box. It has, for each part that meets it, the sides whose lines pass through it. A part without such a
 * side contains the whole cell in its interior (or two parts do together); nothing in the cell can then be boundary or
 * degenerate, so that the cell is closed, whatever else crosses it. Otherwise the cell is divided until few candidates
 * are left. So everything deep inside some part is discarded before anything is intersected, and the cost depends on
 * the boundary of the sum rather than on the arrangement of all sides.
 *
 * In a leaf that only one part meets, its candidates are boundary. A candidate that passes through such leaves only is
 * settled here.
 *
 * The tests are in floating point with error bounds, and one-sided: a part is taken to contain a cell, or to miss it,
 * only if that is proved. The result is, for each line with live candidates (sides that pass through an open leaf), a
 * list of parts that determines exactly which stretches of those sides are covered: every part of the open leaves that
 * they pass, and for each closed cell the one or two parts that contain it. The coverage itself is computed exactly
 * from these lists (coverage.h). */
#ifndef SUNDER_I_CULLING_H
#define SUNDER_I_CULLING_H

#include "outline/lines.h"
#include "outline/pairs.h"
#include "sunder_sum.h"

typedef struct sunder_i_culled {
    sunder_i_pairs pairs;
    uint8_t *fate;   /* [sides] the result for each candidate: SUNDER_I_COVERED ... */
    bool *live_line; /* [lines] whether the line contains an open candidate */
    size_t whole;    /* the number of sides with the fate SUNDER_I_WHOLE */
    double most;     /* the largest approximate coordinate */
} sunder_i_culled;

/* The result for a candidate. No other part meets a WHOLE one, not even at its ends: it is boundary completely. */
enum { SUNDER_I_COVERED = 0, SUNDER_I_OPEN = 1, SUNDER_I_WHOLE = 2 };

/* Finds the fate of every candidate of the parts, and the pairs of lines and parts that decide the open ones. Fails
 * with SUNDER_ENOMEM, or SUNDER_ECANCEL. */
sunder_status sunder_i_cull(const sunder_i_convex_pieces *parts, const sunder_i_lines *lines,
                            const sunder_sum_options *options, sunder_i_culled *out, sunder_error *err);
void sunder_i_culled_free(sunder_i_culled *culled);

#endif
