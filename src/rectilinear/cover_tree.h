/* A segment tree: how many of the ranges put in cover each element, and which elements of a range none does. A question
 * goes down only to where covered and free elements mix, so it costs O((k + 1) log n) for k runs found.
 *
 * Leaves are blocks of elements, which count for themselves the ranges that begin or end among them: bit i of the first
 * number of a leaf is the lowest digit of element i's count, that of the next number the next digit, and so on. So one
 * is added to many of them at once, and runs are read off as bits. Nodes are numbered as in a heap. Each counts the
 * ranges that are its own, and knows its state, which is that of its elements under the ranges of its own and of
 * what is below. */
#ifndef SUNDER_I_COVER_TREE_H
#define SUNDER_I_COVER_TREE_H

#include "base/memory.h"

typedef struct sunder_i_cover_tree {
    uint32_t *node;    /* [2 * size] count * 4 + state */
    uint32_t size;     /* a power of two; leaves are from here on */
    uint64_t *digit;   /* [32 * size] of each leaf, one after the other, the lowest first */
    uint32_t digits;   /* that any count has had so far */
    uint64_t *covered; /* [size] a bit for each element whose count is not zero */
} sunder_i_cover_tree;

/* Elements from (inclusive) to (exclusive). */
typedef struct sunder_i_element_run {
    uint32_t from, to;
} sunder_i_element_run;

typedef struct sunder_i_element_runs {
    sunder_i_element_run *item;
    size_t n, capacity;
} sunder_i_element_runs;

/* All of them free; false if memory is out. */
bool sunder_i_cover_tree_init(sunder_i_cover_tree *tree, uint32_t elements);
void sunder_i_cover_tree_free(sunder_i_cover_tree *tree);
/* One range more, or one of those put in less; from < to. */
void sunder_i_cover_tree_add(sunder_i_cover_tree *tree, uint32_t from, uint32_t to);
void sunder_i_cover_tree_remove(sunder_i_cover_tree *tree, uint32_t from, uint32_t to);
/* Appends the longest runs of free elements in a range, ascending. False if memory is out. */
bool sunder_i_cover_tree_free_runs(const sunder_i_cover_tree *tree, uint32_t from, uint32_t to,
                                   sunder_i_element_runs *out);

#endif
