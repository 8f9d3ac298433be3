/* dop_tree.h: the convex pieces of an operand by position: a tree with their extents in eight directions (discrete
 * oriented polytopes with sixteen sides [KHMSZ98]), so that long thin pieces at an angle are separated, too. With two
 * such trees, of P and of -Q, the subsums near a square of the plane are found, and those that may cover it.
 *
 * Extents are floats rounded to nearest; instead, the square is enlarged by more than all rounding errors
 * (sunder_i_dop_query()). */
#ifndef SUNDER_I_DOP_TREE_H
#define SUNDER_I_DOP_TREE_H

#include "separation/operands/pair_operands.h"

#include <math.h>
#include <string.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

#define SUNDER_I_DOP_WAYS 8 /* directions at multiples of pi / 8; the first is along x, the fifth along y */

typedef struct sunder_i_dop {
    float low[SUNDER_I_DOP_WAYS], high[SUNDER_I_DOP_WAYS];
} sunder_i_dop;

/* A perfect binary tree: node k has the children 2k and 2k + 1, node 1 is the root, node leaves + i has piece[i]. */
typedef struct sunder_i_dop_tree {
    uint32_t leaves;
    uint32_t *piece;      /* [leaves] the number of the piece; UINT32_MAX: none */
    sunder_i_dop *extent; /* [2 * leaves] for leaves without a piece the bounds are infinite, low above high */
} sunder_i_dop_tree;

/* Returns the power of two by which coordinates are multiplied before they become floats, so that they are below 2 in
 * any unit. */
double sunder_i_float_scale(const sunder_i_operands *operands);

/* Returns the extents of the empty set; the second function adds a point to extents. */
sunder_i_dop sunder_i_dop_nowhere(void);
void sunder_i_dop_add(sunder_i_dop *extents, float x, float y);

/* Builds *tree over n convex sets with the extents extent[n]. Returns false if out of memory; the caller frees the tree
 * in any case. */
bool sunder_i_dop_tree_build(sunder_i_dop_tree *tree, const sunder_i_dop *extent, uint32_t n);
void sunder_i_dop_tree_free(sunder_i_dop_tree *tree);

/* Returns the extents of a square, enlarged by the error of doubles and floats, and by `by` units. */
sunder_i_dop sunder_i_dop_query(const sunder_i_operands *operands, const double square[4], double by);

/* Vectors of four floats or masks, which compilers map to the machine's vector instructions. */
typedef float sunder_i_floats __attribute__((vector_size(16)));
typedef int32_t sunder_i_masks __attribute__((vector_size(16)));
typedef int64_t sunder_i_halves __attribute__((vector_size(16)));

static inline sunder_i_floats sunder_i_floats_at(const float *v)
{
    sunder_i_floats f;
    memcpy(&f, v, sizeof f);
    return f;
}

/* Returns the lesser element of each pair; the second one if one of them is NaN. */
static inline sunder_i_floats sunder_i_floats_min(sunder_i_floats a, sunder_i_floats b)
{
#ifdef __SSE__
    return (sunder_i_floats)_mm_min_ps((__m128)a, (__m128)b);
#else
    const sunder_i_masks less = a < b;
    return (sunder_i_floats)(((sunder_i_masks)a & less) | ((sunder_i_masks)b & ~less));
#endif
}

static inline sunder_i_floats sunder_i_floats_max(sunder_i_floats a, sunder_i_floats b)
{
#ifdef __SSE__
    return (sunder_i_floats)_mm_max_ps((__m128)a, (__m128)b);
#else
    return -sunder_i_floats_min(-a, -b);
#endif
}

static inline float sunder_i_floats_least(sunder_i_floats v)
{
    const float a = v[0] < v[1] ? v[0] : v[1], b = v[2] < v[3] ? v[2] : v[3];
    return a < b ? a : b;
}

/* Returns whether a subsum of convex sets with the extents u and v may come near the square of the query. */
static inline bool sunder_i_dop_near(const sunder_i_dop *u, const sunder_i_dop *v, const sunder_i_dop *query)
{
    sunder_i_masks off = {0, 0, 0, 0};
    for (int k = 0; k < SUNDER_I_DOP_WAYS; k += 4) {
        const sunder_i_floats low = sunder_i_floats_at(u->low + k) + sunder_i_floats_at(v->low + k);
        const sunder_i_floats high = sunder_i_floats_at(u->high + k) + sunder_i_floats_at(v->high + k);
        off |= (low > sunder_i_floats_at(query->high + k)) | (high < sunder_i_floats_at(query->low + k));
    }
    const sunder_i_halves any = (sunder_i_halves)off;
    return (any[0] | any[1]) == 0;
}

/* Returns an upper bound of the depth of the whole square of the query inside a subsum of convex sets with the extents
 * u and v; if it is not positive the subsum does not cover the square. */
static inline float sunder_i_dop_depth(const sunder_i_dop *u, const sunder_i_dop *v, const sunder_i_dop *query)
{
    sunder_i_floats least = {INFINITY, INFINITY, INFINITY, INFINITY};
    for (int k = 0; k < SUNDER_I_DOP_WAYS; k += 4) {
        const sunder_i_floats low = sunder_i_floats_at(u->low + k) + sunder_i_floats_at(v->low + k);
        const sunder_i_floats high = sunder_i_floats_at(u->high + k) + sunder_i_floats_at(v->high + k);
        least = sunder_i_floats_min(sunder_i_floats_at(query->low + k) - low, least);
        least = sunder_i_floats_min(high - sunder_i_floats_at(query->high + k), least);
    }
    return sunder_i_floats_least(least);
}

#endif
