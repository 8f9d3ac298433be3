/* shape_on_lattice.c: places shapes on a lattice.
 *
 * A vertex x of a shape with the exact translation s is placed at x + s - o, o being the origin. On a small lattice, o
 * - s is split into a double c and an exact remainder d (two-sum), so that x - c is small and all integers fit. The
 * size of the remainder is part of the extent that the lattice must contain. On other lattices the three are simply
 * added. Vertices that are not doubles (crossings of a repaired shape) keep their denominators. */
#include "shape/rational_corners.h"

#include "predicate/predicate.h"

#include "base/extremes.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <string.h>

/* Returns the extent of the shape translated by s, rounded outwards. */
static sunder_i_extent shifted_extent(const sunder_shape *shape, const double *s)
{
    sunder_i_extent e = sunder_i_shape_extent(shape);
    if (!s || !e.any) return e;
    for (int k = 0; k < 2; k++) {
        if (s[k] == 0) continue;
        e.low[k] = nextafter(e.low[k] + s[k], -INFINITY);
        e.high[k] = nextafter(e.high[k] + s[k], INFINITY);
        const int b = sunder_i_low_bit(s[k]);
        if (b < e.low_bit) e.low_bit = b;
    }
    return e;
}

/* Limits bounds to the range of doubles. Returns false if one was beyond it; the lattice must then be wide. */
static bool clamp_extent(sunder_i_extent *e)
{
    bool inside = true;
    for (int k = 0; k < 2 && e->any; k++) {
        if (isfinite(e->low[k]) && isfinite(e->high[k])) continue;
        inside = false;
        e->low[k] = sunder_i_max(sunder_i_min(e->low[k], DBL_MAX), -DBL_MAX);
        e->high[k] = sunder_i_max(sunder_i_min(e->high[k], DBL_MAX), -DBL_MAX);
    }
    return inside;
}

static sunder_i_extent extent_union(const sunder_i_extent *a, const sunder_i_extent *b)
{
    if (!a->any) return *b;
    if (!b->any) return *a;
    sunder_i_extent u = *a;
    for (int k = 0; k < 2; k++) {
        u.low[k] = sunder_i_min(a->low[k], b->low[k]);
        u.high[k] = sunder_i_max(a->high[k], b->high[k]);
    }
    if (b->low_bit < u.low_bit) u.low_bit = b->low_bit;
    return u;
}

/* Adds the extent of the remainder of o - s, at most an ulp of the numbers in between. It is symmetric, so that its
 * origin is zero. */
static void remainder_extent(const sunder_i_extent *shifted, const double *s, sunder_i_extent *extra)
{
    for (int k = 0; k < 2; k++) {
        if (!s || s[k] == 0) continue;
        const double m = DBL_EPSILON * (fabs(shifted->low[k]) + fabs(shifted->high[k]) + 2 * fabs(s[k])) + DBL_TRUE_MIN;
        extra->any = true;
        extra->low[0] = extra->low[1] = sunder_i_min(extra->low[0], -m);
        extra->high[0] = extra->high[1] = sunder_i_max(extra->high[0], m);
        if (shifted->low_bit < extra->low_bit) extra->low_bit = shifted->low_bit;
    }
}

static bool is_zero(const double *s) { return !s || (s[0] == 0 && s[1] == 0); }

/* Computes the part of one coordinate that is the same for all vertices: x + s - o = int(x, *from) + the result. */
static int64_t common_part(sunder_i_lattice *l, double s, double o, double *from)
{
    if (s == 0) {
        *from = o;
        return 0;
    }
    if (!l->small || l->pooled) {
        *from = 0;
        return sunder_i_lattice_int(l, s, o);
    }
    const double c = o - s, bb = c - o, rest = (o - (c - bb)) + (-s - bb); /* Knuth's two-sum */
    *from = c;
    return sunder_i_lattice_int(l, -rest, 0);
}

/* ---- Vertices that are not doubles ---- */

sunder_i_point sunder_i_place_exact(sunder_i_lattice *lattice, const sunder_i_exact *corner, const double *shift,
                                    const double origin[2])
{
    if (lattice->arena.failed) return (sunder_i_point){0, 0};
    const sunder_i_mark mark = sunder_i_lattice_begin(lattice);
    sunder_i_arena *m = &lattice->scratch;
    /* Origin and translation are multiples of the lattice's unit, and the numerators of a crossing of its lines have no
     * lower bits; those of one from another lattice may, and its denominator is then scaled. */
    const long unit = corner->exponent < lattice->exponent ? corner->exponent : lattice->exponent;
    const sunder_i_big den = sunder_i_big_shl(m, corner->den, (unsigned long)(lattice->exponent - unit));
    sunder_i_big at[2];
    for (int k = 0; k < 2; k++) {
        sunder_i_big add = sunder_i_big_neg(sunder_i_big_in_units(m, origin[k], unit));
        if (shift) add = sunder_i_big_add(m, add, sunder_i_big_in_units(m, shift[k], unit));
        at[k] = sunder_i_big_shl(m, corner->num[k], (unsigned long)(corner->exponent - unit));
        at[k] = sunder_i_big_add(m, at[k], sunder_i_big_mul(m, add, corner->den));
    }
    const sunder_i_point p = sunder_i_rational_put(lattice, (sunder_i_rational_point){at[0], at[1], den});
    sunder_i_lattice_end(lattice, mark);
    return p;
}

static void place_corners(sunder_i_lattice *l, const sunder_shape *shape, const double *shift, const double origin[2],
                          sunder_i_point *out)
{
    for (uint32_t i = 0; i < shape->vertices; i++)
        if (shape->form->numbers->exact[i].den.size)
            out[i] = sunder_i_place_exact(l, &shape->form->numbers->exact[i], shift, origin);
}

/* ---- Shapes ---- */

static void place_doubles(sunder_i_lattice *l, const sunder_shape *shape, const double *shift, const double origin[2],
                          sunder_i_point *out)
{
    static const double none[2] = {0, 0};
    const double *s = shift ? shift : none;
    double from[2];
    const sunder_i_point add = {common_part(l, s[0], origin[0], &from[0]), common_part(l, s[1], origin[1], &from[1])};
    const bool adds = !is_zero(shift);
    if (!adds && !shape->rational) {
        sunder_i_lattice_points(l, shape->xy, shape->vertices, from, out);
        return;
    }
    for (uint32_t i = 0; i < shape->vertices; i++) {
        if (shape->rational && shape->form->numbers->exact[i].den.size) continue;
        out[i].x = sunder_i_lattice_int(l, shape->xy[2 * (size_t)i], from[0]);
        out[i].y = sunder_i_lattice_int(l, shape->xy[2 * (size_t)i + 1], from[1]);
        if (adds) out[i] = sunder_i_point_add(l, out[i], add);
    }
    if (shape->rational) place_corners(l, shape, shift, origin, out);
}

static sunder_status finish_placing(sunder_i_placed *out, sunder_error *err)
{
    if (!out->lattice.arena.failed) return SUNDER_OK;
    sunder_i_placed_free(out);
    return sunder_i_failure_cause(err);
}

/* Reflects q and its origin. */
static void reflect_operand(sunder_i_placed *placed, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) placed->q[i] = sunder_i_point_neg(&placed->lattice, placed->q[i]);
    for (int k = 0; k < 2; k++) placed->origin_q[k] = placed->origin_q[k] == 0 ? 0 : -placed->origin_q[k];
}

static sunder_status make_room(const sunder_shape *p, const sunder_shape *q, sunder_i_placed *out, sunder_error *err)
{
    const size_t n = p->vertices, m = q ? q->vertices : 0;
    out->p = sunder_i_alloc(n + m, sizeof *out->p);
    if (!out->p) return sunder_i_failure_cause(err);
    out->q = out->p + n;
    return SUNDER_OK;
}

sunder_status sunder_i_place(const sunder_shape *p, const sunder_shape *q, const sunder_i_place_options *options,
                             sunder_i_placed *result, sunder_error *err)
{
    static const sunder_i_place_options plain = {0};
    const sunder_i_place_options *const o = options ? options : &plain;
    sunder_i_placed placed, *const out = &placed;
    memset(out, 0, sizeof *out);
    sunder_status status = make_room(p, q, out, err);
    if (status) return status;
    const sunder_shape *const shape[2] = {p, q};
    const double *const shift[2] = {o->shift_p, o->shift_q};
    const bool rational = p->rational || (q && q->rational);
    sunder_i_extent extent[4] = {shifted_extent(p, shift[0])};
    if (q) extent[1] = shifted_extent(q, shift[1]);
    if (o->common_origin) extent[0] = extent[1] = extent_union(&extent[0], &extent[1]);
    extent[2].low_bit = INT_MAX;
    for (int i = 0; i < 2; i++)
        if (shape[i] && extent[i].any) remainder_extent(&extent[i], shift[i], &extent[2]);
    /* further doubles, as an extent symmetric about zero in both coordinates */
    for (size_t i = 0; i < o->extra_n; i++) {
        const double v = fabs(o->extra[i]), corner[4] = {-v, -v, v, v};
        sunder_i_extent_add(&extent[3], corner, 2);
    }
    double origin[4][2];
    bool overflow = false;
    for (int i = 0; i < 3; i++) overflow |= !clamp_extent(&extent[i]);
    sunder_i_lattice_init(&out->lattice, extent, 4, !overflow, origin, o->force_wide || overflow);
    if (rational) sunder_i_lattice_admit_ratios(&out->lattice);
    memcpy(out->origin_p, origin[0], sizeof origin[0]);
    memcpy(out->origin_q, origin[1], sizeof origin[1]);
    place_doubles(&out->lattice, p, shift[0], out->origin_p, out->p);
    if (q) place_doubles(&out->lattice, q, shift[1], out->origin_q, out->q);
    if (q && o->reflect_q) reflect_operand(out, q->vertices);
    status = finish_placing(out, err);
    if (status) return status;
    *result = placed;
    return SUNDER_OK;
}

void sunder_i_placed_free(sunder_i_placed *placed)
{
    sunder_i_lattice_free(&placed->lattice);
    sunder_i_free(placed->p);
    placed->p = placed->q = NULL;
}
