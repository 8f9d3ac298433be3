/* A* over the visibility graph, which is never made: from a node that is reached, edges go to what visibility.c says
 * may be seen and come next; they are tried only when their turn comes.
 *
 * The queue holds edges (v, w) by the length of the path over them to the goal, as the crow flies from w on. An edge
 * that comes out is skipped if w has been reached by less; else the exact test is made, and w is reached. So only edges
 * that could belong to a shortest path are ever tried. A first search that overrates the distance left finds some path
 * quickly; its length keeps out of the second search all edges that cannot beat it.
 *
 * Lengths are doubles until two of them are too close to tell apart; then they are taken to more than 256 significant
 * bits (path_length.c), and paths still equal are compared as sequences of places. */
#include "motion/shortest_path.h"

#include "base/heap.h"
#include "base/invariant.h"
#include "motion/path_length.h"
#include "motion/visibility.h"

#include <math.h>
#include <string.h>

/* How the first search overrates: three times gives paths a few percent too long in a few expansions. */
#define HASTE 3.0

typedef struct edge {
    double key;
    uint32_t from, to; /* nodes */
} edge;

typedef struct reached {
    double length;
    uint32_t before; /* node */
    uint32_t news;   /* how often the way here has become shorter, */
    uint32_t heard;  /* and what that of the node before was when this one was last told */
    bool known;
} reached;

/* A way to a node that is as long as the one known. */
typedef struct tie {
    uint32_t from, to; /* nodes */
} tie;

typedef struct search {
    const sunder_i_free_space *space;
    const sunder_i_corners *corners;
    const sunder_sum_options *options;
    sunder_i_visibility view;
    reached *at;      /* [nodes] */
    uint32_t *way[2]; /* [nodes + 1] room for paths to compare */
    uint64_t *mark;   /* [nodes] stamps of parting() */
    uint64_t stamp;
    edge *heap;
    tie *tie;
    size_t ties, tie_capacity;
    size_t heap_n, heap_capacity;
    double haste, limit, slack;
    uint32_t start, goal; /* nodes */
    unsigned tried;
    bool all_round; /* edges go everywhere, not only where shortest paths can go on */
    bool no_memory, cancelled;
} search;

static const sunder_i_filtered_point *place_of(const search *s, uint32_t node)
{
    return &s->corners->place[s->corners->node[node]];
}

/* ---- The queue ---- */

/* A total order. */
static bool before(const void *x, const void *y)
{
    const edge *a = x, *b = y;
    if (a->key != b->key) return a->key < b->key;
    return a->from != b->from ? a->from < b->from : a->to < b->to;
}

static void push(search *s, edge e)
{
    if (s->heap_n == s->heap_capacity &&
        !sunder_i_reserve(&s->heap, &s->heap_capacity, s->heap_n + 1, sizeof *s->heap)) {
        s->no_memory = true;
        return;
    }
    sunder_i_heap_push(s->heap, &s->heap_n, sizeof e, &e, before);
}

static edge pop(search *s)
{
    edge top;
    sunder_i_heap_pop(s->heap, &s->heap_n, sizeof top, &top, before);
    return top;
}

/* Edges from v. The hasty search does not turn what it has reached into shortest paths, so that where they come from
 * does not tell where they go on. */
static void expand(search *s, uint32_t v)
{
    const double so_far = s->at[v].length;
    const uint32_t before = s->all_round || v == s->start ? SUNDER_I_NO_NODE : s->at[v].before;
    sunder_i_visibility_look(&s->view, v, before, s->limit - so_far);
    for (size_t i = 0; i < s->view.seen_n && !s->no_memory; i++) {
        const uint32_t w = s->view.seen[i];
        const double length = so_far + sunder_i_visibility_distance(&s->view, v, w);
        const double key = length + s->haste * sunder_i_visibility_distance(&s->view, w, s->goal);
        if (key <= s->limit && !(s->at[w].known && s->at[w].length < length - s->slack)) push(s, (edge){key, v, w});
    }
}

/* ---- Comparing paths ---- */

/* Nodes of the path to v, from one that it passes on, into room for all nodes; how many. */
static size_t path_to(const search *s, uint32_t from, uint32_t v, uint32_t *out)
{
    size_t n = 1;
    for (uint32_t u = v; u != from; u = s->at[u].before) n++;
    for (size_t i = n; i-- > 0; v = s->at[v].before) out[i] = v;
    return n;
}

/* Where the paths to v and to w part. Both are walked back in turn, so that the cost is what they differ by. */
static uint32_t parting(search *s, uint32_t v, uint32_t w)
{
    uint32_t at[2] = {v, w};
    s->stamp += 2;
    for (unsigned side = 0;; side = !side) {
        const uint32_t u = at[side];
        if (s->mark[u] == s->stamp + !side) return u;
        s->mark[u] = s->stamp + side;
        if (u != s->start) at[side] = s->at[u].before;
    }
}

/* Takes out the nodes at which a path goes straight on; how many are left. A path turns back nowhere, so collinear is
 * straight. */
static size_t straighten(const search *s, uint32_t *path, size_t n)
{
    size_t m = 0;
    for (size_t i = 0; i < n; i++) {
        while (m >= 2 && sunder_i_filtered_orient(&s->space->filter, place_of(s, path[m - 2]), place_of(s, path[m - 1]),
                                                  place_of(s, path[i])) == 0)
            m--;
        path[m++] = path[i];
    }
    return m;
}

static sunder_i_path path_of(const search *s, const uint32_t *node, size_t n)
{
    return (sunder_i_path){s->corners->place, s->corners->node, node, n};
}

/* 2 or -2 where lengths differ, else 1, 0 or -1. What the two begin with in common is left out of the comparison. */
static int compare_paths(const search *s, const uint32_t *p, size_t m, const uint32_t *q, size_t n)
{
    size_t same = 0;
    while (same < m && same < n && p[same] == q[same]) same++;
    if (same == m && same == n) return 0; /* one path by two ways, along collinear corners */
    sunder_i_arena *arena = &s->space->filter.lattice->arena;
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    const size_t from = same ? same - 1 : 0;
    const sunder_i_path one = path_of(s, p + from, m - from), other = path_of(s, q + from, n - from);
    const unsigned long bits = sunder_i_path_length_bits(&s->space->filter, arena, &one);
    const sunder_i_big d = sunder_i_big_sub(arena, sunder_i_path_length_scaled(arena, &one, bits),
                                            sunder_i_path_length_scaled(arena, &other, bits));
    const sunder_i_big noise = sunder_i_big_i64(arena, 4 * (int64_t)(m + n));
    int c = 0;
    if (sunder_i_big_cmp(d, noise) > 0) c = 2;
    if (sunder_i_big_cmp(sunder_i_big_neg(d), noise) > 0) c = -2;
    if (arena->failed) return 0;
    sunder_i_arena_release(arena, mark);
    if (c == 0 && same < m && same < n)
        c = sunder_i_filtered_cmp(&s->space->filter, place_of(s, p[same]), place_of(s, q[same]));
    return c ? c : (m > n) - (m < n);
}

/* The path to v and on to w beside the one known to w: shorter (-2), as long and lexicographically smaller (-1), the
 * same (0), ... They are compared from one node before they part, since there the one may go straight on. */
static int compare_ways(search *s, uint32_t v, uint32_t w)
{
    uint32_t *p = s->way[0], *q = s->way[1], from = parting(s, v, w);
    if (from == w) return 2; /* w lies on the way to v: no path */
    if (from != s->start) from = s->at[from].before;
    size_t m = path_to(s, from, v, p);
    size_t n = path_to(s, from, w, q);
    p[m++] = w;
    m = straighten(s, p, m);
    n = straighten(s, q, n);
    return compare_paths(s, p, m, q, n);
}

/* ---- The search ---- */

static bool edge_is_free(const search *s, uint32_t v, uint32_t w)
{
    return sunder_i_leg_is_free(s->space, place_of(s, v), place_of(s, w), false, NULL);
}

/* The way to a node has become shorter, itself or that to the node before: what lost against it by less than can be
 * seen is asked again, and whoever is reached over it hears of it. */
static void shorten(search *s, edge e)
{
    s->at[e.to].heard = s->at[e.from].news;
    s->at[e.to].news++;
    if (e.to != s->goal) expand(s, e.to);
}

/* Another way to a node that has been reached. If it is as long, which of the two goes is seen to in the end: what goes
 * on from there does not depend on it. */
static void take_again(search *s, edge e)
{
    const int c = compare_ways(s, e.from, e.to);
    if (c == -2 && edge_is_free(s, e.from, e.to)) {
        s->at[e.to].before = e.from;
        shorten(s, e);
    }
    if (c < -1 || c > 1) return;
    if (sunder_i_reserve(&s->tie, &s->tie_capacity, s->ties + 1, sizeof *s->tie))
        s->tie[s->ties++] = (tie){e.from, e.to};
    else
        s->no_memory = true;
}

static void take(search *s, edge e)
{
    const double length = s->at[e.from].length + sunder_i_visibility_distance(&s->view, e.from, e.to);
    reached *to = &s->at[e.to];
    if (to->known && to->length < length - s->slack) return;
    if ((++s->tried & 255) == 0 && s->options && s->options->progress &&
        !s->options->progress(0.5, s->options->progress_user))
        s->cancelled = true;
    if (to->known) {
        if (s->haste == 1 && to->before != e.from)
            take_again(s, e);
        else if (s->haste == 1 && to->heard != s->at[e.from].news)
            shorten(s, e);
        return;
    }
    if (!edge_is_free(s, e.from, e.to)) return;
    *to = (reached){.length = length, .before = e.from, .heard = s->at[e.from].news, .known = true};
    if (e.to != s->goal) expand(s, e.to);
}

static void run(search *s, double haste, double limit)
{
    memset(s->at, 0, s->corners->nodes * sizeof *s->at);
    s->heap_n = 0;
    s->haste = haste;
    s->limit = limit;
    s->at[s->start] = (reached){.before = s->start, .known = true};
    expand(s, s->start);
    while (s->heap_n && !s->no_memory && !s->cancelled && !s->space->filter.lattice->arena.failed) {
        const edge e = pop(s);
        const reached *goal = &s->at[s->goal];
        if (goal->known && (haste > 1 || e.key > goal->length + s->slack)) break;
        take(s, e);
    }
}

/* ---- Ties ---- */

/* Ties by the node that they lead to: those of w are [end[w - 1], end[w]) in `from`. */
typedef struct tie_lists {
    size_t *end;
    uint32_t *from;
} tie_lists;

static bool list_ties(const search *s, tie_lists *t)
{
    const size_t nodes = s->corners->nodes;
    t->end = sunder_i_calloc(nodes + 1, sizeof *t->end);
    t->from = sunder_i_alloc(s->ties, sizeof *t->from);
    if (!t->end || !t->from) return false;
    for (size_t i = 0; i < s->ties; i++) t->end[s->tie[i].to + 1]++;
    for (size_t w = 0; w < nodes; w++) t->end[w + 1] += t->end[w];
    for (size_t i = 0; i < s->ties; i++) t->from[t->end[s->tie[i].to]++] = s->tie[i].from;
    return true;
}

/* The best of the ways to w, when those to all nodes before it are settled: marked with `settled`. */
static void choose_way(search *s, const tie_lists *t, uint32_t w, uint64_t settled, const uint64_t *mark)
{
    for (size_t i = w ? t->end[w - 1] : 0; i < t->end[w]; i++) {
        const uint32_t v = t->from[i];
        if (mark[v] == settled && s->at[w].before != v && compare_ways(s, v, w) < 0 && edge_is_free(s, v, w))
            s->at[w].before = v;
    }
}

/* Of ways that are equally long the lexicographically smallest, node by node, each after all that may come before it:
 * in the order in which a search back from the goal leaves them. Ways lead from shorter to longer ones, so there are no
 * circles, but where lengths differ by less than can be seen; what would close one is left out. */
static void settle_ties(search *s)
{
    enum { ENTERED = 1, SETTLED = 2 };
    tie_lists t = {0};
    const size_t nodes = s->corners->nodes;
    uint64_t *mark = sunder_i_calloc(nodes, sizeof *mark);
    size_t *next = sunder_i_calloc(nodes, sizeof *next), n = 0; /* [nodes] how many ways back have been tried */
    uint32_t *stack = sunder_i_alloc(nodes, sizeof *stack);
    if (!list_ties(s, &t) || !mark || !next || !stack) s->no_memory = true;
    if (!s->no_memory) {
        mark[s->start] = SETTLED;
        mark[stack[n++] = s->goal] = ENTERED;
    }
    while (n && !s->no_memory) {
        const uint32_t w = stack[n - 1];
        const size_t first = w ? t.end[w - 1] : 0, k = next[w]++;
        if (first + k > t.end[w]) {
            choose_way(s, &t, w, SETTLED, mark);
            mark[w] = SETTLED;
            n--;
            continue;
        }
        const uint32_t v = k ? t.from[first + k - 1] : s->at[w].before;
        if (mark[v] == 0) mark[stack[n++] = v] = ENTERED;
    }
    sunder_i_free(t.end);
    sunder_i_free(t.from);
    sunder_i_free(mark);
    sunder_i_free(next);
    sunder_i_free(stack);
}

/* Two runs, if memory allows. */
static void find(search *s)
{
    const size_t nodes = s->corners->nodes;
    s->at = sunder_i_calloc(nodes, sizeof *s->at);
    for (int k = 0; k < 2; k++) s->way[k] = sunder_i_alloc(nodes + 1, sizeof *s->way[k]);
    s->mark = sunder_i_calloc(nodes, sizeof *s->mark);
    s->no_memory =
        !sunder_i_visibility_init(&s->view, s->space, s->corners) || !s->at || !s->way[0] || !s->way[1] || !s->mark;
    if (s->no_memory) return;
    run(s, HASTE, INFINITY);
    /* In haste nodes are not reached by shortest paths, and that these go on from there nowhere proves nothing. */
    s->all_round = !s->at[s->goal].known;
    if (s->all_round) run(s, HASTE, INFINITY);
    s->all_round = false;
    /* Lengths are of places less the start. No place on a path of at most this length is farther from there. With two
     * such coordinates a leg, each off by 2^-51 of itself or by what is too small for doubles, and roundings, lengths
     * are off by less than this. Twice, for both of two that are compared. */
    const double some = s->at[s->goal].length;
    s->slack = (0x1p-46 * some + 0x1p-1060) * ((double)nodes + 4);
    if (!s->at[s->goal].known) return;
    run(s, 1, some + s->slack);
    if (s->at[s->goal].known && !s->no_memory && !s->cancelled) settle_ties(s);
}

sunder_status sunder_i_shortest_path(const sunder_i_free_space *space, sunder_i_corners *corners,
                                     const sunder_sum_options *options, uint32_t **path, size_t *n, sunder_error *err)
{
    search s = {.space = space,
                .corners = corners,
                .options = options,
                .start = corners->nodes - 2,
                .goal = corners->nodes - 1};
    find(&s);
    sunder_status status = SUNDER_OK;
    if (s.no_memory || space->filter.lattice->arena.failed || (!s.cancelled && !s.at[s.goal].known))
        status = sunder_i_no_memory(err);
    else if (s.cancelled)
        status = sunder_i_cancelled(err);
    if (status == SUNDER_OK) {
        SUNDER_I_ASSERT(s.at[s.goal].length <= s.limit + s.slack);
        *n = straighten(&s, s.way[0], path_to(&s, s.start, s.goal, s.way[0]));
        for (size_t i = 0; i < *n; i++) s.way[0][i] = corners->node[s.way[0][i]];
        *path = s.way[0];
        s.way[0] = NULL;
    }
    sunder_i_visibility_free(&s.view);
    sunder_i_free(s.way[0]);
    sunder_i_free(s.way[1]);
    sunder_i_free(s.mark);
    sunder_i_free(s.at);
    sunder_i_free(s.heap);
    sunder_i_free(s.tie);
    return status;
}
