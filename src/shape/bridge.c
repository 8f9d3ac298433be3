/* bridge.c: joins holes to the outer ring by bridges, so that a polygon becomes one closed walk.
 *
 *        f                  h is the lexicographically smallest vertex of a hole, e and f the edges of the polygon
 *    ---------------        directly below and above it. Among the vertices between them, left of h, and the left ends
 *       u .   /\            of e and f, the lexicographically greatest one, u, is joined to h: nothing can be between
 *           ' h \           them, since it would have a greater vertex. These are the diagonals that a sweep adds at
 *    --------\__/---        split vertices [BKOS08, section 3.2]: each is in one trapezoid of the vertical
 *        e                  decomposition, so that no two of them cross, and u < h makes them a tree with the outer
 *                           ring as its root.
 *
 * All bridges are found from the edges of the rings alone and then inserted one after the other. Several nodes may be
 * at the positions of u and h (rings that touch; bridges inserted before): the bridge connects those nodes whose
 * sectors of the interior it runs through. */
#include "shape/build.h"

#include "base/extremes.h"

#include <math.h>

static uint32_t ring_begin(const sunder_i_rings *r, uint32_t ring) { return ring ? r->ring_end[ring - 1] : 0; }

/* An edge by its ends in lexicographic order. */
typedef struct span {
    uint32_t left, right;
} span;

static span span_of(const sunder_i_rings *r, uint32_t e)
{
    const uint32_t f = r->next[e];
    return sunder_i_rings_cmp(r, e, f) < 0 ? (span){e, f} : (span){f, e};
}

/* Returns whether s is above t, for two edges whose ranges of x overlap and that do not cross; they may touch. */
static bool is_above(const sunder_i_rings *r, span s, span t)
{
    int side = 0;
    if (sunder_i_rings_cmp(r, t.left, s.left) <= 0) {
        side = sunder_i_rings_orient(r, t.left, t.right, s.left);
        if (side == 0) side = sunder_i_rings_orient(r, t.left, t.right, s.right);
    } else {
        side = -sunder_i_rings_orient(r, s.left, s.right, t.left);
        if (side == 0) side = -sunder_i_rings_orient(r, s.left, s.right, t.right);
    }
    return side > 0;
}

static uint32_t smallest_corner(const sunder_i_rings *r, uint32_t ring)
{
    uint32_t v = ring_begin(r, ring);
    for (uint32_t i = v + 1; i < r->ring_end[ring]; i++)
        if (sunder_i_rings_cmp(r, i, v) < 0) v = i;
    return v;
}

/* The search from h: the nearest edges below and above, then the vertex u. `reach` is the box in which a better result
 * may still be found; it shrinks. */
typedef struct view {
    const sunder_i_rings *r;
    uint32_t h, u;
    span below, above; /* left is NONE until an edge is found */
    double reach[4];
} view;

static double lower_y(const sunder_i_rings *r, span s)
{
    return sunder_i_min(r->xy[2 * (size_t)s.left + 1], r->xy[2 * (size_t)s.right + 1]);
}

static double upper_y(const sunder_i_rings *r, span s)
{
    return sunder_i_max(r->xy[2 * (size_t)s.left + 1], r->xy[2 * (size_t)s.right + 1]);
}

static void see_edge(void *user, uint32_t e)
{
    view *w = user;
    const sunder_i_rings *r = w->r;
    const double x = w->reach[0], a = r->xy[2 * (size_t)e], b = r->xy[2 * (size_t)r->next[e]];
    if ((a > x && b > x) || (a < x && b < x)) return;
    const span s = span_of(r, e);
    if (sunder_i_rings_cmp(r, s.left, w->h) >= 0 || sunder_i_rings_cmp(r, s.right, w->h) <= 0) return;
    if (sunder_i_rings_orient(r, s.left, s.right, w->h) > 0) {
        if (w->below.left != SUNDER_I_NONE && !is_above(r, s, w->below)) return;
        w->below = s;
        w->reach[1] = lower_y(r, s);
    } else {
        if (w->above.left != SUNDER_I_NONE && !is_above(r, w->above, s)) return;
        w->above = s;
        w->reach[3] = upper_y(r, s);
    }
}

static void see_corner(void *user, uint32_t v)
{
    view *w = user;
    const sunder_i_rings *r = w->r;
    const double x = r->xy[2 * (size_t)v];
    if (x > w->reach[2] || x < w->reach[0]) return;
    if (sunder_i_rings_cmp(r, v, w->h) >= 0 || sunder_i_rings_cmp(r, v, w->u) <= 0) return;
    if (sunder_i_rings_orient(r, w->below.left, w->below.right, v) <= 0 ||
        sunder_i_rings_orient(r, w->above.left, w->above.right, v) >= 0)
        return;
    w->u = v;
    w->reach[0] = x;
}

static void look_at_edges(view *w, sunder_i_edge_visitor see, const sunder_i_edge_tree *tree, uint32_t lo, uint32_t hi)
{
    if (tree)
        sunder_i_edge_tree_query(tree, w->reach, see, w);
    else
        for (uint32_t e = lo; e < hi; e++) see(w, e);
}

/* Returns the vertex to which h is joined, among the vertices lo .. hi of the polygon; NONE only if out of memory. */
static uint32_t visible_left(const sunder_i_rings *r, const sunder_i_edge_tree *tree, uint32_t lo, uint32_t hi,
                             uint32_t h)
{
    const double x = r->xy[2 * (size_t)h];
    view w = {r, h, SUNDER_I_NONE, {SUNDER_I_NONE, 0}, {SUNDER_I_NONE, 0}, {x, -INFINITY, x, INFINITY}};
    look_at_edges(&w, see_edge, tree, lo, hi);
    if (w.below.left == SUNDER_I_NONE || w.above.left == SUNDER_I_NONE) return SUNDER_I_NONE;
    w.u = sunder_i_rings_cmp(r, w.below.left, w.above.left) > 0 ? w.below.left : w.above.left;
    w.reach[0] = r->xy[2 * (size_t)w.u];
    look_at_edges(&w, see_corner, tree, lo, hi);
    return w.u;
}

/* Returns whether the direction to vertex d is in the sector of the node. */
static bool faces_vertex(const sunder_i_rings *r, const sunder_i_walk *walk, uint32_t node, uint32_t d)
{
    return sunder_i_in_wedge(r, walk->vertex[node], walk->vertex[walk->next[node]], walk->vertex[walk->prev[node]], d);
}

/* Returns the node at the position of vertex v whose sector contains the direction to vertex d; lo is the vertex of
 * node 0. Usually it is the vertex's own first node. */
static uint32_t facing_node(const sunder_i_rings *r, const sunder_i_walk *walk, uint32_t lo, uint32_t v, uint32_t d)
{
    if (faces_vertex(r, walk, v - lo, d)) return v - lo;
    for (uint32_t node = walk->nodes; node-- > 0;)
        if (sunder_i_rings_cmp(r, walk->vertex[node], v) == 0 && faces_vertex(r, walk, node, d)) return node;
    return SUNDER_I_NONE;
}

static uint32_t copy_node(sunder_i_walk *walk, uint32_t node)
{
    const uint32_t copy = walk->nodes++;
    walk->vertex[copy] = walk->vertex[node];
    return copy;
}

static void link_nodes(sunder_i_walk *walk, uint32_t a, uint32_t b)
{
    walk->next[a] = b;
    walk->prev[b] = a;
}

/* Joins the nodes u and h: the walk becomes ... u -> h ... (around the hole) ... h' -> u' ..., with copies h' and
 * u'. */
static void join_nodes(sunder_i_walk *walk, uint32_t u, uint32_t h, uint32_t number)
{
    const uint32_t u2 = copy_node(walk, u), h2 = copy_node(walk, h);
    const uint32_t after = walk->next[u], before = walk->prev[h];
    link_nodes(walk, u2, after);
    link_nodes(walk, before, h2);
    link_nodes(walk, u, h);
    link_nodes(walk, h2, u2);
    walk->beyond[u2] = walk->beyond[u]; /* the edge that left u now leaves its copy */
    walk->beyond[u] = walk->beyond[h2] = SUNDER_I_BRIDGE | number;
}

void sunder_i_bridge_holes(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, sunder_i_walk *walk,
                           sunder_i_arena *arena)
{
    const uint32_t lo = ring_begin(r, ring_lo), hi = r->ring_end[ring_hi - 1];
    sunder_i_edge_tree tree;
    sunder_i_edge_tree *const use = hi - lo >= SUNDER_I_TREE_FROM ? &tree : NULL;
    if (use) sunder_i_edge_tree_build(use, r, ring_lo, ring_hi, arena);
    for (uint32_t ring = ring_lo + 1; ring < ring_hi && !arena->failed; ring++) {
        const uint32_t h = smallest_corner(r, ring), u = visible_left(r, use, lo, hi, h);
        uint32_t from = SUNDER_I_NONE, to = SUNDER_I_NONE;
        if (u != SUNDER_I_NONE) {
            from = facing_node(r, walk, lo, u, h);
            to = facing_node(r, walk, lo, h, u);
        }
        if (from == SUNDER_I_NONE || to == SUNDER_I_NONE) {
            /* valid rings have a bridge; only predicates that ran out of memory give another answer */
            arena->failed = true;
            return;
        }
        join_nodes(walk, from, to, ring - ring_lo - 1);
    }
}
