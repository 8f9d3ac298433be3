/* hpoint.c: intersection points in homogeneous coordinates: degree 3 over degree 2, compared in degree 5. Points
 * computed from plain points use native integers on every lattice: coordinates below 2^188 and weights below 2^126 on
 * lattices that are not narrow. */
#include "base/extremes.h"
#include "base/invariant.h"
#include "predicate/narrow.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The error of ax and ay, relative to the larger of 1 and the coordinate: three conversions, a division. */
#define HPOINT_ERROR 0x1p-49

static double scaled(const sunder_i_lattice *l, double v) { return l->approx_shift ? ldexp(v, -l->approx_shift) : v; }

static sunder_i_hpoint native_point(const sunder_i_lattice *l, sunder_i_i256 x, sunder_i_i256 y, sunder_i_i128 w)
{
    const double d = sunder_i_i128_double(w);
    return (sunder_i_hpoint){x, y, w, scaled(l, sunder_i_i256_double(&x) / d), scaled(l, sunder_i_i256_double(&y) / d)};
}

/* Returns the point v, whose numbers are in the scratch arena, with handles. */
static sunder_i_hpoint pooled_point(sunder_i_lattice *l, sunder_i_rational_point v)
{
    sunder_i_hpoint p;
    memset(&p, 0, sizeof p);
    if (l->arena.failed || l->scratch.failed) {
        p.w = 1;
        return p;
    }
    sunder_i_rational_doubles(&l->scratch, v, -l->approx_shift, &p.ax, &p.ay);
    const sunder_i_rational_point kept = sunder_i_rational_copy(&l->arena, v);
    p.x.limb[0] = (uint64_t)sunder_i_lattice_pool(l, kept.x, kept.w, p.ax);
    p.y.limb[0] = (uint64_t)sunder_i_lattice_pool(l, kept.y, kept.w, p.ay);
    return p;
}

sunder_i_hpoint sunder_i_hpoint_at(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b,
                                   const sunder_i_fraction *t)
{
    if (lattice->narrow ||
        (t->den != 0 && sunder_i_point_is_plain(a) && sunder_i_point_is_plain(b) && !lattice->pooled)) {
        const sunder_i_point u = sunder_i_narrow_sub(b, a);
        const sunder_i_i128 num = sunder_i_det_i128(t->num), den = sunder_i_det_i128(t->den);
        return native_point(lattice, sunder_i_mul_add(a.x, den, u.x, num), sunder_i_mul_add(a.y, den, u.y, num), den);
    }
    /* a + (num / den) u with a over v, u = b - a over w: (a w den + u v num) / (v w den), and less if w = v. */
    const sunder_i_mark mark = sunder_i_lattice_begin(lattice);
    sunder_i_arena *m = &lattice->scratch;
    const sunder_i_rational_point o = sunder_i_rational_get(m, lattice, a);
    const sunder_i_rational_point u = sunder_i_rational_sub(m, sunder_i_rational_get(m, lattice, b), o);
    const sunder_i_ratio f = sunder_i_fraction_read(m, lattice, t);
    const bool same = sunder_i_big_cmp(o.w, u.w) == 0;
    const sunder_i_big num = same ? f.num : sunder_i_times(m, f.num, o.w);
    const sunder_i_big by = same ? f.den : sunder_i_times(m, f.den, u.w);
    const sunder_i_hpoint p = pooled_point(
        lattice,
        (sunder_i_rational_point){sunder_i_big_add(m, sunder_i_big_mul(m, o.x, by), sunder_i_big_mul(m, u.x, num)),
                                  sunder_i_big_add(m, sunder_i_big_mul(m, o.y, by), sunder_i_big_mul(m, u.y, num)),
                                  sunder_i_times(m, by, o.w)});
    sunder_i_lattice_end(lattice, mark);
    return p;
}

sunder_i_hpoint sunder_i_hpoint_of(sunder_i_lattice *lattice, sunder_i_point a)
{
    if (lattice->narrow)
        return (sunder_i_hpoint){sunder_i_narrow_i256(a.x), sunder_i_narrow_i256(a.y), 1, (double)a.x, (double)a.y};
    if (sunder_i_point_is_plain(a))
        return (sunder_i_hpoint){sunder_i_narrow_i256(a.x), sunder_i_narrow_i256(a.y), 1, sunder_i_approx(lattice, a.x),
                                 sunder_i_approx(lattice, a.y)};
    const sunder_i_mark mark = sunder_i_lattice_begin(lattice);
    const sunder_i_rational_point v = sunder_i_rational_get(&lattice->scratch, lattice, a);
    sunder_i_hpoint p;
    if (!sunder_i_is_plain(a.x) && !sunder_i_is_plain(a.y) &&
        lattice->pool[a.x - INT64_MIN].ratio.den.limb == v.w.limb &&
        lattice->pool[a.y - INT64_MIN].ratio.den.limb == v.w.limb) {
        /* The handles of the point itself are used. */
        memset(&p, 0, sizeof p);
        p.ax = sunder_i_approx(lattice, a.x);
        p.ay = sunder_i_approx(lattice, a.y);
        p.x.limb[0] = (uint64_t)a.x;
        p.y.limb[0] = (uint64_t)a.y;
    } else {
        p = pooled_point(lattice, v);
    }
    sunder_i_lattice_end(lattice, mark);
    return p;
}

static sunder_i_i256 big_i256(sunder_i_big a)
{
    sunder_i_i256 r = {{0, 0, 0, 0}, (a.size > 0) - (a.size < 0)};
    const long n = a.size < 0 ? -a.size : a.size;
    SUNDER_I_ASSERT(n <= 4);
    for (long i = 0; i < n && i < 4; i++) r.limb[i] = a.limb[i];
    return r;
}

static bool is_native(const sunder_i_lattice *l, sunder_i_rational_point p)
{
    return l->narrow ||
           (!l->pooled && sunder_i_big_bits(p.x) < 256 && sunder_i_big_bits(p.y) < 256 && sunder_i_big_bits(p.w) < 127);
}

sunder_i_hpoint sunder_i_hpoint_make(sunder_i_lattice *lattice, sunder_i_rational_point v)
{
    SUNDER_I_ASSERT(lattice->arena.failed || lattice->scratch.failed || sunder_i_big_sign(v.w) > 0);
    if (is_native(lattice, v)) {
        const sunder_i_i256 d = big_i256(v.w);
        return native_point(lattice, big_i256(v.x), big_i256(v.y),
                            (sunder_i_i128)((sunder_i_u128)d.limb[1] << 64 | d.limb[0]));
    }
    const sunder_i_mark mark = sunder_i_lattice_begin(lattice);
    const sunder_i_hpoint p = pooled_point(lattice, v);
    sunder_i_lattice_end(lattice, mark);
    return p;
}

sunder_i_rational_point sunder_i_hpoint_read(sunder_i_arena *arena, const sunder_i_lattice *lattice,
                                             const sunder_i_hpoint *p)
{
    if (p->w != 0)
        return (sunder_i_rational_point){sunder_i_big_i256(arena, p->x), sunder_i_big_i256(arena, p->y),
                                         sunder_i_big_i128(arena, p->w)};
    const sunder_i_ratio x = sunder_i_lattice_read(arena, lattice, (int64_t)p->x.limb[0]);
    return (sunder_i_rational_point){x.num, sunder_i_lattice_read(arena, lattice, (int64_t)p->y.limb[0]).num, x.den};
}

static sunder_i_u128 low_bits(const sunder_i_i256 *a)
{
    const sunder_i_u128 m = (sunder_i_u128)a->limb[1] << 64 | a->limb[0];
    return a->sign < 0 ? -m : m;
}

static double bound_of(double a, double b)
{
    return SUNDER_I_DOUBT(HPOINT_ERROR * (fabs(a) + fabs(b)) + DBL_MIN); /* the last term is for underflow */
}

/* Compares the coordinate k (0: x, 1: y) of two native points, p / v and q / w: doubles have not decided it, so that
 * they differ by at most twice the error bound. */
static int native_cmp(const sunder_i_lattice *l, const sunder_i_hpoint *a, const sunder_i_hpoint *b, int k)
{
    const sunder_i_i256 *p = k ? &a->y : &a->x, *q = k ? &b->y : &b->x;
    const double apart = 2 * (k ? bound_of(a->ay, b->ay) : bound_of(a->ax, b->ax));
    if (a->w == b->w) return sunder_i_i256_cmp(p, q);
    if (l->approx_shift == 0) {
        const sunder_i_u128 pl = low_bits(p), ql = low_bits(q), v = (sunder_i_u128)a->w, w = (sunder_i_u128)b->w;
        if (sunder_i_i128_is_short(a->w) && sunder_i_i128_is_short(b->w) &&
            sunder_i_is_low_64(apart, (int64_t)v, (int64_t)w))
            return sunder_i_sign_low_64((uint64_t)pl, (uint64_t)v, (uint64_t)ql, (uint64_t)w);
        if (sunder_i_is_low_128(apart, a->w, b->w)) return sunder_i_sign_low_128(pl, v, ql, w);
    }
    return sunder_i_cmp_products_256(p, b->w, q, a->w);
}

/* Compares the coordinate k of two points if doubles have not decided it. */
static __attribute__((noinline)) int exact_coordinate_cmp(sunder_i_lattice *l, const sunder_i_hpoint *a,
                                                          const sunder_i_hpoint *b, int k)
{
    l->counts.exact_fallbacks++;
    if (a->w != 0 && b->w != 0) return native_cmp(l, a, b, k);
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const sunder_i_rational_point p = sunder_i_hpoint_read(m, l, a), q = sunder_i_hpoint_read(m, l, b);
    const int c = sunder_i_rational_cmp(m, &p, &q, k);
    sunder_i_lattice_end(l, mark);
    return c;
}

static int coordinate_cmp(sunder_i_lattice *l, const sunder_i_hpoint *a, const sunder_i_hpoint *b, int k)
{
    return SUNDER_I_DOUBLES_MAY_ERR ? exact_coordinate_cmp(l, a, b, k) : 0;
}

/* Returns 0 if doubles do not decide. */
static int filter_cmp(double a, double b)
{
    const double d = a - b, bound = bound_of(a, b);
    return d > bound ? 1 : d < -bound ? -1 : 0;
}

int sunder_i_hpoint_cmp(sunder_i_lattice *lattice, const sunder_i_hpoint *a, const sunder_i_hpoint *b)
{
    lattice->counts.comparisons++;
    int c = filter_cmp(a->ax, b->ax);
    if (c) return c;
    c = coordinate_cmp(lattice, a, b, 0);
    if (c) return c;
    c = filter_cmp(a->ay, b->ay);
    return c ? c : coordinate_cmp(lattice, a, b, 1);
}

int sunder_i_hpoint_cmp_x(sunder_i_lattice *lattice, const sunder_i_hpoint *a, const sunder_i_hpoint *b)
{
    lattice->counts.comparisons++;
    const int c = filter_cmp(a->ax, b->ax);
    return c ? c : coordinate_cmp(lattice, a, b, 0);
}

int sunder_i_hpoint_cmp_y(sunder_i_lattice *lattice, const sunder_i_hpoint *a, const sunder_i_hpoint *b)
{
    lattice->counts.comparisons++;
    const int c = filter_cmp(a->ay, b->ay);
    return c ? c : coordinate_cmp(lattice, a, b, 1);
}

bool sunder_i_hpoint_equal(sunder_i_lattice *lattice, const sunder_i_hpoint *a, const sunder_i_hpoint *b)
{
    lattice->counts.comparisons++;
    if (filter_cmp(a->ax, b->ax) || filter_cmp(a->ay, b->ay)) return false;
    return coordinate_cmp(lattice, a, b, 0) == 0 && coordinate_cmp(lattice, a, b, 1) == 0;
}

/* Returns the side of c with respect to the line ab if doubles decide it, else 0. The bound is derived as in orient.c;
 * the doubles of the point have an error of 2^-49 of the largest coordinate: 2^4 times the bound there. */
static int filter_side(const sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, const sunder_i_hpoint *c)
{
    const double ax = sunder_i_approx(l, a.x), ay = sunder_i_approx(l, a.y);
    const double bx = sunder_i_approx(l, b.x), by = sunder_i_approx(l, b.y);
    const double most = sunder_i_max(sunder_i_max(sunder_i_max(fabs(ax), fabs(ay)), sunder_i_max(fabs(bx), fabs(by))),
                                     sunder_i_max(fabs(c->ax), fabs(c->ay)));
    const double det = (bx - ax) * (c->ay - ay) - (by - ay) * (c->ax - ax),
                 bound = SUNDER_I_DOUBT(0x1p-43 * most * most);
    return most < 0x1p-200 ? 0 : det > bound ? 1 : det < -bound ? -1 : 0;
}

static uint64_t mix_hash(uint64_t h, uint64_t v)
{
    h = (h ^ v) * 0x9e3779b97f4a7c15u;
    return h ^ h >> 32;
}

/* Returns a hash of the square with sides of 2^-64 units that contains the point: floor(2^64 x / w) depends on the
 * value of the fraction only. */
uint64_t sunder_i_hpoint_hash(sunder_i_lattice *lattice, const sunder_i_hpoint *a)
{
    const sunder_i_mark mark = sunder_i_lattice_begin(lattice);
    sunder_i_arena *m = &lattice->scratch;
    const sunder_i_rational_point at = sunder_i_hpoint_read(m, lattice, a);
    uint64_t h = 0;
    for (int k = 0; k < 2; k++) {
        const sunder_i_big v = sunder_i_big_div_floor(m, sunder_i_big_shl(m, sunder_i_rational_axis(&at, k), 64), at.w);
        for (long i = 0; i < labs(v.size); i++) h = mix_hash(h, v.limb[i]);
        h = mix_hash(h, (uint64_t)v.size);
    }
    sunder_i_lattice_end(lattice, mark);
    return h;
}

/* Returns the sign of cross(b - a, c - a) * w with big integers; this is rarely needed. */
static __attribute__((noinline)) int exact_orient_hpoint(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b,
                                                         const sunder_i_hpoint *c)
{
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    l->counts.exact_fallbacks++;
    const int s = sunder_i_rational_orient(m, sunder_i_rational_get(m, l, a), sunder_i_rational_get(m, l, b),
                                           sunder_i_hpoint_read(m, l, c));
    sunder_i_lattice_end(l, mark);
    return s;
}

int sunder_i_orient_hpoint(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, const sunder_i_hpoint *c)
{
    lattice->counts.orientation_tests++;
    if (lattice->arena.failed) return 0;
    const int s = lattice->pooled ? 0 : filter_side(lattice, a, b, c);
    return s || !SUNDER_I_DOUBLES_MAY_ERR ? s : exact_orient_hpoint(lattice, a, b, c);
}
