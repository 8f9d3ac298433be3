/* disjoint_sets.h: disjoint sets of numbers, as an array of parents. The root of a set is its least member. */
#ifndef GIS_DISJOINT_SETS_H
#define GIS_DISJOINT_SETS_H

#include <stddef.h>

static inline size_t gis_set_root(size_t *parent, size_t x)
{
    while (parent[x] != x) x = parent[x] = parent[parent[x]];
    return x;
}

static inline void gis_set_join(size_t *parent, size_t a, size_t b)
{
    const size_t x = gis_set_root(parent, a), y = gis_set_root(parent, b);
    parent[x > y ? x : y] = x > y ? y : x;
}

#endif
