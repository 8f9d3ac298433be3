/* Sums of the library as canonical text, and laws on such texts. */
#ifndef SUNDER_TESTS_SUM_TEXT_H
#define SUNDER_TESTS_SUM_TEXT_H

#include "polyset.h"

/* The same text as oracle_sum_text() gives, through the public getters only. Checks on the way that the counts agree
 * with what the getters give, and that the vertices as doubles are the nearest to the exact ones. Freed by the
 * caller. */
char *sum_text(const sunder_sum *sum);

/* Canonical text of the library's P + Q; NULL, with the reason on stderr, where anything fails. */
char *library_sum_text(const polyset *p, const polyset *q);
/* The same on big integers. */
char *library_sum_text_wide(const polyset *p, const polyset *q);
/* Is the sum of operand[0] and operand[1] made, or memory said to be out without a leak, whichever allocation fails? */
bool library_sum_survives(const polyset operand[2]);

/* Every coordinate of a canonical text times 2^scale, plus (dx, dy), in rationals. */
char *sum_text_moved(const char *text, long scale, double dx, double dy);

/* Every coordinate times an integer k > 0. */
char *sum_text_times(const char *text, long k);

/* Is the point, given by rational texts, covered: inside a polygon of the canonical text and on no degenerate segment
 * or point? */
bool sum_text_covers(const char *text, const char *x, const char *y);

/* The convex hull of a polygonal set, exact, as a set of one ring. */
void polyset_hull(polyset *hull, const polyset *set);
/* The convex hull of all outer vertices of a canonical text, written like a ring there. */
char *sum_text_hull(const char *text);
/* The outer ring of the only polygon of a canonical text, written like a ring there; NULL if there is not one or it has
 * holes. */
char *sum_text_only_ring(const char *text);

#endif
