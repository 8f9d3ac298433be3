/* orient.c: tests of degree 1 and 2: order, side, cross and dot products, angle.
 *
 * On lattices that are not narrow there are three steps. Plain operands are treated as on narrow ones: differences of
 * plain numbers are below 2^62, so that products of two are below 2^124 and their differences below 2^125. If a handle
 * is among the operands, doubles decide as far as the error bounds derived below allow; otherwise big integers decide,
 * over the operands' own denominators. */
#include "predicate/narrow.h"
#include "predicate/rational_point.h"

#include "base/extremes.h"

#include <math.h>

/* Products of approximations must neither overflow (they are below 2^501) nor lose bits by underflow. */
#define SMALLEST 0x1p-400

/* With u = 2^-53: the doubles of both vectors have a relative error of u, the products are rounded once, and so is
 * their sum or difference: 4 u (1 + u)^3 of the products together. */
#define PRODUCT_ERROR 0x1p-50

static int sign_of(double v, double bound) { return v > bound ? 1 : v < -bound ? -1 : 0; }

static int filter_products(double s, double t)
{
    const double size = fabs(s) + fabs(t);
    return size > SMALLEST ? sign_of(s + t, PRODUCT_ERROR * size) : 0;
}

/* Tests that doubles do not decide are made in functions named exact_*, so that a profile shows their cost. */
static __attribute__((noinline)) int exact_int_cmp(sunder_i_lattice *l, int64_t a, int64_t b)
{
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const sunder_i_ratio p = sunder_i_lattice_read(m, l, a), q = sunder_i_lattice_read(m, l, b);
    const int s = sunder_i_big_cmp(sunder_i_times(m, p.num, q.den), sunder_i_times(m, q.num, p.den));
    sunder_i_lattice_end(l, mark);
    return s;
}

int sunder_i_int_cmp(sunder_i_lattice *lattice, int64_t a, int64_t b)
{
    if (lattice->narrow || (sunder_i_is_plain(a) && sunder_i_is_plain(b))) return (a > b) - (a < b);
    if (lattice->arena.failed) return 0;
    const double x = sunder_i_approx(lattice, a), y = sunder_i_approx(lattice, b);
    const int c = sign_of(x - y, 0x1p-51 * (fabs(x) + fabs(y)) + SMALLEST);
    return c ? c : exact_int_cmp(lattice, a, b);
}

int sunder_i_point_cmp(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b)
{
    lattice->counts.comparisons++;
    const int c = sunder_i_int_cmp(lattice, a.x, b.x);
    return c ? c : sunder_i_int_cmp(lattice, a.y, b.y);
}

bool sunder_i_point_equal(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b)
{
    if (lattice->narrow) return a.x == b.x && a.y == b.y;
    return sunder_i_int_cmp(lattice, a.x, b.x) == 0 && sunder_i_int_cmp(lattice, a.y, b.y) == 0;
}

static bool both_plain(sunder_i_point a, sunder_i_point b)
{
    return sunder_i_point_is_plain(a) && sunder_i_point_is_plain(b);
}

static bool stays_plain(int64_t n)
{
    const int64_t limit = (int64_t)1 << SUNDER_I_PLAIN_BITS;
    return n < limit && n > -limit;
}

/* Returns a + b if sign is 1, a - b if it is -1. */
static sunder_i_point combine_points(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, int sign)
{
    if (!l->pooled && both_plain(a, b)) {
        const sunder_i_point s = {a.x + sign * b.x, a.y + sign * b.y};
        if (stays_plain(s.x) && stays_plain(s.y)) return s;
    }
    if (l->arena.failed) return (sunder_i_point){0, 0};
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const sunder_i_rational_point u = sunder_i_rational_get(m, l, a), v = sunder_i_rational_get(m, l, b);
    const sunder_i_point r =
        sunder_i_rational_put(l, sign > 0 ? sunder_i_rational_add(m, u, v) : sunder_i_rational_sub(m, u, v));
    sunder_i_lattice_end(l, mark);
    return r;
}

sunder_i_point sunder_i_point_add(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b)
{
    return lattice->narrow ? (sunder_i_point){a.x + b.x, a.y + b.y} : combine_points(lattice, a, b, 1);
}

sunder_i_point sunder_i_point_sub(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b)
{
    return lattice->narrow ? (sunder_i_point){a.x - b.x, a.y - b.y} : combine_points(lattice, a, b, -1);
}

static int64_t negated_number(sunder_i_lattice *l, int64_t n)
{
    if (sunder_i_is_plain(n)) return -n;
    const sunder_i_ratio r = l->pool[n - INT64_MIN].ratio;
    return sunder_i_lattice_ratio(l, sunder_i_big_neg(r.num), r.den);
}

sunder_i_point sunder_i_point_neg(sunder_i_lattice *lattice, sunder_i_point a)
{
    return (sunder_i_point){negated_number(lattice, a.x), negated_number(lattice, a.y)};
}

void sunder_i_point_difference(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, double *dx, double *dy)
{
    *dx = *dy = 0;
    if (lattice->arena.failed) return;
    if (lattice->approx_shift == 0 && (lattice->narrow || both_plain(a, b))) {
        *dx = (double)(a.x - b.x);
        *dy = (double)(a.y - b.y);
        return;
    }
    const sunder_i_mark mark = sunder_i_lattice_begin(lattice);
    const sunder_i_rational_point u = sunder_i_rational_diff(&lattice->scratch, lattice, a, b);
    sunder_i_rational_doubles(&lattice->scratch, u, -lattice->approx_shift, dx, dy);
    sunder_i_lattice_end(lattice, mark);
}

/* ---- Side ---- */

/* Each double has an error of at most u M, M the largest of them (half an ulp). So differences, which are below 2 M,
 * have an error of 2 u M and that of their own rounding, 4 u M together; each product one of 2 * 2 M * 4 u M, plus the
 * square of that error. So the determinant has an error of 32 u M^2 and that of its roundings, 3 u * 8 M^2: below 64 u
 * M^2. */
#define SIDE_ERROR 0x1p-47

static int filter_orient(const sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, sunder_i_point c)
{
    const double ax = sunder_i_approx(l, a.x), ay = sunder_i_approx(l, a.y);
    const double bx = sunder_i_approx(l, b.x), by = sunder_i_approx(l, b.y);
    const double cx = sunder_i_approx(l, c.x), cy = sunder_i_approx(l, c.y);
    const double most = sunder_i_max(sunder_i_max(sunder_i_max(fabs(ax), fabs(ay)), sunder_i_max(fabs(bx), fabs(by))),
                                     sunder_i_max(fabs(cx), fabs(cy)));
    if (most < 0x1p-200) return 0;
    return sign_of((bx - ax) * (cy - ay) - (by - ay) * (cx - ax), SIDE_ERROR * most * most);
}

static __attribute__((noinline)) int exact_orient(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b,
                                                  sunder_i_point c)
{
    l->counts.exact_fallbacks++;
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const int s = sunder_i_rational_orient(m, sunder_i_rational_get(m, l, a), sunder_i_rational_get(m, l, b),
                                           sunder_i_rational_get(m, l, c));
    sunder_i_lattice_end(l, mark);
    return s;
}

int sunder_i_orient(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c)
{
    lattice->counts.orientation_tests++;
    if (lattice->narrow || (both_plain(a, b) && sunder_i_point_is_plain(c)))
        return sunder_i_det_sign(sunder_i_narrow_orient(a, b, c));
    if (lattice->arena.failed) return 0;
    const int s = lattice->pooled ? 0 : filter_orient(lattice, a, b, c);
    return s ? s : exact_orient(lattice, a, b, c);
}

/* ---- Products of two vectors ---- */

static __attribute__((noinline)) int exact_product(sunder_i_lattice *l, sunder_i_point u, sunder_i_point v, bool cross)
{
    l->counts.exact_fallbacks++;
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const sunder_i_rational_point p = sunder_i_rational_get(m, l, u), q = sunder_i_rational_get(m, l, v);
    const int s = cross ? sunder_i_rational_cross_sign(m, p, q) : sunder_i_big_sign(sunder_i_rational_dot(m, p, q));
    sunder_i_lattice_end(l, mark);
    return s;
}

int sunder_i_cross_sign(sunder_i_lattice *lattice, sunder_i_point u, sunder_i_point v)
{
    lattice->counts.orientation_tests++;
    if (lattice->narrow || both_plain(u, v)) return sunder_i_det_sign(sunder_i_narrow_cross(u, v));
    if (lattice->arena.failed) return 0;
    const int s = lattice->pooled ? 0
                                  : filter_products(sunder_i_approx(lattice, u.x) * sunder_i_approx(lattice, v.y),
                                                    -sunder_i_approx(lattice, u.y) * sunder_i_approx(lattice, v.x));
    return s ? s : exact_product(lattice, u, v, true);
}

int sunder_i_dot_sign(sunder_i_lattice *lattice, sunder_i_point u, sunder_i_point v)
{
    if (lattice->narrow || both_plain(u, v)) return sunder_i_det_sign(sunder_i_narrow_dot(u, v));
    if (lattice->arena.failed) return 0;
    const int s = lattice->pooled ? 0
                                  : filter_products(sunder_i_approx(lattice, u.x) * sunder_i_approx(lattice, v.x),
                                                    sunder_i_approx(lattice, u.y) * sunder_i_approx(lattice, v.y));
    return s ? s : exact_product(lattice, u, v, false);
}

static int number_sign(const sunder_i_lattice *l, int64_t n)
{
    return sunder_i_is_plain(n) ? (n > 0) - (n < 0) : sunder_i_big_sign(l->pool[n - INT64_MIN].ratio.num);
}

int sunder_i_direction_half(sunder_i_lattice *lattice, sunder_i_point u)
{
    const int sx = number_sign(lattice, u.x), sy = number_sign(lattice, u.y);
    return sy < 0 || (sy == 0 && sx < 0);
}

int sunder_i_angle_cmp(sunder_i_lattice *lattice, sunder_i_point u, sunder_i_point v)
{
    const int hu = sunder_i_direction_half(lattice, u), hv = sunder_i_direction_half(lattice, v);
    if (hu != hv) return hu < hv ? -1 : 1;
    return -sunder_i_cross_sign(lattice, u, v);
}
