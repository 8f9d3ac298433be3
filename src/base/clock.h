/* clock.h: the clock with which phases are timed. */
#ifndef SUNDER_I_CLOCK_H
#define SUNDER_I_CLOCK_H

#include <time.h>

/* Returns the seconds since a fixed moment. */
static inline double sunder_i_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
