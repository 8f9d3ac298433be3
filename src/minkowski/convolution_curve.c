/* The curve: P's sides, each moved by the corner of Q that is extreme in its outward direction, and what joins them. */
#include "minkowski/convolution_inner.h"

#include <string.h>

typedef struct mover {
    sunder_i_convolution *curve;
    const sunder_i_point *at; /* P's vertices */
    sunder_i_point *q;        /* [m] Q's corners, counter-clockwise */
    uint32_t m;
    uint32_t *first, *last; /* [vertices] the corners of Q extreme for the side that leaves a vertex; they differ where
                               Q has a side of that direction, from first to last */
    sunder_i_point *from, *to; /* [vertices] that side, moved */
} mover;

static sunder_i_point sum_of(sunder_i_point a, sunder_i_point b) { return (sunder_i_point){a.x + b.x, a.y + b.y}; }
static bool same(sunder_i_point a, sunder_i_point b) { return a.x == b.x && a.y == b.y; }
static uint32_t after(const mover *t, uint32_t j) { return j + 1 < t->m ? j + 1 : 0; }
static uint32_t before(const mover *t, uint32_t j) { return j ? j - 1 : t->m - 1; }

/* The sign of the turn from d to the side of Q that ends in corner j. */
static int turn_to(const mover *t, sunder_i_point d, uint32_t j)
{
    const sunder_i_det c = sunder_i_narrow_cross(d, sunder_i_narrow_sub(t->q[j], t->q[before(t, j)]));
    return (c > 0) - (c < 0);
}

/* From corner j, the last extreme one of the side before, to the last for d: forwards at a left turn, backwards at a
 * right one. */
static uint32_t walk_to(const mover *t, uint32_t j, sunder_i_point d, bool backwards)
{
    if (backwards)
        while (turn_to(t, d, j) > 0) j = before(t, j);
    else
        while (turn_to(t, d, after(t, j)) <= 0) j = after(t, j);
    return j;
}

/* The last of the corners that are extreme for d: the lowest across it. */
static uint32_t find_corner(const mover *t, sunder_i_point d)
{
    uint32_t best = 0;
    for (uint32_t j = 1; j < t->m; j++)
        if (sunder_i_narrow_cross(d, sunder_i_narrow_sub(t->q[j], t->q[best])) < 0) best = j;
    return walk_to(t, best, d, false);
}

/* ---- Holes ---- */

/* The corners of a ring of P, and how far they reach along x and y. */
static void size_of(const sunder_i_point *at, uint32_t n, int64_t size[2])
{
    sunder_i_point low = at[0], high = at[0];
    for (uint32_t i = 1; i < n; i++) {
        if (at[i].x < low.x) low.x = at[i].x;
        if (at[i].x > high.x) high.x = at[i].x;
        if (at[i].y < low.y) low.y = at[i].y;
        if (at[i].y > high.y) high.y = at[i].y;
    }
    size[0] = high.x - low.x;
    size[1] = high.y - low.y;
}

static uint32_t ring_begin(const sunder_shape *p, uint32_t r) { return r ? p->ring_end[r - 1] : 0; }

/* A hole that is narrower than Q one way or the other is of no consequence and left out [BFHHM15]: where x - Q's
 * interior has no point in common with P it lies in one hole, connected as it is, and does not fit into this one. One
 * that is just as large as Q both ways may be filled by a translate of -Q, where winding numbers do not count pieces:
 * then *fits is false. */
static void leave_out_holes(const mover *t, bool *fits)
{
    const sunder_shape *p = t->curve->p;
    int64_t size[2], own[2];
    t->curve->left_out[0] = false;
    if (p->rings == 1) return;
    size_of(t->q, t->m, size);
    for (uint32_t r = 1; r < p->rings; r++) {
        size_of(t->at + ring_begin(p, r), p->ring_end[r] - ring_begin(p, r), own);
        t->curve->left_out[r] = own[0] < size[0] || own[1] < size[1];
        if (own[0] == size[0] && own[1] == size[1]) *fits = false;
    }
}

/* ---- Sides ---- */

/* Which corners are extreme for the sides of one ring. False where two rings meet in a vertex, which then is not of one
 * chain. */
static bool find_corners(mover *t, uint32_t start)
{
    const sunder_shape *p = t->curve->p;
    uint32_t v = start;
    sunder_i_point d = sunder_i_narrow_sub(t->at[start], t->at[p->prev[start]]);
    uint32_t j = find_corner(t, d);
    do {
        const sunder_i_point e = sunder_i_narrow_sub(t->at[p->next[v]], t->at[v]);
        const sunder_i_det bend = sunder_i_narrow_cross(d, e);
        if (bend == 0 || p->shared[v]) return false;
        t->curve->reflex[v] = bend < 0;
        j = walk_to(t, j, e, bend < 0);
        t->last[v] = j;
        t->first[v] = turn_to(t, e, j) == 0 ? before(t, j) : j;
        d = e;
        v = p->next[v];
    } while (v != start);
    return true;
}

/* Where Q has a side of the same direction the two are joined to one; but at a reflex end it would be run back at once,
 * and is left out. False where with two such ends nothing is left. */
static bool move_sides(mover *t, uint32_t begin, uint32_t end)
{
    const sunder_shape *p = t->curve->p;
    for (uint32_t v = begin; v < end; v++) {
        const uint32_t w = p->next[v];
        const bool *reflex = t->curve->reflex;
        const sunder_i_point d = sunder_i_narrow_sub(t->at[w], t->at[v]);
        t->from[v] = sum_of(t->at[v], t->q[reflex[v] ? t->last[v] : t->first[v]]);
        t->to[v] = sum_of(t->at[w], t->q[reflex[w] ? t->first[v] : t->last[v]]);
        if (sunder_i_narrow_dot(d, sunder_i_narrow_sub(t->to[v], t->from[v])) <= 0) return false;
    }
    return true;
}

/* ---- Links ---- */

static uint32_t arc_length(const mover *t, uint32_t v)
{
    const uint32_t a = t->last[t->curve->p->prev[v]], b = t->first[v];
    return b >= a ? b - a : b + t->m - a;
}

static size_t count_links(const mover *t, uint32_t begin, uint32_t end)
{
    size_t n = end - begin;
    for (uint32_t v = begin; v < end; v++) n += t->curve->reflex[v] ? 1 : arc_length(t, v);
    return n;
}

static void add_chain(sunder_i_convolution *c, uint32_t vertex, uint32_t first, bool side, sunder_i_point end)
{
    sunder_i_chain x = {{end.x, end.y}, {end.x, end.y}, first, c->links, vertex, side};
    for (uint32_t i = first; i < c->links; i++) {
        const sunder_i_point a = c->corner[i];
        if (a.x < x.low[0]) x.low[0] = a.x;
        if (a.x > x.high[0]) x.high[0] = a.x;
        if (a.y < x.low[1]) x.low[1] = a.y;
        if (a.y > x.high[1]) x.high[1] = a.y;
    }
    c->chain[c->chains++] = x;
}

/* From where the side before v ends to where the side that leaves v starts. */
static void add_joint(mover *t, uint32_t v)
{
    sunder_i_convolution *c = t->curve;
    const uint32_t u = c->p->prev[v], first = c->links;
    c->joined[v] = same(t->to[u], t->from[v]);
    if (c->joined[v]) return;
    const uint32_t n = c->reflex[v] ? 1 : arc_length(t, v);
    for (uint32_t k = 0, j = t->last[u]; k < n; k++, j = after(t, j)) {
        c->chord[c->links] = c->reflex[v];
        c->corner[c->links++] = c->reflex[v] ? t->to[u] : sum_of(t->at[v], t->q[j]);
    }
    add_chain(c, v, first, false, t->from[v]);
}

static void add_links(mover *t)
{
    sunder_i_convolution *c = t->curve;
    for (uint32_t r = 0; r < c->p->rings; r++) {
        const uint32_t start = ring_begin(c->p, r), begin = c->links;
        c->ring_end[r] = c->links;
        if (c->left_out[r]) continue;
        uint32_t v = start;
        do {
            add_joint(t, v);
            c->chord[c->links] = false;
            c->corner[c->links++] = t->from[v];
            add_chain(c, v, c->links - 1, true, t->to[v]);
            v = c->p->next[v];
        } while (v != start);
        for (uint32_t i = begin; i < c->links; i++) c->next[i] = i + 1 < c->links ? i + 1 : begin;
        c->ring_end[r] = c->links;
    }
}

/* ---- All of it ---- */

static bool make_room(mover *t, const sunder_shape *q, const sunder_i_point *at_q)
{
    sunder_i_convolution *c = t->curve;
    sunder_i_arena *m = &c->memory;
    const size_t n = c->p->vertices;
    t->q = sunder_i_arena_alloc(m, t->m, sizeof *t->q);
    t->first = sunder_i_arena_alloc(m, n, sizeof *t->first);
    t->last = sunder_i_arena_alloc(m, n, sizeof *t->last);
    t->from = sunder_i_arena_alloc(m, n, sizeof *t->from);
    t->to = sunder_i_arena_alloc(m, n, sizeof *t->to);
    c->reflex = sunder_i_arena_alloc(m, n, sizeof *c->reflex);
    c->joined = sunder_i_arena_alloc(m, n, sizeof *c->joined);
    c->left_out = sunder_i_arena_alloc(m, c->p->rings, sizeof *c->left_out);
    if (m->failed) return false;
    for (uint32_t j = 0, v = 0; j < t->m; j++, v = q->next[v]) t->q[j] = at_q[v];
    return true;
}

static sunder_status build(mover *t, bool *fits, sunder_error *err)
{
    sunder_i_convolution *c = t->curve;
    const sunder_shape *p = c->p;
    size_t n = 0;
    *fits = true;
    leave_out_holes(t, fits);
    for (uint32_t r = 0; *fits && r < p->rings; r++) {
        if (c->left_out[r]) continue;
        *fits = find_corners(t, ring_begin(p, r)) && move_sides(t, ring_begin(p, r), p->ring_end[r]);
        n += *fits ? count_links(t, ring_begin(p, r), p->ring_end[r]) : 0;
    }
    if (!*fits) return SUNDER_OK;
    *fits = n < UINT32_MAX / 4;
    if (!*fits) return SUNDER_OK;
    sunder_i_arena *m = &c->memory;
    c->corner = sunder_i_arena_alloc(m, n, sizeof *c->corner);
    c->next = sunder_i_arena_alloc(m, n, sizeof *c->next);
    c->chord = sunder_i_arena_alloc(m, n, sizeof *c->chord);
    c->chain = sunder_i_arena_alloc(m, 2 * (size_t)p->vertices, sizeof *c->chain);
    c->ring_end = sunder_i_arena_alloc(m, p->rings, sizeof *c->ring_end);
    if (m->failed) return sunder_i_no_memory(err);
    add_links(t);
    return SUNDER_OK;
}

sunder_status sunder_i_convolution_build(sunder_i_convolution *curve, const sunder_i_point *at_p, const sunder_shape *q,
                                         const sunder_i_point *at_q, bool *fits, sunder_error *err)
{
    mover t = {.curve = curve, .at = at_p, .m = q->vertices};
    return make_room(&t, q, at_q) ? build(&t, fits, err) : sunder_i_no_memory(err);
}
