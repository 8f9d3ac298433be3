/* Independent work on several threads. */
#ifndef SUNDER_I_PARALLEL_H
#define SUNDER_I_PARALLEL_H

#include "sunder.h"

/* Does items [begin, end). Results are stored by index, so that the order of work has no effect. */
typedef sunder_status (*sunder_i_work)(void *context, size_t begin, size_t end, sunder_error *err);

/* Grains, by the cost of one item: a piece of this many items takes long enough to hide the cost of handing it out, and
 * is short enough that no thread waits long at the end. */
enum {
    SUNDER_I_GRAIN_WHOLE = 1,   /* a cluster, a polygon: seconds, perhaps */
    SUNDER_I_GRAIN_SHAPES = 4,  /* a union of shapes: some hundred microseconds */
    SUNDER_I_GRAIN_PAIRS = 8,   /* a pair's least translation: some ten microseconds */
    SUNDER_I_GRAIN_TESTS = 32,  /* an exact test of a pair: a few microseconds */
    SUNDER_I_GRAIN_BOXES = 256, /* a search in a tree of boxes */
    SUNDER_I_GRAIN_LOOKS = 8192 /* a look at a feature: no more than it takes to get it from memory */
};

/* Runs `work` over [0, n) in pieces of `grain` items on up to `threads` threads, the caller's among them; nested calls
 * use the threads that are idle. Returns the error of the first failing piece. */
sunder_status sunder_i_parallel(unsigned threads, size_t n, size_t grain, sunder_i_work work, void *context,
                                sunder_error *err);
/* The same in single items, the largest first, so that no thread starts a large one when the others have nothing left;
 * on one thread in their order. size: [n] */
sunder_status sunder_i_parallel_largest_first(unsigned threads, const size_t *size, size_t n, sunder_i_work work,
                                              void *context, sunder_error *err);

#endif
