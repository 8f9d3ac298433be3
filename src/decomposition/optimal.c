/* optimal.c: the decomposition of a polygon without holes by diagonals of least total weight: one with the fewest
 * pieces if each diagonal has weight one. The dynamic programming is in the manner of Greene and of Keil [Gre83,
 * Kei85], arranged so that each pair of a vertex and an edge is processed once.
 *
 * Vertices are 0 .. n - 1 around the ring. A *link* (u, v), u < v, is an edge of the polygon or a diagonal. W(u, v) is
 * the least weight of diagonals inside the part of the polygon that the vertices u .. v bound, without the link itself.
 * The piece at the link (i, j), inside this part, is a convex chain of links i = v0 < v1 < ... < vk = j, and
 *
 *     W(i, j) = min over such chains of the sum over its links of W(v, v') + weight(v, v').
 *
 * For each i, from the last vertex to the first, all chains that start at i are extended at once, u ascending: a chain
 * that arrives at u by a link (t, u) may continue with (u, v) if the corner at u is convex. The vertices that u sees
 * are sorted by angle around u; so for v ascending the permitted t are a growing range (two pointers), and only the
 * best chains of it are kept. If i is convex, the best chain is that of least weight. If i is reflex, the chain's first
 * link matters, too, since the angle at i from there to j must not exceed pi: later first links are better, and the
 * chains that no other beats in both respects are kept (the front). If each diagonal has weight one, a chain to u that
 * is not lighter than the link (i, u) itself is beaten by that link, so that fronts are short. With other weights
 * fronts are limited to FRONT_MOST chains, and the result may not be quite the least.
 *
 * A chain is discarded when the turn back to i is no left turn, or the angle at i exceeds pi: both can only get worse.
 *
 * Diagonals between two convex vertices are not used: removing one leaves convex corners. Corners of pieces may be
 * straight: a vertex on a line between two others divides it into two diagonals. (So the optimum is at most that of
 * decompositions into strictly convex pieces with matching sides.) A closing link is never degenerate, since a diagonal
 * meets no vertex between its ends.
 *
 * Weights are sums of doubles, exact if each diagonal has weight one. All decisions about the geometry are orientations
 * of vertices (degree 2). Time: for each vertex from which a diagonal leads to a greater vertex, the links among the
 * vertices that it sees: at most O(r n n), usually far less; memory O(r n). */
#include "decomposition/maker.h"

#include "base/list.h"
#include "base/watch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The largest length of a front if weights differ: without a limit it may become as long as the number of vertices that
 * a vertex sees. The lightest chains are kept, and the single link. */
#define FRONT_MOST 8

/* A convex chain that starts at the current vertex: its last link comes from `from`; `before` is the chain without that
 * link. */
typedef struct chain {
    double weight;
    uint32_t from, start;  /* start: the vertex of its first link (0 if it does not matter) */
    uint32_t before, next; /* next: the next chain that arrives at the same vertex, by ascending `from` */
} chain;

struct sunder_i_program {
    sunder_i_maker *m;
    uint32_t first, n;
    bool *reflex;
    uint32_t *up_first, *up; /* [n + 1], [links] the upper ends v of the links (u, v) of each u, ascending */
    uint32_t *allowed;       /* [links] for (u, v): the greatest t with a convex corner t u v, plus one; 0: none */
    double *length, *within; /* [links] within: W */
    double each, by_length;
    chain *chain; /* grows */
    uint32_t chains;
    size_t chain_room;
    uint32_t *least;                      /* [n] a cache, see least_start(); SUNDER_I_NONE: not computed yet */
    uint32_t *head, *tail;                /* [n] the list of chains that arrive at each vertex */
    uint32_t pieces, *piece_end, *corner; /* the last solution */
    uint32_t *front;                      /* the chains kept at one vertex; grows */
    size_t front_room;
};

static int turn_of_corners(const sunder_i_program *p, uint32_t a, uint32_t b, uint32_t c)
{
    return sunder_i_rings_orient(&p->m->rings, p->first + a, p->first + b, p->first + c);
}

/* ---- Links ---- */

typedef struct both_ways {
    uint32_t u, v;
} both_ways;

/* Returns all pairs u < v that are edges, or that see each other and are not both convex, *count of them; the caller
 * frees the array. NULL if out of memory. */
static both_ways *find_links(sunder_i_program *p, const sunder_i_member *member, uint32_t *count)
{
    sunder_i_ray_shooting rays;
    both_ways *link = NULL;
    size_t room = 0, n = 0;
    bool ok = sunder_i_ray_shooting_init(&rays, &p->m->rings, member, &p->m->scratch) &&
              sunder_i_reserve(&link, &room, p->n, sizeof *link);
    for (uint32_t v = 0; ok && v < p->n; v++) {
        const uint32_t w = (v + 1) % p->n;
        link[n++] = (both_ways){v < w ? v : w, v < w ? w : v};
    }
    for (uint32_t v = 0; ok && v < p->n; v++) {
        if (!p->reflex[v]) continue;
        ok = sunder_i_ray_shooting_visible(&rays, p->first + v, NULL) &&
             sunder_i_reserve(&link, &room, n + rays.seen_n, sizeof *link);
        for (uint32_t i = 0; ok && i < rays.seen_n; i++) {
            const uint32_t w = rays.seen[i] - p->first, gap = v < w ? w - v : v - w;
            if (gap == 1 || gap == p->n - 1 || (p->reflex[w] && w < v)) continue;
            link[n++] = (both_ways){v < w ? v : w, v < w ? w : v};
        }
    }
    sunder_i_ray_shooting_free(&rays);
    if (ok && n <= UINT32_MAX) {
        qsort(link, n, sizeof *link, sunder_i_by_id_pair);
        *count = (uint32_t)n;
        return link;
    }
    sunder_i_free(link);
    return NULL;
}

/* For each link from u to a greater vertex v, finds the end of the range of t; t and v ascend together. */
static void find_allowed(sunder_i_program *p, const uint32_t *down_first, const uint32_t *down)
{
    for (uint32_t u = 0; u < p->n; u++) {
        uint32_t t = down_first[u];
        for (uint32_t e = p->up_first[u]; e < p->up_first[u + 1]; e++) {
            while (t < down_first[u + 1] && turn_of_corners(p, down[t], u, p->up[e]) >= 0) t++;
            p->allowed[e] = t > down_first[u] ? down[t - 1] + 1 : 0;
        }
    }
}

static bool fill_links(sunder_i_program *p, const both_ways *link, uint32_t count)
{
    sunder_i_arena *arena = &p->m->scratch;
    const double *xy = p->m->rings.xy + 2 * (size_t)p->first;
    p->up_first = sunder_i_arena_alloc(arena, (size_t)p->n + 1, sizeof *p->up_first);
    p->up = sunder_i_arena_alloc(arena, count, sizeof *p->up);
    p->allowed = sunder_i_arena_alloc(arena, count, sizeof *p->allowed);
    p->length = sunder_i_arena_alloc(arena, count, sizeof *p->length);
    p->within = sunder_i_arena_alloc(arena, count, sizeof *p->within);
    uint32_t *down_first = sunder_i_arena_alloc(arena, (size_t)p->n + 2, sizeof *down_first);
    uint32_t *down = sunder_i_arena_alloc(arena, count, sizeof *down);
    if (arena->failed) return false;
    memset(p->up_first, 0, ((size_t)p->n + 1) * sizeof *p->up_first);
    memset(down_first, 0, ((size_t)p->n + 2) * sizeof *down_first);
    for (uint32_t e = 0; e < count; e++) {
        const double *a = xy + 2 * (size_t)link[e].u, *b = xy + 2 * (size_t)link[e].v;
        p->up_first[link[e].u + 1]++;
        down_first[link[e].v + 2]++;
        p->up[e] = link[e].v;
        p->length[e] = hypot(a[0] - b[0], a[1] - b[1]);
    }
    for (uint32_t u = 0; u < p->n; u++) {
        p->up_first[u + 1] += p->up_first[u];
        down_first[u + 2] += down_first[u + 1];
    }
    for (uint32_t e = 0; e < count; e++) down[down_first[link[e].v + 1]++] = link[e].u; /* ascending, as link[] is */
    find_allowed(p, down_first, down);
    return !sunder_i_maker_failed(p->m);
}

sunder_i_program *sunder_i_program_new(sunder_i_maker *m, const sunder_i_member *member)
{
    sunder_i_arena *arena = &m->scratch;
    sunder_i_program *p = sunder_i_arena_alloc(arena, 1, sizeof *p);
    if (!p) return NULL;
    memset(p, 0, sizeof *p);
    p->m = m;
    p->first = member->first;
    p->n = member->n;
    p->reflex = sunder_i_arena_alloc(arena, p->n, sizeof *p->reflex);
    p->least = sunder_i_arena_alloc(arena, p->n, sizeof *p->least);
    p->head = sunder_i_arena_alloc(arena, p->n, sizeof *p->head);
    p->tail = sunder_i_arena_alloc(arena, p->n, sizeof *p->tail);
    p->piece_end = sunder_i_arena_alloc(arena, p->n, sizeof *p->piece_end);
    p->corner = sunder_i_arena_alloc(arena, 3 * (size_t)p->n, sizeof *p->corner);
    if (arena->failed) return NULL;
    for (uint32_t v = 0; v < p->n; v++) p->reflex[v] = sunder_i_is_reflex(&m->rings, p->first + v);
    uint32_t count = 0;
    both_ways *link = find_links(p, member, &count);
    const bool ok = link && fill_links(p, link, count);
    sunder_i_free(link);
    if (ok) return p;
    arena->failed = true;
    return NULL;
}

/* ---- Chains ---- */

static double weight_of(const sunder_i_program *p, uint32_t u, uint32_t e)
{
    const uint32_t gap = p->up[e] - u;
    return gap == 1 || gap == p->n - 1 ? 0 : p->each + p->by_length * p->length[e];
}

static bool add_chain(sunder_i_program *p, uint32_t at, chain c)
{
    if (!sunder_i_reserve(&p->chain, &p->chain_room, (size_t)p->chains + 1, sizeof *p->chain) ||
        p->chains == SUNDER_I_NONE - 1) {
        p->m->scratch.failed = true;
        return false;
    }
    c.next = SUNDER_I_NONE;
    p->chain[p->chains] = c;
    if (p->head[at] == SUNDER_I_NONE)
        p->head[at] = p->chains;
    else
        p->chain[p->tail[at]].next = p->chains;
    p->tail[at] = p->chains++;
    return true;
}

/* Adds chain c to the front of n chains unless one of them is as good; removes those that c beats. Returns the new
 * length of the front. */
static uint32_t front_add(sunder_i_program *p, uint32_t n, uint32_t c)
{
    const chain *now = &p->chain[c];
    uint32_t kept = 0;
    for (uint32_t k = 0; k < n; k++) {
        const chain *old = &p->chain[p->front[k]];
        if (old->weight <= now->weight && old->start >= now->start) return n;
    }
    for (uint32_t k = 0; k < n; k++) {
        const chain *old = &p->chain[p->front[k]];
        if (!(now->weight <= old->weight && now->start >= old->start)) p->front[kept++] = p->front[k];
    }
    if (!sunder_i_reserve(&p->front, &p->front_room, (size_t)kept + 1, sizeof *p->front)) {
        p->m->scratch.failed = true;
        return kept;
    }
    if (kept >= FRONT_MOST && p->by_length > 0) {
        uint32_t heaviest = SUNDER_I_NONE;
        for (uint32_t k = 0; k < kept; k++) {
            const chain *old = &p->chain[p->front[k]];
            if (old->before == SUNDER_I_NONE) continue; /* the single link may be the only chain that can be extended */
            if (heaviest == SUNDER_I_NONE || old->weight > p->chain[p->front[heaviest]].weight) heaviest = k;
        }
        if (p->chain[p->front[heaviest]].weight > now->weight) p->front[heaviest] = c;
        return kept;
    }
    p->front[kept++] = c;
    return kept;
}

/* Returns the least first link for which chains from i can be extended to v: for this link and later ones the angle at
 * i is at most pi. The search is binary, since the vertices linked to i are sorted by their angles; for a vertex that i
 * does not see the result may be anything, since no chain through it can be closed. */
static uint32_t least_start(sunder_i_program *p, uint32_t i, uint32_t v)
{
    if (!p->reflex[i]) return 0;
    if (p->least[v] != SUNDER_I_NONE) return p->least[v];
    uint32_t lo = p->up_first[i], hi = p->up_first[i + 1];
    while (lo < hi) {
        const uint32_t middle = lo + (hi - lo) / 2;
        if (p->up[middle] >= v || turn_of_corners(p, v, i, p->up[middle]) >= 0)
            hi = middle;
        else
            lo = middle + 1;
    }
    return p->least[v] = lo < p->up_first[i + 1] ? p->up[lo] : v;
}

/* Extends the n chains of the front from u by link e. Returns false if out of memory. */
static bool extend_front(sunder_i_program *p, uint32_t i, uint32_t u, uint32_t e, uint32_t n)
{
    const uint32_t v = p->up[e];
    if (n == 0 || turn_of_corners(p, u, v, i) < 0) return true;
    const uint32_t least = least_start(p, i, v);
    for (uint32_t k = 0; k < n; k++) {
        const chain *c = &p->chain[p->front[k]];
        if (c->start < least) continue;
        const chain longer = {c->weight + p->within[e] + weight_of(p, u, e), u, c->start, p->front[k], SUNDER_I_NONE};
        if (!add_chain(p, v, longer)) return false;
    }
    return true;
}

/* Returns the lightest chain that arrives at u, or SUNDER_I_NONE. */
static uint32_t lightest_chain(const sunder_i_program *p, uint32_t u)
{
    uint32_t best = SUNDER_I_NONE;
    for (uint32_t c = p->head[u]; c != SUNDER_I_NONE; c = p->chain[c].next)
        if (best == SUNDER_I_NONE || p->chain[c].weight < p->chain[best].weight) best = c;
    return best;
}

/* Extends all chains from i up to vertex `last`, and sets W of the links from i. Returns the lightest chain that
 * arrives at `last`, or SUNDER_I_NONE. */
static uint32_t grow_chains(sunder_i_program *p, uint32_t i, uint32_t last)
{
    p->chains = 0;
    for (uint32_t v = i; v <= last; v++) p->head[v] = p->least[v] = SUNDER_I_NONE;
    uint32_t link = p->up_first[i];
    const uint32_t link_end = p->up_first[i + 1];
    for (uint32_t u = i + 1; u < last; u++) {
        const bool linked = link < link_end && p->up[link] == u;
        if (!linked && p->head[u] == SUNDER_I_NONE) continue;
        /* The chain that is the link from i only: the first to arrive, since i is the least vertex. */
        uint32_t alone = SUNDER_I_NONE;
        if (linked) {
            const uint32_t c = lightest_chain(p, u);
            if (u > i + 1) p->within[link] = c == SUNDER_I_NONE ? INFINITY : p->chain[c].weight;
            const chain single = {p->within[link] + weight_of(p, i, link), i, p->reflex[i] ? u : 0, SUNDER_I_NONE,
                                  SUNDER_I_NONE};
            link++;
            const uint32_t head = p->head[u], tail = p->tail[u];
            p->head[u] = SUNDER_I_NONE;
            if (!add_chain(p, u, single)) return SUNDER_I_NONE;
            alone = p->head[u];
            p->chain[alone].next = head;
            p->tail[u] = head == SUNDER_I_NONE ? alone : tail;
        }
        uint32_t c = p->head[u], n = 0;
        if (!sunder_i_steps(1 + (p->up_first[u + 1] - p->up_first[u]) / 4)) {
            p->m->scratch.failed = true;
            return SUNDER_I_NONE;
        }
        for (uint32_t e = p->up_first[u]; e < p->up_first[u + 1] && p->up[e] <= last; e++) {
            for (; c != SUNDER_I_NONE && p->chain[c].from < p->allowed[e]; c = p->chain[c].next) n = front_add(p, n, c);
            if (!extend_front(p, i, u, e, n)) return SUNDER_I_NONE;
        }
    }
    const uint32_t best = lightest_chain(p, last);
    if (link < link_end && p->up[link] == last && last > i + 1)
        p->within[link] = best == SUNDER_I_NONE ? INFINITY : p->chain[best].weight;
    return best;
}

/* ---- Solving ---- */

static uint32_t find_link(const sunder_i_program *p, uint32_t u, uint32_t v)
{
    uint32_t lo = p->up_first[u], hi = p->up_first[u + 1];
    while (lo + 1 < hi) {
        const uint32_t middle = lo + (hi - lo) / 2;
        if (p->up[middle] <= v)
            lo = middle;
        else
            hi = middle;
    }
    return lo;
}

/* Finds the pieces of the best solution, from the link (0, n - 1) inwards; chains are extended again, which costs less
 * than storing all of them. Returns false if out of memory. */
static bool trace_pieces(sunder_i_program *p, uint32_t *diagonals, double *length)
{
    both_ways *stack = sunder_i_alloc(p->n, sizeof *stack);
    if (!stack) return false;
    uint32_t depth = 0, corners = 0;
    stack[depth++] = (both_ways){0, p->n - 1};
    p->pieces = 0;
    *diagonals = 0;
    *length = 0;
    while (depth) {
        const both_ways base = stack[--depth];
        uint32_t c = grow_chains(p, base.u, base.v), above = base.v;
        if (c == SUNDER_I_NONE) break; /* out of memory */
        /* The chain is followed from its upper end down, that is clockwise; the corners are reversed afterwards. */
        const uint32_t start = corners;
        p->corner[corners++] = p->first + above;
        for (; c != SUNDER_I_NONE; c = p->chain[c].before) {
            const uint32_t below = p->chain[c].from;
            p->corner[corners++] = p->first + below;
            if (above - below > 1) {
                stack[depth++] = (both_ways){below, above};
                *length += p->length[find_link(p, below, above)];
                ++*diagonals;
            }
            above = below;
        }
        for (uint32_t lo = start, hi = corners - 1; lo < hi; lo++, hi--) {
            const uint32_t swap = p->corner[lo];
            p->corner[lo] = p->corner[hi];
            p->corner[hi] = swap;
        }
        p->piece_end[p->pieces++] = corners;
    }
    sunder_i_free(stack);
    return !sunder_i_maker_failed(p->m);
}

bool sunder_i_program_solve(sunder_i_program *program, double each, double by_length, uint32_t *diagonals,
                            double *length)
{
    program->each = each;
    program->by_length = by_length;
    for (uint32_t e = 0; e < program->up_first[program->n]; e++) program->within[e] = 0;
    for (uint32_t i = program->n - 1; i-- > 0 && !sunder_i_maker_failed(program->m);) {
        const uint32_t first = program->up_first[i], end = program->up_first[i + 1];
        if (end - first > 1 || program->up[first] > i + 1) grow_chains(program, i, program->up[end - 1]);
    }
    if (!sunder_i_maker_failed(program->m) && trace_pieces(program, diagonals, length)) return true;
    program->m->scratch.failed = true;
    return false;
}

void sunder_i_program_emit(const sunder_i_program *program, sunder_i_maker *m)
{
    for (uint32_t i = 0, at = 0; i < program->pieces; at = program->piece_end[i++])
        sunder_i_maker_add_vertices(m, program->corner + at, program->piece_end[i] - at);
}

void sunder_i_program_free(sunder_i_program *program)
{
    if (!program) return;
    sunder_i_free_all(program->chain, program->front);
}
