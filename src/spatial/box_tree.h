/* box_tree.h: a packed tree of boxes over items in a suitable order.
 *
 * The perfect binary tree over blocks of consecutive items, in heap order and without pointers: node 1 is the root, the
 * children of node i are 2 i and 2 i + 1, and the leaves are the last half. A node's box is the hull of the boxes below
 * it. Nothing is sorted here: the caller supplies an order in which neighbours are close to each other (along a ring,
 * along a space-filling curve), and the tree keeps it. The order affects speed only.
 *
 * Callers traverse the tree in loops of their own, since they differ in the boxes that they skip and in the child that
 * they visit first:
 *
 *     sunder_i_box_walk_start(&walk, tree);
 *     for (size_t node; sunder_i_box_walk_next(&walk, &node);) {
 *         if (nothing of tree->box[node] is of interest) continue;
 *         if (node < tree->leaves) {
 *             sunder_i_box_walk_open(&walk, 2 * node + 1, 2 * node);
 *             continue;
 *         }
 *         for (size_t i = sunder_i_box_tree_first(tree, node); i < sunder_i_box_tree_end(tree, node); i++) ...
 *     } */
#ifndef SUNDER_I_BOX_TREE_H
#define SUNDER_I_BOX_TREE_H

#include "base/invariant.h"
#include "spatial/box.h"

#include <stddef.h>
#include <string.h>

typedef struct sunder_i_box_tree {
    size_t n;         /* the number of items */
    size_t block;     /* the number of items in a block */
    size_t leaves;    /* a power of two; block * leaves >= n */
    double (*box)[4]; /* [2 * leaves] the first is unused */
} sunder_i_box_tree;

/* Returns a tree over n items without boxes; the caller allocates 2 * leaves of them. */
static inline sunder_i_box_tree sunder_i_box_tree_of(size_t n, size_t block)
{
    sunder_i_box_tree tree = {n, block, 1, NULL};
    while (tree.leaves * block < n) tree.leaves *= 2;
    return tree;
}

/* Return the index of the first item of a leaf, and the index after its last one. */
static inline size_t sunder_i_box_tree_first(const sunder_i_box_tree *tree, size_t leaf)
{
    return (leaf - tree->leaves) * tree->block;
}

static inline size_t sunder_i_box_tree_end(const sunder_i_box_tree *tree, size_t leaf)
{
    const size_t end = sunder_i_box_tree_first(tree, leaf) + tree->block;
    return end < tree->n ? end : tree->n;
}

/* Sets all boxes. add(of, i, box) extends the box by item i. */
static inline __attribute__((always_inline)) void
sunder_i_box_tree_fill(sunder_i_box_tree *tree, void (*add)(const void *of, size_t i, double box[4]), const void *of)
{
    for (size_t leaf = tree->leaves; leaf < 2 * tree->leaves; leaf++) {
        sunder_i_box_clear(tree->box[leaf]);
        const size_t end = sunder_i_box_tree_end(tree, leaf);
        for (size_t i = sunder_i_box_tree_first(tree, leaf); i < end; i++) add(of, i, tree->box[leaf]);
    }
    for (size_t node = tree->leaves - 1; node > 0; node--) {
        memcpy(tree->box[node], tree->box[2 * node], sizeof tree->box[node]);
        sunder_i_box_join(tree->box[node], tree->box[2 * node + 1]);
    }
}

/* The stack of a traversal: at most one node on each level, and the tree has fewer than 64 levels. */
typedef struct sunder_i_box_walk {
    size_t node[64];
    unsigned n;
} sunder_i_box_walk;

static inline void sunder_i_box_walk_start(sunder_i_box_walk *walk, const sunder_i_box_tree *tree)
{
    walk->n = 0;
    if (tree->n) walk->node[walk->n++] = 1;
}

static inline bool sunder_i_box_walk_next(sunder_i_box_walk *walk, size_t *node)
{
    if (walk->n == 0) return false;
    *node = walk->node[--walk->n];
    return true;
}

/* Pushes both children of a node; `first` is visited next. */
static inline void sunder_i_box_walk_open(sunder_i_box_walk *walk, size_t first, size_t second)
{
    SUNDER_I_ASSERT(walk->n + 2 <= sizeof walk->node / sizeof *walk->node);
    walk->node[walk->n++] = second;
    walk->node[walk->n++] = first;
}

#endif
