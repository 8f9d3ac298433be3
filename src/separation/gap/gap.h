/* Least separating translations that keep a gap g: the obstacle is the union of the subsums, each grown by an open disc
 * of radius g (an offset of the obstacle of the search without a gap). Its boundary consists of sides moved outward by
 * g and of arcs round corners, so the optimum may be irrational; it is known exactly all the same. */
#ifndef SUNDER_I_GAP_H
#define SUNDER_I_GAP_H

#include "number/surd.h"
#include "separation/answer/answer.h"
#include "separation/obstacle/pair_convolution.h"

/* Makes a number larger by far more than the rounding of some doubles, or of some floats, and by nothing that costs. */
#define SUNDER_I_GAP_MORE (1 + 0x1p-40)
#define SUNDER_I_GAP_MORE_FLOATS (1 + 0x1p-20)

/* A rational answer beside an irrational one is longer by at most this fraction: no measured length is known this
 * precisely, and the free space beside most points is far wider. */
#define SUNDER_I_GAP_LONGER 4e-10

/* A stretch of boundary: the line a + t d moved by the gap to its right, outward; or the circle of radius g about a. */
typedef struct sunder_i_gap_curve {
    bool arc;
    sunder_i_point a, d;
} sunder_i_gap_curve;

/* An exact point (x / w, y / w) of the plane of translations, in lattice units, with w > 0. Its coordinates share at
 * most two square roots. */
typedef struct sunder_i_surd_point {
    sunder_i_roots roots;
    sunder_i_surd x, y;
    sunder_i_big w;
} sunder_i_surd_point;

/* Which of the subsums listed matter where: a quartering of the square of translations up to `reach`. */
typedef struct sunder_i_gap_node {
    uint32_t child;    /* its quarters are from here on; 0: it has none */
    uint32_t from, to; /* its subsums in the list */
} sunder_i_gap_node;

typedef struct sunder_i_gap_quadtree {
    double reach;
    sunder_i_gap_node *node; /* the first is the root */
    uint32_t *list;          /* numbers of subsums */
} sunder_i_gap_quadtree;

typedef struct sunder_i_gap_problem {
    sunder_i_operands *operands;
    sunder_i_big gap;  /* gap / 2^gap_bits lattice units: the lattice itself need not be so fine */
    sunder_i_big over; /* boundary_points.c: units are divided by this, so that the points at hand are integers */
    unsigned long gap_bits;
    double gap_units, limit;
    const sunder_i_candidate *segment; /* of the reduced convolution, unmoved */
    size_t segments;
    const sunder_i_point *center; /* corners that arcs may go round */
    size_t centers;
    const sunder_i_gap_quadtree *quadtree; /* NULL: all subsums matter everywhere */
    bool bound_only;                       /* the answer's `at` is not needed */
} sunder_i_gap_problem;

/* With many pairs of pieces: reduces the operands' subsums to those that matter within the limit, which it lowers, and
 * the segments to those near the boundary; the quadtree tells which subsums are near a place. *done is false if these
 * operands are not suited. False if memory is out. The caller frees the quadtree in any case. */
bool sunder_i_gap_by_squares(sunder_i_gap_problem *problem, sunder_i_gap_quadtree *quadtree, bool *done);
void sunder_i_gap_quadtree_free(sunder_i_gap_quadtree *quadtree);
/* The numbers of all subsums that, grown, come near a point, or of one that covers it for certain. */
const uint32_t *sunder_i_gap_quadtree_near(const sunder_i_gap_quadtree *quadtree, double x, double y, size_t *n);

typedef struct sunder_i_gap_answer {
    bool found;             /* a free point within the limit */
    sunder_i_surd_point at; /* rational; longer than the least by at most SUNDER_I_GAP_LONGER of it */
    double bound;           /* the length of the least in units, rounded down */
    double about[2];        /* where it is, up to the error of the search */
    sunder_contact contact;
} sunder_i_gap_answer;

/* The search: what doubles conclude clears an error bound, and all else is decided exactly. */
sunder_status sunder_i_gap_search(const sunder_i_gap_problem *problem, sunder_i_gap_answer *out, sunder_error *err);

/* ---- Exact points (boundary_points.c) ---- */

/* The point of the curve's line or circle that is nearest to the origin; of a circle about the origin the leftmost. */
void sunder_i_gap_foot(const sunder_i_gap_problem *problem, const sunder_i_gap_curve *curve, sunder_i_surd_point *out);
/* A common point of two curves; if one is a line it is the first: on a line and a circle the one farther along the line
 * (sign 1) or the other one (-1), on two circles the one left (1) or right of the direction from c's centre to d's.
 * False if there is none, or the curves coincide. */
bool sunder_i_gap_crossing(const sunder_i_gap_problem *problem, const sunder_i_gap_curve *c,
                           const sunder_i_gap_curve *d, int sign, sunder_i_surd_point *out);
/* The rational point of a line of rational length that stands along / 2^bits lattice units from the foot of the
 * perpendicular from the origin, in the line's direction; false if the length is irrational. */
bool sunder_i_gap_along(const sunder_i_gap_problem *problem, const sunder_i_gap_curve *side, sunder_i_big along,
                        unsigned long bits, sunder_i_surd_point *out);
/* The position of a point on that line, from the foot, within 4 of it times 2^bits. */
bool sunder_i_gap_position(const sunder_i_gap_problem *problem, const sunder_i_gap_curve *side,
                           const sunder_i_surd_point *at, unsigned long bits, sunder_i_big *along);
/* Is the distance of the point from side k of the subsum, from its first corner (included) to its second (not), below,
 * equal to or above the gap? -1, 0, 1; 1 also where the side's second corner is nearer. *inward: the point lies to the
 * left of the side. *flat: a point inside the side is nearest, not its corner. Exact. */
int sunder_i_gap_cmp_side(const sunder_i_gap_problem *problem, const sunder_i_subsum *subsum, uint32_t k,
                          const sunder_i_surd_point *at, bool *inward, bool *flat);
/* The same where the topmost bits tell it, else false; also where two of these are equal (roughly.c). */
bool sunder_i_gap_roughly_side(const sunder_i_gap_problem *problem, const sunder_i_subsum *subsum, uint32_t k,
                               const sunder_i_surd_point *at, int *order, bool *inward, bool *flat);
/* The same for all of the (closed) subsum; *k: the side, if it is not above. */
int sunder_i_gap_cmp(const sunder_i_gap_problem *problem, const sunder_i_subsum *subsum, const sunder_i_surd_point *at,
                     uint32_t *k, bool *flat);

/* ---- Their order and digits (surd_point.c) ---- */

/* A vector of doubles of the caller's units. */
sunder_i_surd_point sunder_i_surd_point_doubles(sunder_i_operands *operands, double dx, double dy);
sunder_i_surd_point sunder_i_surd_point_rational(sunder_i_operands *operands, sunder_i_rational_point at);
/* What a rational one is. */
static inline sunder_i_rational_point sunder_i_surd_point_of(const sunder_i_surd_point *at)
{
    return (sunder_i_rational_point){at->x.part[0], at->y.part[0], at->w};
}
bool sunder_i_surd_point_is_rational(const sunder_i_surd_point *exact);
/* Order of the distances of two points from the origin, then lexicographic. Exact. */
int sunder_i_surd_point_cmp(sunder_i_operands *operands, const sunder_i_surd_point *u, const sunder_i_surd_point *v);
/* The point's coordinates times 2^bits (lattice units), within 3. */
void sunder_i_surd_point_scaled(sunder_i_operands *operands, const sunder_i_surd_point *at, unsigned long bits,
                                sunder_i_big xy[2]);
/* The same with 72 digits or more in the greater one, which must not be zero: returns the bits. `about`: the length in
 * units, a guess. */
unsigned long sunder_i_surd_point_digits(sunder_i_operands *operands, const sunder_i_surd_point *at, double about,
                                         sunder_i_big xy[2]);
/* The distance from the origin in units, rounded down, of a point known to `bits` bits. */
double sunder_i_surd_point_length_down(sunder_i_operands *operands, const sunder_i_big xy[2], unsigned long bits);

/* ---- The exact check (verify_gap.c) ---- */

/* P and Q + t, t rational, are the gap apart: asked again of every pair of pieces, without the subsums. Exact. */
bool sunder_i_gap_verify(const sunder_i_gap_problem *problem, const sunder_i_surd_point *t);

/* A least translation with gap > 0. */
sunder_status sunder_i_least_with_gap(const sunder_shape *p, const sunder_shape *q,
                                      const sunder_i_least_options *options, sunder_separation *out, bool *beyond,
                                      sunder_error *err);

#endif
