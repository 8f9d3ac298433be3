/* A concave function that is a sum over blocks, approximated from above by cuts; see bundle.c. */
#ifndef SUNDER_I_BUNDLE_H
#define SUNDER_I_BUNDLE_H

#include "base/memory.h"

#include <stdbool.h>
#include <stdint.h>

/* A cut of one block: the block's value at x is at most `at_rest` - 2 x.t, where x.t is the scalar product over all
 * copies of the block. */
typedef struct sunder_i_bundle_cut {
    uint32_t block, before; /* the previous cut of the same block */
    double at_rest;
    size_t t;     /* the index of its t in sunder_i_bundle.t */
    double share; /* its share in the last proposal; the shares of a block's cuts add up to 1 */
    double slope; /* scratch */
} sunder_i_bundle_cut;

typedef struct sunder_i_bundle {
    size_t blocks, copies, members;
    const size_t *first;    /* [blocks + 1] the first copy of each block; borrowed */
    const uint32_t *member; /* [copies] the body of each; borrowed */
    const double *others;   /* [copies] 1 - 1 / n for a body with n copies; 0 if the body does not move; borrowed */
    sunder_i_bundle_cut *cut;
    size_t cuts, cut_capacity;
    double *t;
    size_t numbers, capacity;
    uint32_t *last;     /* [blocks] the last cut of each */
    double *mix, *mean; /* mix: [2 * copies] the positions of the copies in the cuts of their block, weighted by the
                         * cuts' shares; mean: [2 * members] the mean of mix over a body's copies */
    uint64_t steps;
} sunder_i_bundle;

/* The caller has set the numbers and the borrowed arrays. Returns false if memory is out; the caller frees *bundle in
 * any case. */
bool sunder_i_bundle_init(sunder_i_bundle *bundle);
void sunder_i_bundle_free(sunder_i_bundle *bundle);
/* Adds a cut of a block. t: the positions of the block's copies in a layout; value: the block's value for it at x.
 * Returns false if memory is out. */
bool sunder_i_bundle_add(sunder_i_bundle *bundle, size_t block, double value, const double *x, const double *t);
/* Sets x to the point where the cuts promise most, less |x - centre|^2 / (2 stride), among points whose sums over each
 * body's copies are those of the centre. *promise is the value there. Returns false if stopped on request. */
bool sunder_i_bundle_propose(sunder_i_bundle *bundle, const double *centre, double stride, double *x, double *promise);

#endif
