/* Sets taken by the even-odd rule, in rationals and by brute force, for tests of what the library repairs. Shares no
 * code with it. Few corners: everything is compared with everything. */
#ifndef SUNDER_TESTS_EVEN_ODD_H
#define SUNDER_TESTS_EVEN_ODD_H

#include "polyset.h"

#include <gmp.h>

typedef struct even_odd_corner {
    mpq_t x, y;
    /* along the boundary, with the set on the left; if boundaries touch, each has a corner of its own */
    size_t next, prev;
    size_t member;
} even_odd_corner;

/* The closure of the set that each member encloses by the rule: corners of the boundary, none of them straight. */
typedef struct even_odd {
    even_odd_corner *corner;
    size_t n, members;
} even_odd;

void even_odd_open(even_odd *e, const polyset *set);
void even_odd_close(even_odd *e);
/* factor = the least common multiple of it and all denominators. */
void even_odd_denominator(const even_odd *e, mpz_t factor);
/* The set times factor: a polygon for each member that encloses anything, its rings in no order. False if doubles do
 * not hold its corners. */
bool even_odd_times(const even_odd *e, const mpz_t factor, polyset *out);

#endif
