/* verify_leg.c: the proof that a leg is free, by another method than that of the search: no tree, no separating axes,
 * and doubles only for boxes.
 *
 * The point p + t (q - p) is in an open part exactly if it is strictly left of each side of the part. The cross product
 * with each side is linear in t, f(t) = (1 - t) f(p) + t f(q), so that the values of t inside are an open interval,
 * intersected with [0, 1]. The leg does not meet the part if this set is empty. */
#include "motion/free_space.h"

#include "base/extremes.h"

/* Returns cross(b - a, c - a) times the positive w of c and a positive number that depends only on the side ab. */
static sunder_i_big scaled_height(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b,
                                  const sunder_i_filtered_point *c)
{
    sunder_i_arena *m = &l->arena;
    const sunder_i_rational_point o = sunder_i_rational_get(m, l, a);
    const sunder_i_rational_point u = sunder_i_rational_sub(m, sunder_i_rational_get(m, l, b), o);
    const sunder_i_rational_point v = {
        sunder_i_big_sub(m, sunder_i_times(m, c->at.x, o.w), sunder_i_big_mul(m, o.x, c->at.w)),
        sunder_i_big_sub(m, sunder_i_times(m, c->at.y, o.w), sunder_i_big_mul(m, o.y, c->at.w)), c->at.w};
    return sunder_i_rational_cross(m, u, v);
}

typedef struct bound {
    sunder_i_ratio at;
    bool open;
} bound;

static int bound_cmp(sunder_i_arena *m, const bound *a, const bound *b) { return sunder_i_ratio_cmp(m, a->at, b->at); }

/* Returns true if some point of the closed segment pq is strictly left of every side of the part. */
static bool passes_part(const sunder_i_free_space *s, uint32_t part, const sunder_i_filtered_point *p,
                        const sunder_i_filtered_point *q)
{
    sunder_i_lattice *l = s->filter.lattice;
    sunder_i_arena *m = &l->arena;
    const sunder_i_convex_pieces *c = &s->part;
    const uint32_t first = sunder_i_convex_pieces_first(c, part), end = c->end[part];
    const sunder_i_big one = sunder_i_big_i64(m, 1);
    bound low = {{sunder_i_big_i64(m, 0), one}, false}, high = {{one, one}, false};
    for (uint32_t k = first; k < end; k++) {
        const sunder_i_point a = c->corner[k], b = c->corner[k + 1 < end ? k + 1 : first];
        /* f(p) and f(q) over the common denominator p.w q.w. */
        const sunder_i_big fp = sunder_i_big_mul(m, scaled_height(l, a, b, p), q->at.w);
        const sunder_i_big fq = sunder_i_big_mul(m, scaled_height(l, a, b, q), p->at.w);
        const int sp = sunder_i_big_sign(fp), sq = sunder_i_big_sign(fq);
        if (sp <= 0 && sq <= 0) return false;
        if (sp > 0 && sq > 0) continue;
        /* f(t) = 0 at t = fp / (fp - fq). One of fp and fq is positive, the other is not. */
        const sunder_i_big d = sunder_i_big_sub(m, fp, fq);
        const bound at = sunder_i_big_sign(d) > 0 ? (bound){{fp, d}, true}
                                                  : (bound){{sunder_i_big_neg(fp), sunder_i_big_neg(d)}, true};
        if (sp > 0) { /* the positive part is from p to the intersection */
            if (bound_cmp(m, &at, &high) <= 0) high = at;
        } else if (bound_cmp(m, &at, &low) >= 0) {
            low = at;
        }
    }
    const int order = bound_cmp(m, &low, &high);
    return order < 0 || (order == 0 && !low.open && !high.open);
}

static bool box_apart(const sunder_i_free_space *s, uint32_t part, const double low[2], const double high[2])
{
    const sunder_i_convex_pieces *c = &s->part;
    bool left = true, right = true, below = true, above = true;
    for (uint32_t k = sunder_i_convex_pieces_first(c, part); k < c->end[part]; k++) {
        const double x = s->corner[k][0], y = s->corner[k][1];
        left = left && x < low[0];
        right = right && x > high[0];
        below = below && y < low[1];
        above = above && y > high[1];
    }
    return left || right || below || above;
}

bool sunder_i_leg_verified(const sunder_i_free_space *space, const sunder_i_filtered_point *p,
                           const sunder_i_filtered_point *q)
{
    sunder_i_arena *m = &space->filter.lattice->arena;
    const double e = 4 * space->filter.error;
    const double low[2] = {sunder_i_min(p->ax, q->ax) - e, sunder_i_min(p->ay, q->ay) - e};
    const double high[2] = {sunder_i_max(p->ax, q->ax) + e, sunder_i_max(p->ay, q->ay) + e};
    for (uint32_t part = 0; part < space->part.n; part++) {
        if (box_apart(space, part, low, high)) continue;
        const sunder_i_mark mark = sunder_i_arena_mark(m);
        const bool meets = passes_part(space, part, p, q);
        if (m->failed) return false;
        sunder_i_arena_release(m, mark);
        if (meets) return false;
    }
    return true;
}
