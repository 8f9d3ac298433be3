/* An allocator that fails on request and counts the live allocations. */
#ifndef SUNDER_TESTS_FAILING_H
#define SUNDER_TESTS_FAILING_H

#include <stdbool.h>
#include <stddef.h>

/* Installs the allocator, with no failures. Not for use from several threads. */
void failing_begin(void);
/* The k-th allocation from now on (1 is the next) fails, and with `sticky` also all later ones; 0: none fails. */
void failing_at(size_t k, bool sticky);
/* Has an allocation failed since failing_at()? */
bool failing_happened(void);
/* Blocks not yet freed since failing_begin(). */
size_t failing_outstanding(void);
/* Restores malloc and related functions. */
void failing_end(void);

/* Fails the 1st, 2nd, 3rd ... allocation of attempt() until it completes before the failing allocation. attempt()
 * returns true on success, after freeing what it made, or false if memory ran out. Returns false if an attempt leaked,
 * failed without a failing allocation, or (with survivable false) succeeded in spite of one. */
bool failing_loop(bool (*attempt)(void *context), void *context, bool survivable);

#endif
