/* predicate.h: tests of lattice points; each returns the exact sign.
 *
 * All have the same structure: on a narrow lattice the determinants have 128 bits (degree 2), their products 256 bits
 * (degree 4), comparisons of intersection points 320 bits (degree 5); a floating-point comparison with a proved error
 * bound comes first if it is cheaper. If a handle is among the operands, the same functions use big integers, after
 * error bounds of their own. Operations are counted in lattice->counts.
 *
 * Points a, b, c ... are lattice points; "line ab" is directed from a to b, a != b. */
#ifndef SUNDER_I_PREDICATE_H
#define SUNDER_I_PREDICATE_H

#include "number/trust.h"
#include "predicate/rational_point.h"

/* ---- Order and orientation: degree 1 and 2 ---- */

int sunder_i_int_cmp(sunder_i_lattice *lattice, int64_t a, int64_t b);
/* Compares two points lexicographically, x first. */
int sunder_i_point_cmp(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b);
bool sunder_i_point_equal(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b);
sunder_i_point sunder_i_point_add(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b);
sunder_i_point sunder_i_point_sub(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b);
sunder_i_point sunder_i_point_neg(sunder_i_lattice *lattice, sunder_i_point a);
/* *dx and *dy become the coordinates of a - b in the units of sunder_i_approx(), each rounded to the nearest double. */
void sunder_i_point_difference(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, double *dx, double *dy);

/* Returns the side of c with respect to the line ab: +1 left, -1 right, 0 on it. */
int sunder_i_orient(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c);
/* Return the sign of the cross product, and of the dot product, of two vectors. */
int sunder_i_cross_sign(sunder_i_lattice *lattice, sunder_i_point u, sunder_i_point v);
int sunder_i_dot_sign(sunder_i_lattice *lattice, sunder_i_point u, sunder_i_point v);
/* Returns 0 if the angle of u is in [0, pi), 1 if it is in [pi, 2 pi). */
int sunder_i_direction_half(sunder_i_lattice *lattice, sunder_i_point u);
/* Compares two non-zero vectors by their angle in [0, 2 pi) from the positive x axis. */
int sunder_i_angle_cmp(sunder_i_lattice *lattice, sunder_i_point u, sunder_i_point v);

/* ---- Positions along a line: fractions, degree 2 over 2, compared in degree 4 ---- */

/* The point a + (num / den) * (b - a) of a line ab. den > 0. |value - num/den| <= 4e-16 * max(1, |num/den|). den == 0:
 * num is the handle of the ratio. */
typedef struct sunder_i_fraction {
    sunder_i_det num, den;
    double value;
} sunder_i_fraction;

/* Returns the position, on the line ab, of its intersection with the line cd; the lines must not be parallel. */
sunder_i_fraction sunder_i_crossing(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c,
                                    sunder_i_point d);
/* Returns the position, on the line ab, of the point c, which must be on that line. */
sunder_i_fraction sunder_i_along(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c);
/* Returns the position, on the line ab, of the foot of the perpendicular from c. Degree 2 over 2. */
sunder_i_fraction sunder_i_foot(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c);
/* Returns the fraction n / 1, n small. */
sunder_i_fraction sunder_i_fraction_int(sunder_i_lattice *lattice, int n);
int sunder_i_fraction_sign(const sunder_i_lattice *lattice, const sunder_i_fraction *t);
/* Returns the integers of a fraction; those of a native fraction are allocated in `arena`. The lattice does not
 * change. */
sunder_i_ratio sunder_i_fraction_read(sunder_i_arena *arena, const sunder_i_lattice *lattice,
                                      const sunder_i_fraction *t);
int sunder_i_fraction_cmp(sunder_i_lattice *lattice, const sunder_i_fraction *s, const sunder_i_fraction *t);

/* ---- Intersection points: homogeneous, degree 3 over 2, compared in degree 5 ---- */

/* The point (x / w, y / w) on the lattice, w > 0. ax, ay are approximations of the coordinates in the units of
 * sunder_i_approx(). w == 0: limb[0] of x and of y are the handles of the coordinates, as ratios with a common
 * denominator. */
typedef struct sunder_i_hpoint {
    sunder_i_i256 x, y;
    sunder_i_i128 w;
    double ax, ay;
} sunder_i_hpoint;

sunder_i_hpoint sunder_i_hpoint_at(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b,
                                   const sunder_i_fraction *t);
sunder_i_hpoint sunder_i_hpoint_of(sunder_i_lattice *lattice, sunder_i_point a);
/* Makes a point from its integers, which are copied. On a narrow lattice x, y < 2^255 and w < 2^127, as for
 * intersections; on another lattice a point within these bounds is native, too. */
sunder_i_hpoint sunder_i_hpoint_make(sunder_i_lattice *lattice, sunder_i_rational_point v);
/* Compares two points lexicographically. */
int sunder_i_hpoint_cmp(sunder_i_lattice *lattice, const sunder_i_hpoint *a, const sunder_i_hpoint *b);
/* Compare two points by x only, and by y only. */
int sunder_i_hpoint_cmp_x(sunder_i_lattice *lattice, const sunder_i_hpoint *a, const sunder_i_hpoint *b);
int sunder_i_hpoint_cmp_y(sunder_i_lattice *lattice, const sunder_i_hpoint *a, const sunder_i_hpoint *b);
bool sunder_i_hpoint_equal(sunder_i_lattice *lattice, const sunder_i_hpoint *a, const sunder_i_hpoint *b);
/* Returns a hash value that is equal for equal points, whatever integers represent them; it usually differs for points
 * with a distance of more than 2^-64 lattice units, even if ax, ay cannot distinguish them. Degree 3 over 2. */
uint64_t sunder_i_hpoint_hash(sunder_i_lattice *lattice, const sunder_i_hpoint *a);
/* Returns the side of c with respect to the line ab. Degree 4. */
int sunder_i_orient_hpoint(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, const sunder_i_hpoint *c);
/* Returns the integers of a point, allocated in `arena`: the lattice does not change, so that several threads may call
 * this at once. */
sunder_i_rational_point sunder_i_hpoint_read(sunder_i_arena *arena, const sunder_i_lattice *lattice,
                                             const sunder_i_hpoint *p);

/* ---- Segments, with all degenerate cases ---- */

typedef enum sunder_i_meeting {
    SUNDER_I_APART,
    SUNDER_I_CROSS,      /* at one point, in the interior of both */
    SUNDER_I_END_INSIDE, /* an end of one is in the interior of the other */
    SUNDER_I_ENDS_EQUAL, /* they meet at a common end and nowhere else */
    SUNDER_I_OVERLAP     /* they share a part of positive length */
} sunder_i_meeting;

/* Returns how the closed segments ab and cd meet; either may have length zero (a point: END_INSIDE or ENDS_EQUAL if it
 * is on the other). */
sunder_i_meeting sunder_i_segments_meet(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c,
                                        sunder_i_point d);

/* Compares the least squared distance of the closed segments ab and cd with the square of the lattice integer gap >= 0:
 * -1 below, 0 equal, +1 above. Segments of length zero are permitted. Degree 6. */
int sunder_i_segment_distance_cmp(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c,
                                  sunder_i_point d, int64_t gap);

#endif
