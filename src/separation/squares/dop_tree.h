/* The convex pieces of an operand, by position: a tree with their extents in eight directions (discrete oriented
 * polytopes of sixteen sides [KHMSZ98]), so that long thin pieces at an angle are separated too. Two such trees, one of
 * P and one of -Q, tell which subsums come near a square of the plane, and which may cover it.
 *
 * Extents are single floats, rounded to nearest; the square is widened instead, by more than all rounding
 * (sunder_i_dop_query()). */
#ifndef SUNDER_I_DOP_TREE_H
#define SUNDER_I_DOP_TREE_H

#include "separation/operands/pair_operands.h"

#include <math.h>
#include <string.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

#define SUNDER_I_DOP_WAYS 8 /* multiples of pi / 8; the first is along x, the middle one along y */

typedef struct sunder_i_dop {
    float low[SUNDER_I_DOP_WAYS], high[SUNDER_I_DOP_WAYS];
} sunder_i_dop;

/* A perfect binary tree: node k has the children 2k and 2k + 1, node 1 is the root, node leaves + i has piece[i]. */
typedef struct sunder_i_dop_tree {
    uint32_t leaves;
    uint32_t *piece;      /* [leaves] UINT32_MAX: none */
    sunder_i_dop *extent; /* [2 * leaves] infinite, low above high, for leaves without a piece */
} sunder_i_dop_tree;

/* Floats are of coordinates times this power of two, so that they are below 2 whatever the units. */
double sunder_i_float_scale(const sunder_i_operands *operands);

/* Those of nothing, and with one point more. */
sunder_i_dop sunder_i_dop_nowhere(void);
void sunder_i_dop_add(sunder_i_dop *extents, float x, float y);

/* Builds *tree over n convex sets with the extents extent[n]. Returns false if memory is out; the caller frees the
 * tree in any case. */
bool sunder_i_dop_tree_build(sunder_i_dop_tree *tree, const sunder_i_dop *extent, uint32_t n);
void sunder_i_dop_tree_free(sunder_i_dop_tree *tree);

/* The extents of a square, widened by the error of doubles and floats, and by `by` units. */
sunder_i_dop sunder_i_dop_query(const sunder_i_operands *operands, const double square[4], double by);

/* Four floats at a time, as vector types that compilers map to the machine. */
typedef float sunder_i_floats __attribute__((vector_size(16)));
typedef int32_t sunder_i_masks __attribute__((vector_size(16)));
typedef int64_t sunder_i_halves __attribute__((vector_size(16)));

static inline sunder_i_floats sunder_i_floats_at(const float *v)
{
    sunder_i_floats f;
    memcpy(&f, v, sizeof f);
    return f;
}

/* Of each two the second where one is no number. */
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

/* May a subsum of convex sets with the extents u and v come near the square that is asked about? */
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

/* How far inside such a subsum all of the square may be at most; it is not covered where that is not positive. */
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
