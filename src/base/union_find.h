/* union_find.h: disjoint sets of the numbers 0 .. n - 1, as a forest: parent[x] is x itself at a root.
 *
 * The root of a set is its least member, whatever the order of joins: so results may depend on it. This excludes union
 * by rank; path halving alone limits m operations to O(m log n) [TL84]. */
#ifndef SUNDER_I_UNION_FIND_H
#define SUNDER_I_UNION_FIND_H

#include "base/invariant.h"

#include <stddef.h>
#include <stdint.h>

static inline void sunder_i_union_init(uint32_t *parent, size_t n)
{
    for (size_t x = 0; x < n; x++) parent[x] = (uint32_t)x;
}

/* Returns the least member of the set of x. */
static inline uint32_t sunder_i_union_find(uint32_t *parent, uint32_t x)
{
    while (parent[x] != x) {
        SUNDER_I_ASSERT(parent[x] < x);
        x = parent[x] = parent[parent[x]];
    }
    return x;
}

static inline void sunder_i_union_join(uint32_t *parent, uint32_t x, uint32_t y)
{
    x = sunder_i_union_find(parent, x);
    y = sunder_i_union_find(parent, y);
    if (x < y)
        parent[y] = x;
    else
        parent[x] = y;
}

#endif
