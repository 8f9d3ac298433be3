/* A concave function that is the sum of blocks' least values, by cuts from above; see bundle.c. */
#ifndef SUNDER_I_BUNDLE_H
#define SUNDER_I_BUNDLE_H

#include "base/memory.h"

#include <stdbool.h>
#include <stdint.h>

/* A cut of one block: the block's least value at x is at most `at_rest` - 2 x.t, where x.t is the scalar product
 * over all copies of the block. */
typedef struct sunder_i_bundle_cut {
    uint32_t block, before; /* the cut of that block before it */
    double at_rest;
    size_t t;     /* in sunder_i_bundle.t */
    double share; /* of its block, in the last proposal: those of a block add up to 1 */
    double slope; /* scratch */
} sunder_i_bundle_cut;

typedef struct sunder_i_bundle {
    size_t blocks, copies, members;
    const size_t *first;    /* [blocks + 1] copies of each block; lent */
    const uint32_t *member; /* [copies] whose copy it is; lent */
    const double *others;   /* [copies] 1 - 1 / n of a member with n copies; 0 of one that does not move; lent */
    sunder_i_bundle_cut *cut;
    size_t cuts, cut_capacity;
    double *t;
    size_t numbers, capacity;
    uint32_t *last;     /* [blocks] its last cut */
    double *mix, *mean; /* [2 * copies] of cuts, by their shares; [2 * members] of mix, over a member's copies */
    uint64_t steps;
} sunder_i_bundle;

/* The caller sets the numbers and the lent arrays. False if memory is out; the caller frees it in any case. */
bool sunder_i_bundle_init(sunder_i_bundle *bundle);
void sunder_i_bundle_free(sunder_i_bundle *bundle);
/* Adds a cut of the block, made from its value at x and from t: the places of the block's copies that give this
 * value. False if memory is out. */
bool sunder_i_bundle_add(sunder_i_bundle *bundle, size_t block, double value, const double *x, const double *t);
/* The x with sums over each member's copies as at the centre, at which the cuts promise most, less |x - centre|^2 /
 * (2 stride): *promise is that much. False if the work is to stop. */
bool sunder_i_bundle_propose(sunder_i_bundle *bundle, const double *centre, double stride, double *x, double *promise);

#endif
