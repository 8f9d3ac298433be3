/* The side of a point to a line, on doubles as they come: the ladder in one place, rung by rung. */
#include "predicate/orient_double.h"

#include "number/big.h"

#include <math.h>

/* Error bound of the filter below: with u = 2^-53 the computed determinant differs from the true one by at most
 * (3 + 16 u) u (|detleft| + |detright|) [She96, section 4.3, "ccwerrboundA"], given round-to-nearest, no underflow and
 * no contraction of multiply-add. Underflow can spoil a product by 2^-1075, so tiny determinants are not believed. */
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

int sunder_i_orient_lattice(const sunder_point *a, const sunder_point *b, const sunder_point *c, bool force_wide)
{
    const double xy[6] = {a->x, a->y, b->x, b->y, c->x, c->y};
    sunder_i_extent extent = {0};
    sunder_i_extent_add(&extent, xy, 3);
    double origin[1][2];
    sunder_i_lattice l;
    sunder_i_lattice_init(&l, &extent, 1, true, origin, force_wide);
    if (!l.narrow && !force_wide) return SUNDER_I_UNSURE;
    sunder_i_point p[3];
    for (int i = 0; i < 3; i++)
        p[i] = (sunder_i_point){sunder_i_lattice_int(&l, xy[2 * i], origin[0][0]),
                                sunder_i_lattice_int(&l, xy[2 * i + 1], origin[0][1])};
    const int s = sunder_i_orient(&l, p[0], p[1], p[2]);
    const bool failed = l.arena.failed;
    sunder_i_lattice_free(&l);
    return failed ? SUNDER_I_UNSURE : s;
}

int sunder_orient(const sunder_point *a, const sunder_point *b, const sunder_point *c)
{
    int s = sunder_i_orient_filter(a, b, c);
    if (s == SUNDER_I_UNSURE) s = sunder_i_orient_lattice(a, b, c, false);
    if (s == SUNDER_I_UNSURE) s = sunder_i_orient_lattice(a, b, c, true);
    return s == SUNDER_I_UNSURE ? 0 : s; /* unsure here only if memory ran out */
}
