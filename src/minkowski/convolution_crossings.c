/* convolution_crossings.c: finds the crossings of the curve: first pairs of chains with overlapping boxes, from left to
 * right, then pairs of links, exactly. */
#include "minkowski/convolution_inner.h"

#include "base/sort.h"
#include "base/watch.h"

#include <string.h>

/* The boxes of chains from left to right, as doubles: rounding is monotone, so that boxes that are disjoint as doubles
 * are disjoint. There is one array for each bound, since most of the time goes into comparing them. */
typedef struct boxes {
    double *low_x, *high_x, *low_y, *high_y; /* [chains] */
    uint32_t *chain;                         /* [chains] the number of each box's chain */
    uint32_t *near;                          /* [chains] the boxes that overlap the current one */
} boxes;

typedef struct crosser {
    sunder_i_convolution *curve;
    size_t pairs; /* the number of pairs that may still be tested */
    bool fits, no_memory;
} crosser;

/* The number of pairs of chains, and of pairs of links, that may be tested for each chain, on average. Curves that are
 * longer in the direction of the sweep are left to the general method, which has a better order. */
static const size_t patience = 256;

/* The functions below avoid branches: these would be mispredicted so often that superfluous tests cost less. */

/* Returns true if chains a and b can meet only at their common end, by construction. A side is on a line that supports
 * v + Q at both of its vertices v. (Two sides with a chord between them usually cross.) */
static bool are_neighbours(const sunder_i_convolution *c, const sunder_i_chain *a, const sunder_i_chain *b)
{
    const uint32_t *next = c->after;
    if (a->side && b->side) {
        const uint32_t v = next[a->vertex] == b->vertex ? b->vertex : a->vertex;
        if (v == a->vertex && next[b->vertex] != a->vertex) return false;
        return c->joined[v] || !c->reflex[v];
    }
    if (a->side == b->side) return false;
    const sunder_i_chain *side = a->side ? a : b, *joint = a->side ? b : a;
    return side->vertex == joint->vertex || next[side->vertex] == joint->vertex;
}

static inline int64_t lesser(int64_t a, int64_t b) { return a < b ? a : b; }
static inline int64_t greater(int64_t a, int64_t b) { return a < b ? b : a; }

static bool link_apart(sunder_i_point a, sunder_i_point b, const sunder_i_chain *c)
{
    const bool left = greater(a.x, b.x)<c->low[0], right = lesser(a.x, b.x)> c->high[0];
    const bool below = greater(a.y, b.y)<c->low[1], above = lesser(a.y, b.y)> c->high[1];
    return left | right | below | above;
}

static bool links_apart(sunder_i_point a, sunder_i_point b, sunder_i_point c, sunder_i_point d)
{
    const bool left = greater(a.x, b.x)<lesser(c.x, d.x), right = lesser(a.x, b.x)> greater(c.x, d.x);
    const bool below = greater(a.y, b.y)<lesser(c.y, d.y), above = lesser(a.y, b.y)> greater(c.y, d.y);
    return left | right | below | above;
}

/* The intersection of the lines ab and cd: a + (s / r) (b - a) = c + (t / r) (d - c), with r > 0. */
typedef struct meeting_point {
    sunder_i_det s, t, r;
    bool rises; /* ab crosses to the left side of cd */
} meeting_point;

/* Returns false if the lines are parallel. */
static bool find_meeting_point(const sunder_i_point ab[2], const sunder_i_point cd[2], meeting_point *m)
{
    const sunder_i_point u = sunder_i_narrow_sub(ab[1], ab[0]), w = sunder_i_narrow_sub(cd[1], cd[0]);
    const sunder_i_point v = sunder_i_narrow_sub(cd[0], ab[0]);
    const sunder_i_det r = sunder_i_narrow_cross(u, w), s = sunder_i_narrow_cross(v, w),
                       t = sunder_i_narrow_cross(v, u);
    *m = r < 0 ? (meeting_point){-s, -t, -r, true} : (meeting_point){s, t, r, false};
    return r != 0;
}

static void add_crossing(crosser *x, uint32_t i, uint32_t j, const meeting_point *m)
{
    sunder_i_convolution *c = x->curve;
    if (c->stops + 2 > c->stops_capacity &&
        !sunder_i_arena_reserve(&c->memory, &c->stop, &c->stops_capacity, c->stops + 2, sizeof *c->stop)) {
        x->no_memory = true;
        return;
    }
    const uint32_t n = (uint32_t)c->stops;
    c->stop[n] = (sunder_i_stop){i, n + 1, sunder_i_narrow_fraction(m->s, m->r), m->rises};
    c->stop[n + 1] = (sunder_i_stop){j, n, sunder_i_narrow_fraction(m->t, m->r), !m->rises};
    c->stops += 2;
    c->lattice->counts.segment_intersections += 2;
}

/* Tests two links with overlapping boxes. If an end of one is on the other, or the two overlap, x->fits becomes
 * false. */
static void cross_links(crosser *x, uint32_t i, const sunder_i_point ab[2], uint32_t j, const sunder_i_point cd[2])
{
    sunder_i_lattice *l = x->curve->lattice;
    meeting_point m;
    if (!find_meeting_point(ab, cd, &m)) {
        x->fits &= sunder_i_segments_meet(l, ab[0], ab[1], cd[0], cd[1]) == SUNDER_I_APART;
        return;
    }
    const bool sides = m.t < 0 || m.t > m.r; /* c and d are on the same side of ab */
    l->counts.orientation_tests += sides ? 2 : 4;
    if (sides || m.s < 0 || m.s > m.r) return;
    if (m.s == 0 || m.s == m.r || m.t == 0 || m.t == m.r)
        x->fits = false;
    else
        add_crossing(x, i, j, &m);
}

static void cross_chains(crosser *x, const sunder_i_chain *a, const sunder_i_chain *b)
{
    const sunder_i_convolution *c = x->curve;
    for (uint32_t i = a->first; i < a->end && x->fits && !x->no_memory; i++) {
        const sunder_i_point ab[2] = {c->corner[i], c->corner[c->next[i]]};
        if (link_apart(ab[0], ab[1], b)) continue;
        for (uint32_t j = b->first; j < b->end && x->fits && !x->no_memory; j++) {
            const sunder_i_point cd[2] = {c->corner[j], c->corner[c->next[j]]};
            if (!links_apart(ab[0], ab[1], cd[0], cd[1])) cross_links(x, i, ab, j, cd);
        }
    }
}

/* Lists in x->near the boxes after box i that overlap it, *n of them. Returns the index after the last box that was
 * tested. */
static uint32_t list_near(const boxes *x, uint32_t i, uint32_t end, uint32_t *n)
{
    const double right = x->high_x[i], low = x->low_y[i], high = x->high_y[i];
    uint32_t k = i + 1;
    *n = 0;
    for (; k < end && x->low_x[k] <= right; k++) {
        x->near[*n] = k;
        *n += !((x->high_y[k] < low) | (x->low_y[k] > high));
    }
    return k;
}

static void cross_all(crosser *x, const boxes *by)
{
    const sunder_i_convolution *c = x->curve;
    for (uint32_t i = 0; i < c->chains && x->fits && !x->no_memory; i++) {
        const sunder_i_chain *a = &c->chain[by->chain[i]];
        uint32_t n;
        const size_t looked_at = list_near(by, i, c->chains, &n) - i - 1;
        x->no_memory |= !sunder_i_step();
        x->fits &= looked_at <= x->pairs;
        x->pairs -= looked_at;
        for (uint32_t k = 0; k < n && x->fits && !x->no_memory; k++) {
            const sunder_i_chain *b = &c->chain[by->chain[by->near[k]]];
            if (!are_neighbours(c, a, b)) cross_chains(x, a, b);
        }
    }
}

/* ---- Stops in the order of their links ---- */

typedef struct stop_order {
    sunder_i_lattice *lattice;
    const sunder_i_stop *stop;
} stop_order;

/* Compares two stops on the same link. */
static int compare_stops(void *context, uint32_t a, uint32_t b)
{
    const stop_order *o = context;
    return sunder_i_fraction_cmp(o->lattice, &o->stop[a].at, &o->stop[b].at);
}

/* Lists the numbers of all stops in `order`, link by link, and sets stop_end. */
static void group_stops(sunder_i_convolution *c, uint32_t *order)
{
    uint32_t *end = c->stop_end, before = 0;
    memset(end, 0, c->links * sizeof *end);
    for (size_t i = 0; i < c->stops; i++) end[c->stop[i].link]++;
    for (uint32_t k = 0; k < c->links; k++) {
        const uint32_t own = end[k];
        end[k] = before; /* the index of the next stop of link k; after the loop below the end of its stops */
        before += own;
    }
    for (uint32_t i = 0; i < c->stops; i++) order[end[c->stop[i].link]++] = i;
}

/* Sorts the stops along their links, and updates their partners. x->fits becomes false if two stops have the same
 * position on a link, since then three links cross there. Returns false if out of memory. */
static bool order_stops(crosser *x, uint32_t *order, uint32_t *rank, sunder_i_stop *sorted)
{
    sunder_i_convolution *c = x->curve;
    const uint32_t n = (uint32_t)c->stops;
    stop_order by = {c->lattice, c->stop};
    group_stops(c, order);
    for (uint32_t k = 0, begin = 0; k < c->links; begin = c->stop_end[k++]) {
        if (c->stop_end[k] - begin < 2) continue;
        if (!sunder_i_sort_indices(order + begin, c->stop_end[k] - begin, compare_stops, &by)) return false;
        for (uint32_t i = begin + 1; i < c->stop_end[k]; i++)
            if (compare_stops(&by, order[i - 1], order[i]) == 0) x->fits = false;
    }
    for (uint32_t i = 0; i < n; i++) rank[order[i]] = i;
    for (uint32_t i = 0; i < n; i++) {
        sorted[i] = c->stop[order[i]];
        sorted[i].partner = rank[sorted[i].partner];
    }
    c->stop = sorted;
    return true;
}

/* Sorts the boxes from left to right, by insertion if there are few. Returns false if out of memory. */
static bool order_boxes(sunder_i_convolution *c, boxes *out)
{
    enum { FEW = 32 };
    sunder_i_valued few[FEW], *low = few;
    const uint32_t n = c->chains;
    if (n > FEW) low = sunder_i_arena_alloc(&c->memory, 2 * (size_t)n, sizeof *low);
    if (!low) return false;
    for (uint32_t i = 0; i < n; i++) {
        const sunder_i_valued own = {(double)c->chain[i].low[0], i, 0};
        uint32_t k = i;
        for (; n <= FEW && k > 0 && low[k - 1].value > own.value; k--) low[k] = low[k - 1];
        low[k] = own;
    }
    if (n > FEW && !sunder_i_sort_valued(low, n)) return false;
    for (uint32_t i = 0; i < n; i++) {
        const sunder_i_chain *a = &c->chain[low[i].item];
        out->chain[i] = low[i].item;
        out->low_x[i] = low[i].value;
        out->high_x[i] = (double)a->high[0];
        out->low_y[i] = (double)a->low[1];
        out->high_y[i] = (double)a->high[1];
    }
    return true;
}

static bool make_boxes(sunder_i_convolution *c, boxes *out)
{
    const size_t n = c->chains;
    out->low_x = sunder_i_arena_alloc(&c->memory, 4 * n, sizeof *out->low_x);
    out->chain = sunder_i_arena_alloc(&c->memory, 2 * n, sizeof *out->chain);
    if (!out->low_x || !out->chain) return false;
    out->high_x = out->low_x + n;
    out->low_y = out->high_x + n;
    out->high_y = out->low_y + n;
    out->near = out->chain + n;
    return order_boxes(c, out);
}

sunder_status sunder_i_convolution_cross(sunder_i_convolution *curve, bool *fits, sunder_error *err)
{
    sunder_i_arena *m = &curve->memory;
    crosser x = {.curve = curve, .pairs = patience * curve->chains, .fits = true};
    boxes by = {0};
    curve->stop_end = sunder_i_arena_alloc(m, curve->links, sizeof *curve->stop_end);
    bool ok = curve->stop_end && make_boxes(curve, &by);
    if (ok) cross_all(&x, &by);
    ok = ok && !x.no_memory;
    if (ok && x.fits) {
        uint32_t *both = sunder_i_arena_alloc(m, 2 * curve->stops, sizeof *both);
        sunder_i_stop *sorted = sunder_i_arena_alloc(m, curve->stops, sizeof *sorted);
        ok = both && sorted && order_stops(&x, both, both + curve->stops, sorted);
    }
    *fits = x.fits;
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
