/* The largest gap for which a conflict has a solution; see need_gap.c. */
#ifndef SUNDER_I_NEED_GAP_H
#define SUNDER_I_NEED_GAP_H

#include "displacement/report/inquiry.h"

/* Sets need_gap of those conflicts whose features keep some gap, smaller than the requested one, in the result itself,
 * and need_gap_most to the requested gap. No question is asked for it. */
sunder_status sunder_i_keep_gaps_there_are(const sunder_i_questions *questions, sunder_error *err);
/* Raises need_gap of the conflict, starting from the gap that the result keeps, to the largest gap for which a solution
 * is found, and sets need_gap_most to the least gap that is proved to be too large. need_gap stays NAN if no solution
 * is found. */
sunder_status sunder_i_find_need_gap(sunder_i_inquiry *inquiry, sunder_error *err);

#endif
