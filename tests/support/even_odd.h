/* Sets by the even-odd rule, in rationals and by brute force, to test what the library repairs. Shares no code with it.
 * For few corners: everything is compared with everything. */
#ifndef SUNDER_TESTS_EVEN_ODD_H
#define SUNDER_TESTS_EVEN_ODD_H

#include "polyset.h"

#include <gmp.h>

typedef struct even_odd_corner {
    mpq_t x, y;
    /* along the boundary, with the set on the left; where boundaries touch, each has a corner of its own */
    size_t next, prev;
    size_t member;
} even_odd_corner;

/* The closure of the set that each member encloses by the rule: the corners of its boundary, without straight ones. */
typedef struct even_odd {
    even_odd_corner *corner;
    size_t n, members;
} even_odd;

void even_odd_open(even_odd *e, const polyset *set);
void even_odd_close(even_odd *e);
/* Replaces factor by the least common multiple of it and all denominators. */
void even_odd_denominator(const even_odd *e, mpz_t factor);
/* The set multiplied by factor: a polygon for each member that encloses anything, with its rings in any order. False if
 * doubles cannot represent its corners. */
bool even_odd_times(const even_odd *e, const mpz_t factor, polyset *out);

#endif
