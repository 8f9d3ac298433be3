/* Sums of the library as canonical text, and laws on such texts. */
#ifndef SUNDER_TESTS_SUM_TEXT_H
#define SUNDER_TESTS_SUM_TEXT_H

#include "polyset.h"

/* The same text as that of oracle_sum_text(), obtained by the public getters only. Checks at the same time that the
 * counts agree with the getters, and that the vertices as doubles are the nearest to the exact ones. Freed by the
 * caller. */
char *sum_text(const sunder_sum *sum);

/* Canonical text of the library's P + Q; NULL, with the reason on stderr, if anything fails. */
char *library_sum_text(const polyset *p, const polyset *q);
/* The same computed with big integers. */
char *library_sum_text_wide(const polyset *p, const polyset *q);
/* For each failing allocation in turn: is the sum of operand[0] and operand[1] computed, or lack of memory reported
 * without a leak? */
bool library_sum_survives(const polyset operand[2]);

/* Every coordinate of a canonical text times 2^scale, plus (dx, dy), in rationals. */
char *sum_text_moved(const char *text, long scale, double dx, double dy);

/* Every coordinate times an integer k > 0. */
char *sum_text_times(const char *text, long k);

/* Is the point, given by rational texts, covered: inside a polygon of the canonical text and not on a degenerate
 * segment or point? */
bool sum_text_covers(const char *text, const char *x, const char *y);

/* The convex hull of a polygonal set, exact, as a set of one ring. */
void polyset_hull(polyset *hull, const polyset *set);
/* The convex hull of all outer vertices of a canonical text, written like a ring there. */
char *sum_text_hull(const char *text);
/* The outer ring of the only polygon of a canonical text, written like a ring there; NULL if there are several polygons
 * or holes. */
char *sum_text_only_ring(const char *text);

#endif
