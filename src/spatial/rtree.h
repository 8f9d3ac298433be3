/* A packed R-tree over boxes, updated in place when some of them move. */
#ifndef SUNDER_I_RTREE_H
#define SUNDER_I_RTREE_H

#include "base/list.h"
#include "base/memory.h"
#include "spatial/box.h"

/* Children of a node, and leaves of a lowest-level node: leaf / SUNDER_I_RTREE_RUN is the number of its run. */
#define SUNDER_I_RTREE_RUN 16u

/* A packed R-tree; its boxes may move. */
typedef struct sunder_i_rtree {
    double *box;      /* [4 * (nodes + 1)] xmin ymin xmax ymax; the leaves first, in Hilbert order, then the root, and
                       * behind it zeros */
    uint32_t *item;   /* [leaves] the item of each leaf */
    uint32_t *leaf;   /* [items] the leaf of each item; items that were absent point behind the root */
    bool borrows;     /* these two belong to another tree ... */
    bool unmoved;     /* ... and the boxes, too */
    size_t level[16]; /* first node of each level; level[levels] is the end */
    unsigned levels;
    size_t leaves;
    double sprawl, packed; /* sum of width and height of all inner nodes: now, and when the tree was built */
} sunder_i_rtree;

/* The first of a node's children on the level below, and the end of them. */
static inline size_t sunder_i_rtree_children(const sunder_i_rtree *tree, unsigned level, size_t node, size_t *end)
{
    const size_t first = tree->level[level - 1] + (node - tree->level[level]) * SUNDER_I_RTREE_RUN;
    *end = first + SUNDER_I_RTREE_RUN < tree->level[level] ? first + SUNDER_I_RTREE_RUN : tree->level[level];
    return first;
}

/* Boxes of the items for which present[i] (NULL: all). */
sunder_status sunder_i_rtree_build(const double *box, const bool *present, size_t n, sunder_i_rtree *out,
                                   sunder_error *err);
/* Another tree over the same boxes, which shares them until they are to move; the first tree must outlive it. */
sunder_i_rtree sunder_i_rtree_lend(const sunder_i_rtree *tree);
/* Gives a tree that shares boxes its own copy, before any of them moves. */
sunder_status sunder_i_rtree_own(sunder_i_rtree *tree, sunder_error *err);
void sunder_i_rtree_free(sunder_i_rtree *tree);
/* Replaces the box of a present item. */
void sunder_i_rtree_move(sunder_i_rtree *tree, uint32_t item, const double box[4]);
/* The box of an item; zeros if it was absent. */
static inline const double *sunder_i_rtree_box(const sunder_i_rtree *tree, uint32_t item)
{
    return tree->box + 4 * (size_t)tree->leaf[item];
}
/* The boxes of all n items, to be freed; NULL if memory is out. */
double *sunder_i_rtree_boxes(const sunder_i_rtree *tree, size_t n);
/* Have boxes moved far enough that the tree should be rebuilt? */
bool sunder_i_rtree_is_worn(const sunder_i_rtree *tree);

/* Appends every item whose box meets the closed query box, in the tree's order. False if memory is out. */
bool sunder_i_rtree_query(const sunder_i_rtree *tree, const double box[4], sunder_i_list *hits);

/* ---- Queries for many neighbouring items ------------------------------------------------------------------------- */

/* Leaves form runs, one for each lowest-level node. To query the boxes of all items, query once for the hull of a run
 * and filter the answer for each item of the run: a sixth of the work of single queries. */
size_t sunder_i_rtree_runs(const sunder_i_rtree *tree);
/* The leaves of a run, and the hull of their boxes. */
const double *sunder_i_rtree_run(const sunder_i_rtree *tree, size_t run, size_t *first, size_t *end);
/* As sunder_i_rtree_query(), but it appends leaves: their places among tree->box and tree->item. */
bool sunder_i_rtree_query_leaves(const sunder_i_rtree *tree, const double box[4], sunder_i_list *hits);

#endif
