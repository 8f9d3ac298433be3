/* nesting.c: the orientation of rings, and whether the holes are valid.
 *
 * The rings neither cross nor overlap, so that each ring by itself has the winding number 0 or +-1 everywhere. Take the
 * lowest position of a ring (of several the leftmost), and there the first direction d counterclockwise from the
 * positive x axis. The point q directly on the left of d, infinitely near the position, is inside the ring. So the ring
 * is counterclockwise exactly if d leaves the position. If outer ring and holes are correctly oriented, the polygon is
 * valid exactly if the winding number of all rings together at q is 1 for the outer ring and 0 for each hole: it is [q
 * in the outer ring] - (the number of holes that contain q), and a hole contains its own q.
 *
 * The winding number of q is counted by a ray to the right at a height just above the position, which no vertex has;
 * edges through the position itself are on the right of q if they are clockwise of d, or are d. */
#include "shape/build.h"

#include <math.h>

typedef struct probe {
    const sunder_i_rings *r;
    uint32_t v, d; /* the lowest position, and the other end of the first direction there */
    bool leaves;   /* the first direction is the edge v -> d (else the edge d -> v) */
    int winding;
} probe;

static probe probe_ring(const sunder_i_rings *r, uint32_t lo, uint32_t hi)
{
    uint32_t v = lo;
    uint32_t equals = 1;
    for (uint32_t i = lo + 1; i < hi; i++) {
        int c = sunder_i_rings_cmp_y(r, i, v);
        if (c == 0) c = sunder_i_rings_cmp_x(r, i, v);
        if (c > 0) continue;
        if (c == 0) {
            equals++;
        } else {
            v = i;
            equals = 1;
        }
    }
    probe p = {r, v, r->next[v], true, 0};
    if (sunder_i_rings_orient(r, v, p.d, r->prev[v]) < 0) {
        p.d = r->prev[v];
        p.leaves = false;
    }
    /* the ring may pass its lowest position several times */
    for (uint32_t i = v + 1; equals > 1 && i < hi; i++) {
        if (sunder_i_rings_cmp(r, i, v) != 0) continue;
        equals--;
        if (sunder_i_rings_orient(r, v, p.d, r->next[i]) < 0) p.d = r->next[i], p.leaves = true;
        if (sunder_i_rings_orient(r, v, p.d, r->prev[i]) < 0) p.d = r->prev[i], p.leaves = false;
    }
    return p;
}

static void count_edge(void *user, uint32_t e)
{
    probe *p = user;
    const sunder_i_rings *r = p->r;
    const uint32_t f = r->next[e];
    const bool e_below = sunder_i_rings_cmp_y(r, e, p->v) <= 0, f_below = sunder_i_rings_cmp_y(r, f, p->v) <= 0;
    if (e_below == f_below) return;
    const uint32_t low = e_below ? e : f, high = e_below ? f : e;
    int side = sunder_i_rings_orient(r, low, high, p->v);
    if (side == 0) side = -sunder_i_rings_orient(r, p->v, p->d, high) >= 0 ? 1 : -1;
    if (side > 0) p->winding += e_below ? 1 : -1;
}

static int winding_number(probe *p, uint32_t lo, uint32_t hi, const sunder_i_edge_tree *tree)
{
    p->winding = 0;
    if (tree) {
        const double *at = p->r->xy + 2 * (size_t)p->v, ray[4] = {at[0], at[1], INFINITY, at[1]};
        sunder_i_edge_tree_query(tree, ray, count_edge, p);
    } else
        for (uint32_t e = lo; e < hi; e++) count_edge(p, e);
    return p->winding;
}

static uint32_t ring_begin(const sunder_i_rings *r, uint32_t ring) { return ring ? r->ring_end[ring - 1] : 0; }

static void reverse_ring(sunder_i_rings *r, uint32_t lo, uint32_t hi)
{
    for (uint32_t i = lo, j = hi - 1; i < j; i++, j--) {
        const sunder_i_point at = r->at[i];
        r->at[i] = r->at[j];
        r->at[j] = at;
        const uint32_t source = r->source[i];
        r->source[i] = r->source[j];
        r->source[j] = source;
        for (int k = 0; k < 2; k++) {
            const double c = r->xy[2 * (size_t)i + (size_t)k];
            r->xy[2 * (size_t)i + (size_t)k] = r->xy[2 * (size_t)j + (size_t)k];
            r->xy[2 * (size_t)j + (size_t)k] = c;
        }
    }
}

void sunder_i_orient_rings(sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi)
{
    for (uint32_t ring = ring_lo; ring < ring_hi; ring++) {
        const uint32_t lo = ring_begin(r, ring), hi = r->ring_end[ring];
        if (probe_ring(r, lo, hi).leaves != (ring == ring_lo)) reverse_ring(r, lo, hi);
    }
}

/* Sets *problem to the rule that is broken, by testing the rings one by one. */
static void explain_fault(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, uint32_t ring,
                          sunder_i_problem *problem)
{
    const uint32_t outer = ring_begin(r, ring_lo);
    for (uint32_t hole = ring == ring_lo ? ring_lo + 1 : ring; hole < ring_hi; hole++) {
        probe p = probe_ring(r, ring_begin(r, hole), r->ring_end[hole]);
        problem->vertex = p.v;
        problem->other = outer;
        problem->fault = SUNDER_I_OUTSIDE;
        if (winding_number(&p, outer, r->ring_end[ring_lo], NULL) == 0) return;
        problem->fault = SUNDER_I_NESTED;
        for (uint32_t other = ring_lo + 1; other < ring_hi; other++) {
            if (other == hole || winding_number(&p, ring_begin(r, other), r->ring_end[other], NULL) == 0) continue;
            problem->other = ring_begin(r, other);
            return;
        }
    }
}

void sunder_i_nesting_check(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, const sunder_i_edge_tree *tree,
                            sunder_i_problem *problem)
{
    for (uint32_t ring = ring_lo; ring < ring_hi && ring_hi - ring_lo > 1; ring++) {
        probe p = probe_ring(r, ring_begin(r, ring), r->ring_end[ring]);
        if (winding_number(&p, ring_begin(r, ring_lo), r->ring_end[ring_hi - 1], tree) != (ring == ring_lo)) {
            explain_fault(r, ring_lo, ring_hi, ring, problem);
            return;
        }
    }
}
