/* filtered_point.c: makes exact points with approximate doubles, compares them and computes orientations. A test is
 * decided first by the doubles, whose error is bounded: by a difference, or by a 2 x 2 determinant with an error bound.
 * If they do not decide it, the exact coordinates, which are big integers, do. */
#include "motion/filtered_point.h"

#include <float.h>
#include <math.h>

/* ---- Construction ---- */

sunder_i_filtered_point sunder_i_filtered_make(sunder_i_lattice *lattice, sunder_i_rational_point at)
{
    sunder_i_filtered_point p = {at, 0, 0};
    if (lattice->arena.failed) return p;
    sunder_i_arena scratch = {0};
    sunder_i_rational_doubles(&scratch, at, -lattice->approx_shift, &p.ax, &p.ay);
    if (scratch.failed) lattice->arena.failed = true;
    sunder_i_arena_free(&scratch);
    return p;
}

sunder_i_filtered_point sunder_i_filtered_of_vertex(sunder_i_lattice *lattice, const sunder_i_hpoint *vertex)
{
    return sunder_i_filtered_make(lattice, sunder_i_hpoint_read(&lattice->arena, lattice, vertex));
}

static sunder_i_big two_to(sunder_i_arena *arena, sunder_i_big a, long e)
{
    return sunder_i_big_shl(arena, a, (unsigned long)e);
}

/* Returns the coordinate v minus both origins of the sum, in lattice units. */
static sunder_i_ratio on_lattice(const sunder_sum *sum, sunder_i_arena *arena, int axis, sunder_i_ratio v)
{
    const sunder_i_lattice *l = &sum->lattice;
    for (int operand = 0; operand < 2; operand++) {
        int e;
        const sunder_i_big o = sunder_i_big_double(arena, sum->origin[operand][axis], &e);
        if (o.size == 0) continue;
        sunder_i_big part = sunder_i_big_mul(arena, o, v.den);
        if (e >= 0) {
            part = two_to(arena, part, e);
        } else {
            v.num = two_to(arena, v.num, -(long)e);
            v.den = two_to(arena, v.den, -(long)e);
        }
        v.num = sunder_i_big_sub(arena, v.num, part);
    }
    if (l->exponent < 0)
        v.num = two_to(arena, v.num, -l->exponent);
    else
        v.den = two_to(arena, v.den, l->exponent);
    return sunder_i_ratio_reduced(arena, v);
}

sunder_i_filtered_point sunder_i_filtered_of_rational(const sunder_sum *sum, sunder_i_lattice *lattice,
                                                      sunder_i_ratio x, sunder_i_ratio y)
{
    sunder_i_arena *arena = &lattice->arena;
    x = on_lattice(sum, arena, 0, x);
    y = on_lattice(sum, arena, 1, y);
    return sunder_i_filtered_make(lattice, (sunder_i_rational_point){sunder_i_big_mul(arena, x.num, y.den),
                                                                     sunder_i_big_mul(arena, y.num, x.den),
                                                                     sunder_i_big_mul(arena, x.den, y.den)});
}

sunder_i_filtered_point sunder_i_filtered_of_double(const sunder_sum *sum, sunder_i_lattice *lattice,
                                                    const double xy[2])
{
    return sunder_i_filtered_of_rational(sum, lattice, sunder_i_ratio_double(&lattice->arena, xy[0]),
                                         sunder_i_ratio_double(&lattice->arena, xy[1]));
}

/* ---- Order ---- */

static int filter_cmp(const sunder_i_filter *g, double a, double b)
{
    const double d = a - b, bound = 2 * g->error;
    return d > bound ? 1 : d < -bound ? -1 : 0;
}

static int coordinate_cmp(const sunder_i_filter *g, const sunder_i_filtered_point *a, const sunder_i_filtered_point *b,
                          int axis)
{
    const int c = axis ? filter_cmp(g, a->ay, b->ay) : filter_cmp(g, a->ax, b->ax);
    if (c) return c;
    sunder_i_arena *arena = &g->lattice->arena;
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    const int e = sunder_i_rational_cmp(arena, &a->at, &b->at, axis);
    if (!arena->failed) sunder_i_arena_release(arena, mark);
    return e;
}

int sunder_i_filtered_cmp_y(const sunder_i_filter *g, const sunder_i_filtered_point *a,
                            const sunder_i_filtered_point *b)
{
    return coordinate_cmp(g, a, b, 1);
}

int sunder_i_filtered_cmp_x(const sunder_i_filter *g, const sunder_i_filtered_point *a,
                            const sunder_i_filtered_point *b)
{
    return coordinate_cmp(g, a, b, 0);
}

int sunder_i_filtered_cmp(const sunder_i_filter *g, const sunder_i_filtered_point *a, const sunder_i_filtered_point *b)
{
    const int c = sunder_i_filtered_cmp_x(g, a, b);
    return c ? c : sunder_i_filtered_cmp_y(g, a, b);
}

/* ---- Orientation ---- */

/* Returns the sign of cross(b - a, c - a) if doubles decide it, else 0. Each coordinate has an error of at most e, so
 * that a difference has one of at most 2 e + u |difference|, u = DBL_EPSILON / 2. With f = 2 e + 2 u |.|, which bounds
 * this and the rounding errors that follow, the two products have errors of at most f (|p| + |q|) + f^2 and one
 * rounding each. */
static int filter_orient(const sunder_i_filter *g, const double a[2], const double b[2], const double c[2])
{
    const double px = b[0] - a[0], py = b[1] - a[1], qx = c[0] - a[0], qy = c[1] - a[1];
    const double size = fabs(px) + fabs(py) + fabs(qx) + fabs(qy);
    const double f = 2 * g->error + DBL_EPSILON * size;
    const double det = px * qy - py * qx;
    const double bound = 2 * f * (size + f) + 4 * DBL_EPSILON * (fabs(px * qy) + fabs(py * qx)) + DBL_MIN;
    return det > bound ? 1 : det < -bound ? -1 : 0;
}

int sunder_i_filtered_orient(const sunder_i_filter *g, const sunder_i_filtered_point *a,
                             const sunder_i_filtered_point *b, const sunder_i_filtered_point *c)
{
    const double pa[2] = {a->ax, a->ay}, pb[2] = {b->ax, b->ay}, pc[2] = {c->ax, c->ay};
    const int s = filter_orient(g, pa, pb, pc);
    if (s) return s;
    const sunder_i_mark mark = sunder_i_arena_mark(&g->lattice->arena);
    const int e = sunder_i_rational_orient(&g->lattice->arena, a->at, b->at, c->at);
    if (!g->lattice->arena.failed) sunder_i_arena_release(&g->lattice->arena, mark);
    return e;
}

static sunder_i_rational_point exact_point(const sunder_i_filter *g, sunder_i_lattice_corner p)
{
    return sunder_i_rational_get(&g->lattice->arena, g->lattice, p.point);
}

int sunder_i_filtered_side(const sunder_i_filter *g, sunder_i_lattice_corner a, sunder_i_lattice_corner b,
                           const sunder_i_filtered_point *c)
{
    const double pc[2] = {c->ax, c->ay};
    const int s = filter_orient(g, a.at, b.at, pc);
    if (s) return s;
    const sunder_i_mark mark = sunder_i_arena_mark(&g->lattice->arena);
    const int e = sunder_i_rational_orient(&g->lattice->arena, exact_point(g, a), exact_point(g, b), c->at);
    if (!g->lattice->arena.failed) sunder_i_arena_release(&g->lattice->arena, mark);
    return e;
}

int sunder_i_filtered_corner_side(const sunder_i_filter *g, const sunder_i_filtered_point *a,
                                  const sunder_i_filtered_point *b, sunder_i_lattice_corner c)
{
    const double pa[2] = {a->ax, a->ay}, pb[2] = {b->ax, b->ay};
    const int s = filter_orient(g, pa, pb, c.at);
    if (s) return s;
    const sunder_i_mark mark = sunder_i_arena_mark(&g->lattice->arena);
    const int e = sunder_i_rational_orient(&g->lattice->arena, a->at, b->at, exact_point(g, c));
    if (!g->lattice->arena.failed) sunder_i_arena_release(&g->lattice->arena, mark);
    return e;
}
