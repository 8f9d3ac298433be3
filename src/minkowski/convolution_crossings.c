/* Where the curve crosses itself: chains by their boxes, from left to right, then link by link, exactly. */
#include "minkowski/convolution_inner.h"

#include "base/sort.h"
#include "base/watch.h"

#include <string.h>

typedef struct crosser {
    sunder_i_convolution *curve;
    size_t pairs; /* that may still be looked at */
    bool fits, no_memory;
} crosser;

/* Pairs of chains and pairs of links to look at, a chain on the average. What is longer in the direction of the sweep
 * is left to the general road, which has a better order. */
static const size_t patience = 256;

/* Branches that nobody foresees take longer here than tests that were not needed: so these are without. */

/* Of chains whose boxes overlap from left to right. */
static bool boxes_apart(const sunder_i_chain *a, const sunder_i_chain *b)
{
    return (a->high[1] < b->low[1]) | (b->high[1] < a->low[1]);
}

/* May they meet in nothing but the end that they share, by their making? A side is on a line that supports v + Q at
 * both of its vertices v. Two sides with a chord between them cross, mostly. */
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

static inline int64_t least(int64_t a, int64_t b) { return a < b ? a : b; }
static inline int64_t most(int64_t a, int64_t b) { return a < b ? b : a; }

static bool link_apart(sunder_i_point a, sunder_i_point b, const sunder_i_chain *c)
{
    return (most(a.x, b.x) < c->low[0]) | (least(a.x, b.x) > c->high[0]) | (most(a.y, b.y) < c->low[1]) |
           (least(a.y, b.y) > c->high[1]);
}

static bool links_apart(sunder_i_point a, sunder_i_point b, sunder_i_point c, sunder_i_point d)
{
    return (most(a.x, b.x) < least(c.x, d.x)) | (least(a.x, b.x) > most(c.x, d.x)) |
           (most(a.y, b.y) < least(c.y, d.y)) | (least(a.y, b.y) > most(c.y, d.y));
}

static void add_crossing(crosser *x, uint32_t i, const sunder_i_point ab[2], uint32_t j, const sunder_i_point cd[2])
{
    sunder_i_convolution *c = x->curve;
    if (c->stops + 2 > c->stops_capacity &&
        !sunder_i_arena_reserve(&c->memory, &c->stop, &c->stops_capacity, c->stops + 2, sizeof *c->stop)) {
        x->no_memory = true;
        return;
    }
    const bool rises = sunder_i_narrow_cross(sunder_i_narrow_sub(cd[1], cd[0]), sunder_i_narrow_sub(ab[1], ab[0])) > 0;
    const uint32_t n = (uint32_t)c->stops;
    c->stop[n] = (sunder_i_stop){i, n + 1, sunder_i_crossing(c->lattice, ab[0], ab[1], cd[0], cd[1]), rises};
    c->stop[n + 1] = (sunder_i_stop){j, n, sunder_i_crossing(c->lattice, cd[0], cd[1], ab[0], ab[1]), !rises};
    c->stops += 2;
}

static void cross_chains(crosser *x, const sunder_i_chain *a, const sunder_i_chain *b)
{
    const sunder_i_convolution *c = x->curve;
    for (uint32_t i = a->first; i < a->end && x->fits && !x->no_memory; i++) {
        const sunder_i_point ab[2] = {c->corner[i], c->corner[c->next[i]]};
        if (link_apart(ab[0], ab[1], b)) continue;
        for (uint32_t j = b->first; j < b->end && x->fits && !x->no_memory; j++) {
            const sunder_i_point cd[2] = {c->corner[j], c->corner[c->next[j]]};
            if (links_apart(ab[0], ab[1], cd[0], cd[1])) continue;
            const sunder_i_meeting how = sunder_i_segments_meet(c->lattice, ab[0], ab[1], cd[0], cd[1]);
            if (how == SUNDER_I_CROSS)
                add_crossing(x, i, ab, j, cd);
            else if (how != SUNDER_I_APART)
                x->fits = false;
        }
    }
}

static int compare_lows(void *context, uint32_t a, uint32_t b)
{
    const sunder_i_chain *e = context;
    return (e[a].low[0] > e[b].low[0]) - (e[a].low[0] < e[b].low[0]);
}

static void cross_all(crosser *x, const uint32_t *order)
{
    const sunder_i_convolution *c = x->curve;
    for (uint32_t i = 0; i < c->chains; i++) {
        const sunder_i_chain *a = &c->chain[order[i]];
        x->no_memory |= !sunder_i_step();
        for (uint32_t k = i + 1; k < c->chains && c->chain[order[k]].low[0] <= a->high[0]; k++) {
            const sunder_i_chain *b = &c->chain[order[k]];
            if (x->pairs-- == 0) x->fits = false;
            if (!x->fits || x->no_memory) return;
            if (!boxes_apart(a, b) && !are_neighbours(c, a, b)) cross_chains(x, a, b);
        }
    }
}

/* ---- Stops in the order of their links ---- */

typedef struct stop_order {
    sunder_i_lattice *lattice;
    const sunder_i_stop *stop;
} stop_order;

static int compare_stops(void *context, uint32_t a, uint32_t b)
{
    const stop_order *o = context;
    const sunder_i_stop *s = &o->stop[a], *t = &o->stop[b];
    if (s->link != t->link) return s->link < t->link ? -1 : 1;
    return a == b ? 0 : sunder_i_fraction_cmp(o->lattice, &s->at, &t->at);
}

/* Puts the stops in order, partners with them. Two stops at one place of a link are three links that cross there. */
static bool order_stops(crosser *x, uint32_t *order, uint32_t *rank, sunder_i_stop *sorted)
{
    sunder_i_convolution *c = x->curve;
    const uint32_t n = (uint32_t)c->stops;
    for (uint32_t i = 0; i < n; i++) order[i] = i;
    stop_order by = {c->lattice, c->stop};
    if (!sunder_i_sort_indices(order, n, compare_stops, &by)) return false;
    for (uint32_t i = 0; i < n; i++) {
        if (i > 0 && compare_stops(&by, order[i - 1], order[i]) == 0) x->fits = false;
        rank[order[i]] = i;
    }
    for (uint32_t i = 0; i < n; i++) {
        sorted[i] = c->stop[order[i]];
        sorted[i].partner = rank[sorted[i].partner];
    }
    for (uint32_t i = 0; i < n; i++) c->stop[i] = sorted[i];
    uint32_t at = 0;
    for (uint32_t k = 0; k < c->links; k++) {
        while (at < n && c->stop[at].link == k) at++;
        c->stop_end[k] = at;
    }
    return true;
}

/* Chains from left to right. */
static bool order_chains(const sunder_i_convolution *c, uint32_t *order)
{
    enum { FEW = 32 };
    for (uint32_t i = 0; i < c->chains; i++) order[i] = i;
    if (c->chains > FEW) return sunder_i_sort_indices(order, c->chains, compare_lows, c->chain);
    int64_t low[FEW];
    for (uint32_t i = 0; i < c->chains; i++) {
        const int64_t own = c->chain[i].low[0];
        uint32_t k = i;
        for (; k > 0 && low[k - 1] > own; k--) {
            low[k] = low[k - 1];
            order[k] = order[k - 1];
        }
        low[k] = own;
        order[k] = i;
    }
    return true;
}

sunder_status sunder_i_convolution_cross(sunder_i_convolution *curve, bool *fits, sunder_error *err)
{
    sunder_i_arena *m = &curve->memory;
    crosser x = {.curve = curve, .pairs = patience * curve->chains, .fits = true};
    uint32_t *order = sunder_i_arena_alloc(m, curve->chains, sizeof *order);
    curve->stop_end = sunder_i_arena_alloc(m, curve->links, sizeof *curve->stop_end);
    bool ok = order && curve->stop_end && order_chains(curve, order);
    if (ok) cross_all(&x, order);
    ok = ok && !x.no_memory;
    if (ok && x.fits) {
        uint32_t *both = sunder_i_arena_alloc(m, 2 * curve->stops, sizeof *both);
        sunder_i_stop *sorted = sunder_i_arena_alloc(m, curve->stops, sizeof *sorted);
        ok = both && sorted && order_stops(&x, both, both + curve->stops, sorted);
    }
    *fits = x.fits;
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}
