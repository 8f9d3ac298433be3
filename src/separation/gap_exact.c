/* Rational points of the boundary of the grown obstacle, and the exact test of the gap. All in big integers: these
 * questions are asked a few times for each answer. */
#include "separation/gap.h"

#include <math.h>

typedef struct vec {
    sunder_i_big x, y;
} vec;

static sunder_i_arena *arena_of(const sunder_i_gap_problem *p) { return &p->pairing->placed.lattice.arena; }

static vec get(const sunder_i_gap_problem *p, sunder_i_point a)
{
    sunder_i_lattice *l = &p->pairing->placed.lattice;
    return (vec){sunder_i_lattice_get(l, a.x), sunder_i_lattice_get(l, a.y)};
}

/* Times 2^gap_bits, so that the gap is an integer beside it. */
static sunder_i_big scaled(const sunder_i_gap_problem *p, sunder_i_big v)
{
    return p->gap_bits ? sunder_i_big_shl(arena_of(p), v, p->gap_bits) : v;
}

static sunder_i_big add(const sunder_i_gap_problem *p, sunder_i_big a, sunder_i_big b)
{
    return sunder_i_big_add(arena_of(p), a, b);
}

static sunder_i_big sub(const sunder_i_gap_problem *p, sunder_i_big a, sunder_i_big b)
{
    return sunder_i_big_sub(arena_of(p), a, b);
}

static sunder_i_big mul(const sunder_i_gap_problem *p, sunder_i_big a, sunder_i_big b)
{
    return sunder_i_big_mul(arena_of(p), a, b);
}

static sunder_i_big cross(const sunder_i_gap_problem *p, vec u, vec v)
{
    return sub(p, mul(p, u.x, v.y), mul(p, u.y, v.x));
}

static sunder_i_big dot(const sunder_i_gap_problem *p, vec u, vec v)
{
    return add(p, mul(p, u.x, v.x), mul(p, u.y, v.y));
}

/* The root of v if it is an integer. */
static bool root(const sunder_i_gap_problem *p, sunder_i_big v, sunder_i_big *out)
{
    if (sunder_i_big_sign(v) < 0) return false;
    *out = sunder_i_big_sqrt_floor(arena_of(p), v);
    return sunder_i_big_cmp(mul(p, *out, *out), v) == 0;
}

/* The moved line as A x + B y = C, |(A, B)| = length, with the gap times length an integer; false if the length of d is
 * irrational. */
typedef struct line {
    vec n;
    sunder_i_big c, length, gap_length;
} line;

static bool moved_line(const sunder_i_gap_problem *p, const sunder_i_curve *curve, line *out)
{
    const vec a = get(p, curve->a), d = get(p, curve->d);
    sunder_i_big length;
    if (!root(p, dot(p, d, d), &length)) return false;
    out->length = scaled(p, length);
    out->gap_length = mul(p, p->gap, length);
    out->n = (vec){scaled(p, d.y), sunder_i_big_neg(scaled(p, d.x))};
    out->c = add(p, dot(p, out->n, a), out->gap_length);
    return true;
}

static bool finish(sunder_i_rational *out, sunder_i_big x, sunder_i_big y, sunder_i_big w)
{
    const bool negative = sunder_i_big_sign(w) < 0;
    out->x = negative ? sunder_i_big_neg(x) : x;
    out->y = negative ? sunder_i_big_neg(y) : y;
    out->w = negative ? sunder_i_big_neg(w) : w;
    return sunder_i_big_sign(w) != 0;
}

bool sunder_i_gap_foot(const sunder_i_gap_problem *p, const sunder_i_curve *curve, sunder_i_rational *out)
{
    if (curve->arc) {
        const vec c = get(p, curve->a);
        sunder_i_big length;
        if (!root(p, dot(p, c, c), &length) || sunder_i_big_sign(length) == 0) return false;
        length = scaled(p, length);
        const sunder_i_big k = sub(p, length, p->gap);
        return finish(out, mul(p, c.x, k), mul(p, c.y, k), length);
    }
    line m;
    return moved_line(p, curve, &m) && finish(out, mul(p, m.n.x, m.c), mul(p, m.n.y, m.c), mul(p, m.length, m.length));
}

bool sunder_i_gap_along(const sunder_i_gap_problem *p, const sunder_i_curve *curve, double along,
                        sunder_i_rational *out)
{
    sunder_i_arena *a = arena_of(p);
    line m;
    if (curve->arc || !isfinite(along) || !moved_line(p, curve, &m)) return false;
    /* n C / L^2 + d k / L with k = v 2^e; d = (-n.y, n.x). */
    int e;
    sunder_i_big v = sunder_i_big_double(a, along, &e), scale = sunder_i_big_i64(a, 1);
    const long shift = e + (long)p->pairing->placed.lattice.approx_shift;
    if (shift >= 0)
        v = sunder_i_big_shl(a, v, (unsigned long)shift);
    else
        scale = sunder_i_big_shl(a, scale, (unsigned long)-shift);
    const sunder_i_big k = mul(p, v, m.length), c = mul(p, m.c, scale);
    return finish(out, sub(p, mul(p, m.n.x, c), mul(p, m.n.y, k)), add(p, mul(p, m.n.y, c), mul(p, m.n.x, k)),
                  mul(p, mul(p, m.length, m.length), scale));
}

/* Of the two points base + s * turn and base - s * turn (over w), the one nearest to (x, y). */
static bool choose(const sunder_i_gap_problem *p, vec base, vec turn, sunder_i_big s, sunder_i_big w, double x,
                   double y, sunder_i_rational *out)
{
    sunder_i_rational r[2];
    double off[2];
    for (int k = 0; k < 2; k++) {
        const sunder_i_big f = k ? sunder_i_big_neg(s) : s;
        if (!finish(r + k, add(p, base.x, mul(p, turn.x, f)), add(p, base.y, mul(p, turn.y, f)), w)) return false;
        double at[2];
        sunder_i_rational_units(p->pairing, r + k, at);
        off[k] = hypot(at[0] - x, at[1] - y);
    }
    *out = r[off[1] < off[0]];
    return true;
}

static bool line_arc(const sunder_i_gap_problem *p, const sunder_i_curve *l, const sunder_i_curve *arc, double x,
                     double y, sunder_i_rational *out)
{
    line m;
    if (!moved_line(p, l, &m)) return false;
    const vec c = get(p, arc->a);
    const sunder_i_big k = sub(p, m.c, dot(p, m.n, c)), gl = m.gap_length;
    const sunder_i_big square = mul(p, m.length, m.length);
    sunder_i_big s;
    if (!root(p, sub(p, mul(p, gl, gl), mul(p, k, k)), &s)) return false;
    const vec base = {add(p, mul(p, c.x, square), mul(p, m.n.x, k)), add(p, mul(p, c.y, square), mul(p, m.n.y, k))};
    const vec turn = {sunder_i_big_neg(m.n.y), m.n.x};
    return choose(p, base, turn, s, square, x, y, out);
}

static bool arc_arc(const sunder_i_gap_problem *p, const sunder_i_curve *c, const sunder_i_curve *d, double x, double y,
                    sunder_i_rational *out)
{
    const vec a = get(p, c->a), b = get(p, d->a), v = {sub(p, b.x, a.x), sub(p, b.y, a.y)};
    const sunder_i_big q = dot(p, v, v), wide = scaled(p, q);
    const sunder_i_big four = sunder_i_big_shl(arena_of(p), mul(p, p->gap, p->gap), 2);
    sunder_i_big s;
    if (!root(p, mul(p, sub(p, four, scaled(p, wide)), q), &s)) return false;
    const vec base = {mul(p, add(p, a.x, b.x), wide), mul(p, add(p, a.y, b.y), wide)};
    const vec turn = {sunder_i_big_neg(v.y), v.x};
    return choose(p, base, turn, s, sunder_i_big_shl(arena_of(p), wide, 1), x, y, out);
}

bool sunder_i_gap_crossing(const sunder_i_gap_problem *p, const sunder_i_curve *c, const sunder_i_curve *d, double x,
                           double y, sunder_i_rational *out)
{
    if (c->arc) return d->arc ? arc_arc(p, c, d, x, y, out) : line_arc(p, d, c, x, y, out);
    if (d->arc) return line_arc(p, c, d, x, y, out);
    line m, n;
    if (!moved_line(p, c, &m) || !moved_line(p, d, &n)) return false;
    const sunder_i_big w = cross(p, m.n, n.n);
    return finish(out, sub(p, mul(p, m.c, n.n.y), mul(p, n.c, m.n.y)), sub(p, mul(p, n.c, m.n.x), mul(p, m.c, n.n.x)),
                  w);
}

int sunder_i_gap_cmp_side(const sunder_i_gap_problem *p, const sunder_i_subsum *s, uint32_t k,
                          const sunder_i_rational *at, bool *outside)
{
    const sunder_i_big gw = mul(p, p->gap, at->w), limit = mul(p, gw, gw);
    const vec c = get(p, s->corner[k]), d = get(p, s->side[k]);
    const vec v = {sub(p, at->x, mul(p, c.x, at->w)), sub(p, at->y, mul(p, c.y, at->w))};
    const sunder_i_big turn = cross(p, d, v), along = dot(p, d, v), square = dot(p, d, d);
    if (outside) *outside = sunder_i_big_sign(turn) <= 0;
    /* The corner, or the inside of the side where the foot falls there. The other end is the next side's corner. */
    if (sunder_i_big_sign(along) > 0 && sunder_i_big_cmp(along, mul(p, square, at->w)) < 0) {
        const sunder_i_big t = scaled(p, turn);
        return sunder_i_big_cmp(mul(p, t, t), mul(p, limit, square));
    }
    return sunder_i_big_cmp(scaled(p, scaled(p, dot(p, v, v))), limit);
}

int sunder_i_gap_cmp(const sunder_i_gap_problem *p, const sunder_i_subsum *s, const sunder_i_rational *at)
{
    bool inside = true;
    int least = 1;
    for (uint32_t k = 0; k < s->sides && least >= 0; k++) {
        bool outside;
        const int order = sunder_i_gap_cmp_side(p, s, k, at, &outside);
        if (order < least) least = order;
        inside = inside && !outside;
    }
    return inside ? -1 : least;
}

int sunder_i_rational_cmp(sunder_i_pairing *g, const sunder_i_rational *a, const sunder_i_rational *b)
{
    const sunder_i_gap_problem p = {.pairing = g};
    const vec u = {mul(&p, a->x, b->w), mul(&p, a->y, b->w)}, v = {mul(&p, b->x, a->w), mul(&p, b->y, a->w)};
    int c = sunder_i_big_cmp(dot(&p, u, u), dot(&p, v, v));
    if (!c) c = sunder_i_big_cmp(u.x, v.x);
    return c ? c : sunder_i_big_cmp(u.y, v.y);
}

void sunder_i_rational_units(sunder_i_pairing *g, const sunder_i_rational *at, double xy[2])
{
    sunder_i_lattice *l = &g->placed.lattice;
    xy[0] = sunder_i_big_ratio(&l->arena, at->x, at->w, -l->approx_shift);
    xy[1] = sunder_i_big_ratio(&l->arena, at->y, at->w, -l->approx_shift);
}

sunder_i_rational sunder_i_rational_doubles(sunder_i_pairing *g, double dx, double dy)
{
    sunder_i_rational r;
    sunder_i_vector_doubles(g, dx, dy, &r.x, &r.y, &r.w);
    return r;
}
