/* How ill a pair of features stands, in rationals and by brute force: for the rule that nothing is made worse. Shares
 * no code with src/. */
#ifndef SUNDER_TESTS_STANDING_H
#define SUNDER_TESTS_STANDING_H

#include "polyset.h"

#include <gmp.h>
#include <stdbool.h>

typedef struct standing {
    bool meet;    /* the interiors do */
    mpq_t square; /* of the distance; or of the length of the least translation that takes the interiors apart */
} standing;

/* Few corners: all pairs of contact segments are crossed. */
void standing_of(standing *s, const polyset *a, const polyset *b);
void standing_clear(standing *s);
/* Disjoint is better than meeting; else by the squares. */
bool stands_worse(const standing *now, const standing *was);
/* Disjoint, and the gap apart? */
bool stands_apart(const standing *s, double gap);

/* The rule, for one pair that is listed as a conflict between blocks: it was in conflict before, and stands no worse
 * now. NULL, or what is wrong. */
const char *standing_rule(const polyset *a_was, const polyset *b_was, const polyset *a_is, const polyset *b_is,
                          double gap);

#endif
