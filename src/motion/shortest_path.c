/* shortest_path.c: A* over the visibility graph, which is never constructed: when a node is reached, visibility.c lists
 * the nodes that may be visible from it, and edges to these are queued; an edge is tested exactly only when it is taken
 * from the queue.
 *
 * The queue holds edges (v, w), ordered by the length of the path through them, plus the straight distance from w to
 * the goal. An edge from the queue is skipped if w has been reached by a shorter path; otherwise it is tested exactly,
 * and w is reached. So only edges that could belong to a shortest path are tested. A first search that overestimates
 * the remaining distance finds some path quickly; its length excludes from the second search all edges that cannot
 * belong to a shorter path.
 *
 * Lengths are doubles unless two of them are too close to decide; then they are computed with more than 256 significant
 * bits (path_length.c), and paths that are still equally long are compared as sequences of positions. */
#include "motion/shortest_path.h"

#include "base/heap.h"
#include "base/invariant.h"
#include "motion/path_length.h"
#include "motion/visibility.h"

#include <math.h>
#include <string.h>

/* The factor of the remaining distance in the first search: with 3 the path is a few percent too long and found after
 * few expansions. */
#define HASTE 3.0

typedef struct edge {
    double key;
    uint32_t from, to; /* node numbers */
} edge;

typedef struct reached {
    double length;
    uint32_t before; /* the previous node of the path */
    uint32_t news;   /* how often the path to this node has become shorter */
    uint32_t heard;  /* the value of `news` of the node `before` when this node was last updated; if they differ, the
                      * path to that node has become shorter since */
    bool known;
} reached;

/* An edge that gives a path to node `to` as long as the known one. */
typedef struct tie {
    uint32_t from, to; /* node numbers */
} tie;

typedef struct search {
    const sunder_i_free_space *space;
    const sunder_i_corners *corners;
    const sunder_sum_options *options;
    sunder_i_visibility view;
    reached *at;      /* [nodes] the path to each node */
    uint32_t *way[2]; /* [nodes + 1] memory for two paths that are compared */
    uint64_t *mark;   /* [nodes] stamps for the search of the last common node */
    uint64_t stamp;
    edge *heap;
    tie *tie;
    size_t ties, tie_capacity;
    size_t heap_n, heap_capacity;
    double haste, limit, slack;
    uint32_t start, goal; /* node numbers */
    unsigned tried;
    bool all_round; /* edges go in all directions, not only in those in which a shortest path can continue */
    bool no_memory, cancelled;
} search;

static const sunder_i_filtered_point *place_of(const search *s, uint32_t node)
{
    return &s->corners->place[s->corners->node[node]];
}

/* ---- The queue ---- */

/* A total order of the edges. */
static bool edge_before(const void *x, const void *y)
{
    const edge *a = x, *b = y;
    if (a->key != b->key) return a->key < b->key;
    return a->from != b->from ? a->from < b->from : a->to < b->to;
}

static void push_edge(search *s, edge e)
{
    if (s->heap_n == s->heap_capacity &&
        !sunder_i_reserve(&s->heap, &s->heap_capacity, s->heap_n + 1, sizeof *s->heap)) {
        s->no_memory = true;
        return;
    }
    sunder_i_heap_push(s->heap, &s->heap_n, sizeof e, &e, edge_before);
}

static edge pop_edge(search *s)
{
    edge top;
    sunder_i_heap_pop(s->heap, &s->heap_n, sizeof top, &top, edge_before);
    return top;
}

/* Queues the edges from v. The first search does not reach nodes by shortest paths, so that in it the direction of the
 * last leg does not restrict the next one if all_round is set. */
static void expand_node(search *s, uint32_t v)
{
    const double so_far = s->at[v].length;
    const uint32_t before = s->all_round || v == s->start ? SUNDER_I_NO_NODE : s->at[v].before;
    sunder_i_visibility_look(&s->view, v, before, s->limit - so_far);
    for (size_t i = 0; i < s->view.seen_n && !s->no_memory; i++) {
        const uint32_t w = s->view.seen[i];
        const double length = so_far + sunder_i_visibility_distance(&s->view, v, w);
        const double key = length + s->haste * sunder_i_visibility_distance(&s->view, w, s->goal);
        if (key <= s->limit && !(s->at[w].known && s->at[w].length < length - s->slack))
            push_edge(s, (edge){key, v, w});
    }
}

/* ---- Comparing paths ---- */

/* Writes the nodes of the path from `from`, which the path to v passes, to v into `out`, which has room for all nodes.
 * Returns their number. */
static size_t path_to(const search *s, uint32_t from, uint32_t v, uint32_t *out)
{
    size_t n = 1;
    for (uint32_t u = v; u != from; u = s->at[u].before) n++;
    for (size_t i = n; i-- > 0; v = s->at[v].before) out[i] = v;
    return n;
}

/* Returns the last common node of the paths to v and to w. Both are followed back alternately, so that the time depends
 * only on the parts in which they differ. */
static uint32_t parting_node(search *s, uint32_t v, uint32_t w)
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

/* Removes the nodes at which the path does not bend, and returns the number of nodes left. A path never turns back, so
 * that it does not bend at a node that is collinear with its neighbours. */
static size_t straighten_path(const search *s, uint32_t *path, size_t n)
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

/* Compares the paths p and q: 2 or -2 if their lengths differ, else 1, 0 or -1 by their order. The common beginning of
 * the two is not included in the lengths. */
static int compare_paths(const search *s, const uint32_t *p, size_t m, const uint32_t *q, size_t n)
{
    size_t same = 0;
    while (same < m && same < n && p[same] == q[same]) same++;
    if (same == m && same == n) return 0; /* one path represented in two ways, along collinear corners */
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

/* Compares the path to v and on to w with the known path to w: -2: shorter; -1: equally long and lexicographically
 * smaller; 0: the same; 1, 2: the opposite. The comparison begins one node before the last common node, since there one
 * of the two may not bend. */
static int compare_ways(search *s, uint32_t v, uint32_t w)
{
    uint32_t *p = s->way[0], *q = s->way[1], from = parting_node(s, v, w);
    if (from == w) return 2; /* w is on the path to v: no path */
    if (from != s->start) from = s->at[from].before;
    size_t m = path_to(s, from, v, p);
    size_t n = path_to(s, from, w, q);
    p[m++] = w;
    m = straighten_path(s, p, m);
    n = straighten_path(s, q, n);
    return compare_paths(s, p, m, q, n);
}

/* ---- The search ---- */

static bool edge_is_free(const search *s, uint32_t v, uint32_t w)
{
    return sunder_i_leg_is_free(s->space, place_of(s, v), place_of(s, w), false, NULL);
}

/* The path to e.to has become shorter, by its own last edge or by the path to the node before. The edges from e.to are
 * queued again, so that edges which lost to it by less than the tolerance are compared again, and the nodes after it
 * are updated. */
static void shorten_path(search *s, edge e)
{
    s->at[e.to].heard = s->at[e.from].news;
    s->at[e.to].news++;
    if (e.to != s->goal) expand_node(s, e.to);
}

/* Takes another edge to a node that has been reached. If the path through it is shorter, it replaces the known one; if
 * the two are equally long, the choice is made at the end of the search, since what follows does not depend on it. */
static void take_again(search *s, edge e)
{
    const int c = compare_ways(s, e.from, e.to);
    if (c == -2 && edge_is_free(s, e.from, e.to)) {
        s->at[e.to].before = e.from;
        shorten_path(s, e);
    }
    if (c < -1 || c > 1) return;
    if (sunder_i_reserve(&s->tie, &s->tie_capacity, s->ties + 1, sizeof *s->tie))
        s->tie[s->ties++] = (tie){e.from, e.to};
    else
        s->no_memory = true;
}

static void take_edge(search *s, edge e)
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
            shorten_path(s, e);
        return;
    }
    if (!edge_is_free(s, e.from, e.to)) return;
    *to = (reached){.length = length, .before = e.from, .heard = s->at[e.from].news, .known = true};
    if (e.to != s->goal) expand_node(s, e.to);
}

static void run_search(search *s, double haste, double limit)
{
    memset(s->at, 0, s->corners->nodes * sizeof *s->at);
    s->heap_n = 0;
    s->haste = haste;
    s->limit = limit;
    s->at[s->start] = (reached){.before = s->start, .known = true};
    expand_node(s, s->start);
    while (s->heap_n && !s->no_memory && !s->cancelled && !s->space->filter.lattice->arena.failed) {
        const edge e = pop_edge(s);
        const reached *goal = &s->at[s->goal];
        if (goal->known && (haste > 1 || e.key > goal->length + s->slack)) break;
        take_edge(s, e);
    }
}

/* ---- Ties ---- */

/* The ties sorted by their `to`: those of node w are from[end[w - 1]] .. from[end[w] - 1]. */
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

/* Chooses the best of the paths to w among those whose previous node is settled, that is, mark[v] == settled. */
static void choose_way(search *s, const tie_lists *t, uint32_t w, uint64_t settled, const uint64_t *mark)
{
    for (size_t i = w ? t->end[w - 1] : 0; i < t->end[w]; i++) {
        const uint32_t v = t->from[i];
        if (mark[v] == settled && s->at[w].before != v && compare_ways(s, v, w) < 0 && edge_is_free(s, v, w))
            s->at[w].before = v;
    }
}

/* Chooses the lexicographically smallest of equally long paths. The nodes are settled in the order in which a
 * depth-first search from the goal back to the start leaves them, so that each is settled after all nodes that may
 * precede it. Edges lead from shorter to longer paths, so that there are no cycles except where lengths differ by less
 * than the tolerance; an edge that closes a cycle is skipped. */
static void settle_ties(search *s)
{
    enum { ENTERED = 1, SETTLED = 2 };
    tie_lists t = {0};
    const size_t nodes = s->corners->nodes;
    uint64_t *mark = sunder_i_calloc(nodes, sizeof *mark);
    /* [nodes] the number of edges back that have been tried */
    size_t *next = sunder_i_calloc(nodes, sizeof *next), n = 0;
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
    sunder_i_free_all(t.end, t.from, mark, next, stack);
}

/* Runs the fast search and then the exact one. Sets no_memory if out of memory. */
static void find_path(search *s)
{
    const size_t nodes = s->corners->nodes;
    s->at = sunder_i_calloc(nodes, sizeof *s->at);
    for (int k = 0; k < 2; k++) s->way[k] = sunder_i_alloc(nodes + 1, sizeof *s->way[k]);
    s->mark = sunder_i_calloc(nodes, sizeof *s->mark);
    s->no_memory =
        !sunder_i_visibility_init(&s->view, s->space, s->corners) || !s->at || !s->way[0] || !s->way[1] || !s->mark;
    if (s->no_memory) return;
    run_search(s, HASTE, INFINITY);
    /* The first search does not reach nodes by shortest paths, so that if it finds no path with restricted directions,
     * this does not prove that there is none. */
    s->all_round = !s->at[s->goal].known;
    if (s->all_round) run_search(s, HASTE, INFINITY);
    s->all_round = false;
    /* Lengths are computed from coordinates relative to the start. No position on a path of at most this length is
     * farther from the start. Each leg has two such coordinates, each with an error of 2^-51 of its size or below the
     * range of normal doubles, and rounding errors; the error of a length is below this bound. The bound is doubled,
     * for the two lengths of a comparison. */
    const double some = s->at[s->goal].length;
    s->slack = (0x1p-46 * some + 0x1p-1060) * ((double)nodes + 4);
    if (!s->at[s->goal].known) return;
    run_search(s, 1, some + s->slack);
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
    find_path(&s);
    sunder_status status = SUNDER_OK;
    if (s.no_memory || space->filter.lattice->arena.failed || (!s.cancelled && !s.at[s.goal].known))
        status = sunder_i_failure_cause(err);
    else if (s.cancelled)
        status = sunder_i_cancelled(err);
    if (status == SUNDER_OK) {
        SUNDER_I_ASSERT(s.at[s.goal].length <= s.limit + s.slack);
        *n = straighten_path(&s, s.way[0], path_to(&s, s.start, s.goal, s.way[0]));
        for (size_t i = 0; i < *n; i++) s.way[0][i] = corners->node[s.way[0][i]];
        *path = s.way[0];
        s.way[0] = NULL;
    }
    sunder_i_visibility_free(&s.view);
    sunder_i_free_all(s.way[0], s.way[1], s.mark, s.at, s.heap, s.tie);
    return status;
}
