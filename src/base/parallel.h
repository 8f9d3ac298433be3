/* parallel.h: independent work on several threads. */
#ifndef SUNDER_I_PARALLEL_H
#define SUNDER_I_PARALLEL_H

#include "sunder_base.h"

/* Processes the items [begin, end). Results are stored by index, so that the order of work has no effect. */
typedef sunder_status (*sunder_i_work)(void *context, size_t begin, size_t end, sunder_error *err);

/* Grains, by the cost of one item: a part of this number of items takes long enough that the cost of its assignment is
 * negligible, and is short enough that no thread waits long at the end. */
enum {
    SUNDER_I_GRAIN_WHOLE = 1,   /* a cluster or a polygon: possibly seconds */
    SUNDER_I_GRAIN_SHAPES = 4,  /* a union of shapes: some hundred microseconds */
    SUNDER_I_GRAIN_PAIRS = 8,   /* the least translation of a pair: some ten microseconds */
    SUNDER_I_GRAIN_TESTS = 32,  /* an exact test of a pair: a few microseconds */
    SUNDER_I_GRAIN_BOXES = 256, /* a search in a tree of boxes */
    SUNDER_I_GRAIN_LOOKS = 8192 /* reading a feature: hardly more time than the memory access */
};

/* Runs `work` over [0, n) in parts of `grain` items on up to `threads` threads, including the calling one; nested calls
 * use the idle threads. Returns the error of the first failing part. */
sunder_status sunder_i_parallel(unsigned threads, size_t n, size_t grain, sunder_i_work work, void *context,
                                sunder_error *err);
/* The same with single items, the largest first, so that no thread starts a large item when the others have nothing
 * left to do; on one thread in the order of their numbers. size: [n] the sizes of the items. */
sunder_status sunder_i_parallel_largest_first(unsigned threads, const size_t *size, size_t n, sunder_i_work work,
                                              void *context, sunder_error *err);

#endif
