/* rtree.h: a packed R-tree over boxes, updated in place when some of them move. */
#ifndef SUNDER_I_RTREE_H
#define SUNDER_I_RTREE_H

#include "base/list.h"
#include "base/memory.h"
#include "spatial/box.h"

/* The number of children of a node, and of leaves of a lowest-level node: leaf / SUNDER_I_RTREE_RUN is the number of
 * its run. */
#define SUNDER_I_RTREE_RUN 16u

/* A packed R-tree; its boxes may move. */
typedef struct sunder_i_rtree {
    double *box;      /* [4 * (nodes + 1)] xmin ymin xmax ymax; the leaves first, in Hilbert order, then the inner nodes
                       * up to the root, and after it zeros */
    uint32_t *item;   /* [leaves] the item of each leaf */
    uint32_t *leaf;   /* [items] the leaf of each item; those of absent items refer to the zeros after the root */
    bool borrows;     /* item and leaf belong to another tree ... */
    bool unmoved;     /* ... and the boxes, too */
    size_t level[16]; /* the first node of each level; level[levels] is the end */
    unsigned levels;
    size_t leaves;
    double sprawl, packed; /* the sum of width and height of all inner nodes: now, and when the tree was built */
} sunder_i_rtree;

/* Returns the first of a node's children on the level below; *end becomes the end of them. */
static inline size_t sunder_i_rtree_children(const sunder_i_rtree *tree, unsigned level, size_t node, size_t *end)
{
    const size_t first = tree->level[level - 1] + (node - tree->level[level]) * SUNDER_I_RTREE_RUN;
    *end = first + SUNDER_I_RTREE_RUN < tree->level[level] ? first + SUNDER_I_RTREE_RUN : tree->level[level];
    return first;
}

/* Builds the tree of the boxes of those items i for which present[i] (NULL: all). Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_rtree_build(const double *box, const bool *present, size_t n, sunder_i_rtree *out,
                                   sunder_error *err);
/* Returns another tree over the same boxes, which shares them until they are to move; the first tree must outlive
 * it. */
sunder_i_rtree sunder_i_rtree_lend(const sunder_i_rtree *tree);
/* Gives a tree that shares boxes its own copy, before any of them moves. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_rtree_own(sunder_i_rtree *tree, sunder_error *err);
void sunder_i_rtree_free(sunder_i_rtree *tree);
/* Replaces the box of a present item. */
void sunder_i_rtree_move(sunder_i_rtree *tree, uint32_t item, const double box[4]);
/* Returns the box of an item; zeros if it was absent. */
static inline const double *sunder_i_rtree_box(const sunder_i_rtree *tree, uint32_t item)
{
    return tree->box + 4 * (size_t)tree->leaf[item];
}
/* Returns a copy of the boxes of all n items, which the caller frees; NULL if out of memory. */
double *sunder_i_rtree_boxes(const sunder_i_rtree *tree, size_t n);
/* Returns true if boxes have moved so far that the tree should be built again. */
bool sunder_i_rtree_is_worn(const sunder_i_rtree *tree);

/* Appends every item whose box meets the closed query box, in the tree's order. Returns false if out of memory. */
bool sunder_i_rtree_query(const sunder_i_rtree *tree, const double box[4], sunder_i_list *hits);

/* ---- Queries for many neighbouring items ------------------------------------------------------------------------- */

/* Returns the number of runs; each consists of the leaves of a lowest-level node. To query the boxes of all items,
 * query once for the hull of a run and filter the result for each item of the run: this takes a sixth of the time of
 * single queries. */
size_t sunder_i_rtree_runs(const sunder_i_rtree *tree);
/* Returns the hull of the boxes of a run; [*first, *end) become its leaves. */
const double *sunder_i_rtree_run(const sunder_i_rtree *tree, size_t run, size_t *first, size_t *end);
/* As sunder_i_rtree_query(), but appends leaves: their indices in tree->box and tree->item. */
bool sunder_i_rtree_query_leaves(const sunder_i_rtree *tree, const double box[4], sunder_i_list *hits);

#endif
