/* The largest gap for which a conflict has a solution; see need_gap.c. */
#ifndef SUNDER_I_NEED_GAP_H
#define SUNDER_I_NEED_GAP_H

#include "displacement/report/inquiry.h"

/* Sets need_gap of those conflicts that keep a smaller gap in the result, without a question. */
sunder_status sunder_i_keep_gaps_there_are(const sunder_i_questions *questions, sunder_error *err);
/* Sets need_gap and need_gap_most of the conflict, starting from the gap that the result keeps. */
sunder_status sunder_i_find_need_gap(sunder_i_inquiry *inquiry, sunder_error *err);

#endif
