/* Invariants that run where NDEBUG is not set: the debug preset, and one configuration of the tests.
 *
 * SUNDER_I_ASSERT  a condition that costs no more than the work that it guards.
 * SUNDER_I_CHECK   a checker, which returns NULL or a sentence. Checkers look at everything, some of them at all pairs:
 *                  they are skipped for more than SUNDER_I_CHECKED things. Some allocate: nothing is checked under an
 *                  allocator of the caller's, e.g. that of a test that counts allocations. */
#ifndef SUNDER_I_INVARIANT_H
#define SUNDER_I_INVARIANT_H

#ifdef NDEBUG
#define SUNDER_I_ASSERT(condition) ((void)0)
#define SUNDER_I_CHECK(checker, n) ((void)0)
#else
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#define SUNDER_I_CHECKED 256 /* a quadratic checker takes a millisecond for this many, so tests can call it often */

bool sunder_i_allocator_is_own(void); /* memory.c: was none set? */

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
