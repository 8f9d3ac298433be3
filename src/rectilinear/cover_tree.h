/* cover_tree.h: a segment tree that counts the ranges that cover each element, and lists the elements of a range that
 * no range covers. A query visits only nodes with both covered and free elements, so that it takes O((k + 1) log n) for
 * k runs found.
 *
 * Nodes have 64 children, which are bits of words: children of the lowest nodes are elements, those of others are
 * nodes. The own ranges of all 64 children are counted at once, bit-sliced: a child's bit in the first number is the
 * lowest digit of its count, that in the next number the next digit, and so on. */
#ifndef SUNDER_I_COVER_TREE_H
#define SUNDER_I_COVER_TREE_H

#include "base/memory.h"

#define SUNDER_I_COVER_LEVELS 6  /* 64^6 is more than the number of elements */
#define SUNDER_I_COVER_DIGITS 29 /* with this number a node has 256 bytes */

/* One bit for each child. A child is covered by its own ranges and by those of the nodes below it. */
typedef struct sunder_i_cover_node {
    uint64_t own;  /* the child has ranges of its own, so that it is covered */
    uint64_t full; /* ranges below the child cover all of it */
    uint64_t some; /* ranges below the child cover some of it */
    uint64_t digit[SUNDER_I_COVER_DIGITS];
} sunder_i_cover_node;

typedef struct sunder_i_cover_tree {
    sunder_i_cover_node *level[SUNDER_I_COVER_LEVELS]; /* from the lowest level to the root; the first pointer is the
                                                        * allocation */
    uint32_t levels;
    uint32_t digits; /* the largest number of digits that a count has needed */
} sunder_i_cover_tree;

/* The elements from (inclusive) to (exclusive). */
typedef struct sunder_i_element_run {
    uint32_t from, to;
} sunder_i_element_run;

typedef struct sunder_i_element_runs {
    sunder_i_element_run *item;
    size_t n, capacity;
} sunder_i_element_runs;

/* Makes a tree whose elements are all free. Returns false if out of memory. */
bool sunder_i_cover_tree_init(sunder_i_cover_tree *tree, uint32_t elements);
void sunder_i_cover_tree_free(sunder_i_cover_tree *tree);
/* Add a range, or remove one that was added; from < to. There may be at most 2^SUNDER_I_COVER_DIGITS - 1 ranges at a
 * time. */
void sunder_i_cover_tree_add(sunder_i_cover_tree *tree, uint32_t from, uint32_t to);
void sunder_i_cover_tree_remove(sunder_i_cover_tree *tree, uint32_t from, uint32_t to);
/* Appends the longest runs of free elements in a range, ascending. Returns false if out of memory. */
bool sunder_i_cover_tree_free_runs(const sunder_i_cover_tree *tree, uint32_t from, uint32_t to,
                                   sunder_i_element_runs *out);

#endif
