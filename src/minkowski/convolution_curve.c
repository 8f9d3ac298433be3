/* convolution_curve.c: constructs the curve: P's sides, each translated by the corner of Q that is extreme in its
 * outward direction, and the arcs and chords that join them. */
#include "minkowski/convolution_inner.h"

/* The state of one round. The vertices of its P are numbered from 0 on; so are the arrays. */
typedef struct mover {
    sunder_i_convolution *curve;
    const sunder_i_round *round;
    const sunder_i_point *at; /* [n] the vertices of P */
    const uint32_t *next;     /* [n] the next vertex of the ring, with the shape's numbers: subtract `start` */
    uint32_t start, n;        /* start: the number of P's first vertex in the shape */
    uint32_t base, ring;      /* the number of P's first vertex in the curve, and that of P's first ring */
    bool *reflex, *joined;    /* [n] these two are parts of the curve's arrays */
    sunder_i_point *q;        /* [m] the corners of Q, counterclockwise */
    uint32_t m;
    uint32_t *first, *last;    /* [n] the corners of Q that are extreme for the side that leaves a vertex; they differ
                                * if Q has a side of that direction, which goes from first to last */
    sunder_i_point *from, *to; /* [n] the ends of that side after translation */
    bool *backwards;           /* [n] whether the translated side has the opposite direction */
} mover;

static sunder_i_point sum_of(sunder_i_point a, sunder_i_point b) { return (sunder_i_point){a.x + b.x, a.y + b.y}; }
static bool is_same_point(sunder_i_point a, sunder_i_point b) { return a.x == b.x && a.y == b.y; }
static uint32_t corner_after(const mover *t, uint32_t j) { return j + 1 < t->m ? j + 1 : 0; }
static uint32_t corner_before(const mover *t, uint32_t j) { return j ? j - 1 : t->m - 1; }
static uint32_t next_of(const mover *t, uint32_t v) { return t->next[v] - t->start; }
static uint32_t prev_of(const mover *t, uint32_t v) { return t->round->p->form->cleaned.prev[t->start + v] - t->start; }

/* Returns the sign of the turn from d to the side of Q that ends at corner j. */
static int turn_to(const mover *t, sunder_i_point d, uint32_t j)
{
    const sunder_i_det c = sunder_i_narrow_cross(d, sunder_i_narrow_sub(t->q[j], t->q[corner_before(t, j)]));
    return (c > 0) - (c < 0);
}

/* Returns the last corner of Q that is extreme for d. The search starts at corner j, the last extreme one of the
 * previous side, and goes forwards at a left turn, backwards at a right turn. */
static uint32_t walk_to(const mover *t, uint32_t j, sunder_i_point d, bool backwards)
{
    if (backwards)
        while (turn_to(t, d, j) > 0) j = corner_before(t, j);
    else
        while (turn_to(t, d, corner_after(t, j)) <= 0) j = corner_after(t, j);
    return j;
}

/* Returns the last of the corners of Q that are extreme for d: the corners farthest to the right of d. */
static uint32_t find_corner(const mover *t, sunder_i_point d)
{
    uint32_t best = 0;
    for (uint32_t j = 1; j < t->m; j++)
        if (sunder_i_narrow_cross(d, sunder_i_narrow_sub(t->q[j], t->q[best])) < 0) best = j;
    return walk_to(t, best, d, false);
}

/* ---- Holes ---- */

/* Stores the width and the height of a ring of n vertices in `size`. */
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

static uint32_t first_ring(const mover *t) { return sunder_i_round_first_ring(t->round); }

static uint32_t rings_of(const mover *t)
{
    return t->round->p->form->cleaned.poly_end[t->round->polygon] - first_ring(t);
}

/* Returns the end of ring r of P. */
static uint32_t ring_end(const mover *t, uint32_t r)
{
    return t->round->p->form->cleaned.ring_end[first_ring(t) + r] - t->start;
}
static uint32_t ring_begin(const mover *t, uint32_t r) { return r ? ring_end(t, r - 1) : 0; }

/* Omits a hole that is narrower than Q along x or y, which changes nothing [BFHHM15]: if the interior of x - Q does not
 * meet P, it is in one hole, since it is connected, and it does not fit into this one. A hole with exactly Q's extent
 * along both axes may be filled by a translate of -Q, where winding numbers do not count components: then *fits becomes
 * false. */
static void leave_out_holes(const mover *t, bool *fits)
{
    int64_t size[2], own[2];
    bool *left_out = t->curve->left_out + t->ring;
    left_out[0] = false;
    if (rings_of(t) == 1) return;
    size_of(t->q, t->m, size);
    for (uint32_t r = 1; r < rings_of(t); r++) {
        size_of(t->at + ring_begin(t, r), ring_end(t, r) - ring_begin(t, r), own);
        left_out[r] = own[0] < size[0] || own[1] < size[1];
        if (own[0] == size[0] && own[1] == size[1]) *fits = false;
    }
}

/* ---- Sides ---- */

/* Finds the extreme corners for the sides of one ring. Returns false if two rings meet in a vertex, since that vertex
 * would belong to several chains, or if a vertex is straight. */
static bool find_corners(mover *t, uint32_t start)
{
    uint32_t v = start;
    sunder_i_point d = sunder_i_narrow_sub(t->at[start], t->at[prev_of(t, start)]);
    uint32_t j = find_corner(t, d);
    do {
        const sunder_i_point e = sunder_i_narrow_sub(t->at[next_of(t, v)], t->at[v]);
        const sunder_i_det bend = sunder_i_narrow_cross(d, e);
        if (bend == 0 || t->round->p->form->cleaned.shared[t->start + v]) return false;
        t->reflex[v] = bend < 0;
        j = walk_to(t, j, e, bend < 0);
        t->last[v] = j;
        t->first[v] = turn_to(t, e, j) == 0 ? corner_before(t, j) : j;
        d = e;
        v = next_of(t, v);
    } while (v != start);
    return true;
}

/* Translates the sides of P. A side of Q with the direction of P's side is joined to it. At a reflex end it would be
 * traversed in the opposite direction at once, and is omitted. So with two reflex ends Q's side is subtracted from P's,
 * and the difference has the opposite direction if Q's side is the longer one: then the interior of Q meets that of P
 * at both ends whenever the two sides are in contact, and the argument about chords holds (convolution.c). Returns
 * false if the difference is zero, which may be an exact fit. */
static bool move_sides(mover *t, uint32_t begin, uint32_t end)
{
    const bool *reflex = t->reflex;
    for (uint32_t v = begin; v < end; v++) {
        const uint32_t w = next_of(t, v);
        t->from[v] = sum_of(t->at[v], t->q[reflex[v] ? t->last[v] : t->first[v]]);
        t->to[v] = sum_of(t->at[w], t->q[reflex[w] ? t->first[v] : t->last[v]]);
        if (is_same_point(t->from[v], t->to[v])) return false;
        const sunder_i_point d = sunder_i_narrow_sub(t->at[w], t->at[v]);
        t->backwards[v] = t->first[v] != t->last[v] && reflex[v] && reflex[w] &&
                          sunder_i_narrow_dot(d, sunder_i_narrow_sub(t->to[v], t->from[v])) < 0;
    }
    return true;
}

/* ---- Links ---- */

static uint32_t arc_length(const mover *t, uint32_t v)
{
    const uint32_t a = t->last[prev_of(t, v)], b = t->first[v];
    return b >= a ? b - a : b + t->m - a;
}

static size_t count_links(const mover *t, uint32_t begin, uint32_t end)
{
    size_t n = end - begin;
    for (uint32_t v = begin; v < end; v++) n += t->reflex[v] ? 1 : arc_length(t, v);
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

/* Adds the arc or chord from the end of the side before v to the beginning of the side that leaves v. */
static void add_joint(mover *t, uint32_t v)
{
    sunder_i_convolution *c = t->curve;
    const uint32_t u = prev_of(t, v), first = c->links;
    t->joined[v] = is_same_point(t->to[u], t->from[v]);
    if (t->joined[v]) return;
    const uint32_t n = t->reflex[v] ? 1 : arc_length(t, v);
    for (uint32_t k = 0, j = t->last[u]; k < n; k++, j = corner_after(t, j)) {
        c->chord[c->links] = t->reflex[v];
        c->corner[c->links++] = t->reflex[v] ? t->to[u] : sum_of(t->at[v], t->q[j]);
    }
    add_chain(c, t->base + v, first, false, t->from[v]);
}

static void add_ring(mover *t, uint32_t start)
{
    sunder_i_convolution *c = t->curve;
    const uint32_t begin = c->links;
    uint32_t v = start;
    do {
        add_joint(t, v);
        c->chord[c->links] = t->backwards[v];
        c->corner[c->links++] = t->from[v];
        add_chain(c, t->base + v, c->links - 1, true, t->to[v]);
        c->after[t->base + v] = t->base + next_of(t, v);
        v = next_of(t, v);
    } while (v != start);
    for (uint32_t i = begin; i < c->links; i++) c->next[i] = i + 1 < c->links ? i + 1 : begin;
}

static void add_links(mover *t)
{
    sunder_i_convolution *c = t->curve;
    for (uint32_t r = 0; r < rings_of(t); r++) {
        if (!c->left_out[t->ring + r]) add_ring(t, ring_begin(t, r));
        c->ring_end[t->ring + r] = c->links;
    }
}

/* ---- The whole curve ---- */

/* Returns the state for one round, whose vertices and rings are numbered after those of the previous rounds. */
static mover mover_of(sunder_i_convolution *c, const sunder_i_round *round)
{
    const uint32_t ring = sunder_i_round_first_ring(round), end = round->p->form->cleaned.poly_end[round->polygon];
    const uint32_t start = ring ? round->p->form->cleaned.ring_end[ring - 1] : 0;
    const mover t = {.curve = c,
                     .round = round,
                     .at = round->at_p + start,
                     .next = round->p->form->cleaned.next + start,
                     .start = start,
                     .n = round->p->form->cleaned.ring_end[end - 1] - start,
                     .base = c->vertices,
                     .ring = c->rings,
                     .m = sunder_i_round_corners(round)};
    c->vertices += t.n;
    c->rings += end - ring;
    return t;
}

/* Allocates the arrays that all rounds share. Returns false if out of memory. */
static bool make_room(sunder_i_convolution *c)
{
    sunder_i_arena *m = &c->memory;
    c->after = sunder_i_arena_alloc(m, c->vertices, sizeof *c->after);
    c->reflex = sunder_i_arena_alloc(m, c->vertices, sizeof *c->reflex);
    c->joined = sunder_i_arena_alloc(m, c->vertices, sizeof *c->joined);
    c->left_out = sunder_i_arena_alloc(m, c->rings, sizeof *c->left_out);
    c->ring_end = sunder_i_arena_alloc(m, c->rings, sizeof *c->ring_end);
    return !m->failed;
}

static bool make_own_room(mover *t)
{
    sunder_i_arena *m = &t->curve->memory;
    t->reflex = t->curve->reflex + t->base;
    t->joined = t->curve->joined + t->base;
    t->q = sunder_i_arena_alloc(m, t->m, sizeof *t->q);
    t->first = sunder_i_arena_alloc(m, t->n, sizeof *t->first);
    t->last = sunder_i_arena_alloc(m, t->n, sizeof *t->last);
    t->from = sunder_i_arena_alloc(m, t->n, sizeof *t->from);
    t->to = sunder_i_arena_alloc(m, t->n, sizeof *t->to);
    t->backwards = sunder_i_arena_alloc(m, t->n, sizeof *t->backwards);
    if (m->failed) return false;
    for (uint32_t j = 0, v = sunder_i_round_first_corner(t->round); j < t->m;
         j++, v = t->round->q->form->cleaned.next[v])
        t->q[j] = t->round->at_q[v];
    return true;
}

/* Translates the sides of one round; adds the number of its links to *links. *fits becomes false if the round cannot be
 * computed in this way. */
static void move_round(mover *t, bool *fits, size_t *links)
{
    leave_out_holes(t, fits);
    for (uint32_t r = 0; *fits && r < rings_of(t); r++) {
        if (t->curve->left_out[t->ring + r]) continue;
        *fits = find_corners(t, ring_begin(t, r)) && move_sides(t, ring_begin(t, r), ring_end(t, r));
        *links += *fits ? count_links(t, ring_begin(t, r), ring_end(t, r)) : 0;
    }
}

static bool make_links(sunder_i_convolution *c, const mover *t, size_t links)
{
    sunder_i_arena *m = &c->memory;
    c->corner = sunder_i_arena_alloc(m, links, sizeof *c->corner);
    c->next = sunder_i_arena_alloc(m, links, sizeof *c->next);
    c->chord = sunder_i_arena_alloc(m, links, sizeof *c->chord);
    c->chain = sunder_i_arena_alloc(m, 2 * (size_t)c->vertices, sizeof *c->chain);
    if (m->failed) return false;
    for (size_t i = 0; i < c->rounds; i++) {
        mover own = t[i];
        add_links(&own);
    }
    return true;
}

sunder_status sunder_i_convolution_build(sunder_i_convolution *curve, bool *fits, sunder_error *err)
{
    size_t links = 0;
    mover *t = sunder_i_arena_alloc(&curve->memory, curve->rounds, sizeof *t);
    if (!t) return sunder_i_failure_cause(err);
    for (size_t i = 0; i < curve->rounds; i++) t[i] = mover_of(curve, &curve->round[i]);
    bool ok = make_room(curve);
    *fits = true;
    for (size_t i = 0; ok && *fits && i < curve->rounds; i++) {
        ok = make_own_room(&t[i]);
        if (ok) move_round(&t[i], fits, &links);
    }
    *fits = *fits && links < UINT32_MAX / 4;
    if (ok && *fits) ok = make_links(curve, t, links);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
