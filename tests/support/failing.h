/* An allocator that fails on request and counts the live allocations. */
#ifndef SUNDER_TESTS_FAILING_H
#define SUNDER_TESTS_FAILING_H

#include <stdbool.h>
#include <stddef.h>

/* Puts the allocator in, nothing failing. Not for use from several threads. */
void failing_begin(void);
/* The k-th allocation from now on (1 is the next) fails, and all after it where `sticky`; 0: none fails. */
void failing_at(size_t k, bool sticky);
/* Has an allocation failed since failing_at()? */
bool failing_happened(void);
/* Blocks not yet freed since failing_begin(). */
size_t failing_outstanding(void);
/* Puts malloc and friends back. */
void failing_end(void);

/* Fails the 1st, 2nd, 3rd ... allocation of attempt() until it runs through without meeting the failure. attempt()
 * returns true on success and must then have freed what it made, or false where memory was out. False if some attempt
 * leaked, or succeeded in spite of a failure that it may not survive (survivable false), or failed without one. */
bool failing_loop(bool (*attempt)(void *context), void *context, bool survivable);

#endif
