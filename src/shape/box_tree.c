/* Candidate pairs of edges by a tree of boxes over the edges in ring order.
 *
 * The tree is the perfect binary tree over blocks of SUNDER_I_LEAF_EDGES consecutive edges; a node's box is the union
 * of its children's. It is joined with itself from the top. Consecutive edges are near each other, so on coasts,
 * outlines and combs the boxes of distant nodes rarely meet, and nothing needs sorting; many small rings come in any
 * order, so they are first sorted along a space-filling curve. That order, like all of this, decides what is looked at
 * first and nothing else: boxes are closed and their coordinates monotone images of the exact ones, so edges that meet
 * are always candidates. */
#include "shape/build.h"

#include "spatial/curve.h"

#include <math.h>

/* Tails of the edges, rings in the curve's order of their first vertices. */
static void sort_rings(sunder_i_box_tree *tree, const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi,
                       sunder_i_arena *arena)
{
    const uint32_t rings = ring_hi - ring_lo;
    tree->edge = sunder_i_arena_alloc(arena, tree->edges, sizeof *tree->edge);
    uint32_t *list = sunder_i_arena_alloc(arena, 2 * (size_t)rings, sizeof *list);
    if (arena->failed) return;
    uint32_t *first = list + rings;
    for (uint32_t k = 0; k < rings; k++) {
        list[k] = k;
        first[k] = ring_lo + k ? r->ring_end[ring_lo + k - 1] : 0;
    }
    sunder_i_curve_sort(r->xy, first, list, rings, arena);
    uint32_t n = 0;
    for (uint32_t k = 0; k < rings; k++)
        for (uint32_t e = first[list[k]]; e < r->ring_end[ring_lo + list[k]]; e++) tree->edge[n++] = e;
}

static uint32_t edge_at(const sunder_i_box_tree *tree, uint32_t i)
{
    return tree->edge ? tree->edge[i] : tree->first + i;
}

static void include(double box[4], const double *at)
{
    if (at[0] < box[0]) box[0] = at[0];
    if (at[1] < box[1]) box[1] = at[1];
    if (at[0] > box[2]) box[2] = at[0];
    if (at[1] > box[3]) box[3] = at[1];
}

static bool boxes_meet(const double a[4], const double b[4])
{
    return a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];
}

static void edge_box(const sunder_i_rings *r, uint32_t e, double box[4])
{
    const double *a = r->xy + 2 * (size_t)e;
    box[0] = box[2] = a[0];
    box[1] = box[3] = a[1];
    include(box, r->xy + 2 * (size_t)r->next[e]);
}

void sunder_i_box_tree_build(sunder_i_box_tree *tree, const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi,
                             sunder_i_arena *arena)
{
    *tree = (sunder_i_box_tree){0};
    tree->first = ring_lo ? r->ring_end[ring_lo - 1] : 0;
    tree->edges = r->ring_end[ring_hi - 1] - tree->first;
    if (ring_hi - ring_lo > 8) sort_rings(tree, r, ring_lo, ring_hi, arena);
    const uint32_t blocks = (tree->edges + SUNDER_I_LEAF_EDGES - 1) / SUNDER_I_LEAF_EDGES;
    tree->leaves = 1;
    while (tree->leaves < blocks) tree->leaves *= 2;
    tree->box = sunder_i_arena_alloc(arena, 2 * (size_t)tree->leaves, sizeof *tree->box);
    if (arena->failed) return;
    for (uint32_t b = 0; b < tree->leaves; b++) {
        double *box = tree->box[tree->leaves + b];
        box[0] = box[1] = INFINITY;
        box[2] = box[3] = -INFINITY;
        for (uint32_t i = b * SUNDER_I_LEAF_EDGES; i < tree->edges && i < (b + 1) * SUNDER_I_LEAF_EDGES; i++) {
            const uint32_t e = edge_at(tree, i);
            include(box, r->xy + 2 * (size_t)e);
            include(box, r->xy + 2 * (size_t)r->next[e]);
        }
    }
    for (uint32_t b = tree->leaves - 1; b > 0; b--) {
        const double *s = tree->box[2 * b], *t = tree->box[2 * b + 1];
        double *box = tree->box[b];
        box[0] = fmin(s[0], t[0]);
        box[1] = fmin(s[1], t[1]);
        box[2] = fmax(s[2], t[2]);
        box[3] = fmax(s[3], t[3]);
    }
}

/* Pairs between two blocks, or within one. */
static bool join_blocks(const sunder_i_box_tree *tree, const sunder_i_rings *r, uint32_t b, uint32_t c,
                        sunder_i_pair_visitor visit, void *user)
{
    const uint32_t b_lo = b * SUNDER_I_LEAF_EDGES, c_lo = c * SUNDER_I_LEAF_EDGES;
    double box[SUNDER_I_LEAF_EDGES][4];
    uint32_t m = 0;
    for (uint32_t j = c_lo; j < tree->edges && m < SUNDER_I_LEAF_EDGES; j++, m++) edge_box(r, edge_at(tree, j), box[m]);
    for (uint32_t i = b_lo; i < tree->edges && i < b_lo + SUNDER_I_LEAF_EDGES; i++) {
        double own[4];
        edge_box(r, edge_at(tree, i), own);
        for (uint32_t j = b == c ? i - b_lo + 1 : 0; j < m; j++)
            if (boxes_meet(own, box[j]) && !visit(user, edge_at(tree, i), edge_at(tree, c_lo + j))) return false;
    }
    return true;
}

bool sunder_i_box_tree_pairs(const sunder_i_box_tree *tree, const sunder_i_rings *r, sunder_i_pair_visitor visit,
                             void *user)
{
    /* Depth at most 28 levels, and each level leaves at most three pairs waiting. */
    uint32_t stack[128][2];
    int n = 0;
    if (tree->edges == 0) return true;
    stack[n][0] = stack[n][1] = 1;
    n++;
    while (n) {
        n--;
        const uint32_t b = stack[n][0], c = stack[n][1];
        if (b != c && !boxes_meet(tree->box[b], tree->box[c])) continue;
        if (b >= tree->leaves) {
            if (!join_blocks(tree, r, b - tree->leaves, c - tree->leaves, visit, user)) return false;
            continue;
        }
        for (uint32_t i = 0; i < 2; i++)
            for (uint32_t j = b == c ? i : 0; j < 2; j++) {
                stack[n][0] = 2 * b + i;
                stack[n][1] = 2 * c + j;
                n++;
            }
    }
    return true;
}

void sunder_i_box_tree_query(const sunder_i_box_tree *tree, const double box[4], sunder_i_edge_visitor visit,
                             void *user)
{
    uint32_t stack[64];
    int n = 0;
    if (tree->edges) stack[n++] = 1;
    while (n) {
        const uint32_t b = stack[--n];
        if (!boxes_meet(tree->box[b], box)) continue;
        if (b < tree->leaves) {
            stack[n++] = 2 * b;
            stack[n++] = 2 * b + 1;
            continue;
        }
        const uint32_t lo = (b - tree->leaves) * SUNDER_I_LEAF_EDGES;
        for (uint32_t i = lo; i < tree->edges && i < lo + SUNDER_I_LEAF_EDGES; i++) visit(user, edge_at(tree, i));
    }
}
