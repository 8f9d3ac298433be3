/* For peers that unite convex subsums: the sums of all pairs of convex pieces of P and Q, as rings of doubles.
 *
 * The pieces are Sunder's, the fewest that need no new vertices (of members with holes, or over 500 vertices, Hertel
 * and Mehlhorn's), so that corners of subsums are sums of corners as given: integers stay integers, and subsums that
 * touch do touch. That is more than the peers have of their own, and none of it counts in their time: with Hertel and
 * Mehlhorn's pieces Clipper takes 6.4 s on forks of 50 vertices, with these 1.3 ms. */
#ifndef SUNDER_BENCH_SUBSUMS_H
#define SUNDER_BENCH_SUBSUMS_H

#include "wkt_input.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A set of convex rings, counter-clockwise and not closed; a polygon each. False with a message on stderr. Freed with
 * bench_set_free(). */
int bench_subsums(const bench_set *p, const bench_set *q, bench_set *out);

/* The radius of the least circle around the middle of q's box that has all of q in it: what a round buffer takes in
 * the place of a regular polygon. */
double bench_radius(const bench_set *q);

#ifdef __cplusplus
}
#endif

#endif
