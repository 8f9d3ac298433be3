/* canonical_sum.h: the canonical form of a sum, in which equal sets have equal representations. All methods sort their
 * results here, except the sum of two convex operands, whose only ring is in order already
 * (minkowski/convex_operands.c).
 *
 *   rings      with the sum on their left; each starts at its lexicographically smallest vertex; no vertex is straight
 *   polygons   in the lexicographic order of their outer rings, vertex by vertex; the holes of each likewise
 *   segments   from the smaller end to the greater, in lexicographic order
 *   points     in lexicographic order */
#ifndef SUNDER_I_CANONICAL_SUM_H
#define SUNDER_I_CANONICAL_SUM_H

#include "sum/sum_value.h"
#include "sunder_sum.h"

typedef struct sunder_i_found_ring {
    size_t start, end; /* the range in sunder_i_found.vertex; the smallest vertex is the first */
    uint32_t component;
    bool outer;
} sunder_i_found_ring;

/* The parts of a sum, in any order, by the numbers of vertices. */
typedef struct sunder_i_found {
    const uint32_t *vertex; /* the vertices of all rings */
    const sunder_i_found_ring *ring;
    size_t rings;
    uint32_t components;     /* the component of each ring is below this; of the rings of a component exactly one is its
                              * outer ring */
    const uint32_t *segment; /* [2 * segments] the ends of each segment, the smaller one first */
    size_t segments;
    const uint32_t *point;
    size_t points;
    int (*compare)(void *context, uint32_t v, uint32_t w); /* the lexicographic order of two vertices */
    void *context;
    const sunder_i_hpoint *place; /* the position of each vertex, or NULL: with positions most vertices need no call of
                                   * `compare` */
    bool sorted;                  /* the vertices of rings are numbered in lexicographic order */
} sunder_i_found;

/* A function for `compare` if the vertices are those of a sum; `context` is that sum. */
int sunder_i_sum_vertex_cmp(void *context, uint32_t v, uint32_t w);

/* Sets the rings, polygons, segments and points of an empty sum. Returns false if out of memory. */
bool sunder_i_canonical(sunder_i_found *found, sunder_sum *out);

/* Returns a message about the first part of a sum that is not canonical; NULL if there is none, or if out of memory. */
const char *sunder_i_canonical_check(sunder_sum *sum);

#endif
