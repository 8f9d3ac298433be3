/* intersections.c: finds where the rings of one polygon meet each other and themselves.
 *
 * Consecutive edges meet at their common end only (clean_ring.c has removed spikes). Any other two may be disjoint,
 * cross (an error), share a segment (an error), or touch: an end of one is on the other. A contact is valid if the two
 * paths through the point stay on their sides of each other, and an error if they change sides; this is decided
 * locally, by the four directions at the point. Each contact is tested where the first vertex of one of the edges takes
 * part in it, so that all are found and few are tested twice. */
#include "shape/build.h"

bool sunder_i_in_wedge(const sunder_i_rings *r, uint32_t p, uint32_t u, uint32_t w, uint32_t d)
{
    const int turn = sunder_i_rings_orient(r, p, u, w);
    if (turn > 0) return sunder_i_rings_orient(r, p, u, d) > 0 && sunder_i_rings_orient(r, p, d, w) > 0;
    if (turn < 0) return !(sunder_i_rings_orient(r, p, w, d) >= 0 && sunder_i_rings_orient(r, p, d, u) >= 0);
    const sunder_i_point to_u = sunder_i_point_sub(r->lattice, r->at[u], r->at[p]);
    const sunder_i_point to_w = sunder_i_point_sub(r->lattice, r->at[w], r->at[p]);
    const int side = sunder_i_rings_orient(r, p, u, d);
    if (sunder_i_dot_sign(r->lattice, to_u, to_w) < 0) return side > 0; /* opposite directions: a half-plane */
    /* equal directions: everything except that direction */
    if (side != 0) return true;
    return sunder_i_dot_sign(r->lattice, to_u, sunder_i_point_sub(r->lattice, r->at[d], r->at[p])) < 0;
}

typedef struct finder {
    const sunder_i_rings *r;
    sunder_i_problem *problem;
    bool touches;
    size_t left; /* the number of pairs that may still be tested */
} finder;

static bool note_fault(finder *c, sunder_i_fault fault, uint32_t e, uint32_t f)
{
    /* the later edge is named first, so that "crosses segment 4" refers to an earlier one */
    c->problem->fault = fault;
    c->problem->vertex = e > f ? e : f;
    c->problem->other = e > f ? f : e;
    return false;
}

/* Returns whether u and w are in the same direction from p. */
static bool same_direction(const sunder_i_rings *r, uint32_t p, uint32_t u, uint32_t w)
{
    return sunder_i_rings_orient(r, p, u, w) == 0 &&
           sunder_i_dot_sign(r->lattice, sunder_i_point_sub(r->lattice, r->at[u], r->at[p]),
                             sunder_i_point_sub(r->lattice, r->at[w], r->at[p])) > 0;
}

/* Tests two paths through the position of p, u1 -> p -> w1 and u2 -> p -> w2. If the second one changes sides of the
 * first it sets the problem and returns false. */
static bool visit_touch(finder *c, uint32_t e, uint32_t f, uint32_t p, uint32_t u1, uint32_t w1, uint32_t u2,
                        uint32_t w2)
{
    c->touches = true;
    if (sunder_i_in_wedge(c->r, p, u1, w1, u2) == sunder_i_in_wedge(c->r, p, u1, w1, w2)) return true;
    const bool overlap = same_direction(c->r, p, u1, u2) || same_direction(c->r, p, u1, w2) ||
                         same_direction(c->r, p, w1, u2) || same_direction(c->r, p, w1, w2);
    return note_fault(c, overlap ? SUNDER_I_OVERLAPS : SUNDER_I_CROSSES, e, f);
}

/* Tests two collinear edges. */
static bool visit_collinear(finder *c, uint32_t e, uint32_t f)
{
    const sunder_i_rings *r = c->r;
    uint32_t a = e, b = r->next[e], g = f, h = r->next[f];
    uint32_t swap;
    if (sunder_i_rings_cmp(r, a, b) > 0) swap = a, a = b, b = swap;
    if (sunder_i_rings_cmp(r, g, h) > 0) swap = g, g = h, h = swap;
    const uint32_t low = sunder_i_rings_cmp(r, a, g) > 0 ? a : g, high = sunder_i_rings_cmp(r, b, h) < 0 ? b : h;
    const int order = sunder_i_rings_cmp(r, low, high);
    if (order < 0) return note_fault(c, SUNDER_I_OVERLAPS, e, f);
    if (order == 0 && ((low == e && high == f) || (low == f && high == e)))
        return visit_touch(c, e, f, e, r->prev[e], r->next[e], r->prev[f], r->next[f]);
    return true;
}

static bool visit_pair(void *user, uint32_t e, uint32_t f)
{
    finder *c = user;
    const sunder_i_rings *r = c->r;
    const uint32_t a = e, b = r->next[e], g = f, h = r->next[f];
    if (c->left-- == 0) return false;
    if (b == g || h == a) return true;
    const int og = sunder_i_rings_orient(r, a, b, g), oh = sunder_i_rings_orient(r, a, b, h);
    if (og * oh > 0) return true;
    if (og == 0 && oh == 0) return visit_collinear(c, e, f);
    const int oa = sunder_i_rings_orient(r, g, h, a), ob = sunder_i_rings_orient(r, g, h, b);
    if (oa * ob > 0) return true;
    if (og && oh && oa && ob) return note_fault(c, SUNDER_I_CROSSES, e, f);
    /* The lines cross in one point, which is an end of an edge. First vertices of edges take part in three ways;
     * contacts of second vertices only are found at the edges that begin there. */
    if (og == 0 && oa == 0) return visit_touch(c, e, f, a, r->prev[a], b, r->prev[g], h);
    if (og == 0 && ob != 0) return visit_touch(c, e, f, g, r->prev[g], h, a, b);
    if (oa == 0 && oh != 0) return visit_touch(c, e, f, a, r->prev[a], b, g, h);
    c->touches = true;
    return true;
}

/* With more pairs than this for each edge, boxes do not separate the edges, as with long thin spikes, and a sweep is
 * used. Measured: coasts, pixels and combs have one to four. */
#define PAIRS_EACH 24

/* Tests the pairs of the tree; if there are too many, only if a sweep finds that some edges meet. */
static void find_by_tree(finder *c, uint32_t ring_lo, uint32_t ring_hi, const sunder_i_edge_tree *tree,
                         sunder_i_arena *arena)
{
    c->left = PAIRS_EACH * tree->boxes.n;
    if (sunder_i_edge_tree_pairs(tree, c->r, visit_pair, c) || c->problem->fault) return;
    if (!c->touches && (sunder_i_rings_simple(c->r, ring_lo, ring_hi, arena) || arena->failed)) return;
    c->left = SIZE_MAX;
    sunder_i_edge_tree_pairs(tree, c->r, visit_pair, c);
}

void sunder_i_intersections_find(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi,
                                 const sunder_i_edge_tree *tree, sunder_i_arena *arena, sunder_i_problem *problem,
                                 bool *touches)
{
    finder c = {r, problem, false, SIZE_MAX};
    const uint32_t lo = ring_lo ? r->ring_end[ring_lo - 1] : 0, hi = r->ring_end[ring_hi - 1];
    if (tree) {
        find_by_tree(&c, ring_lo, ring_hi, tree, arena);
    } else {
        /* few edges: all pairs, boxes first */
        for (uint32_t e = lo; e < hi; e++) {
            const double *a = r->xy + 2 * (size_t)e, *b = r->xy + 2 * (size_t)r->next[e];
            const double x0 = a[0] < b[0] ? a[0] : b[0], x1 = a[0] < b[0] ? b[0] : a[0];
            const double y0 = a[1] < b[1] ? a[1] : b[1], y1 = a[1] < b[1] ? b[1] : a[1];
            for (uint32_t f = e + 1; f < hi; f++) {
                const double *g = r->xy + 2 * (size_t)f, *h = r->xy + 2 * (size_t)r->next[f];
                if ((g[0] > x1 && h[0] > x1) || (g[0] < x0 && h[0] < x0) || (g[1] > y1 && h[1] > y1) ||
                    (g[1] < y0 && h[1] < y0))
                    continue;
                if (!visit_pair(&c, e, f)) goto done;
            }
        }
    }
done:
    *touches = c.touches;
}
