/* sites.c: sites and lines: three tests and one construction, each decided in floating point if the error bound allows
 * it, else exactly.
 *
 * Degrees, if corners are lattice points (degree 1, w of degree 0): a line has A, B of degree 1 and C of degree 2; a
 * crossing x, y of degree 3 over w of degree 2. The degrees of the tests are: side of a corner 2, of a crossing 4;
 * order of corners 1, of two crossings 5; turn of two lines 2. A corner that is a sum with Steiner points has x, y of
 * degree d + 1 over w of degree d (d = 2 for one Steiner point, 4 for two); its line, with a given lattice direction,
 * has A, B of degree d + 1 and C of degree d + 2 before division by the common divisor, and the degrees increase
 * accordingly: crossings of two such lines have x, y of degree 2 d + 3 over w of degree 2 d + 2, compared in degree 4 d
 * + 5. Nothing is constructed from a crossing, so that no number becomes longer.
 *
 * The exact result is always the sign of a sum of up to three products; with up to 16 limbs each (1024 bits) it is
 * computed on the stack, which covers every degree above on a narrow lattice; else in the scratch arena. */
#include "planar_map/map.h"

#include "predicate/rational_point.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>

#define STACK_LIMBS 16

typedef struct sum {
    mp_limb_t limb[2 * STACK_LIMBS + 1];
    mp_size_t n;
} sum;

static void accumulate_product(sum *s, const mp_limb_t *p, mp_size_t n)
{
    while (n > 0 && p[n - 1] == 0) n--;
    if (n == 0) return;
    if (s->n == 0) {
        mpn_copyi(s->limb, p, n);
        s->n = n;
        return;
    }
    mp_limb_t carry;
    if (s->n >= n)
        carry = mpn_add(s->limb, s->limb, s->n, p, n);
    else {
        carry = mpn_add(s->limb, p, n, s->limb, s->n);
        s->n = n;
    }
    if (carry) s->limb[s->n++] = carry;
}

static int sum_cmp(const sum *a, const sum *b)
{
    if (a->n != b->n) return a->n < b->n ? -1 : 1;
    const int c = a->n ? mpn_cmp(a->limb, b->limb, a->n) : 0;
    return (c > 0) - (c < 0);
}

static mp_size_t limbs_of(sunder_i_big a) { return (mp_size_t)labs(a.size); }

/* Returns the sign of the sum of a[i] * b[i], n <= 3. */
static int dot_sign(sunder_i_planar_map *map, const sunder_i_big *a, const sunder_i_big *b, int n)
{
    bool small = true;
    for (int i = 0; i < n; i++) small = small && limbs_of(a[i]) <= STACK_LIMBS && limbs_of(b[i]) <= STACK_LIMBS;
    if (small) {
        sum s[2];
        s[0].n = s[1].n = 0;
        for (int i = 0; i < n; i++) {
            const mp_size_t la = limbs_of(a[i]), lb = limbs_of(b[i]);
            if (la == 0 || lb == 0) continue;
            mp_limb_t p[2 * STACK_LIMBS];
            if (la >= lb)
                mpn_mul(p, a[i].limb, la, b[i].limb, lb);
            else
                mpn_mul(p, b[i].limb, lb, a[i].limb, la);
            accumulate_product(&s[(a[i].size < 0) != (b[i].size < 0)], p, la + lb);
        }
        return sum_cmp(&s[0], &s[1]);
    }
    const sunder_i_mark mark = sunder_i_arena_mark(&map->scratch);
    sunder_i_big t = sunder_i_big_mul(&map->scratch, a[0], b[0]);
    for (int i = 1; i < n; i++) t = sunder_i_big_add(&map->scratch, t, sunder_i_big_mul(&map->scratch, a[i], b[i]));
    const int sign = sunder_i_big_sign(t);
    sunder_i_arena_release(&map->scratch, mark);
    return sign;
}

static int coordinate_cmp(sunder_i_planar_map *map, double p, double q, const sunder_i_site *s, const sunder_i_site *t,
                          int axis)
{
    if (p != q) return p < q ? -1 : 1;
    map->lattice->counts.exact_fallbacks++;
    const sunder_i_big a[2] = {sunder_i_rational_axis(&s->at, axis),
                               sunder_i_big_neg(sunder_i_rational_axis(&t->at, axis))};
    const sunder_i_big b[2] = {t->at.w, s->at.w};
    return dot_sign(map, a, b, 2);
}

int sunder_i_site_cmp_exact(sunder_i_planar_map *map, const sunder_i_site *p, const sunder_i_site *q)
{
    if (p->at.x.limb == q->at.x.limb && p->at.y.limb == q->at.y.limb && p->at.w.limb == q->at.w.limb &&
        p->at.x.size == q->at.x.size && p->at.y.size == q->at.y.size)
        return 0; /* the same numbers in memory */
    const int c = coordinate_cmp(map, p->ax, q->ax, p, q, 0);
    return c ? c : coordinate_cmp(map, p->ay, q->ay, p, q, 1);
}

/* The error bound. With u = 2^-53: the doubles of the site and of the reference point have errors of at most u times
 * their magnitude; the differences dx, dy are rounded once, a and b have errors of u, products and the sum are rounded
 * once more. So the error is at most
 *   (|a dx| + |b dy|) 4 u (1 + u)^3  +  u (|a| (|px| + |rx|) + |b| (|py| + |ry|)) (1 + u)^3
 * and twice that is used. Subnormal coordinates (of a wide lattice) and subnormal a, b add at most 2^-1074 times the
 * other factor, which is below 2^502 for sites on the lattice or between them: 2^-500 bounds this, and makes no
 * difference on a lattice of
 * integers. */
int sunder_i_site_side(sunder_i_planar_map *map, const sunder_i_map_line *line, const sunder_i_site *p)
{
    map->lattice->counts.orientation_tests++;
    const double s = line->a * (p->ax - line->rx), t = line->b * (p->ay - line->ry), det = s + t;
    const double bound =
        0x1p-50 * (fabs(s) + fabs(t)) + 0x1p-500 +
        0x1p-52 * (fabs(line->a) * (fabs(p->ax) + fabs(line->rx)) + fabs(line->b) * (fabs(p->ay) + fabs(line->ry)));
    if (det > bound) return 1;
    if (det < -bound) return -1;
    map->lattice->counts.exact_fallbacks++;
    const sunder_i_big at[3] = {p->at.x, p->at.y, p->at.w};
    return dot_sign(map, line->abc, at, 3);
}

/* The direction of a line is (B, -A). The error bound: each double has an error of u, products and the difference are
 * rounded once: 4 u. */
int sunder_i_line_turn(sunder_i_planar_map *map, const sunder_i_map_line *f, const sunder_i_map_line *g)
{
    if (f == g) return 0;
    map->lattice->counts.orientation_tests++;
    const double s = f->a * g->b, t = f->b * g->a, det = s - t;
    const double bound = 0x1p-50 * (fabs(s) + fabs(t)) + 0x1p-1000;
    if (det > bound) return 1;
    if (det < -bound) return -1;
    map->lattice->counts.exact_fallbacks++;
    const sunder_i_big a[2] = {f->abc[0], sunder_i_big_neg(f->abc[1])}, b[2] = {g->abc[1], g->abc[0]};
    return dot_sign(map, a, b, 2);
}

static void approximate_site(sunder_i_planar_map *map, sunder_i_site *s)
{
    s->ax = s->ay = 0;
    if (sunder_i_map_broken(map) || s->at.w.size == 0) return;
    const sunder_i_mark mark = sunder_i_arena_mark(&map->scratch);
    sunder_i_rational_doubles(&map->scratch, s->at, -(long)map->lattice->approx_shift, &s->ax, &s->ay);
    sunder_i_arena_release(&map->scratch, mark);
}

sunder_i_site sunder_i_site_of(sunder_i_planar_map *map, sunder_i_rational_point at)
{
    sunder_i_site s = {.at = at};
    approximate_site(map, &s);
    return s;
}

/* Returns a b - c d; only the result remains in the arena. */
static sunder_i_big minor_2x2(sunder_i_planar_map *map, sunder_i_arena *arena, sunder_i_big a, sunder_i_big b,
                              sunder_i_big c, sunder_i_big d)
{
    sunder_i_arena *s = &map->scratch;
    const sunder_i_mark mark = sunder_i_arena_mark(s);
    const sunder_i_big r = sunder_i_big_sub(s, sunder_i_big_mul(s, a, b), sunder_i_big_mul(s, c, d));
    if (arena == s) return r;
    const sunder_i_big kept = sunder_i_big_copy(arena, r);
    sunder_i_arena_release(s, mark);
    return kept;
}

sunder_i_site sunder_i_line_crossing(sunder_i_planar_map *map, const sunder_i_map_line *f, const sunder_i_map_line *g,
                                     sunder_i_arena *arena)
{
    map->lattice->counts.segment_intersections++;
    const sunder_i_big *p = f->abc, *q = g->abc;
    sunder_i_site s = {.at = {minor_2x2(map, arena, p[1], q[2], p[2], q[1]),
                              minor_2x2(map, arena, p[2], q[0], p[0], q[2]),
                              minor_2x2(map, arena, p[0], q[1], p[1], q[0])}};
    if (sunder_i_big_sign(s.at.w) < 0)
        s.at = (sunder_i_rational_point){sunder_i_big_neg(s.at.x), sunder_i_big_neg(s.at.y), sunder_i_big_neg(s.at.w)};
    approximate_site(map, &s);
    return s;
}

static sunder_i_big big_quotient(sunder_i_arena *arena, sunder_i_big a, sunder_i_big by)
{
    return sunder_i_big_div_floor(arena, a, by); /* `by` divides a, so that nothing is rounded */
}

/* Returns the line through p along a plain vector (dx, dy): A = -dy w, B = dx w, C = dy x - dx y. Common factors of p's
 * denominator and C are removed, those of dx and dy are not; no later step increases these. */
static sunder_i_map_line line_along(sunder_i_planar_map *map, const sunder_i_site *p, int64_t dx, int64_t dy)
{
    sunder_i_arena *s = &map->scratch;
    if (dx < 0 || (dx == 0 && dy < 0)) {
        dx = -dx;
        dy = -dy;
    }
    sunder_i_big w = p->at.w;
    const sunder_i_big x = sunder_i_big_i64(s, dx), y = sunder_i_big_i64(s, dy);
    sunder_i_big c = sunder_i_big_sub(s, sunder_i_big_mul(s, y, p->at.x), sunder_i_big_mul(s, x, p->at.y));
    if (!sunder_i_big_is_one(w)) {
        const sunder_i_big g = sunder_i_big_gcd(s, w, c);
        if (!s->failed && !sunder_i_big_is_one(g)) {
            w = big_quotient(s, w, g);
            c = big_quotient(s, c, g);
        }
    }
    const double a = -(double)dy, b = (double)dx, scale = ldexp(1, -ilogb(sunder_i_max(fabs(a), b)) - 1);
    return (sunder_i_map_line){.abc = {sunder_i_big_neg(sunder_i_times(s, y, w)), sunder_i_times(s, x, w), c},
                               .a = a * scale,
                               .b = b * scale,
                               .rx = p->ax,
                               .ry = p->ay};
}

/* Returns the line through p along a lattice vector, or through q if `along` is NULL. */
static sunder_i_map_line line_between(sunder_i_planar_map *map, const sunder_i_site *p, const sunder_i_site *q,
                                      const sunder_i_point *along)
{
    sunder_i_arena *s = &map->scratch;
    sunder_i_big abc[3];
    if (along) {
        const sunder_i_rational_point d = sunder_i_rational_get(s, map->lattice, *along);
        const sunder_i_big dx = d.x, dy = d.y;
        abc[0] = sunder_i_big_neg(sunder_i_big_mul(s, dy, p->at.w));
        abc[1] = sunder_i_big_mul(s, dx, p->at.w);
        abc[2] = minor_2x2(map, s, dy, p->at.x, dx, p->at.y);
    } else {
        abc[0] = minor_2x2(map, s, p->at.y, q->at.w, q->at.y, p->at.w);
        abc[1] = minor_2x2(map, s, q->at.x, p->at.w, p->at.x, q->at.w);
        abc[2] = minor_2x2(map, s, p->at.x, q->at.y, q->at.x, p->at.y);
    }
    const int b = sunder_i_big_sign(abc[1]);
    if (b < 0 || (b == 0 && sunder_i_big_sign(abc[0]) > 0))
        for (int i = 0; i < 3; i++) abc[i] = sunder_i_big_neg(abc[i]);
    if (sunder_i_big_bits(p->at.w) > 1 || along || sunder_i_big_bits(q->at.w) > 1) {
        const sunder_i_big g = sunder_i_big_gcd(s, sunder_i_big_gcd(s, abc[0], abc[1]), abc[2]);
        if (!map->scratch.failed && sunder_i_big_bits(g) > 1)
            for (int i = 0; i < 3; i++) abc[i] = big_quotient(s, abc[i], g);
    }
    const unsigned long bits0 = sunder_i_big_bits(abc[0]), bits1 = sunder_i_big_bits(abc[1]);
    const long bits = (long)(bits0 > bits1 ? bits0 : bits1);
    const sunder_i_big one = sunder_i_big_i64(s, 1);
    return (sunder_i_map_line){.abc = {abc[0], abc[1], abc[2]},
                               .a = sunder_i_big_ratio(s, abc[0], one, -bits),
                               .b = sunder_i_big_ratio(s, abc[1], one, -bits),
                               .rx = p->ax,
                               .ry = p->ay};
}

sunder_i_map_line sunder_i_line_through(sunder_i_planar_map *map, const sunder_i_site *p, const sunder_i_site *q,
                                        const sunder_i_point *along, sunder_i_arena *arena)
{
    const sunder_i_mark mark = sunder_i_arena_mark(&map->scratch);
    const bool plain = along && sunder_i_point_is_plain(*along);
    sunder_i_map_line line = plain ? line_along(map, p, along->x, along->y) : line_between(map, p, q, along);
    if (arena == &map->scratch) return line;
    line = sunder_i_line_copy(&line, arena);
    sunder_i_arena_release(&map->scratch, mark);
    return line;
}

sunder_i_map_line sunder_i_line_copy(const sunder_i_map_line *from, sunder_i_arena *arena)
{
    sunder_i_map_line line = *from;
    sunder_i_big_copy_3(arena, &line.abc[0], &line.abc[1], &line.abc[2]);
    return line;
}

sunder_i_site sunder_i_site_copy(const sunder_i_site *from, sunder_i_arena *arena)
{
    sunder_i_site site = *from;
    site.at = sunder_i_rational_copy(arena, from->at);
    return site;
}
