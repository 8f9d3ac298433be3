/* Convex subsums: which of them matter, and their corners. The sum of two convex polygons has the sides of both, merged
 * by direction. */
#include "separation/operands/operands.h"

#include "base/invariant.h"
#include "base/sort.h"
#include "base/watch.h"
#include "convex/merge.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Does a box come within the radius, being so far off in x and in y? */
static inline bool touches_disc(const double d[2], double radius)
{
    const double x = d[0], y = d[1];
    return x <= radius && y <= radius && (x + y <= radius || x * x + y * y <= radius * radius * (1 + 0x1p-50));
}

/* Which of the subsums matter: 0 none, 1 comes within reach, 2 may cover the origin. */
static inline int nearness(const sunder_i_operands *g, uint32_t i, uint32_t j, double reach, double box[4])
{
    double d[2];
    sunder_i_box_sum(g->piece_box[0] + 4 * (size_t)i, g->piece_box[1] + 4 * (size_t)j, box);
    sunder_i_box_distance(box, d);
    return touches_disc(d, 2 * g->error) ? 2 : touches_disc(d, reach) ? 1 : 0;
}

/* Among many, the fat ones come first: they cover the most, and the search asks in this order. */
static bool sort_by_size(sunder_i_operands *g)
{
    sunder_i_arena *arena = &g->placed.lattice.arena;
    const size_t n = g->subsums;
    uint64_t *key = sunder_i_arena_alloc(arena, n, sizeof *key);
    sunder_i_subsum *sorted = sunder_i_arena_alloc(arena, n + 1, sizeof *sorted);
    if (!key || !sorted) return false;
    for (size_t k = 0; k < n; k++) {
        const double *b = g->subsum[k].box;
        const float size = (float)(fmin(b[2] - b[0], b[3] - b[1]) / g->magnitude);
        uint32_t bits;
        memcpy(&bits, &size, sizeof bits); /* ordered like the numbers, which are not negative */
        key[k] = (uint64_t)~bits << 32 | k;
    }
    if (!sunder_i_sort_keys(key, n)) return false;
    for (size_t k = 0; k < n; k++) sorted[k] = g->subsum[key[k] & UINT32_MAX];
    g->subsum = sorted;
    return true;
}

bool sunder_i_operands_reach(sunder_i_operands *g, double radius)
{
    const uint32_t m = g->shape[0]->pieces, n = g->shape[1]->pieces;
    const double reach = radius + 2 * g->error;
    double box[4];
    size_t room = (size_t)m * n, count[3] = {0, 0, 0};
    const bool many = room > 64;
    if (many) {
        for (uint32_t i = 0; i < m && sunder_i_steps(n / 8 + 1); i++)
            for (uint32_t j = 0; j < n; j++) count[nearness(g, i, j, reach, box)]++;
        room = count[1] + count[2];
    }
    g->subsum = sunder_i_arena_alloc(&g->placed.lattice.arena, room + 1, sizeof *g->subsum);
    if (!g->subsum) return false;
    size_t near = 0, all = 0; /* those that may cover the origin come first */
    for (uint32_t i = 0; i < m; i++) {
        if (!sunder_i_steps(n / 8 + 1)) return false;
        for (uint32_t j = 0; j < n; j++) {
            const int how = nearness(g, i, j, reach, box);
            if (how == 0) continue;
            sunder_i_subsum *s = g->subsum + all++;
            if (how == 2) {
                if (near + 1 < all) *s = g->subsum[near];
                s = g->subsum + near++;
            }
            s->i = i;
            s->j = j;
            s->sides = 0;
            memcpy(s->box, box, sizeof box);
        }
    }
    g->subsums = all;
    return !many || sort_by_size(g);
}

/* ---- Pieces turned so that they start at their lowest corner (of those the leftmost) ---- */

static uint32_t lowest(sunder_i_operands *g, const sunder_i_point *at, const uint32_t *c, uint32_t n)
{
    sunder_i_lattice *l = &g->placed.lattice;
    uint32_t best = 0;
    sunder_i_point b = at[c[0]];
    for (uint32_t k = 1; k < n; k++) {
        const sunder_i_point a = at[c[k]];
        bool lower;
        if (l->narrow)
            lower = (a.y < b.y) | ((a.y == b.y) & (a.x < b.x));
        else {
            const int d = sunder_i_int_cmp(l, a.y, b.y);
            lower = d < 0 || (d == 0 && sunder_i_int_cmp(l, a.x, b.x) < 0);
        }
        if (lower) best = k, b = a;
    }
    return best;
}

/* The piece's corners and sides, one more corner than sides; NULL if memory is out. A point has no sides. */
static const sunder_i_turned_piece *turn_piece(sunder_i_operands *g, int side, uint32_t piece)
{
    sunder_i_turned_piece *r = g->turned[side] + piece;
    if (r->n) return r;
    const sunder_shape *s = g->shape[side];
    const uint32_t first = piece ? s->piece_end[piece - 1] : 0, n = s->piece_end[piece] - first;
    const uint32_t *c = sunder_i_piece_vertices(s) + first;
    const sunder_i_point *at = g->at[side];
    sunder_i_point *block = sunder_i_arena_alloc(&g->placed.lattice.arena, 2 * (size_t)n + 1, sizeof *block);
    if (!block) return NULL;
    uint32_t k = lowest(g, at, c, n);
    r->corner = block;
    r->side = block + n + 1;
    block[0] = at[c[k]];
    for (uint32_t i = 1; i <= n; i++) {
        if (++k == n) k = 0;
        block[i] = at[c[k]];
        r->side[i - 1] = sunder_i_operands_diff(g, block[i], block[i - 1]);
    }
    if (n >= 2) r->n = n; /* else as if it were not made yet: that is no work */
    return r;
}

bool sunder_i_operands_turn(sunder_i_operands *g)
{
    for (int side = 0; side < 2; side++)
        for (uint32_t i = 0; i < g->shape[side]->pieces; i++)
            if (!turn_piece(g, side, i)) return false;
    return true;
}

/* ---- The merge ---- */

/* Both start at their lowest corners, so that their sides are sorted by angle in [0, 2 pi), and the two sides at hand
 * are never pi or more apart: the side before the further one came before the other, and turns by less than pi. */
static uint32_t merge(sunder_i_operands *g, const sunder_i_turned_piece *a, const sunder_i_turned_piece *b,
                      sunder_i_point *corner, sunder_i_point *side)
{
    uint32_t n = 0;
    sunder_i_merge m = sunder_i_merge_of(a->n, b->n);
    while (SUNDER_I_MERGE_NEXT(&m, -sunder_i_operands_cross(g, a->side[m.next_a], b->side[m.next_b]))) {
        const sunder_i_point u = a->side[m.a], v = b->side[m.b];
        corner[n] = sunder_i_operands_add(g, a->corner[m.a], b->corner[m.b]);
        side[n++] = !m.of_b ? u : !m.of_a ? v : sunder_i_operands_add(g, u, v);
    }
    return n;
}

/* The merge (merge.h) of native integers: corners follow from sides, so only sides are merged. Without branches: whose
 * side comes next is anyone's guess. */
static inline __attribute__((always_inline)) uint32_t narrow_merge(const sunder_i_turned_piece *a,
                                                                   const sunder_i_turned_piece *b, bool brief,
                                                                   sunder_i_point *corner, sunder_i_point *side)
{
    const sunder_i_point *u = a->side, *v = b->side, *const u_end = u + a->n, *const v_end = v + b->n;
    sunder_i_point at = {a->corner[0].x + b->corner[0].x, a->corner[0].y + b->corner[0].y};
    uint32_t n = 0;
    while (u < u_end && v < v_end) {
        const int64_t turn = brief ? sunder_i_brief_cross(*u, *v) : sunder_i_i128_sign(sunder_i_narrow_cross(*u, *v));
        const int64_t of_a = ~(turn >> 63), of_b = (turn - 1) >> 63; /* -1: turn >= 0, turn <= 0; else 0 */
        const sunder_i_point d = {(u->x & of_a) + (v->x & of_b), (u->y & of_a) + (v->y & of_b)};
        u -= of_a;
        v -= of_b;
        corner[n] = at;
        side[n++] = d;
        at = (sunder_i_point){at.x + d.x, at.y + d.y};
    }
    const sunder_i_point *left = u < u_end ? u : v, *const end = u < u_end ? u_end : v_end;
    for (; left < end; left++) { /* of one of them */
        corner[n] = at;
        side[n++] = *left;
        at = (sunder_i_point){at.x + left->x, at.y + left->y};
    }
    return n;
}

#ifndef NDEBUG
/* NULL, or what is wrong: a subsum is strictly convex, closed, and begins at its lowest corner. */
static const char *check(sunder_i_operands *g, const sunder_i_subsum *s)
{
    const char *wrong = s->sides < 3 ? "a subsum has fewer than three sides" : NULL;
    for (uint32_t k = 0; k < s->sides; k++) {
        const uint32_t next = k + 1 < s->sides ? k + 1 : 0;
        const sunder_i_point end = sunder_i_operands_add(g, s->corner[k], s->side[k]);
        if (sunder_i_operands_cross(g, s->side[k], s->side[next]) <= 0) wrong = "a subsum is not strictly convex";
        if (!sunder_i_point_equal(&g->placed.lattice, end, s->corner[next])) wrong = "a subsum is not closed";
        if (s->cy[k] < s->cy[0] - 2 * g->error) wrong = "a subsum does not begin at its lowest corner";
    }
    return g->placed.lattice.arena.failed ? NULL : wrong;
}
#endif

static void narrow_doubles(sunder_i_subsum *s, uint32_t n)
{
    s->plain = true;
    double *cx = s->cx, *cy = s->cy, *sx = s->sx, *sy = s->sy;
    for (uint32_t k = 0; k < n; k++) {
        const sunder_i_point c = s->corner[k], d = s->side[k];
        cx[k] = (double)c.x;
        cy[k] = (double)c.y;
        sx[k] = (double)d.x;
        sy[k] = (double)d.y;
    }
}

static void fill_doubles(const sunder_i_lattice *l, sunder_i_subsum *s, uint32_t n)
{
    s->plain = true;
    for (uint32_t k = 0; k < n; k++) {
        const sunder_i_point c = s->corner[k], d = s->side[k];
        s->plain = s->plain && sunder_i_point_is_plain(c) && sunder_i_point_is_plain(d);
        s->cx[k] = sunder_i_approx(l, c.x);
        s->cy[k] = sunder_i_approx(l, c.y);
        s->sx[k] = sunder_i_approx(l, d.x);
        s->sy[k] = sunder_i_approx(l, d.y);
    }
}

bool sunder_i_subsum_make(sunder_i_operands *g, sunder_i_subsum *s)
{
    sunder_i_lattice *l = &g->placed.lattice;
    const sunder_i_turned_piece *a = turn_piece(g, 0, s->i), *b = turn_piece(g, 1, s->j);
    if (!a || !b) return false;
    const size_t most = ((size_t)a->n + b->n + SUNDER_I_DOUBLES - 1) & ~(size_t)(SUNDER_I_DOUBLES - 1);
    sunder_i_point *points = sunder_i_arena_alloc(&l->arena, most, 2 * sizeof *points + 5 * sizeof *s->cx);
    if (!points) return false;
    s->corner = points;
    s->side = points + most;
    s->cx = (double *)(points + 2 * most);
    s->cy = s->cx + most;
    s->sx = s->cy + most;
    s->sy = s->sx + most;
    s->bound = s->sy + most;
    const uint32_t n = g->brief    ? narrow_merge(a, b, true, s->corner, s->side)
                       : l->narrow ? narrow_merge(a, b, false, s->corner, s->side)
                                   : merge(g, a, b, s->corner, s->side);
    if (l->narrow)
        narrow_doubles(s, n);
    else
        fill_doubles(l, s, n);
    const double per_length = 2 * g->error, fixed = 16 * g->magnitude * g->rough;
    for (uint32_t k = 0; k < n; k++) s->bound[k] = (fabs(s->sx[k]) + fabs(s->sy[k])) * per_length + fixed;
    if (n % SUNDER_I_DOUBLES) { /* most of these is a corner far below of a side to the right */
        s->cx[n] = s->sy[n] = s->bound[n] = 0;
        s->cy[n] = -DBL_MAX;
        s->sx[n] = 1;
    }
    s->sides = n;
    SUNDER_I_CHECK(check(g, s), n);
    return !l->arena.failed;
}
