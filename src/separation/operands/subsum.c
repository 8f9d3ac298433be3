/* subsum.c: lists the convex subsums that matter, and computes their vertices. The sum of two convex polygons has the
 * sides of both, merged by direction. */
#include "separation/operands/pair_operands.h"

#include "base/extremes.h"
#include "base/invariant.h"
#include "base/sort.h"
#include "base/watch.h"
#include "convex/merge.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Returns whether a box at the distances d[0] and d[1] along the axes comes within the radius, without branches, since
 * the outcome cannot be predicted. */
static inline uint32_t touches_disc(const double d[2], double radius)
{
    const double x = d[0], y = d[1];
    return (uint32_t)(x <= radius) & (uint32_t)(y <= radius) &
           ((uint32_t)(x + y <= radius) | (uint32_t)(x * x + y * y <= radius * radius * (1 + 0x1p-50)));
}

/* An iterator over the pairs of pieces, row by row. */
typedef struct pair_walk {
    const sunder_i_operands *g;
    uint32_t i, j;
    size_t left;
} pair_walk;

static pair_walk all_pairs(const sunder_i_operands *g)
{
    return (pair_walk){g, 0, 0, (size_t)g->shape[0]->pieces * g->shape[1]->pieces};
}

/* The number of subsums tested between two checks whether the computation may continue. */
#define PAIRS_AT_ONCE 64

static size_t next_pairs(const pair_walk *w) { return w->left < PAIRS_AT_ONCE ? w->left : PAIRS_AT_ONCE; }

/* Returns whether the sum of the next two pieces is within reach; *near becomes whether it may cover the origin. */
static inline uint32_t look_at_pair(pair_walk *w, double reach, uint64_t *pair, uint32_t *near)
{
    const sunder_i_operands *g = w->g;
    double box[4], d[2];
    sunder_i_box_sum(g->piece_box[0] + 4 * (size_t)w->i, g->piece_box[1] + 4 * (size_t)w->j, box);
    sunder_i_box_distance(box, d);
    *pair = (uint64_t)w->i << 32 | w->j;
    *near = touches_disc(d, 2 * g->error);
    const uint32_t ends = w->j + 1 == g->shape[1]->pieces;
    w->j = (w->j + 1) & (ends - 1);
    w->i += ends;
    w->left--;
    return *near | touches_disc(d, reach);
}

/* Sorts the subsums by the smaller side of their boxes, largest first: large ones cover more, and the search tests them
 * in this order. Returns false if out of memory. */
static bool sort_by_size(sunder_i_operands *g)
{
    sunder_i_arena *arena = &g->placed.lattice.arena;
    const size_t n = g->subsums;
    uint64_t *key = sunder_i_arena_alloc(arena, n, sizeof *key);
    sunder_i_subsum *sorted = sunder_i_arena_alloc(arena, n + 1, sizeof *sorted);
    if (!key || !sorted) return false;
    for (size_t k = 0; k < n; k++) {
        const double *b = g->subsum[k].box;
        const float size = (float)(sunder_i_min(b[2] - b[0], b[3] - b[1]) / g->magnitude);
        uint32_t bits;
        memcpy(&bits, &size, sizeof bits); /* the bits of numbers that are not negative have the order of the numbers */
        key[k] = (uint64_t)~bits << 32 | k;
    }
    if (!sunder_i_sort_keys(key, n)) return false;
    for (size_t k = 0; k < n; k++) sorted[k] = g->subsum[key[k] & UINT32_MAX];
    g->subsum = sorted;
    return true;
}

/* Counts the pairs within reach. Returns false if the computation must stop. */
static bool count_near(const sunder_i_operands *g, double reach, size_t *count)
{
    *count = 0;
    for (pair_walk w = all_pairs(g); w.left;) {
        if (!sunder_i_steps(PAIRS_AT_ONCE / 8)) return false;
        for (size_t n = next_pairs(&w); n > 0; n--) {
            uint64_t pair;
            uint32_t near;
            *count += look_at_pair(&w, reach, &pair, &near);
        }
    }
    return true;
}

/* Lists the pairs within reach; those whose sums may cover the origin come first: each of them is exchanged with the
 * first of the others. Returns false if the computation must stop. */
static bool list_near(const sunder_i_operands *g, double reach, uint64_t *pair, size_t *count)
{
    size_t all = 0, first = 0;
    for (pair_walk w = all_pairs(g); w.left;) {
        if (!sunder_i_steps(PAIRS_AT_ONCE / 8)) return false;
        for (size_t n = next_pairs(&w); n > 0; n--) {
            uint32_t near;
            const uint32_t within = look_at_pair(&w, reach, pair + all, &near);
            const size_t at = all - (-(size_t)near & (all - first));
            const uint64_t own = pair[all];
            pair[all] = pair[at];
            pair[at] = own;
            all += within;
            first += near;
        }
    }
    *count = all;
    return true;
}

bool sunder_i_operands_reach(sunder_i_operands *operands, double radius)
{
    sunder_i_arena *arena = &operands->placed.lattice.arena;
    const double reach = radius + 2 * operands->error;
    size_t room = (size_t)operands->shape[0]->pieces * operands->shape[1]->pieces;
    const bool many = room > PAIRS_AT_ONCE;
    if (many && !count_near(operands, reach, &room)) return false;
    operands->subsum = sunder_i_arena_alloc(arena, room + 1, sizeof *operands->subsum);
    uint64_t *pair = sunder_i_arena_alloc(arena, room + 1, sizeof *pair); /* one element more may be written */
    if (!operands->subsum || !pair || !list_near(operands, reach, pair, &operands->subsums)) return false;
    for (size_t k = 0; k < operands->subsums; k++) {
        sunder_i_subsum *s = operands->subsum + k;
        s->i = (uint32_t)(pair[k] >> 32);
        s->j = (uint32_t)pair[k];
        s->sides = 0;
        sunder_i_box_sum(operands->piece_box[0] + 4 * (size_t)s->i, operands->piece_box[1] + 4 * (size_t)s->j, s->box);
    }
    return !many || sort_by_size(operands);
}

/* ---- Pieces as cycles that begin at their lowest vertex (of several the leftmost) ---- */

static uint32_t lowest_corner(sunder_i_lattice *l, const sunder_i_point *at, const uint32_t *c, uint32_t n)
{
    uint32_t best = 0;
    for (uint32_t k = 1; k < n; k++) {
        const sunder_i_point a = at[c[k]], b = at[c[best]];
        const int d = sunder_i_int_cmp(l, a.y, b.y);
        if (d < 0 || (d == 0 && sunder_i_int_cmp(l, a.x, b.x) < 0)) best = k;
    }
    return best;
}

/* Computes the vertices and sides of a piece of native integers. The vertices are stored twice in succession, so that a
 * complete cycle begins at the lowest one. There are no branches, since it cannot be predicted which vertex is the
 * lowest. */
static void narrow_turn(const sunder_i_point *at, const uint32_t *c, uint32_t n, sunder_i_point *round,
                        sunder_i_turned_piece *r)
{
    uint32_t best = 0;
    sunder_i_point b = at[c[0]];
    for (uint32_t k = 0; k < n; k++) {
        const sunder_i_point a = round[k] = round[n + k] = at[c[k]];
        const int64_t lower = -(int64_t)((a.y < b.y) | ((a.y == b.y) & (a.x < b.x)));
        best ^= (best ^ k) & (uint32_t)lower;
        b = (sunder_i_point){b.x ^ ((b.x ^ a.x) & lower), b.y ^ ((b.y ^ a.y) & lower)};
    }
    sunder_i_point *side = round + 2 * n;
    r->corner = round += best;
    r->side = side;
    for (uint32_t i = 0; i < n; i++) side[i] = sunder_i_narrow_sub(round[i + 1], round[i]);
}

/* Does the same as narrow_turn() on any lattice; `block` receives the n + 1 vertices and then the n sides. */
static void turn_corners(sunder_i_lattice *l, const sunder_i_point *at, const uint32_t *c, uint32_t n,
                         sunder_i_point *block, sunder_i_turned_piece *r)
{
    uint32_t k = lowest_corner(l, at, c, n);
    r->corner = block;
    r->side = block + n + 1;
    block[0] = at[c[k]];
    for (uint32_t i = 1; i <= n; i++) {
        if (++k == n) k = 0;
        block[i] = at[c[k]];
        r->side[i - 1] = sunder_i_point_sub(l, block[i], block[i - 1]);
    }
}

/* Returns the cycle of a piece, with one vertex more than sides; NULL if out of memory. A point has no sides. */
static const sunder_i_turned_piece *turn_piece(sunder_i_operands *g, int side, uint32_t piece)
{
    sunder_i_turned_piece *r = g->turned[side] + piece;
    if (r->n) return r;
    sunder_i_lattice *l = &g->placed.lattice;
    const sunder_i_operand_piece p = sunder_i_operands_piece(g, side, piece);
    sunder_i_point *block = sunder_i_arena_alloc(&l->arena, 3 * (size_t)p.n, sizeof *block);
    if (!block) return NULL;
    if (l->narrow)
        narrow_turn(g->at[side], p.corner, p.n, block, r);
    else
        turn_corners(l, g->at[side], p.corner, p.n, block, r);
    if (p.n >= 2) r->n = p.n; /* a point is computed each time, which takes no time */
    return r;
}

bool sunder_i_operands_turn(sunder_i_operands *operands)
{
    for (int side = 0; side < 2; side++)
        for (uint32_t i = 0; i < operands->shape[side]->pieces; i++)
            if (!turn_piece(operands, side, i)) return false;
    return true;
}

/* ---- The merge ---- */

/* Merges the sides of two pieces. Both cycles begin at their lowest vertices, so that their sides are sorted by angle
 * in [0, 2 pi), and the angle between the two current sides is always less than pi: the side before the farther one
 * came before the other, and turns by less than pi. */
static uint32_t merge_sides(sunder_i_operands *g, const sunder_i_turned_piece *a, const sunder_i_turned_piece *b,
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

/* Merges the sides of pieces of native integers (merge.h); vertices follow from sides. There are no branches, since it
 * cannot be predicted which side comes next. */
static inline __attribute__((always_inline)) uint32_t narrow_merge(const sunder_i_turned_piece *a,
                                                                   const sunder_i_turned_piece *b, bool brief,
                                                                   sunder_i_point *corner, sunder_i_point *side)
{
    const sunder_i_point *u = a->side, *v = b->side, *const u_end = u + a->n, *const v_end = v + b->n;
    sunder_i_point at = {a->corner[0].x + b->corner[0].x, a->corner[0].y + b->corner[0].y};
    uint32_t n = 0;
    while (u < u_end && v < v_end) {
        const int64_t turn = brief ? sunder_i_brief_cross(*u, *v) : sunder_i_i128_sign(sunder_i_narrow_cross(*u, *v));
        /* of_a is -1 if turn >= 0, of_b is -1 if turn <= 0; else they are 0 */
        const int64_t of_a = ~(turn >> 63), of_b = (turn - 1) >> 63;
        const sunder_i_point d = {(u->x & of_a) + (v->x & of_b), (u->y & of_a) + (v->y & of_b)};
        u -= of_a;
        v -= of_b;
        corner[n] = at;
        side[n++] = d;
        at = (sunder_i_point){at.x + d.x, at.y + d.y};
    }
    const sunder_i_point *left = u < u_end ? u : v, *const end = u < u_end ? u_end : v_end;
    for (; left < end; left++) { /* the rest belongs to one of the pieces */
        corner[n] = at;
        side[n++] = *left;
        at = (sunder_i_point){at.x + left->x, at.y + left->y};
    }
    return n;
}

#ifndef NDEBUG
/* Returns NULL, or what is wrong: a subsum is strictly convex and closed, and begins at its lowest vertex. */
static const char *check_subsum(sunder_i_operands *g, const sunder_i_subsum *s)
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

/* A side is decisive if its cross product exceeds its length times per_length, plus fixed. */
typedef struct bounds {
    double per_length, fixed;
} bounds;

static bounds bounds_of(const sunder_i_operands *g) { return (bounds){2 * g->error, 16 * g->magnitude * g->rough}; }

static void narrow_doubles(const sunder_i_operands *g, sunder_i_subsum *s, uint32_t n)
{
    s->plain = true;
    const bounds by = bounds_of(g);
    const sunder_i_point *corner = s->corner, *side = s->side;
    double *restrict cx = s->cx, *restrict cy = s->cy, *restrict sx = s->sx, *restrict sy = s->sy,
                     *restrict bound = s->bound;
    for (uint32_t k = 0; k < n; k++) {
        const double dx = (double)side[k].x, dy = (double)side[k].y;
        cx[k] = (double)corner[k].x;
        cy[k] = (double)corner[k].y;
        sx[k] = dx;
        sy[k] = dy;
        bound[k] = (fabs(dx) + fabs(dy)) * by.per_length + by.fixed;
    }
}

static void fill_doubles(const sunder_i_operands *g, sunder_i_subsum *s, uint32_t n)
{
    const sunder_i_lattice *l = &g->placed.lattice;
    const bounds by = bounds_of(g);
    s->plain = true;
    for (uint32_t k = 0; k < n; k++) {
        const sunder_i_point c = s->corner[k], d = s->side[k];
        s->plain = s->plain && sunder_i_point_is_plain(c) && sunder_i_point_is_plain(d);
        s->cx[k] = sunder_i_approx(l, c.x);
        s->cy[k] = sunder_i_approx(l, c.y);
        s->sx[k] = sunder_i_approx(l, d.x);
        s->sy[k] = sunder_i_approx(l, d.y);
        s->bound[k] = (fabs(s->sx[k]) + fabs(s->sy[k])) * by.per_length + by.fixed;
    }
}

bool sunder_i_subsum_make(sunder_i_operands *operands, sunder_i_subsum *subsum)
{
    sunder_i_lattice *l = &operands->placed.lattice;
    const sunder_i_turned_piece *a = turn_piece(operands, 0, subsum->i), *b = turn_piece(operands, 1, subsum->j);
    if (!a || !b) return false;
    const size_t most = ((size_t)a->n + b->n + SUNDER_I_DOUBLES - 1) & ~(size_t)(SUNDER_I_DOUBLES - 1);
    sunder_i_point *points = sunder_i_arena_alloc(&l->arena, most, 2 * sizeof *points + 5 * sizeof *subsum->cx);
    if (!points) return false;
    subsum->corner = points;
    subsum->side = points + most;
    subsum->cx = (double *)(points + 2 * most);
    subsum->cy = subsum->cx + most;
    subsum->sx = subsum->cy + most;
    subsum->sy = subsum->sx + most;
    subsum->bound = subsum->sy + most;
    const uint32_t n = operands->brief ? narrow_merge(a, b, true, subsum->corner, subsum->side)
                       : l->narrow     ? narrow_merge(a, b, false, subsum->corner, subsum->side)
                                       : merge_sides(operands, a, b, subsum->corner, subsum->side);
    if (l->narrow)
        narrow_doubles(operands, subsum, n);
    else
        fill_doubles(operands, subsum, n);
    if (n % SUNDER_I_DOUBLES) { /* the additional side is far below and points to the right, so that every point is on
                                 * its left */
        subsum->cx[n] = subsum->sy[n] = subsum->bound[n] = 0;
        subsum->cy[n] = -DBL_MAX;
        subsum->sx[n] = 1;
    }
    subsum->sides = n;
    SUNDER_I_CHECK(check_subsum(operands, subsum), n);
    return !l->arena.failed;
}
