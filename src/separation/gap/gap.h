/* gap.h: least translations that separate two operands by a gap g. The obstacle is the union of the subsums, each grown
 * by an open disc of radius g. Its boundary consists of sides moved outward by g and of arcs about vertices, so that
 * the optimum may be irrational; it is nevertheless known exactly. */
#ifndef SUNDER_I_GAP_H
#define SUNDER_I_GAP_H

#include "number/surd.h"
#include "separation/answer/answer.h"
#include "separation/obstacle/pair_convolution.h"

/* Factors that increase a number by more than the rounding errors of some operations on doubles, or on floats, and by
 * an otherwise negligible amount. */
#define SUNDER_I_GAP_MORE (1 + 0x1p-40)
#define SUNDER_I_GAP_MORE_FLOATS (1 + 0x1p-20)

/* If the least translation is irrational, a rational one near it is returned, longer by at most this fraction. No
 * measured length is known with this precision, and the free space beside most points is far wider. */
#define SUNDER_I_GAP_LONGER 4e-10

/* A curve that contains a part of the boundary: the line a + t d, moved by the gap to its right, which is outward; or,
 * if `arc`, the circle of radius g about a. */
typedef struct sunder_i_gap_curve {
    bool arc;
    sunder_i_point a, d;
} sunder_i_gap_curve;

/* An exact point (x / w, y / w) of the plane of translations, in lattice units, w > 0. Both coordinates contain the
 * same square roots, at most two. */
typedef struct sunder_i_surd_point {
    sunder_i_roots roots;
    sunder_i_surd x, y;
    sunder_i_big w;
} sunder_i_surd_point;

/* A quadtree over the square of translations up to `reach`, with the subsums that matter in each of its squares. */
typedef struct sunder_i_gap_node {
    uint32_t child;    /* the number of the first of its four children; 0: a leaf */
    uint32_t from, to; /* the range of its subsums in `list` */
} sunder_i_gap_node;

typedef struct sunder_i_gap_quadtree {
    double reach;
    sunder_i_gap_node *node; /* node[0] is the root */
    uint32_t *list;          /* the numbers of the subsums of the leaves */
} sunder_i_gap_quadtree;

typedef struct sunder_i_gap_problem {
    sunder_i_operands *operands;
    sunder_i_big gap;  /* the gap is gap / 2^gap_bits lattice units, so that the lattice need not contain it */
    sunder_i_big over; /* units are divided by this so that the points in use have integer coordinates
                        * (boundary_points.c) */
    unsigned long gap_bits;
    double gap_units, limit;
    const sunder_i_candidate *segment; /* the segments of the reduced convolution, without the gap */
    size_t segments;
    const sunder_i_point *center; /* the vertices that may be centres of arcs */
    size_t centers;
    const sunder_i_gap_quadtree *quadtree; /* NULL: all subsums matter everywhere */
    bool bound_only;                       /* the member `at` of the answer is not needed */
} sunder_i_gap_problem;

/* For many pairs of pieces: reduces the operands' subsums to those that matter within the limit, which it lowers, and
 * the segments to those near the boundary. The quadtree returns the subsums near a point. *done is false if the method
 * does not suit these operands. Returns false if out of memory. The caller frees the quadtree in any case. */
bool sunder_i_gap_by_squares(sunder_i_gap_problem *problem, sunder_i_gap_quadtree *quadtree, bool *done);
void sunder_i_gap_quadtree_free(sunder_i_gap_quadtree *quadtree);
/* Returns the numbers of the *n subsums that, grown, come near the point, or of one subsum that certainly covers it. */
const uint32_t *sunder_i_gap_quadtree_near(const sunder_i_gap_quadtree *quadtree, double x, double y, size_t *n);

typedef struct sunder_i_gap_answer {
    bool found;             /* whether there is a free point within the limit */
    sunder_i_surd_point at; /* a rational free point, longer than the least translation by at most the fraction
                             * SUNDER_I_GAP_LONGER */
    double bound;           /* the length of the least translation in lattice units, rounded down */
    double about[2];        /* the least translation to within the error of the search */
    sunder_contact contact;
} sunder_i_gap_answer;

/* Finds the least translation. Conclusions from doubles allow for an error bound, and everything else is decided
 * exactly. */
sunder_status sunder_i_gap_search(const sunder_i_gap_problem *problem, sunder_i_gap_answer *out, sunder_error *err);

/* ---- Exact points (boundary_points.c) ---- */

/* *out becomes the rational point of an offset line of rational length at the distance along / 2^bits lattice units, in
 * the line's direction, from the foot of the perpendicular from the origin. Returns false if the length is
 * irrational. */
bool sunder_i_gap_along(const sunder_i_gap_problem *problem, const sunder_i_gap_curve *side, sunder_i_big along,
                        unsigned long bits, sunder_i_surd_point *out);
/* *along becomes 2^bits times the position of the point `at` along the offset line of `side`, as for
 * sunder_i_gap_along(), with an error of at most 4. Returns false if the length of the side is irrational. */
bool sunder_i_gap_position(const sunder_i_gap_problem *problem, const sunder_i_gap_curve *side,
                           const sunder_i_surd_point *at, unsigned long bits, sunder_i_big *along);
/* Compares the distance of the point from side k of the subsum, without its second end, with the gap: -1 below, 0
 * equal, 1 above; also 1 if the side's second end is nearer. *inward: the point lies on the left of the side. *flat: an
 * inner point of the side is nearest, not its first vertex. Exact. */
int sunder_i_gap_cmp_side(const sunder_i_gap_problem *problem, const sunder_i_subsum *subsum, uint32_t k,
                          const sunder_i_surd_point *at, bool *inward, bool *flat);
/* Sets *order, *inward and *flat to the results of sunder_i_gap_cmp_side(), from the highest bits of all numbers, in
 * interval arithmetic (ball_test.c). Returns false if these do not decide, and always if two of the compared numbers
 * are equal. */
bool sunder_i_gap_roughly_side(const sunder_i_gap_problem *problem, const sunder_i_subsum *subsum, uint32_t k,
                               const sunder_i_surd_point *at, int *order, bool *inward, bool *flat);
/* Compares the distance of the point from the whole closed subsum with the gap: -1 below, 0 equal, 1 above; also -1
 * inside the subsum. Exact. If the result is 0, *k becomes a nearest side, and *flat is as for
 * sunder_i_gap_cmp_side(). */
int sunder_i_gap_cmp(const sunder_i_gap_problem *problem, const sunder_i_subsum *subsum, const sunder_i_surd_point *at,
                     uint32_t *k, bool *flat);

/* ---- Order and digits of exact points (surd_point.c) ---- */

/* Converts a vector of doubles in the caller's units to an exact point. */
sunder_i_surd_point sunder_i_surd_point_doubles(sunder_i_operands *operands, double dx, double dy);
sunder_i_surd_point sunder_i_surd_point_rational(sunder_i_operands *operands, sunder_i_rational_point at);
/* Returns a rational point without its roots. */
static inline sunder_i_rational_point sunder_i_surd_point_of(const sunder_i_surd_point *at)
{
    return (sunder_i_rational_point){at->x.part[0], at->y.part[0], at->w};
}
bool sunder_i_surd_point_is_rational(const sunder_i_surd_point *exact);
/* Compares the distances of two points from the origin, then the points lexicographically. Exact. */
int sunder_i_surd_point_cmp(sunder_i_operands *operands, const sunder_i_surd_point *u, const sunder_i_surd_point *v);
/* Sets xy to the point's coordinates, in lattice units, times 2^bits, with an error of at most 3. */
void sunder_i_surd_point_scaled(sunder_i_operands *operands, const sunder_i_surd_point *at, unsigned long bits,
                                sunder_i_big xy[2]);
/* Does the same as sunder_i_surd_point_scaled(), and returns the number of bits by which it scaled: with them one
 * coordinate has at least 72 significant bits. The point is not the origin; `about` is an estimate of its distance from
 * there, in units. */
unsigned long sunder_i_surd_point_digits(sunder_i_operands *operands, const sunder_i_surd_point *at, double about,
                                         sunder_i_big xy[2]);
/* Returns the distance from the origin, in units and rounded down, of a point that sunder_i_surd_point_scaled()
 * converted with `bits`. */
double sunder_i_surd_point_length_down(sunder_i_operands *operands, const sunder_i_big xy[2], unsigned long bits);

/* ---- The exact verification (verify_gap.c) ---- */

/* Returns whether P and Q + t, t rational, keep the gap. It tests each pair of pieces without the subsums. Exact. */
bool sunder_i_gap_verify(const sunder_i_gap_problem *problem, const sunder_i_surd_point *t);

/* Computes a least translation with a gap > 0. */
sunder_status sunder_i_least_with_gap(const sunder_shape *p, const sunder_shape *q,
                                      const sunder_i_least_options *options, sunder_separation *out, bool *beyond,
                                      sunder_error *err);

#endif
