/* Independent work on several threads. */
#ifndef SUNDER_I_PARALLEL_H
#define SUNDER_I_PARALLEL_H

#include "sunder.h"

/* Does items [begin, end). Results go where the index says, so that the order of work cannot show. */
typedef sunder_status (*sunder_i_work)(void *context, size_t begin, size_t end, sunder_error *err);

/* Runs work over [0, n) in pieces of `grain` on that many threads, the caller's among them. The error of the first
 * failing piece is returned. */
sunder_status sunder_i_parallel(unsigned threads, size_t n, size_t grain, sunder_i_work work, void *context,
                                sunder_error *err);

#endif
