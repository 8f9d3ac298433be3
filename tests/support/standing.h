/* How bad the conflict of a pair of features is, in rationals and by brute force: for the rule that no conflict gets
 * worse. Shares no code with src/. */
#ifndef SUNDER_TESTS_STANDING_H
#define SUNDER_TESTS_STANDING_H

#include "polyset.h"

#include <gmp.h>
#include <stdbool.h>

typedef struct standing {
    bool meet;    /* do the interiors meet? */
    mpq_t square; /* the square of the distance; or of the length of the least translation that separates the
                   * interiors */
} standing;

/* For few corners: all pairs of contact segments are intersected. */
void standing_of(standing *s, const polyset *a, const polyset *b);
void standing_clear(standing *s);
/* Disjoint is better than meeting; otherwise the squares decide. */
bool stands_worse(const standing *now, const standing *was);
/* Are the two disjoint, and at least the gap apart? */
bool stands_apart(const standing *s, double gap);

/* The rule, for one pair that is listed as a conflict between blocks: it was in conflict before, and is no worse now.
 * Returns NULL, or the fault. */
const char *standing_rule(const polyset *a_was, const polyset *b_was, const polyset *a_is, const polyset *b_is,
                          double gap);

#endif
