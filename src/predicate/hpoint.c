/* Intersection points in homogeneous coordinates: degree 3 over degree 2, compared in degree 5. */
#include "predicate/kernel.h"
#include "predicate/wide_vector.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Relative to the larger of 1 and the coordinate: three conversions, a division. */
#define HPOINT_ERROR 0x1p-49

static sunder_i_hpoint wide_hpoint(sunder_i_lattice *l, sunder_i_big x, sunder_i_big y, sunder_i_big w)
{
    sunder_i_hpoint p;
    memset(&p, 0, sizeof p);
    if (l->arena.failed) return p;
    p.ax = sunder_i_big_ratio(&l->arena, x, w, -l->approx_shift);
    p.ay = sunder_i_big_ratio(&l->arena, y, w, -l->approx_shift);
    p.x.limb[0] = (uint64_t)sunder_i_lattice_big(l, x);
    p.y.limb[0] = (uint64_t)sunder_i_lattice_big(l, y);
    p.w = sunder_i_lattice_big(l, w);
    return p;
}

sunder_i_hpoint sunder_i_hpoint_at(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, const sunder_i_fraction *t)
{
    if (l->narrow) {
        const sunder_i_point u = sunder_i_narrow_sub(b, a);
        sunder_i_hpoint p;
        p.x = sunder_i_mul_add(a.x, t->den, u.x, t->num);
        p.y = sunder_i_mul_add(a.y, t->den, u.y, t->num);
        p.w = t->den;
        const double w = (double)p.w;
        p.ax = sunder_i_i256_double(&p.x) / w;
        p.ay = sunder_i_i256_double(&p.y) / w;
        return p;
    }
    sunder_i_arena *arena = &l->arena;
    const sunder_i_vector o = sunder_i_wide_get(l, a), u = sunder_i_wide_diff(l, b, a);
    const sunder_i_big num = sunder_i_lattice_get(l, (int64_t)t->num), den = sunder_i_lattice_get(l, (int64_t)t->den);
    return wide_hpoint(
        l, sunder_i_big_add(arena, sunder_i_big_mul(arena, o.x, den), sunder_i_big_mul(arena, u.x, num)),
        sunder_i_big_add(arena, sunder_i_big_mul(arena, o.y, den), sunder_i_big_mul(arena, u.y, num)), den);
}

static sunder_i_i256 narrow_i256(int64_t v)
{
    sunder_i_i256 r = {{v < 0 ? -(uint64_t)v : (uint64_t)v, 0, 0, 0}, (v > 0) - (v < 0)};
    return r;
}

sunder_i_hpoint sunder_i_hpoint_of(sunder_i_lattice *l, sunder_i_point a)
{
    if (l->narrow)
        return (sunder_i_hpoint){narrow_i256(a.x), narrow_i256(a.y), 1, (double)a.x, (double)a.y};
    const sunder_i_vector v = sunder_i_wide_get(l, a);
    return wide_hpoint(l, v.x, v.y, sunder_i_big_i64(&l->arena, 1));
}

static sunder_i_i256 big_i256(sunder_i_big a)
{
    sunder_i_i256 r = {{0, 0, 0, 0}, (a.size > 0) - (a.size < 0)};
    const long n = a.size < 0 ? -a.size : a.size;
    assert(n <= 4);
    for (long i = 0; i < n && i < 4; i++) r.limb[i] = a.limb[i];
    return r;
}

sunder_i_hpoint sunder_i_hpoint_make(sunder_i_lattice *l, sunder_i_big x, sunder_i_big y, sunder_i_big w)
{
    sunder_i_arena *arena = &l->arena;
    if (!l->narrow)
        return wide_hpoint(l, sunder_i_big_copy(arena, x), sunder_i_big_copy(arena, y), sunder_i_big_copy(arena, w));
    const sunder_i_i256 d = big_i256(w);
    sunder_i_hpoint p = {.x = big_i256(x), .y = big_i256(y)};
    p.w = (sunder_i_i128)((sunder_i_u128)d.limb[1] << 64 | d.limb[0]);
    const double v = (double)p.w;
    p.ax = sunder_i_i256_double(&p.x) / v;
    p.ay = sunder_i_i256_double(&p.y) / v;
    return p;
}

void sunder_i_hpoint_read(sunder_i_arena *arena, const sunder_i_lattice *l, const sunder_i_hpoint *p,
                          sunder_i_big xyw[3])
{
    if (l->narrow) {
        xyw[0] = sunder_i_big_i256(arena, p->x);
        xyw[1] = sunder_i_big_i256(arena, p->y);
        xyw[2] = sunder_i_big_i128(arena, p->w);
        return;
    }
    xyw[0] = sunder_i_big_copy(arena, l->pool[(int64_t)p->x.limb[0]]);
    xyw[1] = sunder_i_big_copy(arena, l->pool[(int64_t)p->y.limb[0]]);
    xyw[2] = sunder_i_big_copy(arena, l->pool[(int64_t)p->w]);
}

void sunder_i_hpoint_big(sunder_i_lattice *l, const sunder_i_hpoint *p, sunder_i_big *x, sunder_i_big *y,
                         sunder_i_big *w)
{
    if (l->narrow) {
        sunder_i_big xyw[3];
        sunder_i_hpoint_read(&l->arena, l, p, xyw);
        *x = xyw[0], *y = xyw[1], *w = xyw[2];
        return;
    }
    *x = sunder_i_lattice_get(l, (int64_t)p->x.limb[0]);
    *y = sunder_i_lattice_get(l, (int64_t)p->y.limb[0]);
    *w = sunder_i_lattice_get(l, (int64_t)p->w);
}

static int coordinate_cmp(sunder_i_lattice *l, const sunder_i_i256 *a, sunder_i_i128 aw, const sunder_i_i256 *b,
                          sunder_i_i128 bw)
{
    l->operations.exact_fallbacks++;
    if (l->narrow) return aw == bw ? sunder_i_i256_cmp(a, b) : sunder_i_cmp_products_256(a, bw, b, aw);
    const sunder_i_mark mark = sunder_i_arena_mark(&l->arena);
    const sunder_i_big ax = sunder_i_lattice_get(l, (int64_t)a->limb[0]), bx = sunder_i_lattice_get(l, (int64_t)b->limb[0]);
    const int c = sunder_i_big_cmp(sunder_i_big_mul(&l->arena, ax, sunder_i_lattice_get(l, (int64_t)bw)),
                                   sunder_i_big_mul(&l->arena, bx, sunder_i_lattice_get(l, (int64_t)aw)));
    sunder_i_wide_drop(l, mark);
    return c;
}

/* 0 where the doubles leave it open. */
static int filter(double a, double b)
{
    const double d = a - b, bound = HPOINT_ERROR * (fabs(a) + fabs(b)) + DBL_MIN; /* the last for underflow */
    return d > bound ? 1 : d < -bound ? -1 : 0;
}

int sunder_i_hpoint_cmp(sunder_i_lattice *l, const sunder_i_hpoint *a, const sunder_i_hpoint *b)
{
    l->operations.comparisons++;
    int c = filter(a->ax, b->ax);
    if (c) return c;
    c = coordinate_cmp(l, &a->x, a->w, &b->x, b->w);
    if (c) return c;
    c = filter(a->ay, b->ay);
    return c ? c : coordinate_cmp(l, &a->y, a->w, &b->y, b->w);
}

int sunder_i_hpoint_cmp_y(sunder_i_lattice *l, const sunder_i_hpoint *a, const sunder_i_hpoint *b)
{
    l->operations.comparisons++;
    const int c = filter(a->ay, b->ay);
    return c ? c : coordinate_cmp(l, &a->y, a->w, &b->y, b->w);
}

bool sunder_i_hpoint_equal(sunder_i_lattice *l, const sunder_i_hpoint *a, const sunder_i_hpoint *b)
{
    l->operations.comparisons++;
    if (filter(a->ax, b->ax) || filter(a->ay, b->ay)) return false;
    return coordinate_cmp(l, &a->x, a->w, &b->x, b->w) == 0 && coordinate_cmp(l, &a->y, a->w, &b->y, b->w) == 0;
}

static uint64_t mix(uint64_t h, uint64_t v)
{
    h = (h ^ v) * 0x9e3779b97f4a7c15u;
    return h ^ h >> 32;
}

/* Of the square of 2^-64 units that the point is in: floor(2^64 x / w) depends on the value of the fraction alone. */
uint64_t sunder_i_hpoint_hash(sunder_i_lattice *l, const sunder_i_hpoint *p)
{
    sunder_i_arena *arena = &l->arena;
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    sunder_i_big at[2], w;
    uint64_t h = 0;
    sunder_i_hpoint_big(l, p, &at[0], &at[1], &w);
    for (int k = 0; k < 2 && !arena->failed; k++) {
        const sunder_i_big v = sunder_i_big_div_floor(arena, sunder_i_big_shl(arena, at[k], 64), w);
        for (long i = 0; i < labs(v.size); i++) h = mix(h, v.limb[i]);
        h = mix(h, (uint64_t)v.size);
    }
    sunder_i_wide_drop(l, mark);
    return h;
}

int sunder_i_orient_hpoint(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, const sunder_i_hpoint *c)
{
    l->operations.orientation_tests++;
    /* cross(b - a, c - a) * w = u.x * Y - u.y * X - cross(u, a) * w: big integers; a rarely asked question. */
    sunder_i_arena *arena = &l->arena;
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    l->operations.exact_fallbacks++;
    sunder_i_big x, y, w;
    sunder_i_hpoint_big(l, c, &x, &y, &w);
    const sunder_i_vector o = sunder_i_wide_get(l, a), u = sunder_i_wide_diff(l, b, a);
    const sunder_i_vector v = {sunder_i_big_sub(arena, x, sunder_i_big_mul(arena, o.x, w)),
                               sunder_i_big_sub(arena, y, sunder_i_big_mul(arena, o.y, w))};
    const int s = sunder_i_big_sign(sunder_i_wide_cross(l, u, v));
    sunder_i_wide_drop(l, mark);
    return s;
}
