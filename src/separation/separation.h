/* separation.h: tests of two shapes: whether they overlap, their distance, and the least translation that separates
 * them. The public functions are in sunder.h; these do the same for shapes translated by exact vectors.
 *
 * P may also be flat, with pieces without area, segments and points (shape/of_pieces.h): then "the interior of P" means
 * all of P, which the interior of Q must not meet. The interior of Q is taken as the union of the interiors of its
 * pieces, which must cover it (displacement/layer/interior_cover.h). */
#ifndef SUNDER_I_SEPARATION_H
#define SUNDER_I_SEPARATION_H

#include "predicate/passage.h"
#include "shape/shape.h"

/* Tests whether the interiors of P + tp and Q + tq meet. Exact. A translation NULL is zero. */
sunder_status sunder_i_overlap(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                               bool *overlap, sunder_error *err);
/* Tests whether the interiors are disjoint and the distance is at least `gap` >= 0. Exact. */
sunder_status sunder_i_apart(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                             double gap, bool *apart, sunder_error *err);
/* Returns whether the distance certainly exceeds `far`; false: unknown. In doubles, with all their errors. */
bool sunder_i_surely_apart(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                           double far);
/* Tests `overlap` (sunder_i_overlap()) and `apart` (sunder_i_apart()) at once, and whether the sets touch: whether
 * their distance, as the nearest double, is at most the tolerance. What doubles cannot decide about this stays open
 * (may_touch without touch), except for the tolerance 0, which is exact. If the interiors meet the other members are
 * not set. */
typedef struct sunder_i_encounter {
    bool overlap, apart, touch, may_touch;
} sunder_i_encounter;

sunder_status sunder_i_meet(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                            double gap, double tolerance, sunder_i_encounter *out, sunder_error *err);
/* Does the same as sunder_i_apart() for a gap that is the sum of two doubles, the second at most half an ulp of the
 * first. */
sunder_status sunder_i_apart_by(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                                const double gap[2], bool *apart, sunder_error *err);
/* Tests whether P + tp is a subset of Q + tq (closed sets). Exact. */
sunder_status sunder_i_contained(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                                 bool *contained, sunder_error *err);
/* Tests whether the closed set P contains the point. Exact. */
sunder_status sunder_i_holds(const sunder_shape *p, const double point[2], bool *holds, sunder_error *err);
/* Tests whether the passage begins outside the closed set P and meets it. Exact. */
sunder_status sunder_i_passes(const sunder_i_passage *passage, const sunder_shape *p, bool *passes, sunder_error *err);
/* Tests whether the passage begins strictly on the outer side of the edge from vertex v and meets that closed segment.
 * Exact. */
sunder_status sunder_i_enters_by_edge(const sunder_i_passage *passage, const sunder_shape *p, uint32_t v, bool *enters,
                                      sunder_error *err);
/* Does the same as sunder_pair_distance() for translated shapes. With an empty operand the distance is infinite and
 * both ends are the origin. */
sunder_status sunder_i_distance(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                                double *distance, double on_p[2], double on_q[2], sunder_error *err);
/* Does the same as sunder_pair_separate() for translated shapes, without texts. If the least translation is longer than
 * `upper` (INFINITY: no limit), *beyond is set and out->lower_bound = upper. */
sunder_status sunder_i_separate(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                                double gap, double upper, sunder_separation *out, bool *beyond, sunder_error *err);
/* Computes only the lower bound of the answer of sunder_i_separate(), for shapes without translation, and approximately
 * the translation, which is not set if *beyond becomes true. With a gap this takes less time than finding a free
 * translation. */
sunder_status sunder_i_least_bound(const sunder_shape *p, const sunder_shape *q, double gap, double upper,
                                   double *lower_bound, double about[2], bool *beyond, sunder_error *err);

/* Tests whether the least translation that separates the interiors is not longer than the sum of the two finite
 * lengths. Exact. */
sunder_status sunder_i_parts_within(const sunder_shape *p, const sunder_shape *q, const double length[2], bool *within,
                                    sunder_error *err);

/* Two shapes in their positions: P + tp and Q + tq, neither empty. A translation NULL is zero. */
typedef struct sunder_i_pair {
    const sunder_shape *p, *q;
    const double *tp, *tq;
} sunder_i_pair;

/* Tests whether the pair `is` is worse than the pair `was`: closer; or overlapping where it did not overlap; or
 * overlapping more deeply, that is, with a longer least translation that separates the interiors. Exact. */
sunder_status sunder_i_pair_worsened(const sunder_i_pair *was, const sunder_i_pair *is, bool *worse, sunder_error *err);

/* The original state of a pair, kept between calls: zeroed at first; the first call fills it. */
typedef struct sunder_i_depth {
    enum { SUNDER_I_STOOD_UNKNOWN, SUNDER_I_STOOD_APART, SUNDER_I_STOOD_IN_EACH_OTHER } stood;
    double away[2];         /* overlapping: the least translation of Q that separates the interiors, ... */
    double distance, least; /* ... its length as the nearest double, and a lower bound of it */
} sunder_i_depth;

sunder_status sunder_i_pair_worsened_since(const sunder_i_pair *was, sunder_i_depth *depth, const sunder_i_pair *is,
                                           bool *worse, sunder_error *err);

#endif
