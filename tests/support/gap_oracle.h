/* Least translations with a gap by brute force, for tests. Shares no code with the library.
 *
 * The least translation is the nearest to the origin of three kinds of places: feet of perpendiculars on lines at the
 * distance of the gap from a side of one set moved to a corner of the other, nearest points of circles about the
 * differences of two corners, and crossings of two of these curves. Each place that is no farther than the answer under
 * test is computed in long binary fractions, and corner against side it is tested whether the place keeps the gap. A
 * difference from the gap of less than 2^-2700 counts as equality. Reason: places have degree 4 at most over the
 * coordinates, which have 60 bits here, and the squares that are compared are integers of less than 700 bits in a
 * common unit; so the product with the three conjugates bounds a nonzero difference from below by 2^-2100. */
#ifndef SUNDER_TESTS_GAP_ORACLE_H
#define SUNDER_TESTS_GAP_ORACLE_H

#include "polyset.h"

#include <gmp.h>
#include <stdbool.h>

/* Are the interiors of P and Q + (x, y) disjoint, and the sets at least the gap apart? Exact. gap > 0. */
bool gap_oracle_keeps(const polyset *p, const polyset *q, double gap, const mpq_t x, const mpq_t y);

typedef enum gap_verdict {
    GAP_FINE,
    GAP_TOO_LONG,  /* a free place is nearer than the answer by more than 1e-9 of it */
    GAP_BOUND_HIGH /* a free place is nearer than the bound */
} gap_verdict;

/* Judges a translation that keeps the gap, given by its squared length, and a lower bound. *length: approximately the
 * length of the nearest free place; infinite if none is as near as the answer. */
gap_verdict gap_oracle_judge(const polyset *p, const polyset *q, double gap, const mpq_t square, double bound,
                             double *length);

#endif
