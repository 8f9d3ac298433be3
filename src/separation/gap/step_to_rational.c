/* Off a free point that is irrational, to a rational one. The grown subsums that touch there are convex, so each lies
 * behind the line through the point across the normal of its contact: whoever goes where all normals point, or at right
 * angles to them, is free of all these, however far. The other subsums are farther than the gap, so a small enough step
 * is free of them too: the step is made smaller, and the numbers longer, until the exact test agrees.
 *
 * There always is room: a point that is held on all sides is rational, and one between two opposite contacts lies on a
 * rational line. A side of normal n (integers) and length L = |n| says n.p = c + g L, with c an integer and g rational,
 * a corner says |p - a| = g.
 *
 * Opposite contacts. Two sides, n = -k m: adding up, 2 g L is rational, so is L, and the line n.p = c + g L. A side and
 * a corner: n.a = c + 2 g L, so L is rational and p = a - g n / L. Two corners: p is the middle.
 *
 * Held on all sides, a point has among its contacts two opposite pairs (on two rational lines, so it is rational), or
 * three whose normals n1, n2, n3 have l1 n1 + l2 n2 + l3 n3 = 0 with all l > 0, no two parallel:
 *   - three sides: the l are rational, and l1 L1 + l2 L2 + l3 L3 is. Roots of integers do not cancel with positive
 *     factors: all L are rational.
 *   - three corners: their circle has a rational center.
 *   - a side and two corners: p = m + t v, m the middle of the corners, v the way between them turned by a right angle,
 *     and t^2 rational. Suppose t is not. If n.v = 0, the way +-v is open. Else t = (c - n.m + g L) / n.v, and as its
 *     square is rational but t is not, L is irrational and c = n.m; then g L = t n.v <= |t v| L < g L.
 *   - two sides and a corner: w = (p - a) / g has |w| = 1 and n_i.w = r_i + L_i, r_i rational. Let e_1, e_2 be the
 *     basis with n_i.e_j = 0 or 1, so that w = sum (r_i + L_i) e_i, and s the angle of the normals: |L_i e_i| = 1 / sin
 *     s. Suppose some L is irrational; what stands beside each root in |w|^2 is zero. If both are, of one root: 1 =
 *     |r_1 e_1 + r_2 e_2|^2 + |z|^2 with z.n_i = L_i, so |z| = 1 / cos(s / 2) > 1. Of two roots: r = 0 and e_1.e_2 = 0,
 *     so |w|^2 = 2. If L_2 alone: 1 = (r_1 + L_1)^2 / L_1^2 + 1 / sin(s)^2, so n_1.w = 0 and w is the unit normal of
 *     side 2, not against it. */
#include "separation/gap/gap_search.h"

#include "predicate/rational_point.h"

#include "base/extremes.h"

#include <float.h>
#include <math.h>

/* ---- Room ---- */

typedef struct normal {
    sunder_i_surd x, y;
    sunder_i_big over; /* of a corner: the way from there, times the point's w and this */
} normal;

/* The contact's normal, exactly, of some length. */
static normal normal_of(sunder_i_gap_state *s, const sunder_i_surd_point *at, const sunder_i_gap_contact *c)
{
    sunder_i_lattice *l = &s->g->placed.lattice;
    sunder_i_arena *a = &l->arena;
    const sunder_i_subsum *m = s->g->subsum + c->of;
    const sunder_i_point p = c->flat ? m->side[c->at] : m->corner[c->at];
    const sunder_i_rational_point v = sunder_i_rational_get(a, l, p);
    if (c->flat) return (normal){sunder_i_surd_big(a, v.y), sunder_i_surd_big(a, sunder_i_big_neg(v.x)), v.w};
    return (normal){
        sunder_i_surd_sub(a, sunder_i_surd_scale(a, at->x, v.w), sunder_i_surd_big(a, sunder_i_big_mul(a, v.x, at->w))),
        sunder_i_surd_sub(a, sunder_i_surd_scale(a, at->y, v.w), sunder_i_surd_big(a, sunder_i_big_mul(a, v.y, at->w))),
        v.w};
}

/* Sign of n_i x n_j, or of n_i . n_j. The normals of sides are good to 8 u, those of corners to the point's error over
 * the gap as well. */
static int sign_of(sunder_i_gap_state *s, const sunder_i_gap_free_point *f, size_t i, size_t j, bool dot)
{
    const sunder_i_gap_contact *c = f->contact + i, *d = f->contact + j;
    const double value = dot ? c->nx * d->nx + c->ny * d->ny : c->nx * d->ny - c->ny * d->nx;
    const double doubt = 4 * (8 * DBL_EPSILON + (f->error + s->error) / s->gap);
    if (fabs(value) > doubt) return value > 0 ? 1 : -1;
    if (c->flat && d->flat) {
        const sunder_i_point u = s->g->subsum[c->of].side[c->at], v = s->g->subsum[d->of].side[d->at];
        return dot ? sunder_i_operands_dot(s->g, u, v) : sunder_i_operands_cross(s->g, u, v);
    }
    sunder_i_arena *a = &s->g->placed.lattice.arena;
    const sunder_i_mark mark = sunder_i_arena_mark(a);
    const sunder_i_roots *roots = &f->exact.roots;
    const normal n = normal_of(s, &f->exact, c), m = normal_of(s, &f->exact, d);
    const sunder_i_surd v =
        dot ? sunder_i_surd_add(a, sunder_i_surd_mul(a, roots, n.x, m.x), sunder_i_surd_mul(a, roots, n.y, m.y))
            : sunder_i_surd_sub(a, sunder_i_surd_mul(a, roots, n.x, m.y), sunder_i_surd_mul(a, roots, n.y, m.x));
    const int sign = sunder_i_surd_sign(a, roots, v);
    sunder_i_arena_release(a, mark);
    return sign;
}

/* Is the normal of contact i turned by a right angle, to the left (turn 1) or right (-1), a way to go? */
static bool may_turn(sunder_i_gap_state *s, const sunder_i_gap_free_point *f, size_t i, int turn)
{
    for (size_t k = 0; k < f->contacts; k++)
        if (k != i && turn * sign_of(s, f, i, k, false) < 0) return false;
    return true;
}

sunder_i_gap_way sunder_i_gap_way_off(sunder_i_gap_state *s, const sunder_i_gap_free_point *at)
{
    bool same = true;
    for (size_t k = 1; k < at->contacts && same; k++)
        same = sign_of(s, at, 0, k, false) == 0 && sign_of(s, at, 0, k, true) > 0;
    if (same) return (sunder_i_gap_way){SUNDER_I_ROOM_HALF, 0, 0};
    sunder_i_gap_way way = {SUNDER_I_ROOM_OPEN, -1, -1};
    for (size_t k = 0; k < at->contacts; k++) {
        if (way.left < 0 && may_turn(s, at, k, 1)) way.left = (long)k;
        if (way.right < 0 && may_turn(s, at, k, -1)) way.right = (long)k;
    }
    if (way.left < 0 || way.right < 0) {
        way.room = way.left < 0 && way.right < 0 ? SUNDER_I_ROOM_NONE : SUNDER_I_ROOM_LINE;
        return way;
    }
    /* Between the two all is strictly clear, unless some normal is at right angles to both. */
    for (size_t k = 0; k < at->contacts; k++)
        if (sign_of(s, at, (size_t)way.left, k, false) == 0 && sign_of(s, at, k, (size_t)way.right, false) == 0)
            way.room = SUNDER_I_ROOM_LINE;
    return way;
}

/* ---- Steps ---- */

/* Ways narrower than this are left to exact steps: doubles would have to go too far along them to get off. */
#define NARROW 0x1p-20
/* The first step is some ulps long, so that doubles beside the point differ from it; each further step is 8 times as
 * long, DOUBLES_TRIED steps in all. */
#define FIRST_STEP 0x1p-49
#define DOUBLES_TRIED 8

/* To a place of doubles of the caller's units, where those are fine enough: what users like best. */
static bool to_doubles(sunder_i_gap_state *s, const sunder_i_gap_free_point *f, const sunder_i_gap_contact *a,
                       const sunder_i_gap_contact *b, const sunder_i_big xy[2], unsigned long bits,
                       sunder_i_surd_point *out)
{
    const double unit = s->g->unit;
    if (!(unit > 0 && unit < INFINITY)) return false;
    /* Where the way between a and b is wide, the middle of it. */
    double ux = a->nx + b->nx, uy = a->ny + b->ny, gain = 1;
    const double f1 = sunder_i_gap_length(ux, uy);
    if (!(f1 > NARROW)) return false;
    ux /= f1;
    uy /= f1;
    for (size_t k = 0; k < f->contacts; k++) gain = sunder_i_min(gain, ux * f->contact[k].nx + uy * f->contact[k].ny);
    if (!(gain > NARROW)) return false;
    const double x = sunder_i_gap_big(xy[0], -(long)bits - s->g->placed.lattice.approx_shift);
    const double y = sunder_i_gap_big(xy[1], -(long)bits - s->g->placed.lattice.approx_shift);
    const double size = sunder_i_gap_length(x, y);
    double step = FIRST_STEP * size / gain;
    for (int round = 0; round < DOUBLES_TRIED && step <= size * SUNDER_I_GAP_LONGER; round++, step *= 8) {
        const double dx = (x + ux * step) * unit, dy = (y + uy * step) * unit;
        if (!isfinite(dx) || !isfinite(dy)) return false;
        *out = sunder_i_surd_point_doubles(s->g, dx, dy);
        if (sunder_i_gap_is_free(s, out)) return true;
    }
    return false;
}

/* The unit normal of a contact times 2^bits, within 4. */
static void unit_normal(sunder_i_gap_state *s, const sunder_i_surd_point *at, const sunder_i_gap_contact *c,
                        unsigned long bits, sunder_i_big n[2])
{
    sunder_i_arena *a = &s->g->placed.lattice.arena;
    const normal exact = normal_of(s, at, c);
    const sunder_i_surd part[2] = {exact.x, exact.y};
    if (c->flat) {
        const sunder_i_big x = part[0].part[0], y = part[1].part[0];
        const sunder_i_big square = sunder_i_big_norm(a, x, y);
        const sunder_i_big length = sunder_i_big_sqrt_floor(a, sunder_i_big_shl(a, square, 2 * bits));
        for (int k = 0; k < 2; k++)
            n[k] = sunder_i_big_div_floor(a, sunder_i_big_shl(a, part[k].part[0], 2 * bits), length);
        return;
    }
    const sunder_i_big length = sunder_i_times(a, sunder_i_big_mul(a, s->p->gap, at->w), exact.over);
    for (int k = 0; k < 2; k++)
        n[k] = sunder_i_big_div_floor(a, sunder_i_surd_scaled(a, &at->roots, part[k], bits + s->p->gap_bits), length);
}

/* A step of 2^size lattice units into the open, in numbers of `bits` digits and with normals of `digits`. */
static void step_off(sunder_i_gap_state *s, const sunder_i_gap_free_point *f, size_t i, size_t j, long size,
                     unsigned long bits, unsigned long digits, sunder_i_surd_point *out)
{
    sunder_i_arena *a = &s->g->placed.lattice.arena;
    sunder_i_big at[2], n[2], m[2];
    sunder_i_surd_point_scaled(s->g, &f->exact, bits, at);
    unit_normal(s, &f->exact, f->contact + i, digits, n);
    unit_normal(s, &f->exact, f->contact + j, digits, m);
    /* The middle between the normals; where they are far from each other that cancels, and is said by the ways: n
     * turned left and m turned right. */
    const bool wide = sign_of(s, f, i, j, true) < 0;
    const sunder_i_big u[2] = {wide ? sunder_i_big_sub(a, m[1], n[1]) : sunder_i_big_add(a, n[0], m[0]),
                               wide ? sunder_i_big_sub(a, n[0], m[0]) : sunder_i_big_add(a, n[1], m[1])};
    const unsigned long shift = (unsigned long)(size + (long)bits);
    for (int k = 0; k < 2; k++)
        at[k] = sunder_i_big_add(a, at[k], sunder_i_big_shr(a, sunder_i_big_shl(a, u[k], shift), digits));
    *out = sunder_i_surd_point_rational(
        s->g, (sunder_i_rational_point){at[0], at[1], sunder_i_big_shl(a, sunder_i_big_i64(a, 1), bits)});
}

/* The same along the line between opposite contacts, the way that contact i turned left (turn 1) or right shows. */
static bool step_along(sunder_i_gap_state *s, const sunder_i_gap_free_point *f, size_t i, int turn, long size,
                       unsigned long bits, sunder_i_surd_point *out)
{
    sunder_i_arena *a = &s->g->placed.lattice.arena;
    size_t k = 0;
    while (k < f->contacts && !(f->contact[k].flat && sign_of(s, f, i, k, false) == 0)) k++;
    if (k == f->contacts) return false;
    const sunder_i_subsum *m = s->g->subsum + f->contact[k].of;
    const sunder_i_gap_curve wall = {false, m->corner[f->contact[k].at], m->side[f->contact[k].at]};
    const bool ahead = (sign_of(s, f, i, k, true) > 0) == (turn > 0); /* the side is its normal turned left */
    const unsigned long shift = (unsigned long)(size + (long)bits);
    const sunder_i_big step = sunder_i_big_shl(a, sunder_i_big_i64(a, ahead ? 1 : -1), shift);
    sunder_i_big along;
    if (!sunder_i_gap_position(s->p, &wall, &f->exact, bits, &along)) return false;
    return sunder_i_gap_along(s->p, &wall, sunder_i_big_add(a, along, step), bits, out);
}

/* Steps from 2^-33 of the length downwards, each round with twice as many digits more than the last: a way as narrow as
 * an angle of 2^-n is hit with n digits. */
#define ROUNDS_MAX 12

bool sunder_i_gap_rational_beside(sunder_i_gap_state *s, const sunder_i_gap_free_point *found,
                                  const sunder_i_gap_way *way, const sunder_i_big xy[2], unsigned long bits,
                                  sunder_i_surd_point *out)
{
    const long i = way->left, j = way->right;
    if (way->room == SUNDER_I_ROOM_NONE || found->contacts == 0) return false;
    const bool open = way->room == SUNDER_I_ROOM_OPEN || way->room == SUNDER_I_ROOM_HALF;
    if (open && to_doubles(s, found, found->contact + i, found->contact + j, xy, bits, out)) return true;
    /* The greater coordinate is at least 2^size. */
    const unsigned long u = sunder_i_big_bits(xy[0]), v = sunder_i_big_bits(xy[1]);
    const long size = (long)(u > v ? u : v) - 2 - (long)bits;
    for (int round = 0; round < ROUNDS_MAX && !s->failed && !s->g->placed.lattice.arena.failed; round++) {
        const long digits = 64L << round, step = size - 33 - (digits - 64) / 2;
        const long fine = digits - step > 0 ? digits - step : 0;
        if (open)
            step_off(s, found, (size_t)i, (size_t)j, step, (unsigned long)fine, (unsigned long)digits, out);
        else if (!step_along(s, found, (size_t)(i >= 0 ? i : j), i >= 0 ? 1 : -1, step, (unsigned long)fine, out))
            return false;
        if (sunder_i_gap_is_free(s, out)) return true;
    }
    return false;
}
