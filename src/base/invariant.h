/* invariant.h: tests of invariants, which are active if NDEBUG is not defined: in the debug preset and in one
 * configuration of the tests.
 *
 *   SUNDER_I_ASSERT  a condition that costs no more than the work that it guards.
 *   SUNDER_I_CHECK   a function that tests invariants, and returns NULL or a message. Such functions test everything,
 *                    some of them all pairs: they are skipped for more than SUNDER_I_CHECKED elements. Some allocate
 *                    memory:
 * they are skipped if the caller has set an allocator, for example in a test that counts
 * allocations. */
#ifndef SUNDER_I_INVARIANT_H
#define SUNDER_I_INVARIANT_H

#ifdef NDEBUG
#define SUNDER_I_ASSERT(condition) ((void)0)
#define SUNDER_I_CHECK(checker, n) ((void)0)
#else
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#define SUNDER_I_CHECKED                                                                                               \
    256 /* a quadratic test takes a millisecond for this number of elements, so that tests can call
                              * it often */

bool sunder_i_allocator_is_own(void); /* memory.c: returns true if the caller has set no allocator */

static inline void sunder_i_broken(const char *sentence, const char *file, int line)
{
    if (!sentence) return;
    fprintf(stderr, "%s:%d: invariant broken: %s\n", file, line, sentence);
    abort();
}

#define SUNDER_I_ASSERT(condition) sunder_i_broken((condition) ? NULL : #condition, __FILE__, __LINE__)
#define SUNDER_I_CHECK(checker, n)                                                                                     \
    sunder_i_broken((n) <= SUNDER_I_CHECKED && sunder_i_allocator_is_own() ? (checker) : NULL, __FILE__, __LINE__)
#endif

#endif
