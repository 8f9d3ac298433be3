/* The oracle: Minkowski sums by brute force in GMP integers and rationals, sharing no code with src/.
 *
 * A point x lies in O = int P + int Q exactly if it lies in the interior of some T + S, where T and S are triangles of
 * P and of Q: the interiors of the triangles are dense in the interiors of the sets, and T and S are convex. The
 * boundary of O, its degenerate segments and points lie on segments "edge of one operand + vertex of the other". So all
 * those segments and all their crossings are computed; the membership test decides for each of the two sides of each
 * piece between crossings, for the piece itself, and for each crossing. No result is propagated from one place to
 * another and no winding numbers are used. Slow: O(n^2 m^2) and more. */
#ifndef SUNDER_TESTS_ORACLE_H
#define SUNDER_TESTS_ORACLE_H

#include "polyset.h"

typedef struct oracle oracle;

/* Puts both operands on one integer grid, with their triangles and all sums of these. Accepts sets that are valid for
 * sunder_shape_from_rings(). */
oracle *oracle_new(const polyset *p, const polyset *q);
/* The same for any rings, by the even-odd rule (even_odd.h). */
oracle *oracle_new_even_odd(const polyset *p, const polyset *q);
void oracle_free(oracle *o);

/* Is the point, given as rational texts "num/den", in int P + int Q? */
bool oracle_covers(const oracle *o, const char *x, const char *y);

/* The canonical sum as one line of JSON with rational texts: {"polygons": [{"outer": [["x", "y"], ...], "holes":
 * [...]}], "degenerate_segments": [...], "degenerate_points": [...]} all_segments: arranges every edge-vertex pair;
 * otherwise only those that are locally extreme, which gives the same set by the lemma in oracle_arrangement.c (tests
 * run both). Freed by the caller. */
char *oracle_sum_text(const polyset *p, const polyset *q, bool all_segments);
char *oracle_even_odd_text(const polyset *p, const polyset *q, bool all_segments);
/* Returns 1 if `ours` is the text of P + Q. Otherwise returns -1 and prints how to repeat case `i` of that kind. */
int oracle_verdict(const char *ours, const polyset *p, const polyset *q, const char *kind, uint64_t seed, size_t i);

/* The triangles of a set, member by member, 6 coordinates each, counter-clockwise; found by trying all candidates,
 * O(n^4) at worst. Their vertices are those of the set. Freed by the caller. */
double *oracle_triangles(const polyset *set, size_t *count);

#endif
