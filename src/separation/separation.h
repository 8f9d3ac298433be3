/* Two features: are they apart, how far, and what is the least translation that separates them? The public functions
 * are in sunder.h; these are the same questions for shapes moved by exact vectors.
 *
 * P may also be flat, made of pieces without area, segments and points (shape/of_pieces.h): then statements about its
 * interior hold for all of P, which the interior of Q may not meet. And Q's interior is taken as the union of the
 * interiors of its pieces, which have to cover it (displacement/layer/interior_cover.h). */
#ifndef SUNDER_I_SEPARATION_H
#define SUNDER_I_SEPARATION_H

#include "predicate/passage.h"
#include "shape/shape.h"

/* Do the interiors of P + tp and Q + tq meet? Exact. A NULL translation is zero. */
sunder_status sunder_i_overlap(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                               bool *overlap, sunder_error *err);
/* Interiors disjoint and the distance at least gap? Exact. gap >= 0. */
sunder_status sunder_i_apart(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                             double gap, bool *apart, sunder_error *err);
/* Are they surely farther apart than that? False: nothing is known. In doubles, with all their errors. */
bool sunder_i_surely_apart(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                           double far);
/* Both at once, and do they touch: is their distance, as the nearest double, at most the tolerance? What doubles do not
 * tell of that stays open: may_touch without touch; but for the tolerance 0, which is decided. Where interiors meet
 * nothing more is said. */
typedef struct sunder_i_encounter {
    bool overlap, apart, touch, may_touch;
} sunder_i_encounter;

sunder_status sunder_i_meet(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                            double gap, double tolerance, sunder_i_encounter *out, sunder_error *err);
/* sunder_i_apart() for a gap that is the sum of two doubles, the second at most half a unit in the last place of it. */
sunder_status sunder_i_apart_by(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                                const double gap[2], bool *apart, sunder_error *err);
/* Does P + tp lie in Q + tq (closed sets)? Exact. */
sunder_status sunder_i_contained(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                                 bool *contained, sunder_error *err);
/* Does P, a closed set, hold the point? Exact. */
sunder_status sunder_i_holds(const sunder_shape *p, const double point[2], bool *holds, sunder_error *err);
/* Does the passage, beginning outside the closed set P, meet it? Exact. One that begins in P does not. */
sunder_status sunder_i_passes(const sunder_i_passage *passage, const sunder_shape *p, bool *passes, sunder_error *err);
/* Does it begin strictly on the outer side of the edge from vertex v, and meet that, a closed segment? Exact. */
sunder_status sunder_i_enters_by_edge(const sunder_i_passage *passage, const sunder_shape *p, uint32_t v, bool *enters,
                                      sunder_error *err);
/* sunder_pair_distance() of translated shapes. An empty operand: infinite, with both ends at the origin. */
sunder_status sunder_i_distance(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                                double *distance, double on_p[2], double on_q[2], sunder_error *err);
/* sunder_pair_separate() of translated shapes, numbers only: no texts. upper: INFINITY, or a length past which the
 * answer no longer matters: if the least translation is longer, *beyond is set and out->lower_bound = upper. */
sunder_status sunder_i_separate(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                                double gap, double upper, sunder_separation *out, bool *beyond, sunder_error *err);
/* Of that answer the lower bound, for shapes as they are, and about which translation it is (not where *beyond): with a
 * gap that is less work than to find one that is free. */
sunder_status sunder_i_least_bound(const sunder_shape *p, const sunder_shape *q, double gap, double upper,
                                   double *lower_bound, double about[2], bool *beyond, sunder_error *err);

/* Is the least translation that takes the interiors apart no longer than these lengths together, both finite? Exact. */
sunder_status sunder_i_parts_within(const sunder_shape *p, const sunder_shape *q, const double length[2], bool *within,
                                    sunder_error *err);

/* A pair as it stands: P + tp and Q + tq, neither empty. A NULL translation is zero. */
typedef struct sunder_i_pair {
    const sunder_shape *p, *q;
    const double *tp, *tq;
} sunder_i_pair;

/* Does it stand worse than it did? That is nearer; or in each other, where it was not; or deeper in each other, with a
 * longer least translation that takes the interiors apart. Exact. */
sunder_status sunder_i_pair_worsened(const sunder_i_pair *was, const sunder_i_pair *is, bool *worse, sunder_error *err);

/* The state at the start, kept between calls about the same pair: zero at first, filled in by the first call. */
typedef struct sunder_i_depth {
    enum { SUNDER_I_STOOD_UNKNOWN, SUNDER_I_STOOD_APART, SUNDER_I_STOOD_IN_EACH_OTHER } stood;
    double away[2];         /* in each other: the least translation of Q that takes the interiors apart, ... */
    double distance, least; /* ... its length, as nearest doubles, and what that is at least */
} sunder_i_depth;

sunder_status sunder_i_pair_worsened_since(const sunder_i_pair *was, sunder_i_depth *depth, const sunder_i_pair *is,
                                           bool *worse, sunder_error *err);

#endif
