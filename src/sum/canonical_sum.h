/* The canonical form of a sum, in which equal sets are equal. Roads put what they find in order here, but for the
 * sum of two convex operands, whose only ring is in order as it comes (minkowski/convex_operands.c).
 *
 *   rings      the sum on the left; each starts at its lexicographically smallest vertex, none of which is straight
 *   polygons   in the lexicographic order of their outer rings, vertex by vertex; the holes of each likewise
 *   segments   from the smaller end to the greater, in lexicographic order
 *   points     in lexicographic order */
#ifndef SUNDER_I_CANONICAL_SUM_H
#define SUNDER_I_CANONICAL_SUM_H

#include "sum/sum_value.h"

typedef struct sunder_i_found_ring {
    size_t start, end; /* in sunder_i_found.vertex; the smallest vertex first */
    uint32_t component;
    bool outer;
} sunder_i_found_ring;

/* What a sum is made of, in any order, by numbers of vertices. */
typedef struct sunder_i_found {
    const uint32_t *vertex; /* of all rings */
    const sunder_i_found_ring *ring;
    size_t rings;
    uint32_t components;     /* all rings' are below this, and one ring of each that has any is its outer one */
    const uint32_t *segment; /* [2 * segments] the smaller end of each first */
    size_t segments;
    const uint32_t *point;
    size_t points;
    int (*compare)(void *context, uint32_t v, uint32_t w); /* the lexicographic order of two vertices */
    void *context;
    const sunder_i_hpoint *place; /* of each vertex, where known: then most need no comparison */
    bool sorted;                  /* the vertices of rings are numbered in that order */
} sunder_i_found;

/* For those that know their vertices as the sum does, which then is the context. */
int sunder_i_sum_vertex_cmp(void *context, uint32_t v, uint32_t w);

/* Fills rings, polygons, segments and points of an empty sum. False if memory is out. */
bool sunder_i_canonical(sunder_i_found *found, sunder_sum *out);

/* What of a sum is not canonical, or NULL; NULL too where memory runs out. */
const char *sunder_i_canonical_check(sunder_sum *sum);

#endif
