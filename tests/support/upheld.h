/* The rule that no conflict gets worse, tested for a whole report. */
#ifndef SUNDER_TESTS_UPHELD_H
#define SUNDER_TESTS_UPHELD_H

#include "sunder.h"

/* Which listed pair is worse than at the start, in rationals by brute force (standing.h)? Returns NULL if none is,
 * otherwise a sentence, freed by the caller. Each feature is compared as given and as written. Not tested are pairs
 * with barriers, pairs inside a block, pairs that were contained or duplicates and still are (not worse by definition),
 * and repaired features, whose corners are not doubles. */
char *upheld_breach(const sunder_feature *feature, size_t n, const sunder_layer_options *options,
                    const sunder_report *report);

#endif
