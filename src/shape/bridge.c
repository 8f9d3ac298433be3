/* Holes joined to the outer ring by bridges, so that a polygon becomes one closed walk.
 *
 *        f                  h is the lexicographically smallest corner of a hole, e and f the edges of the polygon
 *    ---------------        just below and above it. Of the corners between them, left of h, and the left ends of e and f,
 *       u .   /\            the lexicographically greatest, u, is joined to h: nothing can stand between them, for it
 *           ' h \           would have a corner that is greater. These are the diagonals that a sweep puts in at split
 *    --------\__/---        vertices [BKOS08, section 3.2]: each lies in one trapezoid of the vertical decomposition, so
 *        e                  no two of them cross, and u < h makes them a tree rooted at the outer ring.
 *
 * All bridges are found from the edges of the rings alone and then put in one by one. At the places of u and h several
 * corners may stand (rings that touch; bridges put in before): the one whose sector of the interior the bridge
 * runs through is meant. */
#include "shape/build.h"

#include <stdlib.h>

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

/* Of two edges that share an abscissa and do not cross: is s above t? They may touch. */
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

typedef struct bridge {
    uint32_t hole, u; /* the smallest corner of the hole, and what it is joined to */
} bridge;

static uint32_t smallest_corner(const sunder_i_rings *r, uint32_t ring)
{
    uint32_t v = ring_begin(r, ring);
    for (uint32_t i = v + 1; i < r->ring_end[ring]; i++)
        if (sunder_i_rings_cmp(r, i, v) < 0) v = i;
    return v;
}

/* The corner to join h to, among the vertices lo .. hi of the polygon. */
static uint32_t visible_left(const sunder_i_rings *r, uint32_t lo, uint32_t hi, uint32_t h)
{
    span below = {SUNDER_I_NONE, 0}, above = below;
    const double x = r->xy[2 * (size_t)h];
    for (uint32_t e = lo; e < hi; e++) {
        const double a = r->xy[2 * (size_t)e], b = r->xy[2 * (size_t)r->next[e]];
        if ((a > x && b > x) || (a < x && b < x)) continue;
        const span s = span_of(r, e);
        if (sunder_i_rings_cmp(r, s.left, h) >= 0 || sunder_i_rings_cmp(r, s.right, h) <= 0) continue;
        const int side = sunder_i_rings_orient(r, s.left, s.right, h);
        if (side > 0) {
            if (below.left == SUNDER_I_NONE || is_above(r, s, below)) below = s;
        } else if (above.left == SUNDER_I_NONE || is_above(r, above, s)) {
            above = s;
        }
    }
    if (below.left == SUNDER_I_NONE || above.left == SUNDER_I_NONE) return SUNDER_I_NONE; /* memory is out */
    uint32_t u = sunder_i_rings_cmp(r, below.left, above.left) > 0 ? below.left : above.left;
    for (uint32_t v = lo; v < hi; v++) {
        const double c = r->xy[2 * (size_t)v];
        if (c > x || c < r->xy[2 * (size_t)u]) continue;
        if (sunder_i_rings_cmp(r, v, h) >= 0 || sunder_i_rings_cmp(r, v, u) <= 0) continue;
        if (sunder_i_rings_orient(r, below.left, below.right, v) > 0 &&
            sunder_i_rings_orient(r, above.left, above.right, v) < 0)
            u = v;
    }
    return u;
}

/* The node at the place of vertex v whose sector the direction to vertex d runs through. */
static uint32_t facing_node(const sunder_i_rings *r, const sunder_i_walk *walk, uint32_t v, uint32_t d)
{
    for (uint32_t node = 0; node < walk->nodes; node++) {
        const uint32_t w = walk->vertex[node];
        if (w != v && sunder_i_rings_cmp(r, w, v) != 0) continue;
        if (sunder_i_in_wedge(r, w, walk->vertex[walk->next[node]], walk->vertex[walk->prev[node]], d)) return node;
    }
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

/* ... u -> h ... (once round the hole) ... h' -> u' ... */
static void join(sunder_i_walk *walk, uint32_t u, uint32_t h, uint32_t number)
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
    (void)arena;
    for (uint32_t ring = ring_lo + 1; ring < ring_hi; ring++) {
        const uint32_t h = smallest_corner(r, ring), u = visible_left(r, lo, hi, h);
        if (u == SUNDER_I_NONE) {
            r->lattice->arena.failed = true;
            return;
        }
        const uint32_t from = facing_node(r, walk, u, h), to = facing_node(r, walk, h, u);
        if (from == SUNDER_I_NONE || to == SUNDER_I_NONE) {
            r->lattice->arena.failed = true;
            return;
        }
        join(walk, from, to, ring - ring_lo - 1);
    }
}
