/* passage.c: whether the path of a point meets a segment, where the end of the path, a + t - s, is a sum of doubles.
 * The tests have degree 2: they are sums of products of the given doubles, and the end is not rounded.
 *
 * With D = d - c, U = t - s, A = a - c, the side of the end with respect to cd is the sign of D x A + D x U, that of c
 * with respect to the path's line the sign of U x (c - a). Doubles are used first, with the error bounds of the
 * orientation test: with u = 2^-53, a 2 x 2 determinant of four differences, each rounded once, has an error of at most
 * (3 + 16 u) u of the sum of the magnitudes of its two products [She96, section 4.3]; the sum of two such determinants
 * has an error of (3 + 16 u) u of the sum of all four, plus u of that for the addition: less than 5 u. Underflow can
 * change a product by 2^-1075, so that tiny determinants decide nothing. Otherwise the long accumulator, which
 * represents any sum of products, decides. */
#include "predicate/passage.h"

#include "number/accumulator.h"
#include "predicate/orient_double.h"

#include "base/extremes.h"

#include <math.h>

#define UNIT 0x1p-53
#define TINY 0x1p-960

static int sign_beyond(double det, double bound, double sum)
{
    if (!(sum < INFINITY) || sum < TINY) return SUNDER_I_PASSAGE_UNSURE;
    return det > bound ? 1 : det < -bound ? -1 : SUNDER_I_PASSAGE_UNSURE;
}

void sunder_i_passage_box(const sunder_i_passage *passage, double box[4])
{
    for (int k = 0; k < 2; k++) {
        /* Two roundings, each with an error of u times the magnitude: 3 u (|a| + |t| + |s|) is more than both. */
        const double end = passage->from[k] + (passage->t[k] - passage->s[k]);
        const double slack = 4 * UNIT * (fabs(passage->from[k]) + fabs(passage->t[k]) + fabs(passage->s[k]));
        const bool known = isfinite(end) && isfinite(slack);
        box[k] = known ? sunder_i_min(passage->from[k], end - slack) : -INFINITY;
        box[k + 2] = known ? sunder_i_max(passage->from[k], end + slack) : INFINITY;
    }
}

int sunder_i_passage_side_filter(const sunder_i_passage *passage, const double c[2])
{
    const double left = (passage->t[0] - passage->s[0]) * (c[1] - passage->from[1]),
                 right = (passage->t[1] - passage->s[1]) * (c[0] - passage->from[0]);
    const double sum = fabs(left) + fabs(right);
    return sign_beyond(left - right, 5 * UNIT * sum, sum);
}

int sunder_i_passage_side_exact(const sunder_i_passage *passage, const double c[2])
{
    const double *a = passage->from, *t = passage->t, *s = passage->s;
    sunder_i_accumulator det = {{0}};
    sunder_i_accumulator_add(&det, t[0], c[1]);
    sunder_i_accumulator_sub(&det, t[0], a[1]);
    sunder_i_accumulator_sub(&det, s[0], c[1]);
    sunder_i_accumulator_add(&det, s[0], a[1]);
    sunder_i_accumulator_sub(&det, t[1], c[0]);
    sunder_i_accumulator_add(&det, t[1], a[0]);
    sunder_i_accumulator_add(&det, s[1], c[0]);
    sunder_i_accumulator_sub(&det, s[1], a[0]);
    return sunder_i_accumulator_sign(&det);
}

int sunder_i_passage_end_filter(const sunder_i_passage *passage, const double c[2], const double d[2])
{
    const double dx = d[0] - c[0], dy = d[1] - c[1];
    const double left = dx * (passage->from[1] - c[1]), right = dy * (passage->from[0] - c[0]);
    const double left_u = dx * (passage->t[1] - passage->s[1]), right_u = dy * (passage->t[0] - passage->s[0]);
    const double sum = (fabs(left) + fabs(right)) + (fabs(left_u) + fabs(right_u));
    return sign_beyond((left - right) + (left_u - right_u), 5 * UNIT * sum, sum);
}

/* D x e - D x c of the end e = a + t - s, multiplied out; D x c = d x c. */
int sunder_i_passage_end_exact(const sunder_i_passage *passage, const double c[2], const double d[2])
{
    const double part[3][2] = {
        {passage->from[0], passage->from[1]}, {passage->t[0], passage->t[1]}, {-passage->s[0], -passage->s[1]}};
    sunder_i_accumulator det = {{0}};
    for (int k = 0; k < 3; k++) {
        sunder_i_accumulator_add(&det, d[0], part[k][1]);
        sunder_i_accumulator_sub(&det, c[0], part[k][1]);
        sunder_i_accumulator_sub(&det, d[1], part[k][0]);
        sunder_i_accumulator_add(&det, c[1], part[k][0]);
    }
    sunder_i_accumulator_sub(&det, d[0], c[1]);
    sunder_i_accumulator_add(&det, d[1], c[0]);
    return sunder_i_accumulator_sign(&det);
}

static int side_of(const sunder_i_passage *p, const double c[2])
{
    const int sign = sunder_i_passage_side_filter(p, c);
    return sign == SUNDER_I_PASSAGE_UNSURE ? sunder_i_passage_side_exact(p, c) : sign;
}

static int end_side(const sunder_i_passage *p, const double c[2], const double d[2])
{
    const int sign = sunder_i_passage_end_filter(p, c, d);
    return sign == SUNDER_I_PASSAGE_UNSURE ? sunder_i_passage_end_exact(p, c, d) : sign;
}

static int from_side(const sunder_i_passage *p, const double c[2], const double d[2])
{
    const sunder_point from = {p->from[0], p->from[1]}, u = {c[0], c[1]}, v = {d[0], d[1]};
    return sunder_orient(&u, &v, &from);
}

typedef struct meeting {
    const sunder_i_passage *passage;
    const double *c, *d;
} meeting;

/* Returns the sign of coordinate k of c minus that of the passage's start, or, if `end`, minus that of its end. */
static int coordinate_sign(const sunder_i_passage *p, const double c[2], int k, bool end)
{
    if (!end) return (c[k] > p->from[k]) - (c[k] < p->from[k]);
    sunder_i_accumulator sum = {{0}};
    sunder_i_accumulator_add(&sum, c[k], 1);
    sunder_i_accumulator_sub(&sum, p->from[k], 1);
    sunder_i_accumulator_sub(&sum, p->t[k], 1);
    sunder_i_accumulator_add(&sum, p->s[k], 1);
    return sunder_i_accumulator_sign(&sum);
}

/* For two segments on one line, or one of them a point: they meet if their projections on both axes do. Returns true if
 * so. */
static bool share_coordinates(const void *context)
{
    const meeting *m = context;
    for (int k = 0; k < 2; k++) {
        const int c = coordinate_sign(m->passage, m->c, k, false), d = coordinate_sign(m->passage, m->d, k, false),
                  ce = coordinate_sign(m->passage, m->c, k, true), de = coordinate_sign(m->passage, m->d, k, true);
        if ((c > 0 && d > 0 && ce > 0 && de > 0) || (c < 0 && d < 0 && ce < 0 && de < 0)) return false;
    }
    return true;
}

bool sunder_i_passage_meets(const sunder_i_passage *passage, const double c[2], const double d[2])
{
    const meeting m = {passage, c, d};
    const int sc = side_of(passage, c), sd = side_of(passage, d);
    if (sc * sd > 0) return false;
    return sunder_i_sides_meet(sc, sd, from_side(passage, c, d), end_side(passage, c, d), share_coordinates, &m);
}
