/* Least separating translations that keep a gap g: the obstacle is the union of the subsums, each grown by an open disc
 * of radius g. Its boundary consists of sides moved outward by g and of arcs round corners, so the optimum may be
 * irrational. */
#ifndef SUNDER_I_GAP_H
#define SUNDER_I_GAP_H

#include "separation/answer.h"
#include "separation/candidates.h"
#include "separation/least.h"

/* A stretch of boundary: the line a + t d moved by the gap to its right (outward), or the circle of radius g about a.
 */
typedef struct sunder_i_curve {
    bool arc;
    sunder_i_point a, d;
} sunder_i_curve;

/* (x / w, y / w) in lattice units, w > 0. */
typedef struct sunder_i_rational {
    sunder_i_big x, y, w;
} sunder_i_rational;

typedef struct sunder_i_gap_problem {
    sunder_i_pairing *pairing;
    sunder_i_big gap; /* gap / 2^gap_bits lattice units: the lattice itself need not be so fine */
    unsigned long gap_bits;
    double gap_units, limit;
    bool last; /* no finer arithmetic will be tried: what cannot be told apart is taken as equal */
    const sunder_i_candidate *segment; /* of the reduced convolution, unmoved */
    size_t segments;
    const sunder_i_point *center; /* corners that arcs may go round */
    size_t centers;
} sunder_i_gap_problem;

typedef struct sunder_i_gap_answer {
    bool found;
    bool isolated; /* nearer than this is a point that cannot be told from an isolated irrational one */
    bool settled;  /* longer than the bound by at most 1e-9 of it, or isolated */
    sunder_i_rational at;
    double bound; /* units; no free point is nearer */
    sunder_contact contact;
} sunder_i_gap_answer;

/* The search, in floating point whose every conclusion clears an error bound; results are checked exactly. Two
 * instances of one text (gap_search.inc): long double, and 113 bits for what that cannot settle. */
sunder_status sunder_i_gap_search_long(const sunder_i_gap_problem *problem, sunder_i_gap_answer *out,
                                       sunder_error *err);
sunder_status sunder_i_gap_search_quad(const sunder_i_gap_problem *problem, sunder_i_gap_answer *out,
                                       sunder_error *err);

/* ---- Exact points (gap_exact.c) ---- */

/* The point of the curve's line or circle that is nearest to the origin, if it is rational. */
bool sunder_i_gap_foot(const sunder_i_gap_problem *problem, const sunder_i_curve *curve, sunder_i_rational *out);
/* The common point of two of them nearest to (x, y) units, if it is rational. */
bool sunder_i_gap_crossing(const sunder_i_gap_problem *problem, const sunder_i_curve *c, const sunder_i_curve *d,
                           double x, double y, sunder_i_rational *out);
/* The point of the curve's moved line that stands `along` units from the foot of the perpendicular from the origin, in
 * the line's direction; false if the line has no such rational point. */
bool sunder_i_gap_along(const sunder_i_gap_problem *problem, const sunder_i_curve *curve, double along,
                        sunder_i_rational *out);
/* Is the distance of the point from the (closed) subsum below, equal to or above the gap? -1, 0, 1. Exact. */
int sunder_i_gap_cmp(const sunder_i_gap_problem *problem, const sunder_i_subsum *subsum, const sunder_i_rational *at);
/* The same for side k alone, from its first corner (included) to its second (not): the gap is kept from the subsum if
 * it is from all of its sides and the point is outside of one (*outside, if not NULL: or on its line). */
int sunder_i_gap_cmp_side(const sunder_i_gap_problem *problem, const sunder_i_subsum *subsum, uint32_t k,
                          const sunder_i_rational *at, bool *outside);
/* Order of the distances of two points from the origin, then lexicographic. *tie: the distances are equal. */
int sunder_i_rational_cmp(sunder_i_pairing *pairing, const sunder_i_rational *a, const sunder_i_rational *b);
/* The same place, nearly, in units. */
void sunder_i_rational_units(sunder_i_pairing *pairing, const sunder_i_rational *at, double xy[2]);
/* A vector of doubles of the caller's units, exactly. */
sunder_i_rational sunder_i_rational_doubles(sunder_i_pairing *pairing, double dx, double dy);

/* A least translation with gap > 0. */
sunder_status sunder_i_least_with_gap(const sunder_shape *p, const sunder_shape *q,
                                      const sunder_i_least_options *options, sunder_separation *out, bool *beyond,
                                      sunder_error *err);

#endif
