/* counts.h: differences of operation counters between two moments. */
#ifndef SUNDER_I_COUNTS_H
#define SUNDER_I_COUNTS_H

#include "sunder_base.h"

/* Adds `after` minus `before` to *to. */
static inline void sunder_i_counts_add(sunder_counts *to, const sunder_counts *after, const sunder_counts *before)
{
    to->comparisons += after->comparisons - before->comparisons;
    to->orientation_tests += after->orientation_tests - before->orientation_tests;
    to->segment_intersections += after->segment_intersections - before->segment_intersections;
    to->exact_fallbacks += after->exact_fallbacks - before->exact_fallbacks;
}

static inline sunder_counts sunder_i_counts_since(const sunder_counts *after, const sunder_counts *before)
{
    sunder_counts since = {0};
    sunder_i_counts_add(&since, after, before);
    return since;
}

#endif
