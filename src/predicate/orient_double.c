/* orient_double.c: the side of a point with respect to a line, for any finite doubles: first with an error bound, then
 * exactly. */
#include "predicate/orient_double.h"

#include "number/accumulator.h"

#include <math.h>

/* The error bound: with u = 2^-53 the computed determinant differs from the true one by at most (3 + 16 u) u (|detleft|
 * + |detright|) [She96, section 4.3, "ccwerrboundA"], given round-to-nearest, no underflow and no contraction of
 * multiply-add. Underflow can change a product by 2^-1075, so that tiny determinants decide nothing. */
int sunder_i_orient_filter(const sunder_point *a, const sunder_point *b, const sunder_point *c)
{
    const double left = (a->x - c->x) * (b->y - c->y), right = (a->y - c->y) * (b->x - c->x);
    const double det = left - right, sum = fabs(left) + fabs(right);
    const double bound = (3.0 + 16.0 * 0x1p-53) * 0x1p-53 * sum;
    if (!(sum < INFINITY) || sum < 0x1p-960) return SUNDER_I_UNSURE;
    if (det > bound) return 1;
    if (det < -bound) return -1;
    return SUNDER_I_UNSURE;
}

/* (a - c) x (b - c) multiplied out: the two products c.x c.y cancel. */
int sunder_i_orient_exact(const sunder_point *a, const sunder_point *b, const sunder_point *c)
{
    sunder_i_accumulator det = {{0}};
    sunder_i_accumulator_add(&det, a->x, b->y);
    sunder_i_accumulator_sub(&det, a->y, b->x);
    sunder_i_accumulator_add(&det, b->x, c->y);
    sunder_i_accumulator_sub(&det, b->y, c->x);
    sunder_i_accumulator_add(&det, c->x, a->y);
    sunder_i_accumulator_sub(&det, c->y, a->x);
    return sunder_i_accumulator_sign(&det);
}

int sunder_orient(const sunder_point *a, const sunder_point *b, const sunder_point *c)
{
    const int s = sunder_i_orient_filter(a, b, c);
    return s == SUNDER_I_UNSURE ? sunder_i_orient_exact(a, b, c) : s;
}
