#include "failing.h"

#include "sunder.h"

#include <stdio.h>
#include <stdlib.h>

static size_t countdown, outstanding;
static bool keep_failing, happened;

static bool fails(void)
{
    if (happened && keep_failing) return true;
    if (countdown == 0 || --countdown > 0) return false;
    happened = true;
    return true;
}

static void *allocate(size_t n)
{
    void *p = fails() ? NULL : malloc(n);
    if (p) outstanding++;
    return p;
}

static void *reallocate(void *old, size_t n)
{
    if (!old) return allocate(n);
    return fails() ? NULL : realloc(old, n);
}

static void release(void *p)
{
    if (p) outstanding--;
    free(p);
}

void failing_begin(void)
{
    countdown = outstanding = 0;
    keep_failing = happened = false;
    sunder_set_allocator(allocate, reallocate, release);
}

void failing_at(size_t k, bool sticky)
{
    countdown = k;
    keep_failing = sticky;
    happened = false;
}

bool failing_happened(void) { return happened; }

size_t failing_outstanding(void) { return outstanding; }

void failing_end(void) { sunder_set_allocator(NULL, NULL, NULL); }

bool failing_loop(bool (*attempt)(void *context), void *context, bool survivable)
{
    bool ok = true, done = false;
    failing_begin();
    for (size_t k = 1; ok && !done; k++) {
        failing_at(k, k % 2 == 0);
        const bool success = attempt(context);
        done = !happened;
        if (outstanding) {
            fprintf(stderr, "allocation %zu fails: %zu blocks are left\n", k, outstanding);
            ok = false;
        }
        if (done ? !success : success && !survivable) {
            fprintf(stderr, "allocation %zu %s, and the call %s\n", k, done ? "does not fail" : "fails",
                    success ? "succeeds" : "fails");
            ok = false;
        }
    }
    failing_end();
    return ok;
}
