/* step_to_rational.c: from a free irrational point to a rational one near it. The grown subsums that touch the point
 * are convex, so that each lies behind the line through the point perpendicular to the normal of its contact: any step
 * whose direction has no negative product with any of the normals stays clear of all of them. The other subsums are
 * farther than the gap, so that a sufficiently small step stays clear of them, too: steps become smaller, and numbers
 * longer, until the exact test succeeds.
 *
 * Such a step always exists: a point where every direction is blocked is rational, and a point between two opposite
 * contacts lies on a rational line. A side with the normal n (integers) and length L = |n| gives n.p = c + g L, with an
 * integer c and a rational g; a vertex gives |p - a| = g.
 *
 * Opposite contacts. Two sides, n = -k m: by addition 2 g L is rational, so is L, and with it the line n.p = c + g L. A
 * side and a vertex: n.a = c + 2 g L, so L is rational and p = a - g n / L. Two vertices: p is their midpoint.
 *
 * A point where every direction is blocked has two opposite pairs among its contacts (it is on two rational lines,
 * hence rational), or three contacts with normals n1, n2, n3 and l1 n1 + l2 n2 + l3 n3 = 0, all l > 0, no two parallel:
 *   - three sides: the l are rational, and so is l1 L1 + l2 L2 + l3 L3. Roots of integers with positive factors do not
 *     cancel: all L are rational.
 *   - three vertices: the circle through them has a rational centre.
 *   - a side and two vertices: p = m + t v, m the midpoint of the vertices, v their difference turned by a right angle,
 *     and t^2 rational. Suppose that t is irrational. If n.v = 0, the direction +-v is free. Else t = (c - n.m + g L) /
 *     n.v, and since its square is rational but t is not, L is irrational and c = n.m; then g L = t n.v <= |t v| L <
 *     g L.
 *   - two sides and a vertex: w = (p - a) / g has |w| = 1 and n_i.w = r_i + L_i, r_i rational. Let e_1, e_2 be the
 *     basis with n_i.e_j = 0 or 1, so that w = sum (r_i + L_i) e_i, and s the angle of the normals: |L_i e_i| = 1 / sin
 *     s. Suppose that some L is irrational; the coefficient of each root in |w|^2 is zero. If both are, with the same
 *     root: 1 = |r_1 e_1 + r_2 e_2|^2 + |z|^2 with z.n_i = L_i, so |z| = 1 / cos(s / 2) > 1. With two roots: r = 0 and
 *     e_1.e_2 = 0, so |w|^2 = 2. If L_2 alone is: 1 = (r_1 + L_1)^2 / L_1^2 + 1 / sin(s)^2, so n_1.w = 0 and w is the
 *     unit normal of side 2, not opposite to it. */
#include "separation/gap/gap_search.h"

#include "predicate/rational_point.h"

#include "base/extremes.h"

#include <float.h>
#include <math.h>

/* ---- Free directions ---- */

typedef struct normal {
    sunder_i_surd x, y;
    sunder_i_big over; /* (x, y) is the outward normal of the side times `over` or, for a vertex, the vector from the
                        * vertex to the point, times the point's w and `over` */
} normal;

/* Returns the exact normal of a contact; its length is arbitrary. */
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

/* Returns the sign of n_i x n_j or, if `dot`, of n_i . n_j, for the normals of the contacts i and j of f. In doubles
 * the normals of sides have a relative error of 8 u; those of vertices have also the point's error divided by the
 * gap. */
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

/* Returns whether the normal of contact i, turned by a right angle to the left (turn 1) or right (-1), is a free
 * direction. */
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
    /* every direction between the two is free of all contacts, unless some normal is perpendicular to both */
    for (size_t k = 0; k < at->contacts; k++)
        if (sign_of(s, at, (size_t)way.left, k, false) == 0 && sign_of(s, at, k, (size_t)way.right, false) == 0)
            way.room = SUNDER_I_ROOM_LINE;
    return way;
}

/* ---- Steps ---- */

/* Sectors of free directions narrower than this are left to exact steps, since doubles would have to go too far to
 * leave the boundary. */
#define NARROW 0x1p-20
/* The first step is some ulps long, so that doubles near the point differ from it; each further one is 8 times as long.
 * DOUBLES_TRIED is the number of steps. */
#define FIRST_STEP 0x1p-49
#define DOUBLES_TRIED 8

/* Tries points whose coordinates are doubles in the caller's units, which users prefer. Returns false if none of them
 * is free. */
static bool to_doubles(sunder_i_gap_state *s, const sunder_i_gap_free_point *f, const sunder_i_gap_contact *a,
                       const sunder_i_gap_contact *b, const sunder_i_big xy[2], unsigned long bits,
                       sunder_i_surd_point *out)
{
    const double unit = s->g->unit;
    if (!(unit > 0 && unit < INFINITY)) return false;
    /* the bisector of the normals of a and b, if it is well defined */
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

/* Sets n to 2^bits times the unit normal of a contact, with an error of at most 4. */
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

/* *out becomes the point plus a step of 2^size lattice units in a free direction between the contacts i and j; the
 * point is computed to `bits` bits after the point and the normals to `digits` bits. */
static void step_off(sunder_i_gap_state *s, const sunder_i_gap_free_point *f, size_t i, size_t j, long size,
                     unsigned long bits, unsigned long digits, sunder_i_surd_point *out)
{
    sunder_i_arena *a = &s->g->placed.lattice.arena;
    sunder_i_big at[2], n[2], m[2];
    sunder_i_surd_point_scaled(s->g, &f->exact, bits, at);
    unit_normal(s, &f->exact, f->contact + i, digits, n);
    unit_normal(s, &f->exact, f->contact + j, digits, m);
    /* The direction is the sum of the normals n and m. If the angle between them is obtuse this sum cancels, and the
     * sum of n turned left and m turned right is used. */
    const bool wide = sign_of(s, f, i, j, true) < 0;
    const sunder_i_big u[2] = {wide ? sunder_i_big_sub(a, m[1], n[1]) : sunder_i_big_add(a, n[0], m[0]),
                               wide ? sunder_i_big_sub(a, n[0], m[0]) : sunder_i_big_add(a, n[1], m[1])};
    const unsigned long shift = (unsigned long)(size + (long)bits);
    for (int k = 0; k < 2; k++)
        at[k] = sunder_i_big_add(a, at[k], sunder_i_big_shr(a, sunder_i_big_shl(a, u[k], shift), digits));
    *out = sunder_i_surd_point_rational(
        s->g, (sunder_i_rational_point){at[0], at[1], sunder_i_big_shl(a, sunder_i_big_i64(a, 1), bits)});
}

/* *out becomes the point plus a step along the line between opposite contacts, in the direction of the normal of
 * contact i turned left (turn 1) or right (-1). Returns false if no rational line is known. */
static bool step_along(sunder_i_gap_state *s, const sunder_i_gap_free_point *f, size_t i, int turn, long size,
                       unsigned long bits, sunder_i_surd_point *out)
{
    sunder_i_arena *a = &s->g->placed.lattice.arena;
    size_t k = 0;
    while (k < f->contacts && !(f->contact[k].flat && sign_of(s, f, i, k, false) == 0)) k++;
    if (k == f->contacts) return false;
    const sunder_i_subsum *m = s->g->subsum + f->contact[k].of;
    const sunder_i_gap_curve wall = {false, m->corner[f->contact[k].at], m->side[f->contact[k].at]};
    /* the side's direction is its normal turned left */
    const bool ahead = (sign_of(s, f, i, k, true) > 0) == (turn > 0);
    const unsigned long shift = (unsigned long)(size + (long)bits);
    const sunder_i_big step = sunder_i_big_shl(a, sunder_i_big_i64(a, ahead ? 1 : -1), shift);
    sunder_i_big along;
    if (!sunder_i_gap_position(s->p, &wall, &f->exact, bits, &along)) return false;
    return sunder_i_gap_along(s->p, &wall, sunder_i_big_add(a, along, step), bits, out);
}

/* The number of rounds of exact steps. The first step is 2^-33 of the length; each round uses twice as many bits as the
 * previous one and shorter steps. A sector of free directions with an angle of 2^-n is hit with n bits. */
#define ROUNDS_MAX 12

bool sunder_i_gap_rational_beside(sunder_i_gap_state *s, const sunder_i_gap_free_point *found,
                                  const sunder_i_gap_way *way, const sunder_i_big xy[2], unsigned long bits,
                                  sunder_i_surd_point *out)
{
    const long i = way->left, j = way->right;
    if (way->room == SUNDER_I_ROOM_NONE || found->contacts == 0) return false;
    const bool open = way->room == SUNDER_I_ROOM_OPEN || way->room == SUNDER_I_ROOM_HALF;
    if (open && to_doubles(s, found, found->contact + i, found->contact + j, xy, bits, out)) return true;
    /* the larger coordinate is at least 2^size */
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
