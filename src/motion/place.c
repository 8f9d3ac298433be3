#include "motion/place.h"

#include "predicate/vector.h"

#include <float.h>
#include <math.h>

/* ---- Making places ---- */

sunder_i_place_at sunder_i_place_make(sunder_i_lattice *l, sunder_i_big x, sunder_i_big y, sunder_i_big w)
{
    sunder_i_place_at p = {x, y, w, 0, 0};
    if (l->arena.failed) return p;
    sunder_i_arena scratch = {0};
    p.ax = sunder_i_big_ratio(&scratch, x, w, -l->approx_shift);
    p.ay = sunder_i_big_ratio(&scratch, y, w, -l->approx_shift);
    if (scratch.failed) l->arena.failed = true;
    sunder_i_arena_free(&scratch);
    return p;
}

sunder_i_place_at sunder_i_place_of_vertex(sunder_i_lattice *l, const sunder_i_hpoint *vertex)
{
    sunder_i_big x, y, w;
    sunder_i_hpoint_big(l, vertex, &x, &y, &w);
    return sunder_i_place_make(l, x, y, w);
}

static sunder_i_big two_to(sunder_i_arena *arena, sunder_i_big a, long e)
{
    return sunder_i_big_shl(arena, a, (unsigned long)e);
}

/* num / den less both origins, in lattice units. */
static void on_lattice(const sunder_sum *sum, sunder_i_arena *arena, int axis, sunder_i_big *num, sunder_i_big *den)
{
    const sunder_i_lattice *l = &sum->lattice;
    for (int operand = 0; operand < 2; operand++) {
        int e;
        const sunder_i_big o = sunder_i_big_double(arena, sum->origin[operand][axis], &e);
        if (o.size == 0) continue;
        sunder_i_big part = sunder_i_big_mul(arena, o, *den);
        if (e >= 0) {
            part = two_to(arena, part, e);
        } else {
            *num = two_to(arena, *num, -(long)e);
            *den = two_to(arena, *den, -(long)e);
        }
        *num = sunder_i_big_sub(arena, *num, part);
    }
    if (l->exponent < 0)
        *num = two_to(arena, *num, -l->exponent);
    else
        *den = two_to(arena, *den, l->exponent);
    const sunder_i_big g = sunder_i_big_gcd(arena, *num, *den);
    if (arena->failed) return;
    *num = sunder_i_big_div_floor(arena, *num, g);
    *den = sunder_i_big_div_floor(arena, *den, g);
}

sunder_i_place_at sunder_i_place_of_rational(const sunder_sum *sum, sunder_i_lattice *l, const sunder_i_big num[2],
                                             const sunder_i_big den[2])
{
    sunder_i_arena *arena = &l->arena;
    sunder_i_big n[2] = {num[0], num[1]}, d[2] = {den[0], den[1]};
    for (int k = 0; k < 2; k++) on_lattice(sum, arena, k, &n[k], &d[k]);
    return sunder_i_place_make(l, sunder_i_big_mul(arena, n[0], d[1]), sunder_i_big_mul(arena, n[1], d[0]),
                               sunder_i_big_mul(arena, d[0], d[1]));
}

sunder_i_place_at sunder_i_place_of_double(const sunder_sum *sum, sunder_i_lattice *l, const double xy[2])
{
    sunder_i_arena *arena = &l->arena;
    sunder_i_big n[2], d[2];
    for (int k = 0; k < 2; k++) {
        int e;
        n[k] = sunder_i_big_double(arena, xy[k], &e);
        d[k] = sunder_i_big_i64(arena, 1);
        if (e >= 0)
            n[k] = two_to(arena, n[k], e);
        else
            d[k] = two_to(arena, d[k], -(long)e);
    }
    return sunder_i_place_of_rational(sum, l, n, d);
}

/* ---- Order ---- */

static int filter(const sunder_i_ground *g, double a, double b)
{
    const double d = a - b, bound = 2 * g->error;
    return d > bound ? 1 : d < -bound ? -1 : 0;
}

static int cmp_exact(const sunder_i_ground *g, sunder_i_big a, sunder_i_big aw, sunder_i_big b, sunder_i_big bw)
{
    sunder_i_arena *arena = &g->lattice->arena;
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    const int c = sunder_i_big_cmp(sunder_i_big_mul(arena, a, bw), sunder_i_big_mul(arena, b, aw));
    if (!arena->failed) sunder_i_arena_release(arena, mark);
    return c;
}

int sunder_i_place_cmp_y(const sunder_i_ground *g, const sunder_i_place_at *a, const sunder_i_place_at *b)
{
    const int c = filter(g, a->ay, b->ay);
    return c ? c : cmp_exact(g, a->y, a->w, b->y, b->w);
}

int sunder_i_place_cmp_x(const sunder_i_ground *g, const sunder_i_place_at *a, const sunder_i_place_at *b)
{
    const int c = filter(g, a->ax, b->ax);
    return c ? c : cmp_exact(g, a->x, a->w, b->x, b->w);
}

int sunder_i_place_cmp(const sunder_i_ground *g, const sunder_i_place_at *a, const sunder_i_place_at *b)
{
    const int c = sunder_i_place_cmp_x(g, a, b);
    return c ? c : sunder_i_place_cmp_y(g, a, b);
}

/* ---- Sides ---- */

/* Sign of cross(b - a, c - a) where doubles settle it, else 0. Each coordinate is off by at most e, so a difference by
 * at most 2 e + u |difference|, u = DBL_EPSILON / 2; with f = 2 e + 2 u |.| for both that and the roundings behind it,
 * the two products are off by at most f (|p| + |q|) + f^2 and a rounding each. */
static int filter_orient(const sunder_i_ground *g, const double a[2], const double b[2], const double c[2])
{
    const double px = b[0] - a[0], py = b[1] - a[1], qx = c[0] - a[0], qy = c[1] - a[1];
    const double size = fabs(px) + fabs(py) + fabs(qx) + fabs(qy);
    const double f = 2 * g->error + DBL_EPSILON * size;
    const double det = px * qy - py * qx;
    const double bound = 2 * f * (size + f) + 4 * DBL_EPSILON * (fabs(px * qy) + fabs(py * qx)) + DBL_MIN;
    return det > bound ? 1 : det < -bound ? -1 : 0;
}

/* The same in integers: with the points over aw, bw, cw > 0 the sign is that of the 3 x 3 determinant of their
 * homogeneous coordinates. */
static int exact_orient(const sunder_i_ground *g, const sunder_i_big a[3], const sunder_i_big b[3],
                        const sunder_i_big c[3])
{
    sunder_i_arena *m = &g->lattice->arena;
    const sunder_i_big bx = sunder_i_big_sub(m, sunder_i_big_mul(m, b[0], a[2]), sunder_i_big_mul(m, a[0], b[2]));
    const sunder_i_big by = sunder_i_big_sub(m, sunder_i_big_mul(m, b[1], a[2]), sunder_i_big_mul(m, a[1], b[2]));
    const sunder_i_big cx = sunder_i_big_sub(m, sunder_i_big_mul(m, c[0], a[2]), sunder_i_big_mul(m, a[0], c[2]));
    const sunder_i_big cy = sunder_i_big_sub(m, sunder_i_big_mul(m, c[1], a[2]), sunder_i_big_mul(m, a[1], c[2]));
    return sunder_i_big_cmp(sunder_i_big_mul(m, bx, cy), sunder_i_big_mul(m, by, cx));
}

int sunder_i_place_orient(const sunder_i_ground *g, const sunder_i_place_at *a, const sunder_i_place_at *b,
                          const sunder_i_place_at *c)
{
    const double pa[2] = {a->ax, a->ay}, pb[2] = {b->ax, b->ay}, pc[2] = {c->ax, c->ay};
    const int s = filter_orient(g, pa, pb, pc);
    if (s) return s;
    const sunder_i_mark mark = sunder_i_arena_mark(&g->lattice->arena);
    const sunder_i_big ha[3] = {a->x, a->y, a->w}, hb[3] = {b->x, b->y, b->w}, hc[3] = {c->x, c->y, c->w};
    const int e = exact_orient(g, ha, hb, hc);
    if (!g->lattice->arena.failed) sunder_i_arena_release(&g->lattice->arena, mark);
    return e;
}

static void corner_big(const sunder_i_ground *g, sunder_i_point p, sunder_i_big out[3])
{
    const sunder_i_vector v = sunder_i_vector_get(&g->lattice->arena, g->lattice, p);
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.w;
}

int sunder_i_side_of(const sunder_i_ground *g, sunder_i_near a, sunder_i_near b, const sunder_i_place_at *c)
{
    const double pc[2] = {c->ax, c->ay};
    const int s = filter_orient(g, a.at, b.at, pc);
    if (s) return s;
    const sunder_i_mark mark = sunder_i_arena_mark(&g->lattice->arena);
    sunder_i_big ha[3], hb[3];
    const sunder_i_big hc[3] = {c->x, c->y, c->w};
    corner_big(g, a.point, ha);
    corner_big(g, b.point, hb);
    const int e = exact_orient(g, ha, hb, hc);
    if (!g->lattice->arena.failed) sunder_i_arena_release(&g->lattice->arena, mark);
    return e;
}

int sunder_i_corner_side(const sunder_i_ground *g, const sunder_i_place_at *a, const sunder_i_place_at *b,
                         sunder_i_near c)
{
    const double pa[2] = {a->ax, a->ay}, pb[2] = {b->ax, b->ay};
    const int s = filter_orient(g, pa, pb, c.at);
    if (s) return s;
    const sunder_i_mark mark = sunder_i_arena_mark(&g->lattice->arena);
    const sunder_i_big ha[3] = {a->x, a->y, a->w}, hb[3] = {b->x, b->y, b->w};
    sunder_i_big hc[3];
    corner_big(g, c.point, hc);
    const int e = exact_orient(g, ha, hb, hc);
    if (!g->lattice->arena.failed) sunder_i_arena_release(&g->lattice->arena, mark);
    return e;
}

/* ---- Lengths ---- */

sunder_i_big sunder_i_place_distance(sunder_i_arena *m, const sunder_i_place_at *a, const sunder_i_place_at *b,
                                     unsigned long bits)
{
    const sunder_i_big dx = sunder_i_big_sub(m, sunder_i_big_mul(m, b->x, a->w), sunder_i_big_mul(m, a->x, b->w));
    const sunder_i_big dy = sunder_i_big_sub(m, sunder_i_big_mul(m, b->y, a->w), sunder_i_big_mul(m, a->y, b->w));
    const sunder_i_big square = sunder_i_big_norm(m, dx, dy);
    const sunder_i_big w = sunder_i_big_mul(m, a->w, b->w);
    if (m->failed) return (sunder_i_big){NULL, 0};
    /* sqrt(4^bits square) / w, each floored: floor(floor(r) / w) = floor(r / w) for an integer w. */
    return sunder_i_big_div_floor(m, sunder_i_big_sqrt_floor(m, sunder_i_big_shl(m, square, 2 * bits)), w);
}
