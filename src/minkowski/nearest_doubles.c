/* Vertices of a sum as the nearest doubles, and how far these are off, without text and without one allocation each.
 *
 * Nearly all vertices are lattice points: n 2^e + both origins. On a narrow lattice that is an integer of at most 126
 * bits where the origins are not too far out, and its conversion rounds once. All others take the big integers. The
 * deviation is measured exactly and rounded up. */
#include "minkowski/sum.h"

#include <limits.h>
#include <math.h>

/* The origins as one multiple of the unit, below 2^120 of it; false if they are not. */
static bool whole_origin(const sunder_sum *sum, int axis, sunder_i_i128 *out)
{
    *out = 0;
    for (int operand = 0; operand < 2; operand++) {
        const double o = sum->origin[operand][axis];
        if (o == 0) continue;
        int e;
        const int64_t m = (int64_t)ldexp(frexp(o, &e), 53);
        const long shift = e - 53 - sum->lattice.exponent;
        if (shift > 66) return false;
        if (shift < 0 && (shift < -62 || m % ((int64_t)1 << -shift))) return false;
        *out += shift < 0 ? m / ((int64_t)1 << -shift) : m * ((sunder_i_i128)1 << shift);
    }
    return true;
}

/* n 2^exponent; false where it may be subnormal or infinite. The conversion to double rounds to nearest, ties to even,
 * and what it leaves is less than 2^74: the difference in doubles is rounded up. */
static bool whole_double(sunder_i_i128 n, long exponent, double *x, double *off)
{
    if (exponent < -900 || exponent > 800) return false;
    const double nearest = (double)n;
    const sunder_i_i128 rest = n - (sunder_i_i128)nearest;
    *x = ldexp(nearest, (int)exponent);
    *off = rest == 0 ? 0 : ldexp(nextafter(fabs((double)rest), INFINITY), (int)exponent);
    return true;
}

/* By big integers; infinite where it leaves the range. */
static void big_double(sunder_i_arena *arena, const sunder_sum *sum, int axis, sunder_i_big n, sunder_i_big w, double *x,
                       double *off)
{
    sunder_i_big num, den;
    const long e = sunder_i_sum_coordinate(arena, sum, axis, n, w, &num, &den);
    *off = INFINITY;
    *x = arena->failed ? (double)NAN : sunder_i_big_ratio(arena, num, den, e);
    if (!isfinite(*x)) return;
    int f;
    const sunder_i_big m = sunder_i_big_mul(arena, sunder_i_big_double(arena, *x, &f), den);
    const long least = m.size && f < e ? f : e;
    sunder_i_big rest = sunder_i_big_shl(arena, num, (unsigned long)(e - least));
    if (m.size) rest = sunder_i_big_sub(arena, rest, sunder_i_big_shl(arena, m, (unsigned long)(f - least)));
    if (sunder_i_big_sign(rest) < 0) rest = sunder_i_big_neg(rest);
    *off = rest.size ? sunder_i_big_ratio_up(arena, rest, den, least) : 0;
}

static void big_vertex(sunder_i_arena *arena, const sunder_sum *sum, const sunder_i_hpoint *p, double xy[2],
                       double off[2])
{
    const sunder_i_lattice *l = &sum->lattice;
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    sunder_i_big xyw[3];
    sunder_i_hpoint_read(arena, l, p, xyw);
    for (int k = 0; k < 2; k++) big_double(arena, sum, k, xyw[k], xyw[2], &xy[k], &off[k]);
    sunder_i_arena_release(arena, mark);
}

/* Is it n / 1 with |n| < 2^63? */
static bool is_whole(const sunder_i_hpoint *p)
{
    for (int k = 0; k < 2; k++) {
        const sunder_i_i256 n = k ? p->y : p->x;
        if (n.limb[0] >> 63 || n.limb[1] || n.limb[2] || n.limb[3]) return false;
    }
    return p->w == 1;
}

sunder_status sunder_sum_vertices(const sunder_sum *sum, const uint32_t *vertex, size_t n, double *xy,
                                  double *deviation, sunder_error *err)
{
    sunder_i_arena arena = {0};
    sunder_i_i128 origin[2];
    const sunder_i_lattice *l = &sum->lattice;
    const bool plain = l->narrow && sunder_i_big_bits(l->denominator) == 1 && whole_origin(sum, 0, &origin[0]) &&
                       whole_origin(sum, 1, &origin[1]);
    double most = 0;
    for (size_t i = 0; i < n; i++) {
        const sunder_i_hpoint *p = &sum->vertex[vertex[i]];
        double *at = xy + 2 * i, off[2];
        if (!plain || !is_whole(p) ||
            !whole_double(p->x.sign * (sunder_i_i128)p->x.limb[0] + origin[0], l->exponent, &at[0], &off[0]) ||
            !whole_double(p->y.sign * (sunder_i_i128)p->y.limb[0] + origin[1], l->exponent, &at[1], &off[1]))
            big_vertex(&arena, sum, p, at, off);
        const double here = off[0] == 0 ? off[1] : off[1] == 0 ? off[0] : nextafter(hypot(off[0], off[1]), INFINITY);
        if (!(here <= most)) most = here;
    }
    const bool failed = arena.failed;
    sunder_i_arena_free(&arena);
    if (failed) return sunder_i_no_memory(err);
    if (most > *deviation) *deviation = most;
    return SUNDER_OK;
}
