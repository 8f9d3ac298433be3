/* nearest_doubles.c: converts vertices of a sum to the nearest doubles, and measures the deviation: the largest
 * distance of a vertex from its doubles, rounded up. There is no allocation for each vertex.
 *
 * A coordinate is n 2^e plus both origins. There are four methods; the first that applies is used:
 *   near_double()   a lattice point, and origins below 2^83 units: the coordinate is the sum of two doubles without
 *                   error, and is rounded once
 *   whole_double()  a lattice point, and origins that are multiples of the unit: an integer of at most 126 bits, whose
 *                   conversion rounds once
 *   ratio_double()  a crossing, whose n is a fraction: for rounding it is sufficient to know the integer part and
 *                   whether the rest is nonzero
 *   big_double()    all others, by big integers */
#include "sum/sum_value.h"

#include <math.h>

/* *out becomes the sum of both origins in one coordinate, in lattice units, below 2^120. Returns false if an origin is
 * not a multiple of the unit, or too large. */
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

/* *x becomes the double nearest to n times the unit, *off an upper bound of the error, 0 if there is none. The unit is
 * a power of two with which no result is subnormal or infinite. The conversion of n rounds to nearest, ties to even;
 * its error is an integer below 2^74, which is rounded up when it is converted to a double. */
static void whole_double(sunder_i_i128 n, double unit, double *x, double *off)
{
    const double nearest = (double)n;
    const sunder_i_i128 rest = n - (sunder_i_i128)nearest;
    *x = nearest * unit;
    *off = rest == 0 ? 0 : nextafter(fabs((double)rest), INFINITY) * unit;
}

/* *whole becomes floor(n / w), and `rest` the remainder, 0 <= rest < w. Returns false if the quotient of |n| and w is
 * not below 2^63. */
static bool divide_limbs(const sunder_i_i256 *n, const mp_limb_t w[2], mp_size_t limbs, sunder_i_i128 *whole,
                         mp_limb_t rest[2])
{
    mp_limb_t q[4] = {0};
    mp_size_t size = 4;
    while (size > 0 && !n->limb[size - 1]) size--;
    rest[0] = size > 0 ? n->limb[0] : 0;
    rest[1] = size > 1 ? n->limb[1] : 0;
    if (size >= limbs) {
        rest[1] = 0;
        mpn_tdiv_qr(q, rest, 0, n->limb, size, w, limbs);
    }
    if (q[0] >> 63 || q[1] || q[2] || q[3]) return false;
    *whole = q[0];
    if (n->sign < 0) {
        *whole = -*whole;
        if (rest[0] || rest[1]) {
            mpn_sub_n(rest, w, rest, 2);
            --*whole;
        }
    }
    return true;
}

/* *x becomes the double nearest to (n / denominator + origin) times the unit, denominator > 0, and *off an upper bound
 * of the error. Returns false if the quotient is too large, or too small even after scaling. Let i be the integer part
 * of the sum. If i has at least 55 bits and the fraction is not 0, the nearest double is the one nearest to i + 1/2: no
 * double, and no midpoint of two doubles, lies strictly between integers of this size. If i is smaller, the sum is
 * scaled by 2^64. */
static bool ratio_double(const sunder_i_i256 *n, sunder_i_i128 denominator, sunder_i_i128 origin, double unit,
                         double *x, double *off)
{
    const sunder_i_i128 large = (sunder_i_i128)1 << 54;
    const mp_limb_t w[2] = {(mp_limb_t)denominator, (mp_limb_t)((sunder_i_u128)denominator >> 64)};
    const mp_size_t limbs = w[1] ? 2 : 1;
    mp_limb_t rest[2];
    sunder_i_i128 i;
    if (!divide_limbs(n, w, limbs, &i, rest)) return false;
    i += origin;
    if (i > -large && i < large) {
        const sunder_i_i256 finer = {{0, rest[0], rest[1], 0}, 1};
        mp_limb_t q[3] = {0};
        const mp_size_t size = rest[1] ? 3 : 2;
        if (rest[0] || rest[1]) {
            rest[1] = 0;
            mpn_tdiv_qr(q, rest, 0, finer.limb, size, w, limbs);
        }
        i = i * ((sunder_i_i128)1 << 64) + q[0];
        unit *= 0x1p-64;
        if (i > -large && i < large) return false;
    }
    const bool more = rest[0] || rest[1];
    const double nearest = (double)(2 * i + more) / 2;
    const double left = (double)(i - (sunder_i_i128)nearest);
    const double fraction = ((double)rest[1] * 0x1p64 + (double)rest[0]) / ((double)w[1] * 0x1p64 + (double)w[0]);
    *x = nearest * unit;
    /* `fraction` has an error of at most 2^-50, `left` a relative error of 2^-53. */
    *off = !more && left == 0 ? 0 : nextafter(fabs(left + fraction) + (fabs(left) + 1) * 0x1p-49, INFINITY) * unit;
    return true;
}

/* *x becomes the double nearest to the coordinate n / w on the lattice, and *off its error, rounded up. *x is infinite
 * beyond the range of doubles and NaN if out of memory; then *off is infinite. */
static void big_double(sunder_i_arena *arena, const sunder_sum *sum, int axis, sunder_i_big n, sunder_i_big w,
                       double *x, double *off)
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
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    const sunder_i_rational_point at = sunder_i_hpoint_read(arena, &sum->lattice, p);
    for (int k = 0; k < 2; k++) big_double(arena, sum, k, sunder_i_rational_axis(&at, k), at.w, &xy[k], &off[k]);
    sunder_i_arena_release(arena, mark);
}

/* The unit and the origins of a sum, in the forms that the conversions need, and the deviation so far. */
typedef struct frame {
    double unit;
    bool plain, near;         /* plain: whole_origin() succeeded for both axes; near: also, both are below 2^83 */
    sunder_i_i128 origin[2];  /* the sum of the origins for each axis, in units, if `plain` */
    double high[2], low[2];   /* origin = high + low: a multiple of 2^32, and 0 <= low < 2^32 */
    double most, off_squared; /* the deviation; a lower bound of its square in squared units, or -1 */
} frame;

static const double part = 0x1p32;

static void part_origin(frame *f, int axis)
{
    const sunder_i_i128 limit = (sunder_i_i128)1 << 83, o = f->origin[axis];
    if (o <= -limit || o >= limit) f->near = false;
    f->low[axis] = (double)(uint32_t)o;
    f->high[axis] = sunder_i_i128_is_short(o) ? (double)(int64_t)(o >> 32) * part : (double)(o - (uint32_t)o);
}

static frame frame_of(const sunder_sum *sum, double most)
{
    const sunder_i_lattice *l = &sum->lattice;
    frame f = {.most = most, .off_squared = -1};
    f.plain = l->small && l->exponent >= -900 && l->exponent <= 800 && whole_origin(sum, 0, &f.origin[0]) &&
              whole_origin(sum, 1, &f.origin[1]);
    if (!f.plain) return f;
    f.unit = ldexp(1, (int)l->exponent);
    f.near = true;
    for (int k = 0; k < 2; k++) part_origin(&f, k);
    return f;
}

/* Returns n + origin[axis], in units, rounded once; *rest becomes the exact rounding error. n is divided like the
 * origin into a multiple of 2^32 and a remainder. The sum of the multiples is below 2^84 and exact, and so is that of
 * the remainders; the two sums are added by two-sum [Knu97]. */
static double near_double(const frame *f, int axis, int64_t n, double *rest)
{
    const double high = f->high[axis] + (double)(n >> 32) * part, low = f->low[axis] + (double)(uint32_t)n;
    const double nearest = high + low, of_low = nearest - high;
    *rest = (high - (nearest - of_low)) + (low - of_low);
    return nearest;
}

static void take_off(frame *f, double x, double y)
{
    const double here = x == 0 ? y : y == 0 ? x : nextafter(hypot(x, y), INFINITY);
    if (here <= f->most) return;
    f->most = here;
    const double most = here / f->unit;
    f->off_squared = most * most * (1 - 0x1p-40);
}

static double off_of(const frame *f, double rest) { return rest == 0 ? 0 : nextafter(fabs(rest), INFINITY) * f->unit; }

/* Sets xy from p, and updates the deviation. Returns false, without an effect, unless f->near is true and p is a
 * lattice point with coordinates below 2^62. */
static bool near_vertex(frame *f, const sunder_i_hpoint *p, double xy[2])
{
    const uint64_t x = p->x.limb[0], y = p->y.limb[0];
    if (!f->near || p->w != 1 || (x | y) >> 62 || p->x.limb[1] || p->y.limb[1] || p->x.limb[2] || p->y.limb[2] ||
        p->x.limb[3] || p->y.limb[3])
        return false;
    double rest[2];
    xy[0] = near_double(f, 0, p->x.sign * (int64_t)x, &rest[0]) * f->unit;
    xy[1] = near_double(f, 1, p->y.sign * (int64_t)y, &rest[1]) * f->unit;
    const double squared = rest[0] * rest[0] + rest[1] * rest[1];
    if (squared > 0 && squared > f->off_squared) take_off(f, off_of(f, rest[0]), off_of(f, rest[1]));
    return true;
}

/* Sets xy from p, and off[] to upper bounds of the errors. Returns false if f->plain is false, if p consists of big
 * integers, or if ratio_double() does not decide. */
static bool plain_vertex(const frame *f, const sunder_i_hpoint *p, double xy[2], double off[2])
{
    if (!f->plain || p->w == 0) return false;
    for (int k = 0; k < 2; k++) {
        const sunder_i_i256 *n = k ? &p->y : &p->x;
        if (p->w == 1 && !(n->limb[0] >> 63 || n->limb[1] || n->limb[2] || n->limb[3]))
            whole_double(n->sign * (sunder_i_i128)n->limb[0] + f->origin[k], f->unit, &xy[k], &off[k]);
        else if (!ratio_double(n, p->w, f->origin[k], f->unit, &xy[k], &off[k]))
            return false;
    }
    return true;
}

sunder_status sunder_sum_vertices(const sunder_sum *sum, const uint32_t *vertex, size_t n, double *xy,
                                  double *deviation, sunder_error *err)
{
    sunder_i_arena arena = {0};
    frame f = frame_of(sum, 0);
    for (size_t i = 0; i < n; i++) {
        const sunder_i_hpoint *p = &sum->vertex[vertex[i]];
        double *at = xy + 2 * i, off[2];
        if (near_vertex(&f, p, at)) continue;
        if (!plain_vertex(&f, p, at, off)) big_vertex(&arena, sum, p, at, off);
        take_off(&f, off[0], off[1]);
    }
    const bool failed = arena.failed;
    sunder_i_arena_free(&arena);
    if (failed) return sunder_i_failure_cause(err);
    if (f.most > *deviation) *deviation = f.most;
    return SUNDER_OK;
}
