/* edge_tree.c: finds candidate pairs of edges by a tree of boxes over the edges in the order of the rings.
 *
 * The tree of boxes (spatial/box_tree.h) is joined with itself from the root. Consecutive edges are near each other, so
 * that on coasts, outlines and combs the boxes of distant nodes rarely meet, and no sorting is needed; many small rings
 * come in any order, so they are first sorted along a space-filling curve. All this only decides which pairs are tested
 * first: boxes are closed and their coordinates are monotone images of the exact ones, so that edges that meet are
 * always candidates. */
#include "shape/build.h"

#include "spatial/curve.h"

/* The number of edges in a leaf: more edges make the tree smaller but cause more pairs to be compared one by one. */
#define LEAF_EDGES 8
/* Up to this number of rings no sorting is done: each ring is in a good order by itself. */
#define FEW_RINGS 8

/* Lists the edges, with the rings in the curve's order of their first vertices. */
static void sort_rings(sunder_i_edge_tree *tree, const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi,
                       sunder_i_arena *arena)
{
    const uint32_t rings = ring_hi - ring_lo;
    tree->edge = sunder_i_arena_alloc(arena, tree->boxes.n, sizeof *tree->edge);
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

static uint32_t edge_at(const sunder_i_edge_tree *tree, size_t i)
{
    return tree->edge ? tree->edge[i] : tree->first + (uint32_t)i;
}

static void edge_box(const sunder_i_rings *r, uint32_t e, double box[4])
{
    const double *a = r->xy + 2 * (size_t)e;
    box[0] = box[2] = a[0];
    box[1] = box[3] = a[1];
    sunder_i_box_include(box, r->xy + 2 * (size_t)r->next[e]);
}

typedef struct edges {
    const sunder_i_edge_tree *tree;
    const sunder_i_rings *r;
} edges;

static void add_edge(const void *of, size_t i, double box[4])
{
    const edges *all = of;
    const uint32_t e = edge_at(all->tree, i);
    sunder_i_box_include(box, all->r->xy + 2 * (size_t)e);
    sunder_i_box_include(box, all->r->xy + 2 * (size_t)all->r->next[e]);
}

void sunder_i_edge_tree_build(sunder_i_edge_tree *tree, const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi,
                              sunder_i_arena *arena)
{
    *tree = (sunder_i_edge_tree){.first = ring_lo ? r->ring_end[ring_lo - 1] : 0};
    tree->boxes = sunder_i_box_tree_of(r->ring_end[ring_hi - 1] - tree->first, LEAF_EDGES);
    if (ring_hi - ring_lo > FEW_RINGS) sort_rings(tree, r, ring_lo, ring_hi, arena);
    tree->boxes.box = sunder_i_arena_alloc(arena, 2 * tree->boxes.leaves, sizeof *tree->boxes.box);
    if (!arena->failed) sunder_i_box_tree_fill(&tree->boxes, add_edge, &(edges){tree, r});
}

/* Visits the pairs of edges between two leaves, or within one. */
static bool join_leaves(const sunder_i_edge_tree *tree, const sunder_i_rings *r, size_t b, size_t c,
                        sunder_i_pair_visitor visit, void *user)
{
    const size_t b_lo = sunder_i_box_tree_first(&tree->boxes, b), b_hi = sunder_i_box_tree_end(&tree->boxes, b);
    const size_t c_lo = sunder_i_box_tree_first(&tree->boxes, c), c_hi = sunder_i_box_tree_end(&tree->boxes, c);
    double box[LEAF_EDGES][4];
    for (size_t j = c_lo; j < c_hi; j++) edge_box(r, edge_at(tree, j), box[j - c_lo]);
    for (size_t i = b_lo; i < b_hi; i++) {
        double own[4];
        edge_box(r, edge_at(tree, i), own);
        for (size_t j = b == c ? i + 1 : c_lo; j < c_hi; j++)
            if (sunder_i_box_meet(own, box[j - c_lo]) && !visit(user, edge_at(tree, i), edge_at(tree, j))) return false;
    }
    return true;
}

bool sunder_i_edge_tree_pairs(const sunder_i_edge_tree *tree, const sunder_i_rings *r, sunder_i_pair_visitor visit,
                              void *user)
{
    /* the depth is at most 28, and each level leaves at most three pairs on the stack */
    size_t stack[128][2];
    int n = 0;
    const double(*box)[4] = (const double(*)[4])tree->boxes.box;
    if (tree->boxes.n == 0) return true;
    stack[n][0] = stack[n][1] = 1;
    n++;
    while (n) {
        n--;
        const size_t b = stack[n][0], c = stack[n][1];
        if (b != c && !sunder_i_box_meet(box[b], box[c])) continue;
        if (b >= tree->boxes.leaves) {
            if (!join_leaves(tree, r, b, c, visit, user)) return false;
            continue;
        }
        for (size_t i = 0; i < 2; i++)
            for (size_t j = b == c ? i : 0; j < 2; j++) {
                stack[n][0] = 2 * b + i;
                stack[n][1] = 2 * c + j;
                n++;
            }
    }
    return true;
}

void sunder_i_edge_tree_query(const sunder_i_edge_tree *tree, const double box[4], sunder_i_edge_visitor visit,
                              void *user)
{
    const sunder_i_box_tree *t = &tree->boxes;
    sunder_i_box_walk walk;
    sunder_i_box_walk_start(&walk, t);
    for (size_t b; sunder_i_box_walk_next(&walk, &b);) {
        if (!sunder_i_box_meet(t->box[b], box)) continue;
        if (b < t->leaves) {
            sunder_i_box_walk_open(&walk, 2 * b + 1, 2 * b);
            continue;
        }
        const size_t end = sunder_i_box_tree_end(t, b);
        for (size_t i = sunder_i_box_tree_first(t, b); i < end; i++) visit(user, edge_at(tree, i));
    }
}
