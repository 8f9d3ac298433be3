/* boundary_points.c: exact points on the boundary of the grown obstacle, and the exact test of the gap.
 *
 * With N = 2^gap_bits the gap is G / N. A side a + t d of length L = sqrt(q) has the normal n = (d.y, -d.x); its offset
 * line is N n.x = C with C = N n.a + G L. So feet of perpendiculars and crossings are fractions with integers and one
 * or two square roots: the length L of each line, and half the chord of a circle. If such a point is rational these
 * roots are integers, so that rational points are represented without roots: no rational point lies on an offset line
 * of irrational length, since N n.x would be rational and C is not. */
#include "separation/gap/gap_search.h"

#include "predicate/rational_point.h"

typedef struct vec {
    sunder_i_big x, y;
} vec;

static sunder_i_arena *arena_of(const sunder_i_gap_problem *p) { return &p->operands->placed.lattice.arena; }

/* Returns the problem in units that are a fraction of the lattice's, such that the n points have integer coordinates in
 * them. */
static sunder_i_gap_problem over_one(const sunder_i_gap_problem *p, const sunder_i_point *point, size_t n)
{
    sunder_i_arena *m = arena_of(p);
    sunder_i_gap_problem q = *p;
    for (size_t i = 0; i < n && !m->failed; i++) {
        if (sunder_i_point_is_plain(point[i])) continue;
        const sunder_i_big w = sunder_i_rational_get(m, &p->operands->placed.lattice, point[i]).w;
        const sunder_i_big g = sunder_i_big_gcd(m, q.over, w);
        if (!m->failed) q.over = sunder_i_big_mul(m, q.over, sunder_i_big_div_floor(m, w, g));
    }
    q.gap = sunder_i_times(m, p->gap, q.over);
    return q;
}

static vec get_point(const sunder_i_gap_problem *p, sunder_i_point a)
{
    sunder_i_arena *m = arena_of(p);
    if (m->failed) return (vec){{NULL, 0}, {NULL, 0}};
    const sunder_i_rational_point v = sunder_i_rational_get(m, &p->operands->placed.lattice, a);
    if (sunder_i_big_is_one(p->over)) return (vec){v.x, v.y};
    const sunder_i_big factor = sunder_i_big_div_floor(m, p->over, v.w);
    return (vec){sunder_i_big_mul(m, v.x, factor), sunder_i_big_mul(m, v.y, factor)};
}

/* Sets out[] to the two points that define a curve; for an arc both are its centre. */
static void points_of(const sunder_i_gap_curve *curve, sunder_i_point out[2])
{
    out[0] = curve->a;
    out[1] = curve->arc ? curve->a : curve->d;
}

static sunder_i_gap_problem over_curve(const sunder_i_gap_problem *p, const sunder_i_gap_curve *curve)
{
    sunder_i_point point[2];
    points_of(curve, point);
    return over_one(p, point, 2);
}

/* Returns v * N. */
static sunder_i_big scaled_by_n(const sunder_i_gap_problem *p, sunder_i_big v)
{
    return p->gap_bits ? sunder_i_big_shl(arena_of(p), v, p->gap_bits) : v;
}

static sunder_i_big big_add(const sunder_i_gap_problem *p, sunder_i_big a, sunder_i_big b)
{
    return sunder_i_big_add(arena_of(p), a, b);
}

static sunder_i_big big_sub(const sunder_i_gap_problem *p, sunder_i_big a, sunder_i_big b)
{
    return sunder_i_big_sub(arena_of(p), a, b);
}

static sunder_i_big big_mul(const sunder_i_gap_problem *p, sunder_i_big a, sunder_i_big b)
{
    return sunder_i_big_mul(arena_of(p), a, b);
}

static sunder_i_big big_cross(const sunder_i_gap_problem *p, vec u, vec v)
{
    return big_sub(p, big_mul(p, u.x, v.y), big_mul(p, u.y, v.x));
}

static sunder_i_big big_dot(const sunder_i_gap_problem *p, vec u, vec v)
{
    return big_add(p, big_mul(p, u.x, v.x), big_mul(p, u.y, v.y));
}

static sunder_i_surd surd_of(const sunder_i_gap_problem *p, sunder_i_big v)
{
    return sunder_i_surd_big(arena_of(p), v);
}

static sunder_i_surd scale_surd(const sunder_i_gap_problem *p, sunder_i_surd a, sunder_i_big f)
{
    return sunder_i_surd_scale(arena_of(p), a, f);
}

/* Converts a coordinate from lattice units to the units of the problem. */
static sunder_i_surd in_units(const sunder_i_gap_problem *p, sunder_i_surd a)
{
    return sunder_i_big_is_one(p->over) ? a : scale_surd(p, a, p->over);
}

static sunder_i_surd surd_sum(const sunder_i_gap_problem *p, sunder_i_surd a, sunder_i_surd b)
{
    return sunder_i_surd_add(arena_of(p), a, b);
}

static sunder_i_surd surd_difference(const sunder_i_gap_problem *p, sunder_i_surd a, sunder_i_surd b)
{
    return sunder_i_surd_sub(arena_of(p), a, b);
}

/* ---- Feet of perpendiculars, and crossings ---- */

typedef struct line {
    vec d, n;
    sunder_i_big square;  /* q, the squared length */
    sunder_i_surd length; /* L, the length */
    sunder_i_surd c;      /* C of the offset line */
} line;

static line moved_line(const sunder_i_gap_problem *p, const sunder_i_gap_curve *curve, sunder_i_roots *roots)
{
    line l = {.d = get_point(p, curve->d)};
    l.n = (vec){l.d.y, sunder_i_big_neg(l.d.x)};
    l.square = big_dot(p, l.d, l.d);
    sunder_i_surd_root(arena_of(p), roots, surd_of(p, l.square), &l.length);
    l.c = surd_sum(p, surd_of(p, scaled_by_n(p, big_dot(p, l.n, get_point(p, curve->a)))),
                   scale_surd(p, l.length, p->gap));
    return l;
}

static void finish_point(sunder_i_surd_point *out, const sunder_i_gap_problem *p, sunder_i_surd x, sunder_i_surd y,
                         sunder_i_big w)
{
    w = sunder_i_times(arena_of(p), w, p->over);
    const bool negative = sunder_i_big_sign(w) < 0;
    const sunder_i_big minus = sunder_i_big_i64(arena_of(p), -1);
    out->x = negative ? scale_surd(p, x, minus) : x;
    out->y = negative ? scale_surd(p, y, minus) : y;
    out->w = negative ? sunder_i_big_neg(w) : w;
}

/* The point c (1 - g / |c|) of the circle of radius g about c that is nearest to the origin. */
static void arc_foot(const sunder_i_gap_problem *p, const sunder_i_gap_curve *curve, sunder_i_surd_point *out)
{
    const vec c = get_point(p, curve->a);
    const sunder_i_big square = big_dot(p, c, c);
    if (sunder_i_big_sign(square) == 0) {
        finish_point(out, p, surd_of(p, sunder_i_big_neg(p->gap)), surd_of(p, square),
                     scaled_by_n(p, sunder_i_big_i64(arena_of(p), 1)));
        return;
    }
    sunder_i_surd length;
    sunder_i_surd_root(arena_of(p), &out->roots, surd_of(p, square), &length);
    const sunder_i_surd k = surd_difference(p, surd_of(p, scaled_by_n(p, square)), scale_surd(p, length, p->gap));
    finish_point(out, p, scale_surd(p, k, c.x), scale_surd(p, k, c.y), scaled_by_n(p, square));
}

/* *out becomes the point of the curve's line or circle that is nearest to the origin; of a circle about the origin the
 * leftmost point. */
static void find_foot(const sunder_i_gap_problem *problem, const sunder_i_gap_curve *curve, sunder_i_surd_point *out)
{
    const sunder_i_gap_problem q = over_curve(problem, curve), *const p = &q;
    out->roots.n = 0;
    if (curve->arc) {
        arc_foot(p, curve, out);
        return;
    }
    const line l = moved_line(p, curve, &out->roots);
    finish_point(out, p, scale_surd(p, l.c, l.n.x), scale_surd(p, l.c, l.n.y), scaled_by_n(p, l.square));
}

/* The crossing c + (n k + sign d s) / (q N) of an offset line and a circle about c, with k = C - N n.c and s = sqrt(G^2
 * q - k^2). */
static bool line_arc(const sunder_i_gap_problem *p, const sunder_i_gap_curve *side, const sunder_i_gap_curve *arc,
                     int sign, sunder_i_surd_point *out)
{
    sunder_i_arena *a = arena_of(p);
    const line l = moved_line(p, side, &out->roots);
    const vec c = get_point(p, arc->a);
    const sunder_i_surd k = surd_difference(p, l.c, surd_of(p, scaled_by_n(p, big_dot(p, l.n, c))));
    const sunder_i_surd square = surd_of(p, big_mul(p, big_mul(p, p->gap, p->gap), l.square));
    sunder_i_surd s;
    if (!sunder_i_surd_root(a, &out->roots, surd_difference(p, square, sunder_i_surd_mul(a, &out->roots, k, k)), &s))
        return false;
    if (sign < 0) s = scale_surd(p, s, sunder_i_big_i64(a, -1));
    const sunder_i_big w = scaled_by_n(p, l.square);
    finish_point(
        out, p,
        surd_sum(p, surd_of(p, big_mul(p, w, c.x)), surd_sum(p, scale_surd(p, k, l.n.x), scale_surd(p, s, l.d.x))),
        surd_sum(p, surd_of(p, big_mul(p, w, c.y)), surd_sum(p, scale_surd(p, k, l.n.y), scale_surd(p, s, l.d.y))), w);
    return true;
}

/* A crossing of two circles: the midpoint of their centres plus or minus v, turned left, times sqrt((4 G^2 - Q N^2) Q)
 * / (2 Q N); v is the difference of the centres and Q = |v|^2. */
static bool arc_arc(const sunder_i_gap_problem *p, const sunder_i_gap_curve *c, const sunder_i_gap_curve *d, int sign,
                    sunder_i_surd_point *out)
{
    sunder_i_arena *arena = arena_of(p);
    const vec a = get_point(p, c->a), b = get_point(p, d->a), v = {big_sub(p, b.x, a.x), big_sub(p, b.y, a.y)};
    const sunder_i_big q = big_dot(p, v, v), wide = scaled_by_n(p, q);
    const sunder_i_big four = sunder_i_big_shl(arena, big_mul(p, p->gap, p->gap), 2);
    sunder_i_surd s;
    if (sunder_i_big_sign(q) == 0 ||
        !sunder_i_surd_root(arena, &out->roots, surd_of(p, big_mul(p, big_sub(p, four, scaled_by_n(p, wide)), q)), &s))
        return false;
    if (sign < 0) s = scale_surd(p, s, sunder_i_big_i64(arena, -1));
    finish_point(out, p, surd_difference(p, surd_of(p, big_mul(p, big_add(p, a.x, b.x), wide)), scale_surd(p, s, v.y)),
                 surd_sum(p, surd_of(p, big_mul(p, big_add(p, a.y, b.y), wide)), scale_surd(p, s, v.x)),
                 sunder_i_big_shl(arena, wide, 1));
    return true;
}

/* *out becomes a common point of two curves; if exactly one is a line it is c. On a line and a circle it is the
 * crossing farther along the line (sign 1) or the other one (-1); on two circles the one on the left (1) or right of
 * the direction from c's centre to d's. Returns false if there is none, or if the curves coincide. */
static bool find_crossing(const sunder_i_gap_problem *problem, const sunder_i_gap_curve *c, const sunder_i_gap_curve *d,
                          int sign, sunder_i_surd_point *out)
{
    sunder_i_point point[4];
    points_of(c, point);
    points_of(d, point + 2);
    const sunder_i_gap_problem q = over_one(problem, point, 4), *const p = &q;
    out->roots.n = 0;
    if (d->arc) return c->arc ? arc_arc(p, c, d, sign, out) : line_arc(p, c, d, sign, out);
    const line l = moved_line(p, c, &out->roots), m = moved_line(p, d, &out->roots);
    const sunder_i_big w = scaled_by_n(p, big_cross(p, l.n, m.n));
    if (sunder_i_big_sign(w) == 0) return false;
    finish_point(out, p, surd_difference(p, scale_surd(p, l.c, m.n.y), scale_surd(p, m.c, l.n.y)),
                 surd_difference(p, scale_surd(p, m.c, l.n.x), scale_surd(p, l.c, m.n.x)), w);
    return true;
}

/* ---- Positions on an offset line of rational length ---- */

bool sunder_i_gap_along(const sunder_i_gap_problem *problem, const sunder_i_gap_curve *side, sunder_i_big along,
                        unsigned long bits, sunder_i_surd_point *out)
{
    const sunder_i_gap_problem q = over_curve(problem, side), *const p = &q;
    along = sunder_i_times(arena_of(p), along, p->over);
    out->roots.n = 0;
    const line l = moved_line(p, side, &out->roots);
    if (out->roots.n) return false;
    /* the point n C / (q N) + d along / (L 2^bits), with the denominator q N 2^bits */
    sunder_i_arena *a = arena_of(p);
    const sunder_i_big k = scaled_by_n(p, big_mul(p, along, l.length.part[0])),
                       c = sunder_i_big_shl(a, l.c.part[0], bits);
    finish_point(out, p, surd_of(p, big_add(p, big_mul(p, l.n.x, c), big_mul(p, l.d.x, k))),
                 surd_of(p, big_add(p, big_mul(p, l.n.y, c), big_mul(p, l.d.y, k))),
                 sunder_i_big_shl(a, scaled_by_n(p, l.square), bits));
    return true;
}

bool sunder_i_gap_position(const sunder_i_gap_problem *problem, const sunder_i_gap_curve *side,
                           const sunder_i_surd_point *at, unsigned long bits, sunder_i_big *along)
{
    /* the result does not depend on the units of the side; `at` is in lattice units */
    const sunder_i_gap_problem q = over_curve(problem, side), *const p = &q;
    sunder_i_arena *a = arena_of(p);
    sunder_i_roots roots = {.n = 0};
    const line l = moved_line(p, side, &roots);
    if (roots.n) return false;
    const sunder_i_surd s = surd_sum(p, scale_surd(p, at->x, l.d.x), scale_surd(p, at->y, l.d.y));
    *along =
        sunder_i_big_div_floor(a, sunder_i_surd_scaled(a, &at->roots, s, bits), big_mul(p, at->w, l.length.part[0]));
    return true;
}

/* ---- The test of the gap ---- */

int sunder_i_gap_cmp_side(const sunder_i_gap_problem *problem, const sunder_i_subsum *subsum, uint32_t k,
                          const sunder_i_surd_point *at, bool *inward, bool *flat)
{
    sunder_i_arena *a = arena_of(problem);
    const sunder_i_mark mark = sunder_i_arena_mark(a);
    int order = 1;
    if (sunder_i_gap_roughly_side(problem, subsum, k, at, &order, inward, flat)) {
        sunder_i_arena_release(a, mark);
        return order;
    }
    const sunder_i_point point[2] = {subsum->corner[k], subsum->side[k]};
    const sunder_i_gap_problem q = over_one(problem, point, 2), *const p = &q;
    const sunder_i_roots *roots = &at->roots;
    const vec c = get_point(p, subsum->corner[k]), d = get_point(p, subsum->side[k]);
    const sunder_i_surd vx = surd_difference(p, in_units(p, at->x), surd_of(p, big_mul(p, c.x, at->w)));
    const sunder_i_surd vy = surd_difference(p, in_units(p, at->y), surd_of(p, big_mul(p, c.y, at->w)));
    const sunder_i_surd turn = surd_difference(p, scale_surd(p, vy, d.x), scale_surd(p, vx, d.y));
    const sunder_i_surd along = surd_sum(p, scale_surd(p, vx, d.x), scale_surd(p, vy, d.y));
    const sunder_i_big gw = big_mul(p, p->gap, at->w), limit = big_mul(p, gw, gw), square = big_dot(p, d, d);
    order = 1;
    *inward = sunder_i_surd_sign(a, roots, turn) > 0;
    *flat = false;
    if (sunder_i_surd_sign(a, roots, along) <= 0) { /* the first vertex of the side is nearest */
        const sunder_i_surd norm =
            surd_sum(p, sunder_i_surd_mul(a, roots, vx, vx), sunder_i_surd_mul(a, roots, vy, vy));
        const sunder_i_surd wide = sunder_i_surd_shl(a, norm, 2 * p->gap_bits);
        order = sunder_i_surd_sign(a, roots, surd_difference(p, wide, surd_of(p, limit)));
    } else if (sunder_i_surd_sign(a, roots, surd_difference(p, along, surd_of(p, big_mul(p, square, at->w)))) < 0) {
        const sunder_i_surd wide = sunder_i_surd_shl(a, sunder_i_surd_mul(a, roots, turn, turn), 2 * p->gap_bits);
        order = sunder_i_surd_sign(a, roots, surd_difference(p, wide, surd_of(p, big_mul(p, limit, square))));
        *flat = true;
    }
    sunder_i_arena_release(a, mark);
    return order;
}

int sunder_i_gap_cmp(const sunder_i_gap_problem *problem, const sunder_i_subsum *subsum, const sunder_i_surd_point *at,
                     uint32_t *k, bool *flat)
{
    bool inside = true;
    int least = 1;
    for (uint32_t i = 0; i < subsum->sides && least >= 0; i++) {
        bool inward, is_flat;
        const int order = sunder_i_gap_cmp_side(problem, subsum, i, at, &inward, &is_flat);
        inside = inside && inward;
        if (order >= least) continue;
        least = order;
        *k = i;
        *flat = is_flat;
    }
    return inside ? -1 : least;
}

const sunder_i_surd_point *sunder_i_gap_solve(sunder_i_gap_state *s, sunder_i_gap_point *p)
{
    if (p->exact) return p->exact;
    sunder_i_surd_point *exact = sunder_i_arena_alloc(&s->g->placed.lattice.arena, 1, sizeof *exact);
    if (!exact) {
        s->failed = true;
        return NULL;
    }
    if (!p->crossing)
        find_foot(s->p, &p->c, exact);
    else if (!find_crossing(s->p, &p->c, &p->d, p->sign, exact))
        return NULL;
    p->exact = exact;
    return exact;
}
