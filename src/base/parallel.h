/* Independent work on several threads. */
#ifndef SUNDER_I_PARALLEL_H
#define SUNDER_I_PARALLEL_H

#include "sunder.h"

/* Does items [begin, end). Results go where the index says, so that the order of work cannot show. */
typedef sunder_status (*sunder_i_work)(void *context, size_t begin, size_t end, sunder_error *err);

/* Grains, by what one item costs: so many take long enough that handing them out does not show, and few enough that no
 * thread waits for another at the end. */
enum {
    SUNDER_I_GRAIN_WHOLE = 1,   /* a cluster, a polygon: seconds, perhaps */
    SUNDER_I_GRAIN_SHAPES = 4,  /* a union of shapes: some hundred microseconds */
    SUNDER_I_GRAIN_PAIRS = 8,   /* a pair's least translation: some ten microseconds */
    SUNDER_I_GRAIN_TESTS = 32,  /* an exact test of a pair: a few microseconds */
    SUNDER_I_GRAIN_BOXES = 256, /* a search in a tree of boxes */
    SUNDER_I_GRAIN_LOOKS = 8192 /* a look at a feature: no more than it takes to get it from memory */
};

/* Runs work over [0, n) in pieces of `grain` on that many threads, the caller's among them; from within such work on no
 * more than those that have no more to do there. The error of the first failing piece is returned. */
sunder_status sunder_i_parallel(unsigned threads, size_t n, size_t grain, sunder_i_work work, void *context,
                                sunder_error *err);
/* The same of whole items, the largest first, so that no thread begins with a large one when others have nothing more
 * to do; on one thread in their order. size: [n] */
sunder_status sunder_i_parallel_largest_first(unsigned threads, const size_t *size, size_t n, sunder_i_work work,
                                              void *context, sunder_error *err);

#endif
