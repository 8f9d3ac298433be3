/* arcs.c: the arrangement of the edges of a polygon, as arcs between its points.
 *
 * The candidate pairs of the tree of boxes give all points where two edges meet. The points (vertices and crossings)
 * are sorted exactly and numbered lexicographically, equal ones alike; after that, the order along an edge is the order
 * of the numbers. One of several coincident arcs remains: by the even-odd rule if their number is odd, since only the
 * parity of the arcs crossed matters; for winding numbers if their turns have a sum other than 0, which it gets. */
#include "shape/even_odd.h"

#include "base/sort.h"

#include <string.h>

typedef struct meet {
    uint32_t edge, node; /* a node is a vertex, or vertices + the number of a made point (a crossing) */
} meet;

typedef struct finder {
    const sunder_i_rings *r;
    meet *meets;
    size_t meet_n, meet_capacity;
    sunder_i_hpoint *made; /* [made_n] the crossings; copied to the arena at the end */
    uint32_t *made_on;     /* [made_n] an edge through each */
    size_t made_n, made_capacity, made_on_capacity;
    sunder_i_hpoint *place; /* the exact positions of all nodes, when they are known */
    bool failed;
} finder;

static bool add_meet(finder *f, uint32_t edge, uint32_t node)
{
    if (!sunder_i_reserve(&f->meets, &f->meet_capacity, f->meet_n + 1, sizeof *f->meets)) {
        f->failed = true;
        return false;
    }
    f->meets[f->meet_n++] = (meet){edge, node};
    return true;
}

/* Adds vertex v, which is on the line of an edge, if it is inside the edge. Returns false if out of memory. */
static bool add_collinear(finder *f, uint32_t edge, uint32_t v)
{
    const int from = sunder_i_rings_cmp(f->r, v, edge), to = sunder_i_rings_cmp(f->r, v, f->r->next[edge]);
    return from * to >= 0 ? true : add_meet(f, edge, v);
}

static bool add_crossing(finder *f, uint32_t e, uint32_t g)
{
    const sunder_i_rings *r = f->r;
    sunder_i_lattice *l = r->lattice;
    const sunder_i_point a = r->at[e], b = r->at[r->next[e]];
    const sunder_i_fraction t = sunder_i_crossing(l, a, b, r->at[g], r->at[r->next[g]]);
    if (!sunder_i_reserve(&f->made, &f->made_capacity, f->made_n + 1, sizeof *f->made) ||
        !sunder_i_reserve(&f->made_on, &f->made_on_capacity, f->made_n + 1, sizeof *f->made_on)) {
        f->failed = true;
        return false;
    }
    f->made[f->made_n] = sunder_i_hpoint_at(l, a, b, &t);
    f->made_on[f->made_n] = e < g ? e : g;
    const uint32_t node = r->vertices + (uint32_t)f->made_n++;
    return add_meet(f, e, node) && add_meet(f, g, node);
}

static bool visit_pair(void *user, uint32_t e, uint32_t g)
{
    finder *f = user;
    const sunder_i_rings *r = f->r;
    const uint32_t a = e, b = r->next[e], c = g, d = r->next[g];
    const int oc = sunder_i_rings_orient(r, a, b, c), od = sunder_i_rings_orient(r, a, b, d);
    if (oc * od > 0) return true;
    const int oa = sunder_i_rings_orient(r, c, d, a), ob = sunder_i_rings_orient(r, c, d, b);
    if (oa * ob > 0) return true;
    if (oc && od && oa && ob) return add_crossing(f, e, g);
    /* an end of one edge is on the line of the other; the four tests cover contacts, common ends, and collinear
     * edges */
    return (oc || add_collinear(f, e, c)) && (od || add_collinear(f, e, d)) && (oa || add_collinear(f, g, a)) &&
           (ob || add_collinear(f, g, b));
}

static int node_order(void *context, uint32_t i, uint32_t j)
{
    const finder *f = context;
    if (i < f->r->vertices && j < f->r->vertices) return sunder_i_rings_cmp(f->r, i, j);
    return sunder_i_hpoint_cmp(f->r->lattice, &f->place[i], &f->place[j]);
}

/* Sets number[] to the point of each node, and out->node[] to the first node of each point, a vertex if there is one.
 * Returns false if out of memory. */
static bool number_nodes(finder *f, sunder_i_arena *arena, uint32_t *number, sunder_i_arcs *out)
{
    const uint32_t n = f->r->vertices + (uint32_t)f->made_n;
    uint32_t *order = sunder_i_arena_alloc(arena, n, sizeof *order);
    f->place = sunder_i_arena_alloc(arena, n, sizeof *f->place);
    out->node = sunder_i_arena_alloc(arena, n, sizeof *out->node);
    if (arena->failed) return false;
    for (uint32_t i = 0; i < n; i++) {
        order[i] = i;
        f->place[i] = i < f->r->vertices ? sunder_i_hpoint_of(f->r->lattice, f->r->at[i]) : f->made[i - f->r->vertices];
    }
    if (!sunder_i_sort_indices(order, n, node_order, f)) return false;
    out->points = 0;
    for (uint32_t k = 0; k < n; k++) {
        const uint32_t i = order[k];
        if (k == 0 || node_order(f, order[k - 1], i) != 0)
            out->node[out->points++] = i < f->r->vertices ? i : SUNDER_I_MADE + (i - f->r->vertices);
        number[i] = out->points - 1;
    }
    return true;
}

typedef struct arc_context {
    const sunder_i_rings *r;
    const sunder_i_arc *arc;
} arc_context;

/* Returns the vector of the parent edge from its lexicographically smaller end. */
static sunder_i_point edge_direction(const sunder_i_rings *r, uint32_t parent)
{
    const uint32_t end = r->next[parent];
    const sunder_i_point a = r->at[parent], b = r->at[end];
    return sunder_i_rings_cmp(r, parent, end) < 0 ? sunder_i_point_sub(r->lattice, b, a)
                                                  : sunder_i_point_sub(r->lattice, a, b);
}

static int arc_ends(void *context, uint32_t i, uint32_t j)
{
    const arc_context *c = context;
    const sunder_i_arc *s = &c->arc[i], *t = &c->arc[j];
    if (s->lo != t->lo) return s->lo < t->lo ? -1 : 1;
    return (s->hi > t->hi) - (s->hi < t->hi);
}

static int arc_slope(void *context, uint32_t i, uint32_t j)
{
    const arc_context *c = context;
    const sunder_i_arc *s = &c->arc[i], *t = &c->arc[j];
    if (s->lo != t->lo) return s->lo < t->lo ? -1 : 1;
    return -sunder_i_cross_sign(c->r->lattice, edge_direction(c->r, s->parent), edge_direction(c->r, t->parent));
}

/* Divides each edge at its points, and returns the *n arcs; NULL if out of memory. */
static sunder_i_arc *cut_edges(finder *f, sunder_i_arena *arena, const uint32_t *number, size_t *n)
{
    const sunder_i_rings *r = f->r;
    const size_t most = f->meet_n + 2 * (size_t)r->vertices;
    uint64_t *key = sunder_i_arena_alloc(arena, most, sizeof *key);
    sunder_i_arc *arc = sunder_i_arena_alloc(arena, most, sizeof *arc);
    if (arena->failed) return NULL;
    size_t k = 0;
    for (uint32_t e = 0; e < r->vertices; e++) {
        key[k++] = (uint64_t)e << 32 | number[e];
        key[k++] = (uint64_t)e << 32 | number[r->next[e]];
    }
    for (size_t i = 0; i < f->meet_n; i++) key[k++] = (uint64_t)f->meets[i].edge << 32 | number[f->meets[i].node];
    if (!sunder_i_sort_keys(key, k)) return NULL;
    *n = 0;
    for (size_t i = 0; i + 1 < k; i++)
        if (key[i] >> 32 == key[i + 1] >> 32 && key[i] != key[i + 1]) {
            const uint32_t e = (uint32_t)(key[i] >> 32);
            const int32_t turn = number[e] < number[r->next[e]] ? 1 : -1; /* the interior is on the left */
            arc[(*n)++] = (sunder_i_arc){(uint32_t)key[i], (uint32_t)key[i + 1], e, turn};
        }
    return arc;
}

/* Keeps at most one of several coincident arcs, in their final order. Returns false if out of memory. */
static bool merge_arcs(const sunder_i_rings *r, bool winding, sunder_i_arena *arena, sunder_i_arc *arc, size_t n,
                       sunder_i_arcs *out)
{
    uint32_t *order = sunder_i_arena_alloc(arena, n, sizeof *order);
    out->arc = sunder_i_arena_alloc(arena, n, sizeof *out->arc);
    if (arena->failed) return false;
    arc_context context = {r, arc};
    for (uint32_t i = 0; i < n; i++) order[i] = i;
    if (!sunder_i_sort_indices(order, n, arc_ends, &context)) return false;
    uint32_t kept = 0;
    for (size_t i = 0, j; i < n; i = j) {
        int32_t turn = 0;
        for (j = i; j < n && arc_ends(&context, order[i], order[j]) == 0;) turn += arc[order[j++]].turn;
        if (winding ? turn == 0 : !((j - i) & 1)) continue;
        arc[order[i]].turn = turn;
        order[kept++] = order[i];
    }
    if (!sunder_i_sort_indices(order, kept, arc_slope, &context)) return false;
    for (uint32_t i = 0; i < kept; i++) out->arc[i] = arc[order[i]];
    out->arcs = kept;
    return true;
}

static bool find_arcs(finder *f, bool winding, sunder_i_arena *arena, sunder_i_arcs *out)
{
    sunder_i_edge_tree tree;
    sunder_i_edge_tree_build(&tree, f->r, 0, f->r->rings, arena);
    if (arena->failed) return false;
    sunder_i_edge_tree_pairs(&tree, f->r, visit_pair, f);
    if (f->failed) return false;
    uint32_t *number = sunder_i_arena_alloc(arena, f->r->vertices + f->made_n, sizeof *number);
    if (!number || !number_nodes(f, arena, number, out)) return false;
    size_t n;
    sunder_i_arc *arc = cut_edges(f, arena, number, &n);
    if (!arc || !merge_arcs(f->r, winding, arena, arc, n, out)) return false;
    out->makes = (uint32_t)f->made_n;
    out->made = sunder_i_arena_alloc(arena, f->made_n, sizeof *out->made);
    out->made_on = sunder_i_arena_alloc(arena, f->made_n, sizeof *out->made_on);
    if (arena->failed) return false;
    if (f->made_n) memcpy(out->made, f->made, f->made_n * sizeof *out->made);
    if (f->made_n) memcpy(out->made_on, f->made_on, f->made_n * sizeof *out->made_on);
    return !f->r->lattice->arena.failed;
}

bool sunder_i_arcs_find(const sunder_i_rings *r, bool winding, sunder_i_arena *arena, sunder_i_arcs *out)
{
    finder f = {.r = r};
    memset(out, 0, sizeof *out);
    const bool found = find_arcs(&f, winding, arena, out);
    sunder_i_free_all(f.meets, f.made, f.made_on);
    return found;
}
