/* Questions about lattice points, each answered with its true sign.
 *
 * One ladder for all: on a narrow lattice the determinants are 128-bit (degree 2), their products 256-bit (degree 4),
 * comparisons of intersection points 320-bit (degree 5); a floating-point comparison with a proved error bound comes
 * first where it is cheaper. Where a handle is among the operands the same functions run on big integers, behind
 * filters of their own. Counters go to lattice->counts.
 *
 * Points a, b, c ... are lattice points; "line ab" is directed from a to b, a != b. */
#ifndef SUNDER_I_PREDICATE_H
#define SUNDER_I_PREDICATE_H

#include "number/trust.h"
#include "predicate/rational_point.h"

/* ---- Order and orientation: degree 1 and 2 ---- */

int sunder_i_int_cmp(sunder_i_lattice *lattice, int64_t a, int64_t b);
/* Lexicographic, x first. */
int sunder_i_point_cmp(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b);
bool sunder_i_point_equal(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b);
sunder_i_point sunder_i_point_add(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b);
sunder_i_point sunder_i_point_sub(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b);
sunder_i_point sunder_i_point_neg(sunder_i_lattice *lattice, sunder_i_point a);
/* a - b as doubles in the units of sunder_i_approx(), each to the nearest one. */
void sunder_i_point_difference(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, double *dx, double *dy);

/* Side of c to the line ab: +1 left, -1 right, 0 on it. */
int sunder_i_orient(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c);
/* Sign of the cross product, and of the dot product, of two vectors. */
int sunder_i_cross_sign(sunder_i_lattice *lattice, sunder_i_point u, sunder_i_point v);
int sunder_i_dot_sign(sunder_i_lattice *lattice, sunder_i_point u, sunder_i_point v);
/* 0 for angles in [0, pi), 1 for [pi, 2 pi). */
int sunder_i_direction_half(sunder_i_lattice *lattice, sunder_i_point u);
/* Order of two non-zero vectors by angle in [0, 2 pi) from the positive x axis. */
int sunder_i_angle_cmp(sunder_i_lattice *lattice, sunder_i_point u, sunder_i_point v);

/* ---- Crossings along a line: fractions, degree 2 over 2, compared in degree 4 ---- */

/* The point a + (num / den) * (b - a) of a line ab. den > 0. value is close: |value - num/den| <= 4e-16 * max(1,
 * |num/den|). den == 0: num is the handle of that ratio. */
typedef struct sunder_i_fraction {
    sunder_i_det num, den;
    double value;
} sunder_i_fraction;

/* Where line ab meets line cd; the lines are not parallel. */
sunder_i_fraction sunder_i_crossing(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c,
                                    sunder_i_point d);
/* Where c stands on the line ab that it lies on. */
sunder_i_fraction sunder_i_along(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c);
/* The foot of the perpendicular from c on line ab. Degree 2 over 2. */
sunder_i_fraction sunder_i_foot(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c);
/* The fraction n / 1, n small. */
sunder_i_fraction sunder_i_fraction_int(sunder_i_lattice *lattice, int n);
int sunder_i_fraction_sign(const sunder_i_lattice *lattice, const sunder_i_fraction *t);
/* Its integers, those of native ones on that arena. The lattice stays as it is. */
sunder_i_ratio sunder_i_fraction_read(sunder_i_arena *arena, const sunder_i_lattice *lattice,
                                      const sunder_i_fraction *t);
int sunder_i_fraction_cmp(sunder_i_lattice *lattice, const sunder_i_fraction *s, const sunder_i_fraction *t);

/* ---- Intersection points: homogeneous, degree 3 over 2, compared in degree 5 ---- */

/* (x / w, y / w) on the lattice, w > 0. ax, ay are close to the coordinates in the units of sunder_i_approx(). w == 0:
 * limb[0] of x and of y are handles of the two, as ratios over one denominator. */
typedef struct sunder_i_hpoint {
    sunder_i_i256 x, y;
    sunder_i_i128 w;
    double ax, ay;
} sunder_i_hpoint;

sunder_i_hpoint sunder_i_hpoint_at(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b,
                                   const sunder_i_fraction *t);
sunder_i_hpoint sunder_i_hpoint_of(sunder_i_lattice *lattice, sunder_i_point a);
/* From its integers, which are copied. On a narrow lattice x, y < 2^255 and w < 2^127, as of crossings; on
 * another one that is so stays native too. */
sunder_i_hpoint sunder_i_hpoint_make(sunder_i_lattice *lattice, sunder_i_rational_point v);
/* Lexicographic. */
int sunder_i_hpoint_cmp(sunder_i_lattice *lattice, const sunder_i_hpoint *a, const sunder_i_hpoint *b);
/* By x alone, and by y. */
int sunder_i_hpoint_cmp_x(sunder_i_lattice *lattice, const sunder_i_hpoint *a, const sunder_i_hpoint *b);
int sunder_i_hpoint_cmp_y(sunder_i_lattice *lattice, const sunder_i_hpoint *a, const sunder_i_hpoint *b);
bool sunder_i_hpoint_equal(sunder_i_lattice *lattice, const sunder_i_hpoint *a, const sunder_i_hpoint *b);
/* Equal for equal points, whatever integers they are written with; as a rule different for points that are more than
 * 2^-64 lattice units apart, also where ax, ay are far too coarse to tell them. Degree 3 over 2. */
uint64_t sunder_i_hpoint_hash(sunder_i_lattice *lattice, const sunder_i_hpoint *a);
/* Side of c to line ab. Degree 4. */
int sunder_i_orient_hpoint(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, const sunder_i_hpoint *c);
/* Its integers, in that arena: the lattice stays as it is, and threads may ask at once. */
sunder_i_rational_point sunder_i_hpoint_read(sunder_i_arena *arena, const sunder_i_lattice *lattice,
                                             const sunder_i_hpoint *p);

/* ---- Segments: every degenerate form by name ---- */

typedef enum sunder_i_meeting {
    SUNDER_I_APART,
    SUNDER_I_CROSS,      /* at one point, interior to both */
    SUNDER_I_END_INSIDE, /* an end of one lies inside the other */
    SUNDER_I_ENDS_EQUAL, /* they meet in a common end and nowhere else */
    SUNDER_I_OVERLAP     /* they share a piece of positive length */
} sunder_i_meeting;

/* How the closed segments ab and cd meet; either may have length zero (a point: END_INSIDE or ENDS_EQUAL where it lies
 * on the other). */
sunder_i_meeting sunder_i_segments_meet(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c,
                                        sunder_i_point d);

/* Is the least squared distance of the closed segments ab and cd below (-1), equal to (0) or above (+1) the square of
 * the lattice integer gap >= 0? Zero-length segments are fine. Degree 6. */
int sunder_i_segment_distance_cmp(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c,
                                  sunder_i_point d, int64_t gap);

#endif
